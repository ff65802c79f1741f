//! `[resolution]`: segment lengths that follow the whale.

use endline_sim::model::Resolution;

use crate::fields::{Fields, Range};
use crate::limits;
use crate::units::Quantity;

/// Lengths a segment may be given [m].
const LENGTHS: Range = Range::Within(&limits::SEGMENT);

/// Reads the table; what it does not name is as usual.
pub(super) fn read(fields: &Fields<'_>, whale: bool) -> Resolution {
    let usual = Resolution::default();
    let near = fields.value("near", Quantity::Length, LENGTHS);
    let edges = fields.value("edges", Quantity::Length, LENGTHS);
    let far = fields.value("far", Quantity::Length, LENGTHS);
    let value =
        |given: &Option<crate::diagnostic::At<f64>>| given.as_ref().map(|given| given.value);
    let near_m = value(&near).unwrap_or(usual.near_m);
    let edge_m = value(&edges).unwrap_or(usual.edge_m.min(near_m));
    let far_m = value(&far).unwrap_or(usual.far_m.max(near_m));
    for (given, wrong, message) in [
        (&edges, edge_m > near_m, "`edges` is longer than `near`"),
        (&far, far_m < near_m, "`far` is shorter than `near`"),
    ] {
        if let (Some(given), true) = (given, wrong) {
            let help = format!(
                "segments are shortest near edges and longest far away: edges {edge_m} m, near {near_m} m, far {far_m} m"
            );
            fields.problems().push(given.place.error(message, help));
        }
    }
    if !whale {
        let help =
            "add a [whale] or take this table out; `segment` or `rope_nodes` sets equal segments";
        fields
            .problems()
            .push(fields.place.error("there is no whale for the resolution to follow", help));
    }
    fields.finish();
    Resolution { near_m, edge_m, far_m }
}
