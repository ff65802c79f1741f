//! `[[whale.pilot]]`: controls that change at a time, or when something happens to the whale.

use endline_sdk::{BodyPart, Controls};

use crate::diagnostic::{At, Place};
use crate::fields::{Fields, Problems, Range};
use crate::nearest::hint;
use crate::tree::Node;
use crate::units::Quantity;

/// An entry of the pilot program; what it names is looked up by [`assemble`](crate::assemble).
#[derive(Clone, Debug, PartialEq)]
pub struct PilotOf {
    /// What begins it.
    pub trigger: TriggerOf,
    /// Time from there to its beginning [s].
    pub delay_s: f64,
    /// How long it holds its controls; infinite for ever [s].
    pub hold_s: f64,
    /// Time over which controls come to their values and leave them [s].
    pub ramp_s: f64,
    /// The controls it names, in the order of [`Controls::NAMES`]; `act` is given apart.
    pub controls: [Option<f64>; Controls::COUNT],
    /// Id of the act it asks for.
    pub act: Option<At<String>>,
}

/// What begins an entry.
#[derive(Clone, Debug, PartialEq)]
pub enum TriggerOf {
    /// A time [s].
    Time(f64),
    /// Rope first presses on a body part, or on any.
    Touch(Option<BodyPart>),
    /// The whale comes this near [m] to a line, body or joint by id, or to any line.
    Within(f64, Option<At<String>>),
    /// Mid-body passes a depth [m].
    Depth(f64),
    /// The whale's heading passes a compass bearing [rad].
    Heading(f64),
    /// Another entry begins, by its place in the list.
    After(usize),
}

/// Keys that begin an entry, with an example of each.
const TRIGGERS: [(&str, &str); 6] = [
    ("at", "at = \"12 s\""),
    ("touch", "touch = \"any\""),
    ("within", "within = \"5 m\""),
    ("depth", "depth = \"10 m\""),
    ("heading", "heading = \"90 deg\""),
    ("after", "after = \"turn\""),
];

/// The ids of entries read so far.
type Ids = Vec<Option<At<String>>>;

/// Reads every entry; those with a problem, which is reported, are left out.
pub(super) fn pilot(fields: &Fields<'_>) -> Vec<PilotOf> {
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
    // With one left out, `after` would count another; but then there is an error and nothing is assembled.
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

/// The controls but `act`, in the order of their names.
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

/// The one thing that begins an entry.
fn trigger(fields: &Fields<'_>, ids: &Ids) -> Option<TriggerOf> {
    let given: Vec<_> =
        TRIGGERS.iter().filter_map(|(key, _)| Some((*key, fields.get(key)?))).collect();
    let of = fields.text("of");
    let Some((key, _)) = given.first() else {
        let examples = TRIGGERS.map(|(_, example)| example).join(", ");
        fields.problems().push(
            fields.place.error(
                "nothing begins this entry of the pilot",
                format!("write one of {examples}"),
            ),
        );
        return None;
    };
    if let Some((other, node)) = given.get(1) {
        let message = format!("both `{key}` and `{other}` begin this entry");
        fields.problems().push(
            node.place.error(message, "keep one; an entry of its own may begin with the other"),
        );
    }
    if let Some(of) = of.as_ref().filter(|_| *key != "within") {
        fields.problems().push(
            of.place.error("`of` without `within`", "write within = \"5 m\", or take it out"),
        );
    }
    Some(match *key {
        "at" => TriggerOf::Time(fields.value("at", Quantity::Time, Range::NotNegative)?.value),
        "touch" => TriggerOf::Touch(touch(fields)?),
        "within" => {
            TriggerOf::Within(fields.value("within", Quantity::Length, Range::Positive)?.value, of)
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

/// A body part by name, or any.
fn touch(fields: &Fields<'_>) -> Option<Option<BodyPart>> {
    let words: Vec<&str> =
        std::iter::once("any").chain(BodyPart::ALL.map(BodyPart::name)).collect();
    let word = fields.word("touch", &words)?;
    Some(BodyPart::ALL.into_iter().find(|part| part.name() == word.value))
}

/// The entry above that has the id named.
fn after(fields: &Fields<'_>, ids: &Ids) -> Option<usize> {
    let after = fields.text("after")?;
    let found = ids.iter().position(|id| id.as_ref().is_some_and(|id| id.value == after.value));
    if found.is_none() {
        let message = format!("no entry above has the id `{}`", after.value);
        let known = ids.iter().flatten().map(|id| id.value.as_str());
        fields.problems().push(after.place.error(message, hint(&after.value, known)));
    }
    found
}

/// Where a key of a table stands.
fn place_of(node: &Node, key: &str) -> Place {
    let problems = Problems::default();
    Fields::of(node, &problems)
        .get(key)
        .map_or_else(|| node.place.clone(), |value| value.place.clone())
}
