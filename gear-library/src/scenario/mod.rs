//! The scenario document: sea, gear, whale, fixtures and probes of one run.

mod bearing;
mod current;
mod friction;
mod gear;
mod lines;
mod obstacle;
mod parts;
mod pilot;
mod resolution;
mod sea;
mod segments;
mod waves;
mod whale;
mod wrap;

use endline_sim::DVec3;
use endline_sim::model::Resolution;

use crate::assembly::{PartLine, PartLink, link};
use crate::diagnostic::{At, Diagnostic, Place};
use crate::entry::{self, Entry};
use crate::fields::{Fields, Problems, Range};
use crate::items::Condition;
use crate::limits;
use crate::tree::{self, Node};
use crate::units::Quantity;

pub use current::{CurrentOf, CurrentRow, RowHeight};
pub use friction::{FrictionChoice, FrictionOn};
pub use gear::PlacedGear;
pub use obstacle::ObstacleOf;
pub use parts::{Fixture, FreeBody, LineStart, ProbeOf, ProbePart};
pub use pilot::{PilotOf, TriggerOf};
pub use sea::{Bed, Sea};
pub use segments::LineSegments;
pub use whale::{AnswerToTouch, PlacedWhale};
pub use wrap::WrapOf;

/// A scenario as read; ids are looked up by [`assemble`](crate::assemble).
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
    /// Seed of everything drawn at random.
    pub seed: u64,
    /// Whether the program chooses the solver's step.
    pub auto_step: bool,
    /// Step between inputs, which is then the solver's too [s].
    pub step_s: Option<f64>,
    /// Longest step while rope is near the whale [s], where the scenario chooses one.
    pub contact_step_s: Option<f64>,
    /// What push and friction may miss by in a step near the whale, as a share of the greatest, where the scenario says.
    pub contact_tolerance: Option<f64>,
    /// How many rope nodes there are in all.
    pub rope_nodes: Option<At<u64>>,
    /// Longest segment [m], where no node count is given.
    pub segment_m: Option<At<f64>>,
    /// Lines with another longest segment; of two that name a line, the later counts.
    pub line_segments: Vec<LineSegments>,
    /// How segment lengths follow the whale, where they do.
    pub resolution: Option<Resolution>,
    /// Whether weak links can part.
    pub weak_links: bool,
    /// Whether rope touches the bodies of the rig.
    pub rope_on_bodies: bool,
    /// Whether the bodies of the rig touch the whale.
    pub bodies_on_whale: bool,
    /// Whether the bodies of the rig touch each other.
    pub bodies_on_bodies: bool,
    /// Whether rope touches rope.
    pub rope_on_rope: bool,
    /// Whether momentum and energy of the gear are told by source, where the scenario says.
    pub balance: Option<bool>,
    /// Friction of rope on rope, where the scenario says.
    pub rope_friction: Option<At<f64>>,
    /// Whether the run starts as its parts are placed, without statics.
    pub as_placed: bool,
    /// Condition of every rope whose line names none.
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
    /// Free joints written in place: id and first guess of the place [m].
    pub joints: Vec<(At<String>, DVec3)>,
    /// Solid things that stand still.
    pub obstacles: Vec<ObstacleOf>,
    /// Bodies written in place.
    pub bodies: Vec<FreeBody>,
    /// Lines written in place, with their start shape.
    pub lines: Vec<(PartLine, LineStart)>,
    /// Weak links written in place.
    pub links: Vec<PartLink>,
    /// Probes.
    pub probes: Vec<ProbeOf>,
}

impl Scenario {
    /// Reads a scenario's text; `name` is its path as shown in messages.
    ///
    /// # Errors
    /// Everything wrong with it that can be seen without the library.
    pub fn read(name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let problems = Problems::default();
        let node = tree::read(name, text).map_err(|problem| vec![*problem])?;
        let scenario = Self::from_node(&node, &problems);
        match scenario {
            Some(scenario) if !problems.any_error() => Ok(scenario),
            _ => Err(problems.into_sorted()),
        }
    }

