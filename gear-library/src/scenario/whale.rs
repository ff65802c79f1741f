//! The whale of a scenario: which, where, how it swims, what its pilot does.

use endline_sim::DVec3;
use endline_sim::whale::kinetic::Effort;

use crate::attributes::Attributes;
use crate::diagnostic::At;
use crate::fields::{Fields, Problems, Range};
use crate::items::YEAR_S;
use crate::tree::{Content, Node};
use crate::units::Quantity;

use super::pilot::{self, PilotOf};

/// Force on one part from which a whale feels rope, where a scenario says nothing else [N]; an estimate.
const FELT_N: f64 = 1.0;

/// A whale in a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedWhale {
    /// Id of the library's whale.
    pub item: At<String>,
    /// Body length, over the library's [m].
    pub length_m: Option<f64>,
    /// Age, from which the length follows [s].
    pub age_s: Option<At<f64>>,
    /// Volume over that of a whale of its length in middling condition [1].
    pub condition: f64,
    /// Whether it is late in pregnancy.
    pub pregnant: bool,
    /// Start of mid-body: east, north, up [m].
    pub position_m: DVec3,
    /// Compass bearing of its snout [rad].
    pub heading_rad: f64,
    /// Nose up [rad].
    pub pitch_rad: f64,
    /// Roll to starboard [rad].
    pub roll_rad: f64,
    /// Speed through the water [m/s].
    pub speed_m_s: f64,
    /// Stiffness of skin and blubber, over the library's [N/m²].
    pub contact_stiffness_n_m2: Option<f64>,
    /// Whether it is dead; then it floats, whatever its motion.
    pub dead: bool,
    /// Whether it is kinetic.
    pub kinetic: bool,
    /// How a kinetic one keeps up its effort.
    pub effort: Effort,
    /// Id of the motion plugin.
    pub motion: At<String>,
    /// Its attributes.
    pub attributes: Attributes,
    /// Acts of the library it can do, in the order of their numbers; `None` for all.
    pub acts: Option<Vec<At<String>>>,
    /// What it does when rope touches it.
    pub answer: Option<AnswerToTouch>,
    /// What its pilot does.
    pub pilot: Vec<PilotOf>,
}

/// What a whale does of itself when rope touches it.
#[derive(Clone, Debug, PartialEq)]
pub struct AnswerToTouch {
    /// Id of the act.
    pub act: At<String>,
    /// Normal force on one part above which it feels a touch [N].
    pub above_n: f64,
    /// It answers again after this long while the touch lasts [s]; infinite for never.
    pub again_s: f64,
}

/// Stands for the motion of a dead whale.
const NO_MOTION: &str = "org.endline.motion.swim";

impl PlacedWhale {
    /// Reads `[whale]`; `None` where something needed is missing, which is reported.
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
        let effort = fields.word("effort", &["power", "thrust", "speed"]);
        let (speed, motion) = if dead { adrift(fields) } else { under_way(fields) };
        let attributes = Attributes::read(fields, "attributes");
        let acts = fields.get("acts").map(|node| acts(node, fields.problems()));
        let answer = answer(fields);
        let pilot = pilot::pilot(fields);
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
            effort: effort_of(effort.as_ref().map(|word| word.value.as_str())),
            motion: motion?,
            attributes,
            acts,
            answer,
            pilot,
        })
    }
}

/// The length is given, or follows from the age.
fn check_age(fields: &Fields<'_>, length: Option<&At<f64>>, age: Option<&At<f64>>) {
    if let (Some(_), Some(age)) = (length, age) {
        let help =
            "leave one of them out: the length follows from the age by the law of the whale's file";
        fields.problems().push(age.place.error("both `length` and `age` are given", help));
    }
}

/// `position` and `depth`: start of mid-body, east, north and up [m].
fn mid_body(fields: &Fields<'_>) -> Option<DVec3> {
    let position = fields.values("position", Quantity::Length, &[2]);
    if position.is_none() && fields.get("position").is_none() {
        fields.missing(
            "position",
            "write where mid-body starts, east and north, as [\"-20 m\", \"0 m\"]",
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
        other => {
            problems
                .push(item.place.error(format!("an act is {}, not a text", other.noun()), help));
            None
        }
    };
    items.iter().filter_map(id).collect()
}

/// `answer_to_touch`, and what belongs to it.
fn answer(fields: &Fields<'_>) -> Option<AnswerToTouch> {
    let act = fields.text("answer_to_touch");
    let above = fields.value("answer_above", Quantity::Force, Range::NotNegative);
    let again = fields.value("answer_again", Quantity::Time, Range::Positive);
    let act = act?;
    Some(AnswerToTouch {
        act,
        above_n: above.map_or(FELT_N, |above| above.value),
        again_s: again.map_or(f64::INFINITY, |again| again.value),
    })
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

/// A dead whale lies still, and its motion is never asked.
fn adrift(fields: &Fields<'_>) -> (Option<f64>, Option<At<String>>) {
    (Some(0.0), Some(At { value: NO_MOTION.to_owned(), place: fields.place.clone() }))
}

fn effort_of(word: Option<&str>) -> Effort {
    match word {
        Some("thrust") => Effort::Thrust,
        Some("speed") => Effort::Speed,
        _ => Effort::Power,
    }
}
