//! Lines written into a scenario, and the shapes they start in.

use crate::assembly::{PartLine, line_fields};
use crate::fields::{Fields, Problems, Range};
use crate::tree::Node;
use crate::units::Quantity;

use super::parts::LineStart;
use super::wrap::WrapOf;

/// Reads a `[[line]]` with its start shape; `None` where something needed is missing, which is reported.
pub(super) fn free_line(node: &Node, problems: &Problems) -> Option<(PartLine, LineStart)> {
    let fields = Fields::of(node, problems);
    let line = line_fields(&fields);
    let start = fields.word("start", &["straight", "catenary", "around", "wrapped"]);
    let start = match start.as_ref().map_or("straight", |start| start.value.as_str()) {
        "catenary" => Some(LineStart::Catenary),
        "around" => around(&fields),
        "wrapped" => wrapped(&fields),
        _ => Some(LineStart::Straight),
    };
    fields.finish();
    Some((line?, start?))
}

fn around(fields: &Fields<'_>) -> Option<LineStart> {
    let obstacle = fields.need_text("around", "write the id of a cylinder among the obstacles");
    let turns = fields.need_value("turns", Quantity::Ratio, Range::Between(-100.0, 100.0));
    let (turns, hitched) = (turns?.value, fields.flag("hitched").unwrap_or(false));
    if let (Some(node), true) = (fields.get("hitched"), hitched && (turns.abs() - 2.0).abs() > 0.3)
    {
        let message = format!("two half hitches are two turns, not {turns}");
        fields
            .problems()
            .push(node.place.error(message, "write turns = 2 or -2, or take hitched out"));
    }
    Some(LineStart::Around { obstacle: obstacle?, turns, hitched })
}

fn wrapped(fields: &Fields<'_>) -> Option<LineStart> {
    let wraps = fields.tables("wrap");
    if wraps.is_empty() && fields.get("wrap").is_none() {
        fields.missing("wrap", "write each wrap under [[line.wrap]], with `part` and `turns`");
        return None;
    }
    let wraps: Vec<Option<WrapOf>> =
        wraps.iter().map(|node| WrapOf::read(node, fields.problems())).collect();
    wraps.into_iter().collect::<Option<Vec<_>>>().map(LineStart::Wrapped)
}
