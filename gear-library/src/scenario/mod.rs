//! The scenario document: sea, gear, whale, fixtures and probes of one run.

mod field;
mod gear;
mod parts;
mod sea;
mod whale;

use endline_sim::DVec3;
use endline_sim::model::Resolution;

use crate::assembly::{PartLine, PartLink, link};
use crate::diagnostic::{At, Diagnostic, Place};
use crate::entry::{self, Entry};
use crate::fields::{Fields, Problems, Range, read_file};
use crate::items::Condition;
use crate::limits;
use crate::tree::{self, Node};
use crate::units::Quantity;

pub use gear::{LineSegments, PlacedGear, WrapOf};
pub use parts::{Fixture, FreeBody, LineStart, ObstacleOf, PositionOf, ProbeOf, ProbePart};
pub(crate) use sea::direction;
pub use sea::{Bed, CurrentOf, CurrentRow, RowHeight, Sea};
pub use whale::{
    AnswersToTouch, FrictionChoice, FrictionOn, PilotOf, PlacedWhale, TiringOf, TriggerOf,
};

/// A scenario as read; [`assemble`](crate::assemble) resolves ids.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Name shown to the user.
    pub name: String,
    /// Remarks shown to the user; may be empty.
    pub notes: String,
    /// The file itself.
    pub place: Place,
    /// Length of the run [s].
    pub duration_s: f64,
    /// Seed of random draws.
    pub seed: u64,
    /// Whether the solver's step is chosen automatically.
    pub auto_step: bool,
    /// Step between inputs and of the solver [s].
    pub step_s: Option<f64>,
    /// Greatest step while rope is near the whale [s].
    pub contact_step_s: Option<f64>,
    /// Tolerance of contact forces in a step near the whale, as a share of the greatest.
    pub contact_tolerance: Option<f64>,
    /// Total number of rope nodes.
    pub rope_nodes: Option<At<u64>>,
    /// Longest segment [m], without a number of nodes.
    pub segment_m: Option<At<f64>>,
    /// Lines with another longest segment; a later entry overrides an earlier one.
    pub line_segments: Vec<LineSegments>,
    /// Segment lengths by distance from the whale.
    pub resolution: Option<Resolution>,
    /// Whether weak links can part.
    pub weak_links: bool,
    /// Whether neither rope nor weak link parts, whatever its tension.
    pub unbreakable: bool,
    /// Whether rope touches the bodies of the rig.
    pub rope_on_bodies: bool,
    /// Whether the bodies of the rig touch the whale.
    pub bodies_on_whale: bool,
    /// Whether the bodies of the rig touch each other.
    pub bodies_on_bodies: bool,
    /// Whether rope touches rope.
    pub rope_on_rope: bool,
    /// Whether momentum and energy of the gear are reported by source.
    pub balance: Option<bool>,
    /// Friction of rope on rope.
    pub rope_friction: Option<At<f64>>,
    /// Whether the run starts as its parts are placed, without statics.
    pub as_placed: bool,
    /// Default condition of ropes.
    pub rope_condition: Condition,
    /// Whether rope resists bending.
    pub rope_bending: bool,
    /// Whether strengths of ropes and weak links vary at random, by the seed: `strength_scatter`.
    pub strength_variation: bool,
    /// The sea.
    pub sea: Sea,
    /// Gear from the library.
    pub gear: Vec<PlacedGear>,
    /// The whale, if any.
    pub whale: Option<PlacedWhale>,
    /// Friction of rope on whale.
    pub friction: Option<FrictionChoice>,
    /// Ropes written in place.
    pub ropes: Vec<Entry>,
    /// Fixed and driven points.
    pub fixtures: Vec<Fixture>,
    /// Free joints written in place: id and initial place [m].
    pub joints: Vec<(At<String>, DVec3)>,
    /// Fixed solids.
    pub obstacles: Vec<ObstacleOf>,
    /// Bodies written in place.
    pub bodies: Vec<FreeBody>,
    /// Lines written in place, with their initial shape.
    pub lines: Vec<(PartLine, LineStart)>,
    /// Weak links written in place.
    pub links: Vec<PartLink>,
    /// Probes.
    pub probes: Vec<ProbeOf>,
}

