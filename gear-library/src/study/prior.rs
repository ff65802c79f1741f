//! Priors: the distributions of the quantities of encounters.
//!
//! Importance sampling draws from a proposal and weights by the density of the prior over that of the proposal.
//! Both must have equal support.

use crate::diagnostic::{At, Place, hint};
use crate::entry::Confidence;
use crate::fields::{Fields, Problems, Range, confidence, read_value};
use crate::items::YEAR_S;
use crate::tree::{Content, Node};
use crate::units::{self, Quantity};

use super::option::library_field;

/// A quantity of the encounter with its distribution.
#[derive(Clone, Debug, PartialEq)]
pub struct Prior {
    /// Name: a quantity of the encounter, or the dotted path of a field.
    pub name: At<String>,
    /// Target of a drawn value.
    pub target: Target,
    /// Its distribution.
    pub law: Law,
    /// The distribution from which most encounters are drawn, weighted by the prior.
    pub proposal: Option<Law>,
    /// Source.
    pub source: String,
    /// Confidence.
    pub confidence: Confidence,
}

/// Target of a drawn value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// A quantity of the encounter, which the session applies.
    Known,
    /// A field of the scenario.
    Scenario(String),
    /// A field of a library file.
    Library(String, String),
}

impl Prior {
    /// Its name in words: `sweep of the flippers`, `scale of friction`.
    pub fn words(&self) -> String {
        prior_words(&self.name.value)
    }
}

/// Names of priors in words, by their paths without numbers.
const NAMED: [(&str, &str); 19] = [
    ("along", "place along the line"),
    ("answer", "first response to rope"),
    ("answer_above", "force above which it responds"),
    ("flipper_raise", "raise of the flippers"),
    ("flipper_sweep", "sweep of the flippers"),
    ("flipper_twist", "twist of the flippers"),
    ("friction.attributes.coefficient_scale", "scale of friction"),
    ("friction.on.model", "law of friction on a part"),
    ("gear.assembly", "gear"),
    ("gear.heading", "heading of the gear"),
    ("offset", "distance of the path from the rope"),
    ("whale.contact_stiffness", "stiffness of skin"),
    ("whale.effort", "what limits the thrust"),
    ("whale.pilot.act", "act of the pilot program"),
    ("whale.pilot.delay", "delay of the pilot program"),
    ("whale.pilot.pitch", "pitch by the pilot program"),
    ("whale.pilot.sees", "distance at which it sees rope"),
    ("whale.pilot.yaw", "yaw by the pilot program"),
    ("tide", "current of the tide"),
];

/// The name of a prior in words: `sweep of the flippers`, `scale of friction`. The words of another path are its parts.
pub fn prior_words(name: &str) -> String {
    let parts: Vec<&str> = name.split('.').filter(|part| part.parse::<usize>().is_err()).collect();
    let path = parts.join(".");
    if let Some((_, words)) = NAMED.iter().find(|(known, _)| *known == path) {
        return (*words).to_owned();
    }
    let spoken = |part: &str| part.replace('_', " ");
    if let ["whale", "answers", when, act] = parts[..] {
        return format!("weight of the act {}, {}", spoken(act), spoken(when));
    }
    let parts = parts.iter().flat_map(|part| part.split('/')).filter(|part| *part != "attributes");
    parts.map(spoken).collect::<Vec<_>>().join(" ")
}

/// The folder of the gear library from which a field of a scenario takes an item: `assemblies` for `gear.0.assembly`; `None` for other
/// fields.
pub fn referenced_folder(field: &str) -> Option<&'static str> {
    let parts: Vec<&str> = field.split('.').filter(|part| part.parse::<usize>().is_err()).collect();
    match parts[..] {
        [.., "assembly"] => Some("assemblies"),
        [.., "rope" | "upper_rope" | "lower_rope" | "groundline" | "bridle_rope"] => Some("ropes"),
        [.., "trap"] => Some("traps"),
        [.., "buoy"] => Some("buoys"),
        [.., "anchor"] => Some("anchors"),
        [.., "weak_link" | "panel_link"] | ["link", "item"] => Some("weak-links"),
        ["whale", "item"] => Some("whales"),
        ["site", "item"] => Some("sites"),
        _ => None,
    }
}

