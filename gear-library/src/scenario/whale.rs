//! The whale of a scenario, its pilot program, and the friction on it.

use endline_sdk::{BodyPart, Controls};
use endline_sim::DVec3;
use endline_sim::whale::kinetic::Effort;

use crate::assembly::Attributes;
use crate::diagnostic::{At, Place, hint};
use crate::fields::{Fields, Problems, Range, provenance, read_value};
use crate::items::{YEAR_S, read_surfaces};
use crate::tree::{Content, Node};
use crate::units::Quantity;

/// Default of the force on one part that a whale feels [N]; an estimate.
const FELT_N: f64 = 1.0;

/// A whale in a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedWhale {
    /// Id of the library's whale.
    pub item: At<String>,
    /// Body length, overrides the library's [m].
    pub length_m: Option<f64>,
    /// Age, which determines the length [s].
    pub age_s: Option<At<f64>>,
    /// Volume over that of a whale of its length in average condition [1].
    pub condition: f64,
    /// Whether it is late in pregnancy.
    pub pregnant: bool,
    /// Initial place of mid-body: east, north, up [m].
    pub position_m: DVec3,
    /// Compass bearing of its snout [rad].
    pub heading_rad: f64,
    /// Pitch, nose up [rad].
    pub pitch_rad: f64,
    /// Roll to starboard [rad].
    pub roll_rad: f64,
    /// Speed through the water [m/s].
    pub speed_m_s: f64,
    /// Stiffness of skin and blubber, overrides the library's [N/m²].
    pub contact_stiffness_n_m2: Option<f64>,
    /// Whether it is dead; then it floats without motion.
    pub dead: bool,
    /// Whether it is kinetic.
    pub kinetic: bool,
    /// What a kinetic whale keeps constant.
    pub effort: Effort,
    /// How a burst tires it.
    pub tiring: TiringOf,
    /// Id of the motion plugin.
    pub motion: At<String>,
    /// Its attributes.
    pub attributes: Attributes,
    /// Its acts of the library, in the order of their numbers; `None` for all.
    pub acts: Option<Vec<At<String>>>,
    /// Its responses to touch.
    pub answers: Option<AnswersToTouch>,
    /// Its pilot program.
    pub pilot: Vec<PilotOf>,
}

/// Time constants of a burst, instead of those of the whale's file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TiringOf {
    /// Decay of its thrust [s].
    pub tires_s: Option<f64>,
    /// Recovery from it [s].
    pub recovers_s: Option<f64>,
}

/// The responses of a whale to contact with rope.
#[derive(Clone, Debug, PartialEq)]
pub struct AnswersToTouch {
    /// Id of the act of the first response, or `none`; `None` if it is drawn like later ones.
    pub first: Option<At<String>>,
    /// Normal force on one part above which it reacts [N].
    pub above_n: f64,
    /// Time between responses during contact [s]; infinite for a single one.
    pub again_s: f64,
    /// How later responses are drawn; `None` if they repeat the first.
    pub drawn: Option<DrawnAnswersOf>,
}

/// Later responses to touch, which are drawn by weight.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnAnswersOf {
    /// Duration of contact after which the whale is held [s].
    pub held_after_s: f64,
    /// Ids of acts, or `none`, with their weights: touched, held by the mouth, held by a fin.
    pub weights: [Vec<(At<String>, f64)>; 3],
}

/// Placeholder for the motion of a dead whale.
const NO_MOTION: &str = "org.endline.motion.swim";

