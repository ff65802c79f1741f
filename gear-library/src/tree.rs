//! A TOML file as a tree of values with their places.

use std::sync::Arc;

use toml_edit::{Document, Item, Table, TableLike, Value};

use crate::diagnostic::{Diagnostic, Place, SourceText};

/// A value of a file with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its place.
    pub place: Place,
    /// Its content.
    pub content: Content,
}

/// The content of a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Text.
    Text(String),
    /// A number without unit.
    Number(f64),
    /// True or false.
    Flag(bool),
    /// A list.
    List(Vec<Node>),
    /// A table: key, place of the key, value; in the order of the file.
    Table(Vec<(String, Place, Node)>),
    /// A date or time.
    Date(String),
}

impl Content {
    /// Its noun with an article.
    pub fn noun(&self) -> &'static str {
        match self {
            Self::Text(_) => "a text",
            Self::Number(_) => "a number",
            Self::Flag(_) => "true or false",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
            Self::Date(_) => "a date",
        }
    }
}

/// Reads a TOML text.
pub fn read(path: &str, text: &str) -> Result<Node, Box<Diagnostic>> {
    let source = Arc::new(SourceText { path: path.to_owned(), text: text.to_owned() });
    let file = Place { source: Arc::clone(&source), span: 0..0, field: String::new() };
    let document = Document::parse(text).map_err(|error| {
        let place = Place { span: error.span().unwrap_or(0..0), ..file.clone() };
        let help = "fix the TOML here; text needs quotes, as in \"3/8 in\"";
        Box::new(place.error(error.message().trim().replace('\n', ", "), help))
    })?;
    Ok(Node { content: table(document.as_table(), &file), place: file })
}

fn table(table: &dyn TableLike, parent: &Place) -> Content {
    let entry = |(name, item): (&str, &Item)| {
        let field = if parent.field.is_empty() {
            name.to_owned()
        } else {
            format!("{}.{name}", parent.field)
        };
        let key_span =
            table.key(name).and_then(toml_edit::Key::span).unwrap_or_else(|| parent.span.clone());
        let key = Place { source: Arc::clone(&parent.source), span: key_span, field };
        let node = item_node(item, &key);
        (name.to_owned(), key, node)
    };
    let mut entries: Vec<_> = table.iter().map(entry).collect();
    entries.sort_by_key(|(_, key, _)| key.span.start);
    Content::Table(entries)
}

fn item_node(item: &Item, key: &Place) -> Node {
    let place = Place { span: item.span().unwrap_or_else(|| key.span.clone()), ..key.clone() };
    match item {
        Item::Value(value) => value_node(value, place),
        Item::ArrayOfTables(tables) => {
            let nodes =
                tables.iter().enumerate().map(|(index, one)| element(one, &place, index)).collect();
            Node { content: Content::List(nodes), place }
        }
        Item::Table(inner) => Node { content: table(inner, &place), place: key.clone() },
        Item::None => Node { content: Content::Table(Vec::new()), place },
    }
}

fn element(one: &Table, parent: &Place, index: usize) -> Node {
    let field = format!("{}.{index}", parent.field);
    let place = Place {
        source: Arc::clone(&parent.source),
        span: one.span().unwrap_or_else(|| parent.span.clone()),
        field,
    };
    Node { content: table(one, &place), place }
}

fn value_node(value: &Value, place: Place) -> Node {
    let content = match value {
        Value::String(text) => Content::Text(text.value().clone()),
        #[expect(clippy::cast_precision_loss, reason = "a count beyond 2^53 is out of every range")]
        Value::Integer(number) => Content::Number(*number.value() as f64),
        Value::Float(number) => Content::Number(*number.value()),
        Value::Boolean(flag) => Content::Flag(*flag.value()),
        Value::Datetime(date) => Content::Date(date.value().to_string()),
        Value::InlineTable(inner) => table(inner, &place),
        Value::Array(values) => {
            let one = |(index, value): (usize, &Value)| {
                let span = value.span().unwrap_or_else(|| place.span.clone());
                value_node(
                    value,
                    Place {
                        source: Arc::clone(&place.source),
                        span,
                        field: format!("{}.{index}", place.field),
                    },
                )
            };
            Content::List(values.iter().enumerate().map(one).collect())
        }
    };
    Node { place, content }
}