/// Reads the remaining tables of `[encounter]`, sorted by name.
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
    let Some(target) = target(name, known.is_some()) else {
        let names = KNOWN.iter().map(|(known, _)| *known).chain(["aim", "aim_by", "gap"]);
        let help = hint(name, names);
        return problems.refuse(key.error(
            format!("an encounter has no quantity `{name}`"),
            format!("{help} Write a field of the scenario or of a library item as a dotted path in quotes"),
        ));
    };
    let fields = Fields::of(node, problems);
    let law = law(&fields, known);
    let proposal = law.as_ref().and_then(|law| proposal(&fields, law, known));
    let source = fields.text("source");
    let level = confidence(&fields, &Confidence::OF_PRIORS);
    if source.is_none() && fields.get("source").is_none() {
        fields.missing("source", "write the source of the distribution, or source = \"assumed\"");
    }
    fields.finish();
    let source = source?;
    if level.is_none() && source.value != "assumed" {
        problems.push(source.place.error(
            format!("`{name}` has a source but no confidence"),
            "write confidence = \"measured\", \"derived\", \"estimate\" or \"assumed\" beside it",
        ));
    }
    let name = At { value: name.to_owned(), place: key.clone() };
    Some(Prior {
        name,
        target,
        law: law?,
        proposal,
        confidence: level.unwrap_or(Confidence::Assumed),
        source: source.value,
    })
}

/// `proposal`: a distribution with equal support.
fn proposal(fields: &Fields<'_>, prior: &Law, known: Option<Takes>) -> Option<Law> {
    let table = fields.table("proposal")?;
    let law = law(&table, known);
    table.finish();
    let place = fields.get("proposal").map(|node| node.place.clone());
    let same =
        |law: &Law| place.is_some_and(|place| check_same(prior, law, &place, fields.problems()));
    law.filter(same)
}

/// Target of the values of a name; `None` for an unknown name.
fn target(name: &str, known: bool) -> Option<Target> {
    match library_field(name) {
        _ if known => Some(Target::Known),
        Some((file, field)) => Some(Target::Library(file, field.to_owned())),
        None => name.contains('.').then(|| Target::Scenario(name.to_owned())),
    }
}

/// Values of a known prior.
#[derive(Clone, Copy)]
enum Takes {
    /// Numbers of a quantity within a range.
    Number(Quantity, Range),
    /// Words.
    Word,
}

/// Quantities of the encounter.
const KNOWN: [(&str, Takes); 18] = [
    ("age", Takes::Number(Quantity::Time, Range::Between(0.0, 120.0 * YEAR_S))),
    ("along", Takes::Number(Quantity::Ratio, Range::Between(0.0, 1.0))),
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

/// A distribution. Numbers are SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Uniform between two values.
    Uniform {
        /// Least.
        low: f64,
        /// Greatest.
        high: f64,
        /// Physical quantity.
        quantity: Quantity,
    },
    /// Normal, truncated at two values.
    Normal {
        /// Mean before truncation.
        mean: f64,
        /// Standard deviation before truncation.
        deviation: f64,
        /// Least.
        low: f64,
        /// Greatest.
        high: f64,
        /// Physical quantity.
        quantity: Quantity,
    },
    /// Uniform within each of several adjacent ranges, with shares that add up to 1.
    Bins {
        /// Ends of the ranges, rising.
        edges: Vec<f64>,
        /// Shares of the ranges.
        shares: Vec<f64>,
        /// Physical quantity.
        quantity: Quantity,
    },
    /// One of several values with weights that add up to 1, in the order of their texts.
    Choice(Vec<(Level, f64)>),
}

impl Law {
    /// A drawn number [SI] as written in a file, to three digits: `1.18 m/s`; the text of a level.
    pub fn written(&self, number: f64) -> String {
        let rounded: f64 = format!("{number:.2e}").parse().unwrap_or(number);
        match self {
            Self::Uniform { quantity, .. }
            | Self::Normal { quantity, .. }
            | Self::Bins { quantity, .. } => in_words(rounded, *quantity),
            Self::Choice(levels) => {
                let is_drawn = |level: &Level| {
                    level.number.is_some_and(|known| known.total_cmp(&number).is_eq())
                };
                levels
                    .iter()
                    .find(|(level, _)| is_drawn(level))
                    .map_or_else(|| rounded.to_string(), |(level, _)| level.text.clone())
            }
        }
    }