impl Scenario {
    /// Reads a scenario's text; `name` is its path as shown in messages.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        read_file(name, text, Self::from_node)
    }

    fn from_node(node: &Node, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, file) = entry::header(&fields, "scenario", problems);
        let duration =
            fields.need_value("duration", Quantity::Time, Range::Within(&limits::DURATION));
        let whale = fields.table("whale");
        let resolution = fields.table("resolution");
        let start = fields.choice("start", &[("rest", false), ("placed", true)]);
        let flag = |key, usual| fields.flag(key).unwrap_or(usual);
        let seed = fields.count("seed", &limits::SEED).map_or(1, |seed| seed.value);
        let mut gear = fields.each("gear", gear::placed_gear);
        gear.extend(fields.each("field", |table| field::read(table, seed)).into_iter().flatten());
        let scenario = Self {
            name,
            notes,
            place: node.place.clone(),
            duration_s: duration.map_or(60.0, |duration| duration.value),
            seed,
            step_s: step(&fields),
            auto_step: is_auto(&fields),
            contact_step_s: seconds(&fields, "contact_step"),
            contact_tolerance: fields
                .value("contact_tolerance", Quantity::Ratio, Range::Between(1e-4, 0.2))
                .map(|tolerance| tolerance.value),
            rope_nodes: fields.count("rope_nodes", &limits::ROPE_NODES),
            segment_m: fields.value("segment", Quantity::Length, Range::Within(&limits::SEGMENT)),
            line_segments: fields.each("segments", LineSegments::read),
            weak_links: flag("weak_links", true),
            unbreakable: flag("unbreakable", false),
            rope_on_bodies: flag("rope_on_bodies", true),
            bodies_on_whale: flag("bodies_on_whale", true),
            bodies_on_bodies: flag("bodies_on_bodies", true),
            rope_on_rope: flag("rope_on_rope", true),
            balance: fields.flag("balance"),
            rope_friction: fields.value("rope_friction", Quantity::Ratio, Range::Between(0.0, 2.0)),
            as_placed: start.is_some_and(|start| start.value),
            rope_condition: fields
                .choice("rope_condition", &Condition::WORDS)
                .map_or(Condition::Secant, |condition| condition.value),
            rope_bending: flag("rope_bending", false),
            strength_variation: flag("strength_scatter", true),
            sea: sea::read(&fields),
            gear,
            resolution: resolution.map(|table| gear::resolution(&table, whale.is_some())),
            whale: whale.as_ref().and_then(PlacedWhale::read),
            friction: fields.inside("friction", whale::friction).flatten(),
            ropes: parts::ropes(&fields, &file),
            fixtures: fields.each("fixture", parts::fixture),
            joints: fields.each("joint", parts::joint),
            obstacles: fields.each("obstacle", |table| parts::obstacle(table, &file)),
            bodies: fields.each("body", |table| parts::body(table, &file)),
            lines: fields.each("line", gear::free_line),
            links: fields.each("link", |table| link(table, true)),
            probes: fields.each("probe", parts::probe),
        };
        scenario.check_whole(&fields);
        fields.finish();
        Some(scenario)
    }

    fn check_whole(&self, fields: &Fields<'_>) {
        if let (Some(nodes), Some(_)) = (&self.rope_nodes, &self.segment_m) {
            let message = "both `rope_nodes` and `segment` are present";
            fields.problems().push(nodes.place.error(message, "keep one of them"));
        }
        if let (Some(lines), None) = (self.line_segments.first(), &self.segment_m) {
            let message = "[[segments]] needs a `segment` for the other lines";
            let help = "write one, such as segment = \"1 m\", instead of `rope_nodes`";
            fields.problems().push(lines.line.place.error(message, help));
        }
        if let (Some(friction), false) = (&self.rope_friction, self.rope_on_rope) {
            let message = "`rope_friction` has no effect: ropes pass through each other here";
            fields
                .problems()
                .push(friction.place.error(message, "remove it, or `rope_on_rope = false`"));
        }
        if self.gear.len() > 1 {
            for gear in self.gear.iter().filter(|gear| gear.id.is_none()) {
                let message = "this gear needs an `id`, because there are several";
                fields.problems().push(gear.assembly.place.error(
                    message,
                    "write an id such as id = \"north\"; its parts are then north/trap …",
                ));
            }
        }
    }
}

/// Whether `step = "auto"`.
fn is_auto(fields: &Fields<'_>) -> bool {
    matches!(fields.get("step"), Some(Node { content: tree::Content::Text(word), .. }) if word == "auto")
}

/// `step`: a time, or "auto" for an automatic step.
fn step(fields: &Fields<'_>) -> Option<f64> {
    if is_auto(fields) {
        return None;
    }
    seconds(fields, "step")
}

/// A time step [s].
fn seconds<'a>(fields: &Fields<'a>, key: &'a str) -> Option<f64> {
    fields.value(key, Quantity::Time, Range::Within(&limits::STEP)).map(|step| step.value)
}

/// A place as east, north, up [m].
pub(crate) fn place3(values: &[f64]) -> DVec3 {
    DVec3::new(values[0], values[1], values[2])
}
