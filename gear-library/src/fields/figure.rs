//! Values with units, such as `"3/8 in"`, their ranges, and figures: values with source and confidence.

use crate::diagnostic::{At, Place};
use crate::document::UNSOURCED;
use crate::entry::{Confidence, FORMER_CONFIDENCE};
use crate::limits::{self, Limit};
use crate::tree::{Content, Node};
use crate::units::{self, Quantity, format_si};

use super::{Fields, Problems};

/// A number used in the physics, with its source and confidence.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Value [SI].
    pub value: f64,
    /// The value as written, such as `3/8 in`.
    pub text: String,
    /// Source.
    pub source: String,
    /// Confidence.
    pub confidence: Confidence,
    /// Place of the value.
    pub place: Place,
}

impl Figure {
    /// Whether it was typed in the program and has no source yet.
    pub fn is_unsourced(&self) -> bool {
        self.source == UNSOURCED
    }
}

/// Source and confidence of figures without their own.
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

/// Help on a missing source or confidence.
const HOW_TO_SOURCE: &str =
    "write { value = …, source = \"…\", confidence = \"measured\" }, or both for the whole file";

/// Reads a figure: `"3/8 in"` with the file's source and confidence, or a table with its own.
/// `None` if it is incomplete or wrong, which is reported.
pub fn read_figure(
    node: &Node,
    quantity: Quantity,
    range: Range,
    file: &Provenance,
    problems: &Problems,
) -> Option<Figure> {
    let help = quantity.expected();
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

/// The value of a figure whose quantity is not known yet; its source and confidence are checked.
/// `None` if it is missing, which is reported.
pub fn sourced(node: &Node, file: &Provenance, problems: &Problems) -> Option<Node> {
    let (value, own) = value_of(node, file, "write the value here", problems)?;
    own.check(node, problems);
    Some(named_as(node, value))
}

/// The value of a figure and its provenance.
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

/// The value under the field name of its figure, for messages.
fn named_as(figure: &Node, value: &Node) -> Node {
    let mut named = value.clone();
    named.place.field.clone_from(&figure.place.field);
    named
}

/// Reads the source and confidence of a table.
pub fn provenance(fields: &Fields<'_>) -> Provenance {
    let source = fields.text("source").map(|text| text.value);
    Provenance { source, confidence: confidence(fields, &Confidence::OF_FIGURES) }
}

/// Reads the source and confidence of a table; those of the file are the defaults.
pub fn provenance_over(fields: &Fields<'_>, file: &Provenance) -> Provenance {
    let own = provenance(fields);
    Provenance {
        source: own.source.or_else(|| file.source.clone()),
        confidence: own.confidence.or(file.confidence),
    }
}

/// Reads `confidence` (`sureness` in older files), one of the allowed words.
pub fn confidence(fields: &Fields<'_>, words: &[&str]) -> Option<Confidence> {
    let key = if fields.get("confidence").is_some() { "confidence" } else { FORMER_CONFIDENCE };
    fields.word(key, words).and_then(|word| Confidence::from_word(&word.value))
}

/// A problem of a value, and its correction.
struct Refused {
    message: String,
    help: String,
}

/// Reads a value [SI] from a text with a unit, or from a plain number if the quantity is a ratio.
/// `None` if it is invalid or out of range, which is reported.
pub fn read_value(
    node: &Node,
    quantity: Quantity,
    range: Range,
    problems: &Problems,
) -> Option<At<f64>> {
    let mut parts = node.place.field.rsplit('.');
    let name = parts.find(|part| part.parse::<usize>().is_err()).unwrap_or_default();
    let refused = match number(node, quantity, name) {
        Ok(value) => match within(value, quantity, range, name) {
            Ok(()) => return Some(At { value, place: node.place.clone() }),
            Err(refused) => refused,
        },
        Err(refused) => refused,
    };
    problems.refuse(node.place.error(refused.message, refused.help))
}

/// Rejects a value outside its range or beyond the limit of its quantity.
fn within(value: f64, quantity: Quantity, range: Range, name: &str) -> Result<(), Refused> {
    let limit = match range {
        Range::Within(limit) => limit,
        _ if range.holds(value) => limits::amount(quantity),
        _ => {
            return Err(Refused {
                message: format!("`{name}` is {}", format_si(value, quantity)),
                help: format!("it must be {}", range.words(quantity)),
            });
        }
    };
    limit.check(name, value).map_err(|limits::Beyond { message, help }| Refused { message, help })
}

/// The SI value of a node.
fn number(node: &Node, quantity: Quantity, name: &str) -> Result<f64, Refused> {
    let expected = quantity.expected();
    match &node.content {
        Content::Text(text) => with_unit(text, quantity, name),
        Content::Number(number) if quantity == Quantity::Ratio => Ok(*number),
        Content::Number(number) => Err(Refused {
            message: format!("`{name}` is {number} without a unit"),
            help: format!("{expected}, in quotes"),
        }),
        other => Err(Refused { message: format!("`{name}` is {}", other.noun()), help: expected }),
    }
}

/// The SI value of a text with its unit.
fn with_unit(text: &str, quantity: Quantity, name: &str) -> Result<f64, Refused> {
    let value = units::parse(text, quantity).map_err(|error| Refused {
        message: format!("{} in `{name}`", error.message),
        help: error.help,
    })?;
    match units::odd_fraction(text) {
        None => Ok(value),
        Some(nearest) => Err(Refused {
            message: format!("`{text}` in `{name}` is not a fraction of an inch in common use"),
            help: format!(
                "write halves, quarters, eighths, sixteenths, 32nds or 64ths; the nearest is {nearest}; or write a decimal or millimetres"
            ),
        }),
    }
}

/// The allowed range of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// Between the two, inclusive.
    Between(f64, f64),
    /// Within a limit; the message states its reason.
    Within(&'static Limit),
}

impl Range {
    /// Whether a value [SI] lies in the range.
    pub(super) fn holds(self, value: f64) -> bool {
        match self {
            Self::Any => value.is_finite(),
            Self::Positive => value > 0.0 && value.is_finite(),
            Self::NotNegative => value >= 0.0 && value.is_finite(),
            Self::Between(least, most) => (least..=most).contains(&value),
            Self::Within(limit) => limit.holds(value),
        }
    }

    /// Words for messages and help: `above zero`.
    pub fn words(self, quantity: Quantity) -> String {
        match self {
            Self::Any => "any number".to_owned(),
            Self::Positive => "above zero".to_owned(),
            Self::NotNegative => "zero or above".to_owned(),
            Self::Between(least, most) => {
                format!("between {} and {}", format_si(least, quantity), format_si(most, quantity))
            }
            Self::Within(Limit { least, most, .. }) => Self::Between(*least, *most).words(quantity),
        }
    }
}