impl PlacedWhale {
    /// Reads `[whale]`; `None` if a required field is missing, which is reported.
    pub(super) fn read(fields: &Fields<'_>) -> Option<Self> {
        let item = fields
            .need_text("item", "write the id of a whale of the library, such as \"right-whale\"");
        let length = fields.value("length", Quantity::Length, Range::Between(1.0, 35.0));
        let age = fields.value("age", Quantity::Time, Range::Between(0.0, 120.0 * YEAR_S));
        check_age(fields, length.as_ref(), age.as_ref());
        let condition = fields.value("condition", Quantity::Ratio, Range::Between(0.65, 1.5));
        let pregnant = fields.flag("pregnant").unwrap_or(false);
        let position_m = mid_body(fields);
        let angle = |key, default| {
            fields.value(key, Quantity::Angle, Range::Any).map_or(default, |angle| angle.value)
        };
        let heading_rad = angle("heading", std::f64::consts::FRAC_PI_2);
        let (pitch_rad, roll_rad) = (angle("pitch", 0.0), angle("roll", 0.0));
        let stiffness = fields.value("contact_stiffness", Quantity::Pressure, Range::Positive);
        let state = fields.word("state", &["alive", "dead"]);
        let dead = state.is_some_and(|word| word.value == "dead");
        let dynamics = fields.word("dynamics", &["kinematic", "kinetic"]);
        let efforts =
            [("power", Effort::Power), ("thrust", Effort::Thrust), ("speed", Effort::Speed)];
        let effort = fields.choice("effort", &efforts);
        let tiring = TiringOf {
            tires_s: fields.value("tires", Quantity::Time, Range::Positive).map(|time| time.value),
            recovers_s: fields
                .value("recovers", Quantity::Time, Range::Positive)
                .map(|time| time.value),
        };
        let (speed, motion) = if dead { adrift(fields) } else { under_way(fields) };
        let attributes = Attributes::read(fields, "attributes");
        let acts = fields.get("acts").map(|node| acts(node, fields.problems()));
        let answers = answers(fields);
        let pilot = pilot(fields);
        fields.finish();
        Some(Self {
            item: item?,
            length_m: length.map(|length| length.value),
            age_s: age,
            condition: condition.map_or(1.0, |condition| condition.value),
            pregnant,
            position_m: position_m?,
            heading_rad,
            pitch_rad,
            roll_rad,
            speed_m_s: speed?,
            contact_stiffness_n_m2: stiffness.map(|stiffness| stiffness.value),
            dead,
            kinetic: dynamics.is_some_and(|word| word.value == "kinetic"),
            effort: effort.map_or(Effort::Power, |effort| effort.value),
            tiring,
            motion: motion?,
            attributes,
            acts,
            answers,
            pilot,
        })
    }
}

/// Reports both a length and an age.
fn check_age(fields: &Fields<'_>, length: Option<&At<f64>>, age: Option<&At<f64>>) {
    if let (Some(_), Some(age)) = (length, age) {
        let help =
            "remove one of them: the age determines the length by the law in the whale's file";
        fields.problems().push(age.place.error("both `length` and `age` are present", help));
    }
}

/// `position` and `depth`: initial place of mid-body, east, north and up [m].
fn mid_body(fields: &Fields<'_>) -> Option<DVec3> {
    let position = fields.values("position", Quantity::Length, &[2]);
    if position.is_none() && fields.get("position").is_none() {
        fields.missing(
            "position",
            "write the initial place of mid-body, east and north, such as [\"-20 m\", \"0 m\"]",
        );
    }
    let depth = fields.need_value("depth", Quantity::Length, Range::Between(-10.0, 6000.0));
    let (position, depth) = (position?, depth?);
    Some(DVec3::new(position.value[0], position.value[1], -depth.value))
}

/// `acts`: a list of ids.
fn acts(node: &Node, problems: &Problems) -> Vec<At<String>> {
    let help = "write a list of acts of the library, such as [\"roll-away\", \"flinch\"]";
    let Content::List(items) = &node.content else {
        problems
            .push(node.place.error(format!("`acts` is {}, not a list", node.content.noun()), help));
        return Vec::new();
    };
    let id = |item: &Node| match &item.content {
        Content::Text(id) => Some(At { value: id.clone(), place: item.place.clone() }),
        other => problems
            .refuse(item.place.error(format!("an act is {}, not a text", other.noun()), help)),
    };
    items.iter().filter_map(id).collect()
}

/// `answer_to_touch` with its parameters, and `answers`.
fn answers(fields: &Fields<'_>) -> Option<AnswersToTouch> {
    let first = fields.text("answer_to_touch");
    let above = fields.value("answer_above", Quantity::Force, Range::NotNegative);
    let again = fields.value("answer_again", Quantity::Time, Range::Positive);
    let drawn = fields.inside("answers", drawn_answers);
    if let (Some(table), None) = (fields.get("answers"), &again) {
        let message = "`answers` is present, but not the time between them";
        let help = "write it in the table above, such as answer_again = \"20 s\"";
        fields.problems().push(table.place.error(message, help));
    }
    (first.is_some() || drawn.is_some()).then(|| AnswersToTouch {
        first,
        above_n: above.map_or(FELT_N, |above| above.value),
        again_s: again.map_or(f64::INFINITY, |again| again.value),
        drawn,
    })
}

