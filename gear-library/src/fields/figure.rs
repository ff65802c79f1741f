//! Figures: values with source and confidence.

use super::Fields;
use super::problems::Problems;
use super::range::Range;
use super::value::read_value;
use crate::confidence::{Confidence, FORMER_CONFIDENCE};
use crate::diagnostic::Place;
use crate::document::UNSOURCED;
use crate::tree::{Content, Node};
use crate::units::{Quantity, format_si};

/// A number that enters physics: value, as written, source, confidence.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Value [SI].
    pub value: f64,
    /// As the file has it, such as `3/8 in`.
    pub text: String,
    /// Where it comes from.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
    /// Where the value stands.
    pub place: Place,
}

impl Figure {
    /// Whether it was typed, and nobody has said since where it comes from.
    #[must_use]
    pub fn is_unsourced(&self) -> bool {
        self.source == UNSOURCED
    }
}

/// Source and confidence of figures that name none of their own.
#[derive(Clone, Debug, Default)]
pub struct Provenance {
    /// The file's source.
    pub source: Option<String>,
    /// The file's confidence.
    pub confidence: Option<Confidence>,
}

impl Provenance {
    /// Reports a figure that has no source or no confidence.
    fn check(&self, figure: &Node, problems: &Problems) {
        let has_source = self.source.as_ref().is_some_and(|source| !source.trim().is_empty());
        let lacks = match self.confidence {
            None => "confidence",
            Some(_) if has_source => return,
            Some(_) => "source",
        };
        let message = format!("`{}` has no {lacks}", figure.place.field);
        problems.push(figure.place.error(message, HOW_TO_SOURCE));
    }
}

/// How a figure is given its source.
const HOW_TO_SOURCE: &str =
    "write { value = …, source = \"…\", confidence = \"measured\" }, or one for the whole file";

/// Reads a figure: `"3/8 in"` with the file's source and confidence, or a table with its own.
/// `None` where something is missing or wrong, which is reported.
pub fn read_figure(
    node: &Node,
    quantity: Quantity,
    range: Range,
    file: &Provenance,
    problems: &Problems,
) -> Option<Figure> {
    let help = format!("expected {} such as {}", quantity.noun(), quantity.examples());
    let (value, own) = value_of(node, file, &help, problems)?;
    let read = read_value(&named_as(node, value), quantity, range, problems);
    own.check(node, problems);
    let text = match &value.content {
        Content::Text(text) => text.clone(),
        _ => format_si(read.as_ref()?.value, quantity),
    };
    Some(Figure {
        value: read?.value,
        text,
        source: own.source?,
        confidence: own.confidence?,
        place: value.place.clone(),
    })
}

/// The value of a figure whose quantity is not known yet: `"3/8 in"` with the file's source and
/// confidence, or a table with its own. `None` where it is missing, which is reported.
pub fn sourced(node: &Node, file: &Provenance, problems: &Problems) -> Option<Node> {
    let (value, own) = value_of(node, file, "write the value here", problems)?;
    own.check(node, problems);
    Some(named_as(node, value))
}

/// The value of a figure, and where it comes from.
fn value_of<'a>(
    node: &'a Node,
    file: &Provenance,
    help: &str,
    problems: &'a Problems,
) -> Option<(&'a Node, Provenance)> {
    if !matches!(node.content, Content::Table(_)) {
        return Some((node, file.clone()));
    }
    let fields = Fields::of(node, problems);
    let value = fields.get("value");
    let own = provenance_over(&fields, file);
    if value.is_none() {
        fields.missing("value", help);
    }
    fields.finish();
    Some((value?, own))
}

/// A figure's value under the name of the figure, for messages.
fn named_as(figure: &Node, value: &Node) -> Node {
    let mut named = value.clone();
    named.place.field.clone_from(&figure.place.field);
    named
}

/// Reads the file's own source and confidence.
pub fn provenance(fields: &Fields<'_>) -> Provenance {
    let source = fields.text("source").map(|text| text.value);
    Provenance { source, confidence: confidence(fields, &Confidence::OF_FIGURES) }
}

/// Reads a table's own source and confidence over those of the file.
pub fn provenance_over(fields: &Fields<'_>, file: &Provenance) -> Provenance {
    let own = provenance(fields);
    Provenance {
        source: own.source.or_else(|| file.source.clone()),
        confidence: own.confidence.or(file.confidence),
    }
}

/// Reads how well something is known, in one of the words allowed, where it is given: `confidence`,
/// or `sureness` in older files.
pub fn confidence(fields: &Fields<'_>, words: &[&str]) -> Option<Confidence> {
    let key = if fields.get("confidence").is_some() { "confidence" } else { FORMER_CONFIDENCE };
    fields.word(key, words).and_then(|word| Confidence::from_word(&word.value))
}
