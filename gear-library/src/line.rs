//! The make of a line: condition of its rope, knots at its ends, weak inserts or sleeves, weak places.
//!
//! The keys occur in `[[line]]` of an assembly or scenario and in `[lines.<line>]` of an assembly with a gear type.
//! `[gear.lines.<line>]` of a scenario overrides the assembly.

use endline_sdk::LineEnd;

use crate::diagnostic::{At, Place};
use crate::fields::{ENDS, Fields, Range, read_value};
use crate::items::Condition;
use crate::tree::{Content, Node};
use crate::units::Quantity;

/// The make of a line; missing properties have defaults.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineMake {
    /// Condition of its rope.
    pub condition: Option<At<Condition>>,
    /// Strength after wear, overrides the rope's [1].
    pub wear_factor: Option<f64>,
    /// Required mean strength at the weakest place, for which the rope is scaled [N].
    pub delivered_n: Option<f64>,
    /// Whether the rope keeps the stiffness of its item; otherwise it is scaled with the strength, so that the stretch at break is constant.
    pub keeps_stiffness: Option<bool>,
    /// Knot or splice at end A.
    pub from_knot: Option<At<String>>,
    /// Knot or splice at end B.
    pub to_knot: Option<At<String>>,
    /// Weak inserts or sleeves along it.
    pub inserts: Option<Inserts>,
    /// Places that are weaker than the rest of it.
    pub weak_places: Option<WeakPlaces>,
}

/// Weak inserts or sleeves at equal distances.
#[derive(Clone, Debug, PartialEq)]
pub struct Inserts {
    /// Kind of insert.
    pub what: Insert,
    /// The end from which distances are measured.
    pub counted_from: LineEnd,
    /// From that end to the start of the first insert [m].
    pub first_m: f64,
    /// From start to start [m].
    pub every_m: f64,
    /// Share of the line, from that end, in which entire inserts are placed [1].
    pub within: f64,
    /// Knot or splice of the line's rope at each insert; `None` for the rope's default.
    pub knot: Option<At<String>>,
    /// Their place.
    pub place: Place,
}

/// A kind of insert.
#[derive(Clone, Debug, PartialEq)]
pub enum Insert {
    /// A length of another rope.
    Rope {
        /// Id of the rope.
        rope: At<String>,
        /// Its length [m].
        length_m: f64,
    },
    /// A weak link between the two cut ends, which adds no length.
    Sleeve(At<String>),
}

/// Places of a line that are weaker than the rest of it, such as sleeves, which change nothing but its strength.
#[derive(Clone, Debug, PartialEq)]
pub struct WeakPlaces {
    /// Where they are.
    pub positions: WeakPositions,
    /// Mean strength that the line delivers at each of them [N].
    pub strength_n: f64,
    /// Their place in the file.
    pub place: Place,
}

/// Positions of weak places, as unstretched lengths from end A.
#[derive(Clone, Debug, PartialEq)]
pub enum WeakPositions {
    /// At equal distances, as many as the line has.
    Spaced {
        /// From one to the next [m].
        every_m: f64,
        /// From end A to the first [m].
        first_m: f64,
    },
    /// At these lengths, in any order [m].
    Listed(Vec<At<f64>>),
}

impl LineMake {
    /// Reads the make of a line.
    pub(crate) fn read(fields: &Fields<'_>) -> Self {
        let wear = fields.value("wear_factor", Quantity::Ratio, Range::Between(0.05, 1.0));
        let delivered = fields.value("delivered_strength", Quantity::Force, Range::Positive);
        Self {
            condition: fields.choice("condition", &Condition::WORDS),
            wear_factor: wear.map(|wear| wear.value),
            delivered_n: delivered.map(|delivered| delivered.value),
            keeps_stiffness: fields.flag("keeps_stiffness"),
            from_knot: fields.text("from_knot"),
            to_knot: fields.text("to_knot"),
            inserts: fields.inside("inserts", inserts).flatten(),
            weak_places: fields.inside("weak_places", weak_places).flatten(),
        }
    }

    /// This make with defaults for missing properties.
    pub(crate) fn over(&self, usual: &Self) -> Self {
        Self {
            condition: self.condition.clone().or_else(|| usual.condition.clone()),
            wear_factor: self.wear_factor.or(usual.wear_factor),
            delivered_n: self.delivered_n.or(usual.delivered_n),
            keeps_stiffness: self.keeps_stiffness.or(usual.keeps_stiffness),
            from_knot: self.from_knot.clone().or_else(|| usual.from_knot.clone()),
            to_knot: self.to_knot.clone().or_else(|| usual.to_knot.clone()),
            inserts: self.inserts.clone().or_else(|| usual.inserts.clone()),
            weak_places: self.weak_places.clone().or_else(|| usual.weak_places.clone()),
        }
    }
}