/// Tables of `[whale.answers]`, one for each state of a whale in contact.
const STATES: [&str; 3] = ["touched", "held_by_mouth", "held_by_fin"];

/// Usual duration of contact after which a whale counts as held [s].
const HELD_AFTER_S: f64 = 10.0;

/// `[whale.answers]`.
fn drawn_answers(fields: &Fields<'_>) -> DrawnAnswersOf {
    // Stated for readers of the file; no report names them.
    provenance(fields);
    let held_after = fields.value("held_after", Quantity::Time, Range::NotNegative);
    let weights = STATES.map(|state| match fields.get(state) {
        Some(node) => weights(state, node, fields.problems()),
        None => {
            let help = "write the acts with their weights, such as { none = 3, roll-away = 1 }";
            fields.missing(state, help);
            Vec::new()
        }
    });
    DrawnAnswersOf { held_after_s: held_after.map_or(HELD_AFTER_S, |time| time.value), weights }
}

/// Acts of a state with their weights, at least one of which is above zero.
fn weights(state: &str, node: &Node, problems: &Problems) -> Vec<(At<String>, f64)> {
    let table = Fields::of(node, problems);
    let weight = |(act, place, node): &(String, Place, Node)| {
        let weight = read_value(node, Quantity::Ratio, Range::NotNegative, problems)?;
        Some((At { value: act.clone(), place: place.clone() }, weight.value))
    };
    let found: Vec<_> = table.rest().into_iter().filter_map(weight).collect();
    if found.iter().all(|(_, weight)| *weight <= 0.0) {
        let message = format!("no act of `{state}` has a weight above zero");
        problems.push(node.place.error(message, "write at least one, such as none = 1"));
    }
    found
}

/// Speed and motion of a living whale.
fn under_way(fields: &Fields<'_>) -> (Option<f64>, Option<At<String>>) {
    let speed = fields.need_value("speed", Quantity::Speed, Range::Between(0.0, 15.0));
    let motion = fields.need_text(
        "motion",
        "write the id of a motion plugin, such as \"org.endline.motion.swim\"",
    );
    (speed.map(|speed| speed.value), motion)
}

/// Speed and motion of a dead whale; the motion is not used.
fn adrift(fields: &Fields<'_>) -> (Option<f64>, Option<At<String>>) {
    (Some(0.0), Some(At { value: NO_MOTION.to_owned(), place: fields.place.clone() }))
}

/// An entry of the pilot program; [`assemble`](crate::assemble) resolves its names.
#[derive(Clone, Debug, PartialEq)]
pub struct PilotOf {
    /// Its trigger.
    pub trigger: TriggerOf,
    /// Time from the trigger to its start [s].
    pub delay_s: f64,
    /// Duration of its controls; may be infinite [s].
    pub hold_s: f64,
    /// Time of the transition of controls at both ends [s].
    pub ramp_s: f64,
    /// Its controls, in the order of [`Controls::NAMES`], without `act`.
    pub controls: [Option<f64>; Controls::COUNT],
    /// Id of its act.
    pub act: Option<At<String>>,
}

/// The trigger of an entry.
#[derive(Clone, Debug, PartialEq)]
pub enum TriggerOf {
    /// A time [s].
    Time(f64),
    /// First contact of rope with a body part, or with any.
    Touch(Option<BodyPart>),
    /// A distance [m] to a line, body or joint by id, or to any line.
    Within(f64, Option<At<String>>),
    /// A mean and a standard deviation of the distance [m] from an eye to a line, body or joint by id, or to any line.
    Sees([f64; 2], Option<At<String>>),
    /// Mid-body at a depth [m].
    Depth(f64),
    /// The heading at a compass bearing [rad].
    Heading(f64),
    /// The start of another entry, by its index.
    After(usize),
}

