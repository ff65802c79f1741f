//! `[[line.wrap]]`: turns of rope that lie about a part of the whale when the run starts.

use endline_sdk::BodyPart;

use crate::diagnostic::Place;
use crate::fields::{Fields, Problems, Range};
use crate::tree::Node;
use crate::units::Quantity;

/// Station of a wrap on a fin that names none: nearer to the root a plane across the fin cuts the body.
const USUAL_ON_FINS: f64 = 0.7;

/// Turns of a line about a part of the whale.
#[derive(Clone, Debug, PartialEq)]
pub struct WrapOf {
    /// The part.
    pub part: BodyPart,
    /// How often round [turns]; below zero is left-handed about the part's axis.
    pub turns: f64,
    /// Where its middle lies along the part: 0 at the end nearer the snout or at the root, 1 at the other.
    pub station: f64,
    /// Way along the part in each turn, aft or to the tip [m]; `None` for five rope diameters.
    pub pitch_m: Option<f64>,
    /// Where it begins, from the whale's back, right-handed about the axis [rad]; `None` for the shortest way to it and on.
    pub azimuth_rad: Option<f64>,
    /// Rope over the tight way round, as a share of it.
    pub slack: f64,
    /// Tension it is laid with [N].
    pub pretension_n: f64,
    /// Longest segment in it [m]; `None` for the usual of the part.
    pub segment_m: Option<f64>,
    /// Unstretched rope before it, from the wrap before or from the line's `from` end [m].
    pub before_m: Option<f64>,
    /// Where it stands.
    pub place: Place,
}

impl WrapOf {
    /// Reads one; `None` where something needed is missing, which is reported.
    pub(super) fn read(node: &Node, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let names = BodyPart::ALL.map(BodyPart::name);
        let part = fields
            .need_text("part", "write the part of the whale it goes round, such as \"peduncle\"");
        let part = part.and_then(|_| fields.word("part", &names));
        let turns = fields.need_value("turns", Quantity::Ratio, Range::Between(-20.0, 20.0));
        if let Some(none) = turns.as_ref().filter(|turns| turns.value.abs() < 0.05) {
            problems.push(none.place.error(
                "`turns` is next to nothing",
                "write at least 0.05 turns, or below -0.05, left-handed",
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
            problems.push(slack.place.error(
                "both `slack` and `pretension` are given",
                "a slack wrap bears no tension: keep one of them",
            ));
        }
        fields.finish();
        let value = |at: Option<crate::diagnostic::At<f64>>| at.map(|at| at.value);
        let part = BodyPart::ALL
            .into_iter()
            .find(|known| part.as_ref().is_some_and(|part| part.value == known.name()))?;
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
            place: node.place.clone(),
        })
    }
}
