//! Points of a body where a line can be made fast, by name.
//!
//! Places are measured from the middle of the box or of the float: along its length, to port, up (a buoy's
//! axis is up). The first point of a list is where a line goes that names none.

use crate::diagnostic::At;
use crate::fields::{Fields, Problems, Provenance, provenance_over};
use crate::tree::Node;
use crate::units::Quantity;

/// A point with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Name, such as `bridle-port`.
    pub name: String,
    /// Place from the middle of the box or float: along, to port, up [m].
    pub at_m: [f64; 3],
}

/// Reads the `[[point]]`s of a trap, buoy or anchor.
pub(crate) fn points(fields: &Fields<'_>, file: &Provenance) -> Vec<Point> {
    let mut read: Vec<Point> = Vec::new();
    for node in fields.tables("point") {
        let Some((name, point)) = point(node, file, fields.problems()) else { continue };
        if read.iter().any(|known| known.name == point.name) {
            let message = format!("there are two points `{}`", point.name);
            fields.problems().push(name.place.error(message, "give one of them another name"));
        }
        read.push(point);
    }
    read
}

fn point(node: &Node, file: &Provenance, problems: &Problems) -> Option<(At<String>, Point)> {
    let fields = Fields::of(node, problems);
    let name = fields.need_text("name", "write a name such as \"eye\"");
    let row = provenance_over(&fields, file);
    if fields.get("at").is_none() {
        fields.missing(
            "at",
            "write along, to port and up from the middle, as [\"0.4 m\", \"0 m\", \"0.1 m\"]",
        );
    }
    let at = fields.values("at", Quantity::Length, &[3]);
    if row.source.is_none() || row.confidence.is_none() {
        let message = format!("`{}` has no source or no confidence", node.place.field);
        problems.push(node.place.error(
            message,
            "write source = \"…\" and confidence = \"measured\" here, or for the whole file",
        ));
    }
    fields.finish();
    let name = name?;
    if name.value.is_empty() || name.value.contains(':') {
        let message = format!("`{}` cannot be a point's name", name.value);
        problems
            .push(name.place.error(message, "a name has letters, digits and dashes; the colon stands before it where a line is made fast"));
    }
    let at_m = <[f64; 3]>::try_from(at?.value).ok()?;
    let point = Point { name: name.value.clone(), at_m };
    Some((name, point))
}

/// The usual points of a body with an item's own added; one of a usual name takes that one's place.
#[must_use]
pub fn with_own(mut usual: Vec<Point>, own: &[Point]) -> Vec<Point> {
    for point in own {
        match usual.iter_mut().find(|known| known.name == point.name) {
            Some(known) => known.at_m = point.at_m,
            None => usual.push(point.clone()),
        }
    }
    usual
}
