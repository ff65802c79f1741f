//! A prior: what is drawn for each encounter, by which law, and how sure that is.

use crate::diagnostic::{At, Place};
use crate::fields::{Fields, Range, read_value};
use crate::items::YEAR_S;
use crate::nearest::hint;
use crate::tree::{Content, Node};
use crate::units::{self, Quantity};

use super::option::library_field;

/// A quantity of the encounter with its distribution.
#[derive(Clone, Debug, PartialEq)]
pub struct Prior {
    /// Name: one of the known ones, or the dotted path of a field.
    pub name: At<String>,
    /// Where a drawn value goes.
    pub target: Target,
    /// Its distribution.
    pub law: Law,
    /// Where that comes from.
    pub source: String,
    /// How sure that is.
    pub basis: Basis,
}

/// Where a drawn value goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// One of the encounter's own quantities: the session knows what it does.
    Known,
    /// A field of the scenario.
    Scenario(String),
    /// A field of a library file.
    Library(String, String),
}

/// How sure a distribution is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// Measured on whales or gear.
    Measured,
    /// Computed from what was measured.
    Derived,
    /// Nobody measured it.
    Assumed,
}

impl Basis {
    const ALL: [Self; 3] = [Self::Measured, Self::Derived, Self::Assumed];

    /// Its word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Derived => "derived",
            Self::Assumed => "assumed",
        }
    }
}

/// A distribution. Numbers are SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Even between two values.
    Uniform {
        /// Least.
        low: f64,
        /// Greatest.
        high: f64,
        /// What it measures.
        quantity: Quantity,
    },
    /// Normal, cut off at two values.
    Normal {
        /// Mean before cutting off.
        mean: f64,
        /// Standard deviation before cutting off.
        deviation: f64,
        /// Least.
        low: f64,
        /// Greatest.
        high: f64,
        /// What it measures.
        quantity: Quantity,
    },
    /// One of a few values by their weights, which add up to 1; in the order of their texts.
    Choice(Vec<(Level, f64)>),
}

impl Law {
    /// A drawn number [SI] as the file would have it, to three figures: `1.18 m/s`; a level by its own text.
    #[must_use]
    pub fn told(&self, number: f64) -> String {
        let rounded: f64 = format!("{number:.2e}").parse().unwrap_or(number);
        match self {
            Self::Uniform { quantity, .. } | Self::Normal { quantity, .. } => {
                in_words(rounded, *quantity)
            }
            Self::Choice(levels) => {
                let same = |level: &Level| {
                    level.number.is_some_and(|known| known.total_cmp(&number).is_eq())
                };
                levels
                    .iter()
                    .find(|(level, _)| same(level))
                    .map_or_else(|| rounded.to_string(), |(level, _)| level.text.clone())
            }
        }
    }

    /// In words, such as `even from 0.6 m/s to 1.6 m/s`.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Uniform { low, high, quantity } => {
                format!("even from {} to {}", in_words(*low, *quantity), in_words(*high, *quantity))
            }
            Self::Normal { mean, deviation, low, high, quantity } => {
                let [mean, deviation, low, high] =
                    [mean, deviation, low, high].map(|value| in_words(*value, *quantity));
                format!("normal about {mean} with deviation {deviation}, from {low} to {high}")
            }
            Self::Choice(levels) => {
                let level = |(level, weight): &(Level, f64)| {
                    format!("{} {:.0} %", level.text, 100.0 * weight)
                };
                levels.iter().map(level).collect::<Vec<_>>().join(", ")
            }
        }
    }
}

/// A value with its unit: angles in degrees, all else in SI.
fn in_words(value: f64, quantity: Quantity) -> String {
    if quantity == Quantity::Angle {
        return format!("{} deg", value.to_degrees().round());
    }
    units::format_si(value, quantity)
}

impl Prior {
    /// Its name for people: `flipper sweep`, `friction coefficient scale`.
    #[must_use]
    pub fn words(&self) -> String {
        let parts = self
            .name
            .value
            .split(['.', '/'])
            .filter(|part| *part != "attributes" && part.parse::<usize>().is_err());
        parts.collect::<Vec<_>>().join(" ").replace('_', " ")
    }
}

/// A value that may be chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// As written.
    pub text: String,
    /// Its number [SI]; none for a word.
    pub number: Option<f64>,
    /// Whether it stands in a file without quotes.
    pub plain: bool,
}

/// What a known prior takes.
#[derive(Clone, Copy)]
enum Takes {
    Number(Quantity, Range),
    Word,
}