/// Reads `[lines.<line>]`: makes by id.
pub(crate) fn line_choices(fields: &Fields<'_>) -> Vec<(At<String>, LineMake)> {
    let Some(table) = fields.table("lines") else { return Vec::new() };
    let choice = |(line, key, node): &(String, Place, Node)| {
        let inner = Fields::of(node, fields.problems());
        let make = LineMake::read(&inner);
        inner.finish();
        (At { value: line.clone(), place: key.clone() }, make)
    };
    table.rest().into_iter().map(choice).collect()
}

/// Distances along a line [m].
const ALONG: Range = Range::Between(0.01, 20_000.0);

/// Reads `[line.weak_places]`.
fn weak_places(fields: &Fields<'_>) -> Option<WeakPlaces> {
    let strength = fields.need_value("strength", Quantity::Force, Range::Positive);
    let every = fields.value("every", Quantity::Length, ALONG);
    let first = fields.value("first", Quantity::Length, ALONG);
    let positions = match (fields.get("at"), fields.get("every").is_some(), first) {
        (None, true, first) => every.map(|every| WeakPositions::Spaced {
            every_m: every.value,
            first_m: first.map_or(0.5 * every.value, |first| first.value),
        }),
        (None, false, _) => {
            fields.missing("every", "write every = \"60 ft\", or at = [\"10 m\", \"25 m\"]");
            None
        }
        (Some(at), true, _) => {
            fields.refuse(at.place.error("both `every` and `at` are present", "keep one of them"))
        }
        (Some(_), false, Some(first)) => fields.refuse(
            first.place.error("`first` is present without `every`", "remove `first`, or `at`"),
        ),
        (Some(at), false, None) => listed(fields, at),
    };
    Some(WeakPlaces {
        positions: positions?,
        strength_n: strength?.value,
        place: fields.place.clone(),
    })
}

/// A list of lengths from the `from` end of a line.
fn listed(fields: &Fields<'_>, at: &Node) -> Option<WeakPositions> {
    let help = "write a list of lengths from the `from` end, such as [\"10 m\", \"25 m\"]";
    let Content::List(items) = &at.content else {
        return fields
            .refuse(at.place.error(format!("`at` is {}, not a list", at.content.noun()), help));
    };
    if items.is_empty() {
        return fields.refuse(at.place.error("`at` has no values", help));
    }
    // All items are read, so that each fault is reported.
    let read: Vec<_> = items
        .iter()
        .map(|item| read_value(item, Quantity::Length, ALONG, fields.problems()))
        .collect();
    read.into_iter().collect::<Option<_>>().map(WeakPositions::Listed)
}

/// Reads `[line.inserts]`.
fn inserts(fields: &Fields<'_>) -> Option<Inserts> {
    let what = insert(fields);
    let every = fields.need_value("every", Quantity::Length, ALONG);
    let first = fields.value("first", Quantity::Length, ALONG);
    let within = fields.value("within", Quantity::Ratio, Range::Between(0.0, 1.0));
    let end = fields.choice("counted_from", &ENDS);
    let knot = fields.text("knot");
    let (what, every) = (what?, every?);
    if let Insert::Rope { length_m, .. } = &what
        && every.value < *length_m + 0.01
    {
        let message = format!("`every` is {} m, but an insert is {length_m} m long", every.value);
        return fields.refuse(
            every.place.error(message, "write a longer `every`, so that inserts do not overlap"),
        );
    }
    Some(Inserts {
        what,
        counted_from: end.map_or(LineEnd::B, |end| end.value),
        first_m: first.map_or(every.value, |first| first.value),
        every_m: every.value,
        within: within.map_or(1.0, |within| within.value),
        knot,
        place: fields.place.clone(),
    })
}

/// `rope` with `length`, or `sleeve`.
fn insert(fields: &Fields<'_>) -> Option<Insert> {
    let (rope, sleeve) = (fields.text("rope"), fields.text("sleeve"));
    let length = fields.value("length", Quantity::Length, Range::Between(0.01, 100.0));
    match (rope, sleeve, length) {
        (Some(rope), None, Some(length)) => Some(Insert::Rope { rope, length_m: length.value }),
        (Some(_), None, None) => {
            fields.require("length", "write the length of an insert, such as \"3 ft\"");
            None
        }
        (None, Some(sleeve), None) => Some(Insert::Sleeve(sleeve)),
        (None, Some(sleeve), Some(_)) => {
            let help =
                "a sleeve has no length; remove `length`, or name a rope instead of a sleeve";
            fields.refuse(sleeve.place.error("a sleeve has no length", help))
        }
        (Some(rope), Some(_), _) => fields
            .refuse(rope.place.error("both `rope` and `sleeve` are present", "keep one of them")),
        (None, None, _) => {
            fields.missing(
                "rope",
                "write rope = \"weak-1700-3-8\" with a length, or sleeve = \"south-shore-1700\"",
            );
            None
        }
    }
}
