//! The scenario document: sea, gear, whale, fixtures and probes of one run.

mod current;
mod friction;
mod motion;
mod obstacle;
mod parts;
mod pilot;
mod resolution;
mod sea;
mod waves;
mod wrap;

use endline_sim::DVec3;
use endline_sim::model::Resolution;

use crate::assembly::{PartLine, PartLink, line_fields, link};
use crate::attributes::Attributes;
use crate::diagnostic::{At, Diagnostic, Place};
use crate::entry::{self, Entry};
use crate::fields::{Fields, Problems, Range};
use crate::items::Condition;
use crate::line::LineMake;
use crate::tree::{self, Node};
use crate::units::Quantity;

pub use current::{CurrentOf, CurrentRow, RowHeight};
pub use friction::{FrictionChoice, FrictionOn};
pub use motion::{AnswerToTouch, Swimmer};
pub use obstacle::ObstacleOf;
pub use parts::{Fixture, FreeBody, LineStart, ProbeOf, ProbePart};
pub use pilot::{PilotOf, TriggerOf};
pub use sea::{Bed, Sea};
pub use wrap::WrapOf;
pub(crate) use wrap::on_trunk;

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
    /// How many rope nodes there are in all.
    pub rope_nodes: Option<At<u64>>,
    /// Longest segment [m], where no node count is given.
    pub segment_m: Option<f64>,
    /// How segment lengths follow the whale, where they do.
    pub resolution: Option<Resolution>,
    /// Whether weak links can part.
    pub weak_links: bool,
    /// Whether rope touches the bodies of the rig.
    pub rope_on_bodies: bool,
    /// Whether rope touches rope.
    pub rope_on_rope: bool,
    /// Friction of rope on rope, where the scenario says.
    pub rope_friction: Option<At<f64>>,
    /// Whether the run starts as its parts are placed, without statics.
    pub as_placed: bool,
    /// Condition of every rope whose line names none.
    pub rope_condition: Condition,
    /// Whether rope resists bending.
    pub rope_bending: bool,
    /// Whether strengths of ropes and weak links scatter by the seed.
    pub strength_scatter: bool,
    /// The sea.
    pub sea: Sea,
    /// Gear from the library.
    pub gear: Vec<PlacedGear>,
    /// The whale, if any.
    pub whale: Option<Swimmer>,
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
        let duration = fields.need_value("duration", Quantity::Time, Range::Between(1e-6, 1e6));
        let seed = fields.count("seed", 0);
        let step = step(&fields);
        let contact_step = fields.value("contact_step", Quantity::Time, Range::Between(1e-6, 1.0));
        let rope_nodes = fields.count("rope_nodes", 2);
        let segment = fields.value("segment", Quantity::Length, Range::Between(1e-3, 1000.0));
        let weak_links = fields.flag("weak_links");
        let rope_on_bodies = fields.flag("rope_on_bodies");
        let rope_on_rope = fields.flag("rope_on_rope");
        let rope_friction =
            fields.value("rope_friction", Quantity::Ratio, Range::Between(0.0, 2.0));
        let whale = fields.table("whale");
        let follow = fields.table("resolution");
        let start = fields.word("start", &["rest", "placed"]);
        let rope_condition = fields.word("rope_condition", &Condition::WORDS);
        let each = |key: &'static str| fields.tables(key).iter();
        let scenario = Self {
            name,
            notes,
            place: node.place.clone(),
            duration_s: duration.as_ref().map_or(60.0, |duration| duration.value),
            seed: seed.map_or(1, |seed| seed.value),
            step_s: step,
            auto_step: is_auto(&fields),
            contact_step_s: contact_step.map(|step| step.value),
            rope_nodes,
            segment_m: segment.map(|segment| segment.value),
            weak_links: weak_links.unwrap_or(true),
            rope_on_bodies: rope_on_bodies.unwrap_or(false),
            rope_on_rope: rope_on_rope.unwrap_or(false),
            rope_friction,
            as_placed: start.is_some_and(|start| start.value == "placed"),
            rope_condition: rope_condition
                .and_then(|word| Condition::from_word(&word.value))
                .unwrap_or_default(),
            rope_bending: fields.flag("rope_bending").unwrap_or(false),
            strength_scatter: fields.flag("strength_scatter").unwrap_or(true),
            sea: sea::read(&fields),
            gear: each("gear").filter_map(|node| placed_gear(node, problems)).collect(),
            resolution: follow.as_ref().map(|follow| resolution::read(follow, whale.is_some())),
            whale: whale.as_ref().and_then(Swimmer::read),
            friction: fields.table("friction").as_ref().and_then(friction::read),
            ropes: parts::ropes(&fields, &file),
            fixtures: each("fixture").filter_map(|node| parts::fixture(node, problems)).collect(),
            joints: each("joint").filter_map(|node| parts::joint(node, problems)).collect(),
            obstacles: each("obstacle")
                .filter_map(|node| obstacle::obstacle(node, &file, problems))
                .collect(),
            bodies: each("body").filter_map(|node| parts::body(node, &file, problems)).collect(),
            lines: each("line").filter_map(|node| free_line(node, problems)).collect(),
            links: each("link").filter_map(|node| link(node, problems, true)).collect(),
            probes: each("probe").filter_map(|node| parts::probe(node, problems)).collect(),
        };
        scenario.check_whole(&fields);
        fields.finish();
        Some(scenario)
    }

    fn check_whole(&self, fields: &Fields<'_>) {
        if let (Some(nodes), Some(_)) = (&self.rope_nodes, self.segment_m) {
            let message = "both `rope_nodes` and `segment` are given";
            fields.problems().push(nodes.place.error(message, "keep the one that is meant"));
        }
        if let (Some(friction), false) = (&self.rope_friction, self.rope_on_rope) {
            let message = "`rope_friction` is given, but ropes pass through each other here";
            fields.problems().push(
                friction.place.error(message, "write rope_on_rope = true besides, or take it out"),
            );
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
    fields.value("step", Quantity::Time, Range::Between(1e-6, 1.0)).map(|step| step.value)
}

fn placed_gear(node: &Node, problems: &Problems) -> Option<PlacedGear> {
    let fields = Fields::of(node, problems);
    let id = fields.text("id");
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
            tree::Content::Text(rope) => choices.push((
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

/// `[gear.lines.<line>]`: how a line is made up, by id.
fn line_choices(fields: &Fields<'_>) -> Vec<(At<String>, LineMake)> {
    let Some(table) = fields.table("lines") else { return Vec::new() };
    let choice = |(line, key, node): &(String, Place, Node)| {
        let inner = Fields::of(node, fields.problems());
        let make = LineMake::read(&inner);
        inner.finish();
        (At { value: line.clone(), place: key.clone() }, make)
    };
    table.rest().into_iter().map(choice).collect()
}

fn free_line(node: &Node, problems: &Problems) -> Option<(PartLine, LineStart)> {
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

/// A place as east, north, up [m].
pub(crate) fn place3(values: &[f64]) -> DVec3 {
    DVec3::new(values[0], values[1], values[2])
}
