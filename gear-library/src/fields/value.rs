//! Values with units: `"3/8 in"`, or a plain number where a pure number is meant.

use super::problems::Problems;
use super::range::Range;
use crate::diagnostic::At;
use crate::limits;
use crate::tree::{Content, Node};
use crate::units::{self, Quantity, format_si};

/// What is wrong with a value, and how to write it.
struct Refused {
    message: String,
    help: String,
}

/// Reads a value in SI units from a text with its unit, or from a plain number where the quantity is
/// a ratio. `None` where it cannot be read or lies outside the range, which is reported.
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
    problems.push(node.place.error(refused.message, refused.help));
    None
}

/// Refuses a value outside its range, or beyond the greatest amount of its quantity.
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
    let expected = format!("expected {} such as {}", quantity.noun(), quantity.examples());
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
            message: format!("`{text}` in `{name}` is no size in inches"),
            help: format!(
                "inches go in halves, quarters, eighths, sixteenths, 32nds and 64ths; the nearest is {nearest}; else write a decimal or millimetres"
            ),
        }),
    }
}
