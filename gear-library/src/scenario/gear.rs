//! Gear of a scenario: placed assemblies, lines with their initial shapes, segment lengths.

use endline_sdk::BodyPart;
use endline_sim::model::Resolution;

use crate::assembly::{Attributes, PartLine, line};
use crate::diagnostic::{At, Place};
use crate::fields::{Fields, Range};
use crate::limits;
use crate::line::{LineMake, line_choices};
use crate::tree::Content;
use crate::units::Quantity;

use super::parts::LineStart;

/// An assembly of the library, placed.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedGear {
    /// Prefix of the ids of its parts; required if there are several.
    pub id: Option<At<String>>,
    /// Id of the assembly.
    pub assembly: At<String>,
    /// Its origin, east and north [m].
    pub position_m: [f64; 2],
    /// Compass bearing of its x axis [rad].
    pub heading_rad: f64,
    /// Attributes that override the assembly's.
    pub attributes: Attributes,
    /// Replaced ropes: id of the line, id of the rope.
    pub ropes: Vec<(At<String>, At<String>)>,
    /// Makes that override the assembly's: id of the line.
    pub lines: Vec<(At<String>, LineMake)>,
}

/// Reads a `[[gear]]`; `None` without an assembly, which is reported.
pub(super) fn placed_gear(fields: &Fields<'_>) -> Option<PlacedGear> {
    let id = fields.id("id");
    let assembly = fields.need_text("assembly", "write the id of an assembly, such as \"single\"");
    let position = fields.values("position", Quantity::Length, &[2]);
    let heading = fields.value("heading", Quantity::Angle, Range::Any);
    let attributes = Attributes::read(fields, "attributes");
    let ropes = rope_choices(fields);
    let lines = line_choices(fields);
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

/// `[gear.ropes]`: id of a rope by id of a line.
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

/// Reads a `[[line]]` with its initial shape; `None` if a required field is missing, which is reported.
pub(super) fn free_line(fields: &Fields<'_>) -> Option<(PartLine, LineStart)> {
    let part = line(fields);
    let start = fields.word("start", &["straight", "catenary", "around", "wrapped"]);
    let start = match start.as_ref().map_or("straight", |start| start.value.as_str()) {
        "catenary" => Some(LineStart::Catenary),
        "around" => around(fields),
        "wrapped" => wrapped(fields),
        _ => Some(LineStart::Straight),
    };
    Some((part?, start?))
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
            .push(node.place.error(message, "write turns = 2 or -2, or remove hitched"));
    }
    Some(LineStart::Around { obstacle: obstacle?, turns, hitched })
}

fn wrapped(fields: &Fields<'_>) -> Option<LineStart> {
    let Some(tables) = fields.get("wrap").map(|_| fields.tables("wrap").len()) else {
        fields.missing("wrap", "write each wrap under [[line.wrap]], with `part` and `turns`");
        return None;
    };
    let wraps = fields.each("wrap", WrapOf::read);
    (wraps.len() == tables).then_some(LineStart::Wrapped(wraps))
}

/// Default station of a wrap on a fin: closer to the root a plane across the fin intersects the body.
const USUAL_ON_FINS: f64 = 0.7;

/// A `[[line.wrap]]`: turns of a line about a part of the whale at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct WrapOf {
    /// The part.
    pub part: BodyPart,
    /// Turns; negative for left-handed about the part's axis.
    pub turns: f64,
    /// Place of its middle along the part: 0 at the end closer to the snout or at the root, 1 at the other.
    pub station: f64,
    /// Distance along the part per turn, aft or to the tip [m]; `None` for five rope diameters.
    pub pitch_m: Option<f64>,
    /// Its start, from the whale's back, right-handed about the axis [rad]; `None` for the shortest path.
    pub azimuth_rad: Option<f64>,
    /// Excess of rope over the tight path, as a share.
    pub slack: f64,
    /// Initial tension [N].
    pub pretension_n: f64,
    /// Longest segment [m]; `None` for the default of the part.
    pub segment_m: Option<f64>,
    /// Unstretched rope before it, from the wrap before or from the line's `from` end [m].
    pub before_m: Option<f64>,
    /// Its place.
    pub place: Place,
}