/// The encounter's own quantities.
const KNOWN: [(&str, Takes); 17] = [
    ("age", Takes::Number(Quantity::Time, Range::Between(0.0, 120.0 * YEAR_S))),
    ("answer", Takes::Word),
    ("answer_above", Takes::Number(Quantity::Force, Range::NotNegative)),
    ("behaviour", Takes::Word),
    ("condition", Takes::Number(Quantity::Ratio, Range::Between(0.65, 1.5))),
    ("depth", Takes::Number(Quantity::Length, Range::Between(0.0, 6000.0))),
    ("flipper_raise", Takes::Number(Quantity::Ratio, Range::Between(-1.0, 1.0))),
    ("flipper_sweep", Takes::Number(Quantity::Ratio, Range::Between(-1.0, 1.0))),
    ("flipper_twist", Takes::Number(Quantity::Ratio, Range::Between(-1.0, 1.0))),
    ("gape", Takes::Number(Quantity::Ratio, Range::Between(0.0, 1.0))),
    ("heading", Takes::Number(Quantity::Angle, Range::Any)),
    ("length", Takes::Number(Quantity::Length, Range::Between(1.0, 35.0))),
    ("offset", Takes::Number(Quantity::Length, Range::Between(-100.0, 100.0))),
    ("pitch", Takes::Number(Quantity::Angle, Range::Any)),
    ("roll", Takes::Number(Quantity::Angle, Range::Any)),
    ("speed", Takes::Number(Quantity::Speed, Range::Between(0.0, 15.0))),
    ("tide", Takes::Number(Quantity::Speed, Range::Between(0.0, 10.0))),
];

/// Reads every table of `[encounter]` that is left, sorted by name.
pub(super) fn read_all(fields: &Fields<'_>) -> Vec<Prior> {
    let mut priors: Vec<Prior> = fields
        .rest()
        .into_iter()
        .filter_map(|(name, key, node)| read(name, key, node, fields))
        .collect();
    priors.sort_by(|one, other| one.name.value.cmp(&other.name.value));
    priors
}

fn read(name: &str, key: &Place, node: &Node, outer: &Fields<'_>) -> Option<Prior> {
    let problems = outer.problems();
    let known = KNOWN.iter().find(|(known, _)| *known == name).map(|(_, takes)| *takes);
    let target = match (known, library_field(name)) {
        (Some(_), _) => Target::Known,
        (None, Some((file, field))) => Target::Library(file, field.to_owned()),
        (None, None) if name.contains('.') => Target::Scenario(name.to_owned()),
        _ => {
            let names = KNOWN.iter().map(|(known, _)| *known).chain(["aim", "aim_by", "gap"]);
            let help = hint(name, names);
            problems.push(key.error(
                format!("nothing of an encounter is called `{name}`"),
                format!("{help} A field of the scenario or of a library item goes by its dotted path in quotes"),
            ));
            return None;
        }
    };
    let fields = Fields::of(node, problems);
    let law = law(&fields, known);
    let source = fields.text("source");
    let basis = fields.word("sureness", &Basis::ALL.map(Basis::word));
    if source.is_none() && fields.get("source").is_none() {
        fields.missing("source", "say where the distribution comes from, or source = \"assumed\"");
    }
    fields.finish();
    let source = source?;
    let assumed = source.value == "assumed";
    let basis =
        basis.and_then(|word| Basis::ALL.into_iter().find(|basis| basis.word() == word.value));
    if basis.is_none() && !assumed {
        problems.push(source.place.error(
            format!("`{name}` has a source but no sureness"),
            "write sureness = \"measured\", \"derived\" or \"assumed\" beside it",
        ));
    }
    let name = At { value: name.to_owned(), place: key.clone() };
    Some(Prior {
        name,
        target,
        law: law?,
        basis: basis.unwrap_or(Basis::Assumed),
        source: source.value,
    })
}

/// One of `uniform`, `normal` with `between`, `choice` with `weights`, or `value`.
fn law(fields: &Fields<'_>, known: Option<Takes>) -> Option<Law> {
    let given = ["uniform", "normal", "choice", "value"].map(|key| fields.get(key));
    let between = fields.get("between");
    let weights = fields.get("weights");
    match given {
        [Some(node), None, None, None] => {
            let (pair, quantity) = numbers(node, known, fields)?;
            let [low, high] = two(&pair, node, fields)?;
            if low >= high {
                fields.problems().push(node.place.error(
                    "the first value is not below the second",
                    "write the least value first; value = … where it does not vary",
                ));
                return None;
            }
            Some(Law::Uniform { low, high, quantity })
        }
        [None, Some(node), None, None] => normal(node, between, known, fields),
        [None, None, Some(node), None] => choice(node, weights, known, fields),
        [None, None, None, Some(node)] => {
            Some(Law::Choice(vec![(level(node, known, fields)?, 1.0)]))
        }
        _ => {
            fields.missing("uniform", "write one of uniform = [least, greatest], normal = [mean, deviation] with between = [least, greatest], choice = [a, b] or value = a");
            None
        }
    }
}

