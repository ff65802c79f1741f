//! Gear of the library, placed in a scenario.

use crate::attributes::Attributes;
use crate::diagnostic::At;
use crate::fields::{Fields, Problems, Range};
use crate::line::{LineMake, line_choices};
use crate::tree::{Content, Node};
use crate::units::Quantity;

/// An assembly of the library, placed.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedGear {
    /// Prefix of its parts' ids; needed where several are placed.
    pub id: Option<At<String>>,
    /// Id of the assembly.
    pub assembly: At<String>,
    /// Where its origin lies, east and north [m].
    pub position_m: [f64; 2],
    /// Compass bearing of its x axis [rad].
    pub heading_rad: f64,
    /// Attributes over the assembly's.
    pub attributes: Attributes,
    /// Ropes over the assembly's: id of the line, id of the rope.
    pub ropes: Vec<(At<String>, At<String>)>,
    /// How lines are made up, over the assembly's: id of the line.
    pub lines: Vec<(At<String>, LineMake)>,
}

/// Reads a `[[gear]]`; `None` where it names no assembly, which is reported.
pub(super) fn placed_gear(node: &Node, problems: &Problems) -> Option<PlacedGear> {
    let fields = Fields::of(node, problems);
    let id = fields.id("id");
    let assembly = fields.need_text("assembly", "write the id of an assembly, such as \"single\"");
    let position = fields.values("position", Quantity::Length, &[2]);
    let heading = fields.value("heading", Quantity::Angle, Range::Any);
    let attributes = Attributes::read(&fields, "attributes");
    let ropes = rope_choices(&fields);
    let lines = line_choices(&fields);
    fields.finish();
    Some(PlacedGear {
        id,
        assembly: assembly?,
        position_m: position.map_or([0.0; 2], |xy| [xy.value[0], xy.value[1]]),
        heading_rad: heading.map_or(std::f64::consts::FRAC_PI_2, |heading| heading.value),
        attributes,
        ropes,
        lines,
    })
}

/// `[gear.ropes]`: a rope for a line, by id.
fn rope_choices(fields: &Fields<'_>) -> Vec<(At<String>, At<String>)> {
    let Some(table) = fields.table("ropes") else { return Vec::new() };
    let mut choices = Vec::new();
    for (line, key, node) in table.rest() {
        match &node.content {
            Content::Text(rope) => choices.push((
                At { value: line.clone(), place: key.clone() },
                At { value: rope.clone(), place: node.place.clone() },
            )),
            other => {
                let message = format!("`{line}` is {}, not the id of a rope", other.noun());
                fields.problems().push(node.place.error(message, "write the rope's id in quotes"));
            }
        }
    }
    choices
}
