//! Parameters of a rule: the numbers that its text names, with unit, source and confidence.

use crate::confidence::Confidence;
use crate::diagnostic::Place;
use crate::fields::{Fields, Provenance, Range, read_figure};
use crate::tree::{Content, Node};
use crate::units::{self, Quantity, Unit};

/// A number of a rule.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The name by which expressions use it.
    pub key: String,
    /// Where its name stands.
    pub place: Place,
    /// Value [SI].
    pub value: f64,
    /// What it measures.
    pub quantity: Quantity,
    /// The unit in which the rule names it; none for a pure number.
    pub unit: Option<&'static Unit>,
    /// As the file has it, such as `1,700 lbf`.
    pub text: String,
    /// Where it comes from.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// Reads `[rule.parameters]`: a figure by each name.
pub(super) fn parameters(rule: &Fields<'_>, file: &Provenance) -> Vec<Parameter> {
    let Some(table) = rule.table("parameters") else { return Vec::new() };
    table.rest().into_iter().filter_map(|entry| parameter(rule, entry, file)).collect()
}

fn parameter(
    rule: &Fields<'_>,
    (key, place, node): &(String, Place, Node),
    file: &Provenance,
) -> Option<Parameter> {
    let (quantity, unit) = measured_in(node);
    let figure = read_figure(node, quantity, Range::Any, file, rule.problems())?;
    Some(Parameter {
        key: key.clone(),
        place: place.clone(),
        value: figure.value,
        quantity,
        unit,
        text: figure.text,
        source: figure.source,
        confidence: figure.confidence,
    })
}

/// What the unit of a figure measures: nothing says it besides the unit. A length, where the unit is not known.
fn measured_in(node: &Node) -> (Quantity, Option<&'static Unit>) {
    let value = match &node.content {
        Content::Table(entries) => entries.iter().find(|(key, ..)| key == "value"),
        _ => None,
    };
    let Content::Text(text) = &value.map_or(node, |(_, _, value)| value).content else {
        return (Quantity::Ratio, None);
    };
    let is_number = |letter: char| letter.is_ascii_digit() || " .,/+-".contains(letter);
    let unit = text.trim_start_matches(is_number).trim();
    let found = Quantity::ALL
        .into_iter()
        .find_map(|quantity| units::find(unit, quantity).map(|unit| (quantity, Some(unit))));
    found.unwrap_or((Quantity::Length, None))
}
