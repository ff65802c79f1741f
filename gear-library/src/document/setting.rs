//! Values as they stand in a file, and how one takes the place of another.

use toml_edit::{Array, Item, TableLike, Value};

use crate::tree::{Content, Node};

/// A value as it stands in a file: a text, a number, true or false, or a list of them.
#[derive(Clone, Debug)]
pub struct Setting(pub(super) Value);

impl Setting {
    /// A text, such as `"0.5 m/s"`.
    #[must_use]
    pub fn text(text: &str) -> Self {
        Self(Value::from(text))
    }

    /// A plain number.
    #[must_use]
    pub fn number(number: f64) -> Self {
        Self(Value::from(number))
    }

    /// A list of texts.
    #[must_use]
    pub fn texts(texts: &[String]) -> Self {
        Self(Value::Array(texts.iter().map(String::as_str).collect()))
    }

    /// A value that stands without quotes where `text` reads as one, else a text.
    #[must_use]
    pub fn plain(text: &str) -> Self {
        Self(text.parse().unwrap_or_else(|_| Value::from(text)))
    }

    /// What a file's value is; `None` for a table or a date.
    pub(crate) fn of(node: &Node) -> Option<Self> {
        let value = match &node.content {
            Content::Text(text) => Value::from(text.as_str()),
            Content::Number(number) if number.fract() == 0.0 && number.abs() < 1e15 => {
                Value::from(*number as i64)
            }
            Content::Number(number) => Value::from(*number),
            Content::Flag(flag) => Value::from(*flag),
            Content::List(items) => Value::Array(
                items
                    .iter()
                    .map(|item| Self::of(item).map(|value| value.0))
                    .collect::<Option<Array>>()?,
            ),
            Content::Table(_) | Content::Date(_) => return None,
        };
        Some(Self(value))
    }

    /// As it is written.
    #[must_use]
    pub fn written(&self) -> String {
        self.0.to_string().trim().to_owned()
    }
}

impl PartialEq for Setting {
    fn eq(&self, other: &Self) -> bool {
        self.written() == other.written()
    }
}

/// Sets a key of a table; a figure's table keeps its source and confidence.
pub(super) fn set_in(table: &mut dyn TableLike, key: &str, text: &str) {
    match table.get_mut(key) {
        Some(Item::Value(Value::InlineTable(figure))) if figure.contains_key("value") => {
            figure.get_mut("value").into_iter().for_each(|slot| replace(slot, text));
        }
        Some(Item::Table(figure)) if figure.contains_key("value") => {
            figure
                .get_mut("value")
                .and_then(Item::as_value_mut)
                .into_iter()
                .for_each(|slot| replace(slot, text));
        }
        Some(Item::Value(slot)) => replace(slot, text),
        _ => {
            table.insert(key, Item::Value(Value::from(text)));
        }
    }
}

/// Puts a new value in the place of an old one, with the spaces and comments around it.
pub(super) fn replace(slot: &mut Value, text: &str) {
    let decor = slot.decor().clone();
    let plain = !matches!(slot, Value::String(_));
    let fresh = if plain {
        text.parse::<Value>().unwrap_or_else(|_| Value::from(text))
    } else {
        Value::from(text)
    };
    *slot = fresh;
    *slot.decor_mut() = decor;
}
