//! Texts with braces: `trap-{i}` counts, `{rope}` names the item that an attribute chose.

use endline_sdk::AttributeValue;

use super::expression::{Expression, Name, noun};
use crate::diagnostic::At;
use crate::fields::Problems;

/// A text with braces that was read.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Words(Vec<Piece>);

#[derive(Clone, Debug, PartialEq)]
enum Piece {
    Text(String),
    /// The item of the attribute at this place.
    Item(usize),
    /// A whole number.
    Count(Expression),
}

impl Words {
    /// Reads a text; what is wrong becomes a problem.
    pub fn read(text: &At<String>, names: &[Name], problems: &Problems) -> Option<Self> {
        let (mut pieces, mut rest) = (Vec::new(), text.value.as_str());
        while let Some((before, after)) = rest.split_once('{') {
            pieces.push(Piece::Text(before.to_owned()));
            let Some((inside, after)) = after.split_once('}') else {
                problems.push(
                    text.place.error(
                        "a brace is not closed",
                        "write a } where it ends, as in \"trap-{i}\"",
                    ),
                );
                return None;
            };
            pieces.push(piece(inside.trim(), text, names, problems)?);
            rest = after;
        }
        pieces.push(Piece::Text(rest.to_owned()));
        Some(Self(pieces))
    }

    /// The text, for the values of the names and the plugin's attributes.
    pub fn text(&self, values: &[f64], attributes: &[AttributeValue]) -> String {
        let mut text = String::new();
        for piece in &self.0 {
            match piece {
                Piece::Text(words) => text.push_str(words),
                Piece::Item(index) => text.push_str(
                    attributes.get(*index).and_then(AttributeValue::item).unwrap_or_default(),
                ),
                Piece::Count(expression) => {
                    text.push_str(&format!("{:.0}", expression.value(values)))
                }
            }
        }
        text
    }
}

fn piece(inside: &str, text: &At<String>, names: &[Name], problems: &Problems) -> Option<Piece> {
    if let Some(index) = names.iter().position(|name| name.key == inside && name.power.is_none()) {
        return Some(Piece::Item(index));
    }
    match Expression::read(inside, names) {
        Ok(expression) if expression.power == 0 => Some(Piece::Count(expression)),
        Ok(expression) => {
            let message = format!(
                "`{{{inside}}}` is {}, not a whole number or an item",
                noun(expression.power)
            );
            problems.push(text.place.error(
                message,
                "write a count such as {i}, or the key of an attribute that is an item",
            ));
            None
        }
        Err((message, help)) => {
            problems.push(text.place.error(message, help));
            None
        }
    }
}