    /// In words, such as `even from 0.6 m/s to 1.6 m/s`.
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
            Self::Bins { edges, shares, quantity } => {
                let range = |(ends, share): (&[f64], &f64)| {
                    let [low, high] = [ends[0], ends[1]].map(|end| in_words(end, *quantity));
                    format!("{:.0} % from {low} to {high}", 100.0 * share)
                };
                edges.windows(2).zip(shares).map(range).collect::<Vec<_>>().join(", ")
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

/// A value with its unit: angles in degrees, others in SI.
fn in_words(value: f64, quantity: Quantity) -> String {
    if quantity == Quantity::Angle {
        return format!("{} deg", value.to_degrees().round());
    }
    units::format_si(value, quantity)
}

/// A value of a choice.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// As written.
    pub text: String,
    /// Its number [SI]; `None` for a word.
    pub number: Option<f64>,
    /// Whether it is written without quotes.
    pub plain: bool,
}

impl Law {
    /// Least and greatest number; `None` for a choice.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self {
            Self::Uniform { low, high, .. } | Self::Normal { low, high, .. } => Some([*low, *high]),
            Self::Bins { edges, .. } => Some([*edges.first()?, *edges.last()?]),
            Self::Choice(_) => None,
        }
    }

    /// Texts of the levels of a choice with positive weight, in order; empty for other laws.
    fn levels(&self) -> Vec<&str> {
        let Self::Choice(levels) = self else { return Vec::new() };
        let drawn = levels.iter().filter(|(_, weight)| *weight > 0.0);
        drawn.map(|(level, _)| level.text.as_str()).collect()
    }

    /// Ranges of zero share.
    fn gaps(&self) -> Vec<[f64; 2]> {
        let Self::Bins { edges, shares, .. } = self else { return Vec::new() };
        let empty = edges.windows(2).zip(shares).filter(|(_, share)| **share <= 0.0);
        empty.map(|(ends, _)| [ends[0], ends[1]]).collect()
    }
}

/// Whether proposal and prior have equal support; a difference is reported.
fn check_same(prior: &Law, proposal: &Law, place: &Place, problems: &Problems) -> bool {
    let problem = match (prior.ends(), proposal.ends()) {
        (Some(own), Some(other)) => differing_ranges(prior, proposal, own, other),
        (None, None) => (prior.levels() != proposal.levels()).then(|| {
            format!(
                "the proposal draws {} where the prior has {}",
                proposal.levels().join(", "),
                prior.levels().join(", ")
            )
        }),
        _ => Some("one of proposal and prior is a range and the other a choice".into()),
    };
    let same = problem.is_none();
    if let Some(problem) = problem {
        problems.push(place.error(
            problem,
            "a proposal has the values of its prior with other shares, all above zero",
        ));
    }
    same
}

fn differing_ranges(prior: &Law, proposal: &Law, own: [f64; 2], other: [f64; 2]) -> Option<String> {
    let width = own[1] - own[0];
    let far = |one: f64, other: f64| (one - other).abs() > 1e-9 * width;
    if far(own[0], other[0]) || far(own[1], other[1]) {
        return Some(format!(
            "the proposal reaches from {} to {}, the prior from {} to {} (SI units)",
            other[0], other[1], own[0], own[1]
        ));
    }
    let differ = prior.gaps() != proposal.gaps();
    differ.then(|| "the proposal and the prior leave out different ranges".to_owned())
}

/// One of `uniform`, `normal` with `between`, `bins` or `choice` with `weights`, or `value`.
fn law(fields: &Fields<'_>, known: Option<Takes>) -> Option<Law> {
    let laws = ["uniform", "normal", "bins", "choice", "value"].map(|key| fields.get(key));
    let between = fields.get("between");
    let weights = fields.get("weights");
    match laws {
        [Some(node), None, None, None, None] => uniform(node, known, fields),
        [None, Some(node), None, None, None] => normal(node, between, known, fields),
        [None, None, Some(node), None, None] => bins(node, weights, known, fields),
        [None, None, None, Some(node), None] => choice(node, weights, known, fields),
        [None, None, None, None, Some(node)] => {
            Some(Law::Choice(vec![(level(node, known, fields)?, 1.0)]))
        }
        _ => {
            fields.missing("uniform", "write one of uniform = [least, greatest], normal = [mean, deviation] with between = [least, greatest], bins = [a, b, c] with weights = [0.3, 0.7], choice = [a, b] or value = a");
            None
        }
    }
}

fn uniform(node: &Node, known: Option<Takes>, fields: &Fields<'_>) -> Option<Law> {
    let (pair, quantity) = numbers(node, known, fields)?;
    let [low, high] = two(&pair, node, fields)?;
    if low >= high {
        return fields.refuse(node.place.error(
            "the first value is not below the second",
            "write the least value first; or value = … for a constant",
        ));
    }
    Some(Law::Uniform { low, high, quantity })
}