/// Keys of triggers, each with an example.
const TRIGGERS: [(&str, &str); 7] = [
    ("at", "at = \"12 s\""),
    ("touch", "touch = \"any\""),
    ("within", "within = \"5 m\""),
    ("sees", "sees = \"3 m\""),
    ("depth", "depth = \"10 m\""),
    ("heading", "heading = \"90 deg\""),
    ("after", "after = \"turn\""),
];

/// Ids of the entries read so far.
type Ids = Vec<Option<At<String>>>;

/// Reads the entries; invalid ones are reported and omitted.
fn pilot(fields: &Fields<'_>) -> Vec<PilotOf> {
    let (mut entries, mut ids, mut latest_s) = (Vec::new(), Ids::new(), f64::NEG_INFINITY);
    for node in fields.tables("pilot") {
        let (id, entry) = entry(node, &ids, fields.problems());
        if let Some(PilotOf { trigger: TriggerOf::Time(at_s), .. }) = entry {
            if at_s <= latest_s {
                let place = place_of(node, "at");
                fields.problems().push(place.error(
                    "commands are not in rising order of `at`",
                    "put them in the order of time",
                ));
            }
            latest_s = at_s;
        }
        ids.push(id);
        entries.push(entry);
    }
    // An omitted entry shifts the indices of `after`, but its error prevents the assembly.
    entries.into_iter().flatten().collect()
}

fn entry(node: &Node, ids: &Ids, problems: &Problems) -> (Option<At<String>>, Option<PilotOf>) {
    let fields = Fields::of(node, problems);
    let id = own_id(&fields, ids);
    let trigger = trigger(&fields, ids);
    let time = |key, range| fields.value(key, Quantity::Time, range);
    let (delay, hold, ramp) = (
        time("delay", Range::NotNegative),
        time("hold", Range::Positive),
        time("ramp", Range::NotNegative),
    );
    if let (Some(TriggerOf::Time(_)), Some(delay)) = (&trigger, &delay) {
        problems.push(delay.place.error("an entry with `at` has no `delay`", "add it to `at`"));
    }
    let controls = controls(&fields);
    let act = fields.text("act");
    if act.is_none()
        && controls.iter().all(Option::is_none)
        && Controls::NAMES.iter().all(|name| fields.get(name).is_none())
    {
        problems.push(fields.place.error(
            "the entry sets no control",
            format!("write one or more of {}", Controls::NAMES.join(", ")),
        ));
    }
    fields.finish();
    let or = |value: Option<At<f64>>, default| value.map_or(default, |value| value.value);
    let entry = trigger.map(|trigger| PilotOf {
        trigger,
        delay_s: or(delay, 0.0),
        hold_s: or(hold, f64::INFINITY),
        ramp_s: or(ramp, 0.0),
        controls,
        act,
    });
    (id, entry)
}

fn own_id(fields: &Fields<'_>, ids: &Ids) -> Option<At<String>> {
    let id = fields.id("id")?;
    if ids.iter().flatten().any(|known| known.value == id.value) {
        let message = format!("there are two entries with the id `{}`", id.value);
        fields.problems().push(id.place.error(message, "give one of them another id"));
    }
    Some(id)
}

/// The controls except `act`, in the order of their names.
fn controls(fields: &Fields<'_>) -> [Option<f64>; Controls::COUNT] {
    std::array::from_fn(|index| {
        let [least, most] = Controls::RANGES[index];
        let is_amount = index != Controls::ACT;
        is_amount
            .then(|| {
                fields.value(Controls::NAMES[index], Quantity::Ratio, Range::Between(least, most))
            })?
            .map(|value| value.value)
    })
}