    fn from_node(node: &Node, problems: &Problems) -> Option<Self> {
        let fields = Fields::of(node, problems);
        let (name, notes, file) = entry::header(&fields, "scenario", problems);
        let duration =
            fields.need_value("duration", Quantity::Time, Range::Within(&limits::DURATION));
        let whale = fields.table("whale");
        let resolution = fields.table("resolution");
        let start = fields.word("start", &["rest", "placed"]);
        let rope_condition = fields.word("rope_condition", &Condition::WORDS);
        let flag = |key, usual| fields.flag(key).unwrap_or(usual);
        let each = |key: &'static str| fields.tables(key).iter();
        let scenario = Self {
            name,
            notes,
            place: node.place.clone(),
            duration_s: duration.map_or(60.0, |duration| duration.value),
            seed: fields.count("seed", &limits::SEED).map_or(1, |seed| seed.value),
            step_s: step(&fields),
            auto_step: is_auto(&fields),
            contact_step_s: seconds(&fields, "contact_step"),
            contact_tolerance: contact_tolerance(&fields),
            rope_nodes: fields.count("rope_nodes", &limits::ROPE_NODES),
            segment_m: segment(&fields),
            line_segments: each("segments")
                .filter_map(|node| LineSegments::read(node, problems))
                .collect(),
            weak_links: flag("weak_links", true),
            rope_on_bodies: flag("rope_on_bodies", true),
            bodies_on_whale: flag("bodies_on_whale", true),
            bodies_on_bodies: flag("bodies_on_bodies", true),
            rope_on_rope: flag("rope_on_rope", true),
            balance: fields.flag("balance"),
            rope_friction: rope_friction(&fields),
            as_placed: start.is_some_and(|start| start.value == "placed"),
            rope_condition: rope_condition
                .and_then(|word| Condition::from_word(&word.value))
                .unwrap_or_default(),
            rope_bending: flag("rope_bending", false),
            strength_variation: flag("strength_scatter", true),
            sea: sea::read(&fields),
            gear: each("gear").filter_map(|node| gear::placed_gear(node, problems)).collect(),
            resolution: resolution.map(|table| resolution::read(&table, whale.is_some())),
            whale: whale.as_ref().and_then(PlacedWhale::read),
            friction: fields.table("friction").as_ref().and_then(friction::read),
            ropes: parts::ropes(&fields, &file),
            fixtures: each("fixture").filter_map(|node| parts::fixture(node, problems)).collect(),
            joints: each("joint").filter_map(|node| parts::joint(node, problems)).collect(),
            obstacles: each("obstacle")
                .filter_map(|node| obstacle::obstacle(node, &file, problems))
                .collect(),
            bodies: each("body").filter_map(|node| parts::body(node, &file, problems)).collect(),
            lines: each("line").filter_map(|node| lines::free_line(node, problems)).collect(),
            links: each("link").filter_map(|node| link(node, problems, true)).collect(),
            probes: each("probe").filter_map(|node| parts::probe(node, problems)).collect(),
        };
        scenario.check_whole(&fields);
        fields.finish();
        Some(scenario)
    }

    fn check_whole(&self, fields: &Fields<'_>) {
        if let (Some(nodes), Some(_)) = (&self.rope_nodes, &self.segment_m) {
            let message = "both `rope_nodes` and `segment` are given";
            fields.problems().push(nodes.place.error(message, "keep the one that is meant"));
        }
        if let (Some(lines), None) = (self.line_segments.first(), &self.segment_m) {
            let message = "[[segments]] is given, but no `segment` for the other lines";
            let help = "write one, such as segment = \"1 m\", in place of `rope_nodes`";
            fields.problems().push(lines.line.place.error(message, help));
        }
        if let (Some(friction), false) = (&self.rope_friction, self.rope_on_rope) {
            let message = "`rope_friction` is given, but ropes pass through each other here";
            fields
                .problems()
                .push(friction.place.error(message, "take it out, or `rope_on_rope = false`"));
        }
        if self.gear.len() > 1 {
            for gear in self.gear.iter().filter(|gear| gear.id.is_none()) {
                let message = "this gear has no `id`, and there is more than one";
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

/// `step`: a time, or "auto" for the step the program chooses.
fn step(fields: &Fields<'_>) -> Option<f64> {
    if is_auto(fields) {
        return None;
    }
    seconds(fields, "step")
}

/// A step of time of at most a second [s].
fn seconds<'a>(fields: &Fields<'a>, key: &'a str) -> Option<f64> {
    fields.value(key, Quantity::Time, Range::Within(&limits::STEP)).map(|step| step.value)
}

/// `contact_tolerance`: what push and friction may miss by in a step near the whale, as a share of the greatest.
fn contact_tolerance(fields: &Fields<'_>) -> Option<f64> {
    let tolerance = fields.value("contact_tolerance", Quantity::Ratio, Range::Between(1e-4, 0.2));
    tolerance.map(|tolerance| tolerance.value)
}

/// `segment`: the longest segment [m].
fn segment(fields: &Fields<'_>) -> Option<At<f64>> {
    fields.value("segment", Quantity::Length, Range::Within(&limits::SEGMENT))
}

/// `rope_friction`: the coefficient of rope on rope.
fn rope_friction(fields: &Fields<'_>) -> Option<At<f64>> {
    fields.value("rope_friction", Quantity::Ratio, Range::Between(0.0, 2.0))
}

/// A place as east, north, up [m].
pub(crate) fn place3(values: &[f64]) -> DVec3 {
    DVec3::new(values[0], values[1], values[2])
}