fn normal(
    node: &Node,
    between: Option<&Node>,
    known: Option<Takes>,
    fields: &Fields<'_>,
) -> Option<Law> {
    let Some(between) = between else {
        fields.missing("between", "a normal law is cut off: write between = [least, greatest]");
        return None;
    };
    // A deviation need not lie in the quantity's own range.
    let free = known.map(|takes| {
        if let Takes::Number(quantity, _) = takes {
            Takes::Number(quantity, Range::Any)
        } else {
            takes
        }
    });
    let (pair, quantity) = numbers(node, free, fields)?;
    let [mean, deviation] = two(&pair, node, fields)?;
    let (ends, _) = numbers(between, known, fields)?;
    let [low, high] = two(&ends, between, fields)?;
    if deviation <= 0.0 || low >= high {
        fields.problems().push(node.place.error(
            "this normal law has no width",
            "the deviation is above zero, and `between` rises",
        ));
        return None;
    }
    Some(Law::Normal { mean, deviation, low, high, quantity })
}

fn choice(
    node: &Node,
    weights: Option<&Node>,
    known: Option<Takes>,
    fields: &Fields<'_>,
) -> Option<Law> {
    let Content::List(items) = &node.content else {
        fields.problems().push(node.place.error(
            "`choice` is no list",
            "write choice = [a, b], and weights = [0.7, 0.3] where they are not alike",
        ));
        return None;
    };
    let levels =
        items.iter().map(|item| level(item, known, fields)).collect::<Option<Vec<Level>>>()?;
    let weights = match weights {
        None => vec![1.0; levels.len()],
        Some(node) => {
            let Content::List(items) = &node.content else { return None };
            let read = items.iter().map(|item| {
                read_value(item, Quantity::Ratio, Range::NotNegative, fields.problems())
                    .map(|at| at.value)
            });
            read.collect::<Option<Vec<f64>>>()?
        }
    };
    let sum: f64 = weights.iter().sum();
    if weights.len() != levels.len() || levels.is_empty() || sum <= 0.0 {
        fields.problems().push(node.place.error(
            "`choice` and `weights` do not fit",
            "give as many weights as values, not all zero",
        ));
        return None;
    }
    let mut choice: Vec<(Level, f64)> =
        levels.into_iter().zip(weights.into_iter().map(|weight| weight / sum)).collect();
    choice.sort_by(|one, other| one.0.text.cmp(&other.0.text));
    Some(Law::Choice(choice))
}

fn level(node: &Node, known: Option<Takes>, fields: &Fields<'_>) -> Option<Level> {
    if let Some(Takes::Number(quantity, range)) = known {
        let number = read_value(node, quantity, range, fields.problems())?.value;
        let text =
            if let Content::Text(text) = &node.content { text.clone() } else { number.to_string() };
        return Some(Level { text, number: Some(number), plain: quantity == Quantity::Ratio });
    }
    match &node.content {
        Content::Text(text) => Some(Level {
            text: text.clone(),
            number: quantity_of(text).map(|(_, number)| number),
            plain: false,
        }),
        Content::Number(number) => {
            Some(Level { text: number.to_string(), number: Some(*number), plain: true })
        }
        Content::Flag(flag) => Some(Level { text: flag.to_string(), number: None, plain: true }),
        other => {
            fields.problems().push(node.place.error(
                format!("this is {}", other.noun()),
                "write a text, a number, true or false",
            ));
            None
        }
    }
}

/// A list of numbers, all of one quantity.
fn numbers(node: &Node, known: Option<Takes>, fields: &Fields<'_>) -> Option<(Vec<f64>, Quantity)> {
    let Content::List(items) = &node.content else {
        fields.problems().push(node.place.error("this is no list", "write two values in brackets"));
        return None;
    };
    let (quantity, range) = match known {
        Some(Takes::Number(quantity, range)) => (quantity, range),
        Some(Takes::Word) => {
            fields.problems().push(
                node.place.error("this is drawn among words", "write choice = [\"…\", \"…\"]"),
            );
            return None;
        }
        None => {
            let first = items.first().map(|item| &item.content);
            let quantity = if let Some(Content::Text(text)) = first {
                quantity_of(text).map(|(quantity, _)| quantity)
            } else {
                None
            };
            (quantity.unwrap_or(Quantity::Ratio), Range::Any)
        }
    };
    let read: Vec<_> =
        items.iter().map(|item| read_value(item, quantity, range, fields.problems())).collect();
    let values = read
        .into_iter()
        .map(|value| value.map(|value| value.value))
        .collect::<Option<Vec<f64>>>()?;
    Some((values, quantity))
}

fn two(values: &[f64], node: &Node, fields: &Fields<'_>) -> Option<[f64; 2]> {
    if let [first, second] = *values {
        return Some([first, second]);
    }
    fields
        .problems()
        .push(node.place.error(format!("there are {} values", values.len()), "write two"));
    None
}

/// What a text with a unit measures.
fn quantity_of(text: &str) -> Option<(Quantity, f64)> {
    Quantity::ALL
        .into_iter()
        .find_map(|quantity| Some((quantity, units::parse(text, quantity).ok()?)))
}