/// The trigger of an entry, exactly one.
fn trigger(fields: &Fields<'_>, ids: &Ids) -> Option<TriggerOf> {
    let triggers: Vec<_> =
        TRIGGERS.iter().filter_map(|(key, _)| Some((*key, fields.get(key)?))).collect();
    let of = fields.text("of");
    let Some((key, _)) = triggers.first() else {
        let examples = TRIGGERS.map(|(_, example)| example).join(", ");
        return fields.refuse(
            fields.place.error(
                "this entry of the pilot has no trigger",
                format!("write one of {examples}"),
            ),
        );
    };
    if let Some((other, node)) = triggers.get(1) {
        let message = format!("this entry has two triggers, `{key}` and `{other}`");
        fields.problems().push(node.place.error(message, "keep one, or write another entry"));
    }
    if let Some(of) = of.as_ref().filter(|_| !["within", "sees"].contains(key)) {
        let message = "`of` without `within` or `sees`";
        fields.problems().push(of.place.error(message, "write within = \"5 m\", or remove it"));
    }
    let deviation = fields.value("sees_deviation", Quantity::Length, Range::NotNegative);
    if let Some(deviation) = deviation.as_ref().filter(|_| *key != "sees") {
        let message = "`sees_deviation` without `sees`";
        fields
            .problems()
            .push(deviation.place.error(message, "write sees = \"3 m\", or remove it"));
    }
    Some(match *key {
        "at" => TriggerOf::Time(fields.value("at", Quantity::Time, Range::NotNegative)?.value),
        "touch" => TriggerOf::Touch(touch(fields)?),
        "within" => {
            TriggerOf::Within(fields.value("within", Quantity::Length, Range::Positive)?.value, of)
        }
        "sees" => {
            let mean = fields.value("sees", Quantity::Length, Range::NotNegative)?.value;
            TriggerOf::Sees([mean, deviation.map_or(0.0, |deviation| deviation.value)], of)
        }
        "depth" => {
            TriggerOf::Depth(fields.value("depth", Quantity::Length, Range::NotNegative)?.value)
        }
        "heading" => {
            TriggerOf::Heading(fields.value("heading", Quantity::Angle, Range::Any)?.value)
        }
        _ => TriggerOf::After(after(fields, ids)?),
    })
}

/// A body part by name; `None` for any.
fn touch(fields: &Fields<'_>) -> Option<Option<BodyPart>> {
    let parts = BodyPart::ALL.map(|part| (part.name(), Some(part)));
    let choices: Vec<_> = std::iter::once(("any", None)).chain(parts).collect();
    fields.choice("touch", &choices).map(|part| part.value)
}

/// The index of the earlier entry with an id.
fn after(fields: &Fields<'_>, ids: &Ids) -> Option<usize> {
    let after = fields.text("after")?;
    let found = ids.iter().position(|id| id.as_ref().is_some_and(|id| id.value == after.value));
    if found.is_none() {
        let message = format!("no earlier entry has the id `{}`", after.value);
        let known = ids.iter().flatten().map(|id| id.value.as_str());
        fields.problems().push(after.place.error(message, hint(&after.value, known)));
    }
    found
}

/// The place of a key of a table.
fn place_of(node: &Node, key: &str) -> Place {
    let problems = Problems::default();
    Fields::of(node, &problems)
        .get(key)
        .map_or_else(|| node.place.clone(), |value| value.place.clone())
}

/// The friction model of a scenario, and those of some surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionChoice {
    /// Id of the plugin.
    pub model: At<String>,
    /// Its attributes, which override those of rope materials.
    pub attributes: Attributes,
    /// Models of some surfaces; a later entry overrides an earlier one.
    pub on: Vec<FrictionOn>,
}

/// A friction model for some surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionOn {
    /// Its surfaces, at least one, such as `baleen`.
    pub surfaces: Vec<At<String>>,
    /// Id of the plugin.
    pub model: At<String>,
    /// Its attributes.
    pub attributes: Attributes,
}

/// Reads the table `[friction]`.
pub(super) fn friction(fields: &Fields<'_>) -> Option<FrictionChoice> {
    let model = fields.need_text(
        "model",
        "write the id of a friction model, such as \"org.endline.friction.coulomb\"",
    );
    let attributes = Attributes::read(fields, "attributes");
    let on = fields.each("on", friction_on);
    Some(FrictionChoice { model: model?, attributes, on })
}

/// `[[friction.on]]`: a model for some surfaces.
fn friction_on(fields: &Fields<'_>) -> Option<FrictionOn> {
    fields.require("surfaces", "write the surfaces of this model, such as [\"baleen\"]");
    let surfaces = read_surfaces(fields, "surfaces");
    let model = fields.need_text(
        "model",
        "write the id of a friction model, such as \"org.endline.friction.baleen\"",
    );
    let attributes = Attributes::read(fields, "attributes");
    (!surfaces.is_empty()).then_some(FrictionOn { surfaces, model: model?, attributes })
}