impl WrapOf {
    /// Reads a wrap; `None` if a required field is missing, which is reported.
    pub(super) fn read(fields: &Fields<'_>) -> Option<Self> {
        let parts = BodyPart::ALL.map(|part| (part.name(), part));
        let help = "write the part of the whale, such as \"peduncle\"";
        let part = fields.need_choice("part", help, &parts);
        let turns = fields.need_value("turns", Quantity::Ratio, Range::Between(-20.0, 20.0));
        if let Some(none) = turns.as_ref().filter(|turns| turns.value.abs() < 0.05) {
            fields.problems().push(none.place.error(
                "`turns` is almost zero",
                "write at least 0.05 turns, or at most -0.05 (left-handed)",
            ));
        }
        let station = fields.value("station", Quantity::Ratio, Range::Between(0.0, 1.0));
        let pitch = fields.value("pitch", Quantity::Length, Range::Between(-5.0, 5.0));
        let azimuth = fields.value("azimuth", Quantity::Angle, Range::Any);
        let slack = fields.value("slack", Quantity::Ratio, Range::Between(0.0, 2.0));
        let pretension = fields.value("pretension", Quantity::Force, Range::NotNegative);
        let segment = fields.value("segment", Quantity::Length, Range::Between(2e-3, 1.0));
        let before = fields.value("before", Quantity::Length, Range::NotNegative);
        if let (Some(slack), Some(pretension)) = (&slack, &pretension)
            && slack.value > 0.0
            && pretension.value > 0.0
        {
            fields.problems().push(slack.place.error(
                "both `slack` and `pretension` are present",
                "a slack wrap has no tension: keep one of them",
            ));
        }
        let value = |at: Option<At<f64>>| at.map(|at| at.value);
        let part = part?;
        Some(Self {
            part,
            turns: turns?.value,
            station: value(station).unwrap_or(if part.on_trunk() { 0.5 } else { USUAL_ON_FINS }),
            pitch_m: value(pitch),
            azimuth_rad: value(azimuth),
            slack: value(slack).unwrap_or(0.0),
            pretension_n: value(pretension).unwrap_or(0.0),
            segment_m: value(segment),
            before_m: value(before),
            place: fields.place.clone(),
        })
    }
}

/// A `[[segments]]`: longest segment of some lines.
#[derive(Clone, Debug, PartialEq)]
pub struct LineSegments {
    /// Id of a line, or its beginning and `*`.
    pub line: At<String>,
    /// Longest segment [m].
    pub longest_m: f64,
}

impl LineSegments {
    pub(super) fn read(fields: &Fields<'_>) -> Option<Self> {
        let line = fields.need_text(
            "line",
            "write the id of a line, or its beginning and `*`, such as \"endline-*\"",
        );
        let longest =
            fields.need_value("longest", Quantity::Length, Range::Within(&limits::SEGMENT));
        Some(Self { line: line?, longest_m: longest?.value })
    }

    /// Whether they apply to a line.
    pub fn are_of(&self, id: &str) -> bool {
        match self.line.value.strip_suffix('*') {
            Some(begin) => id.starts_with(begin),
            None => id == self.line.value,
        }
    }

    /// Whether they name a single line, which must exist.
    pub fn name_one(&self) -> bool {
        !self.line.value.ends_with('*')
    }
}

/// Allowed lengths of segments [m].
const LENGTHS: Range = Range::Within(&limits::SEGMENT);

/// Reads `[resolution]`, segment lengths near and far from the whale.
pub(super) fn resolution(fields: &Fields<'_>, whale: bool) -> Resolution {
    let usual = Resolution::default();
    let near = fields.value("near", Quantity::Length, LENGTHS);
    let edges = fields.value("edges", Quantity::Length, LENGTHS);
    let far = fields.value("far", Quantity::Length, LENGTHS);
    let value = |length: &Option<At<f64>>| length.as_ref().map(|length| length.value);
    let near_m = value(&near).unwrap_or(usual.near_m);
    let edge_m = value(&edges).unwrap_or(usual.edge_m.min(near_m));
    let far_m = value(&far).unwrap_or(usual.far_m.max(near_m));
    for (length, is_wrong, message) in [
        (&edges, edge_m > near_m, "`edges` is longer than `near`"),
        (&far, far_m < near_m, "`far` is shorter than `near`"),
    ] {
        if let (Some(length), true) = (length, is_wrong) {
            let help = format!(
                "segments must be shortest near edges and longest far away: edges {edge_m} m, near {near_m} m, far {far_m} m"
            );
            fields.problems().push(length.place.error(message, help));
        }
    }
    if !whale {
        let help =
            "add a [whale] or remove this table; `segment` or `rope_nodes` sets equal segments";
        fields.problems().push(fields.place.error("the resolution needs a whale", help));
    }
    fields.finish();
    Resolution { near_m, edge_m, far_m }
}