fn normal(
    node: &Node,
    between: Option<&Node>,
    known: Option<Takes>,
    fields: &Fields<'_>,
) -> Option<Law> {
    let Some(between) = between else {
        fields.missing("between", "a normal law is truncated: write between = [least, greatest]");
        return None;
    };
    // A deviation may be outside the range of the quantity.
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
        return fields.refuse(node.place.error(
            "this normal law has no width",
            "write a deviation above zero, and rising values of `between`",
        ));
    }
    Some(Law::Normal { mean, deviation, low, high, quantity })
}

fn bins(
    node: &Node,
    weights: Option<&Node>,
    known: Option<Takes>,
    fields: &Fields<'_>,
) -> Option<Law> {
    let (edges, quantity) = numbers(node, known, fields)?;
    let weights = weights.map_or_else(|| Some(Vec::new()), |node| shares(node, fields))?;
    let sum: f64 = weights.iter().sum();
    let rises = edges.len() > 1 && edges.windows(2).all(|ends| ends[0] < ends[1]);
    if !rises || weights.len() + 1 != edges.len() || sum <= 0.0 {
        return fields.refuse(node.place.error(
            "`bins` and `weights` do not fit",
            "write the ends of ranges in rising order, and one weight for each range, not all zero",
        ));
    }
    let shares = weights.into_iter().map(|weight| weight / sum).collect();
    Some(Law::Bins { edges, shares, quantity })
}

/// Weights as they are written.
fn shares(node: &Node, fields: &Fields<'_>) -> Option<Vec<f64>> {
    let Content::List(items) = &node.content else {
        return fields.refuse(node.place.error(
            format!("`weights` is {}", node.content.noun()),
            "write a list of numbers, such as weights = [0.7, 0.3]",
        ));
    };
    let read = items.iter().map(|item| {
        read_value(item, Quantity::Ratio, Range::NotNegative, fields.problems()).map(|at| at.value)
    });
    read.collect()
}

fn choice(
    node: &Node,
    weights: Option<&Node>,
    known: Option<Takes>,
    fields: &Fields<'_>,
) -> Option<Law> {
    let Content::List(items) = &node.content else {
        return fields.refuse(node.place.error(
            "`choice` is not a list",
            "write choice = [a, b], and weights = [0.7, 0.3] if they differ",
        ));
    };
    let levels =
        items.iter().map(|item| level(item, known, fields)).collect::<Option<Vec<Level>>>()?;
    let weights = match weights {
        None => vec![1.0; levels.len()],
        Some(node) => shares(node, fields)?,
    };
    let sum: f64 = weights.iter().sum();
    if weights.len() != levels.len() || levels.is_empty() || sum <= 0.0 {
        return fields.refuse(node.place.error(
            "`choice` and `weights` do not fit",
            "write as many weights as values, not all zero",
        ));
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
            fields.refuse(node.place.error(
                format!("this is {}", other.noun()),
                "write a text, a number, true or false",
            ))
        }
    }
}

/// A list of numbers, all of one quantity.
fn numbers(node: &Node, known: Option<Takes>, fields: &Fields<'_>) -> Option<(Vec<f64>, Quantity)> {
    let Content::List(items) = &node.content else {
        return fields
            .refuse(node.place.error("this is not a list", "write two values in brackets"));
    };
    let (quantity, range) = match known {
        Some(Takes::Number(quantity, range)) => (quantity, range),
        Some(Takes::Word) => {
            return fields.refuse(
                node.place.error("this is a choice of words", "write choice = [\"…\", \"…\"]"),
            );
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
    fields.refuse(node.place.error(format!("there are {} values", values.len()), "write two"))
}

/// Quantity and value of a text with a unit.
fn quantity_of(text: &str) -> Option<(Quantity, f64)> {
    Quantity::ALL
        .iter()
        .copied()
        .find_map(|quantity| Some((quantity, units::parse(text, quantity).ok()?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_priors_read_as_words() {
        for (name, words) in [
            ("speed", "speed"),
            ("flipper_sweep", "sweep of the flippers"),
            ("friction.attributes.coefficient_scale", "scale of friction"),
            ("friction.on.0.model", "law of friction on a part"),
            ("whale.pilot.1.sees", "distance at which it sees rope"),
            ("whale.answers.held_by_fin.bolt", "weight of the act bolt, held by fin"),
            (
                "assemblies/groundline-trawl.line.0.length",
                "assemblies groundline-trawl line length",
            ),
        ] {
            assert_eq!(prior_words(name), words);
        }
    }
}
