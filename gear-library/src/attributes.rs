//! Attributes of a plugin: as a file gives them, and as the plugin takes them.

use endline_sdk::{AttributeKind, AttributeValue, Descriptor};

use crate::diagnostic::Place;
use crate::fields::{Fields, Problems, Range, read_value};
use crate::library::Library;
use crate::nearest::hint;
use crate::schema::Kind;
use crate::tree::{Content, Node};
use crate::units::Quantity;

/// Attributes as written: key, place of the key, value; checked once the plugin is known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes(pub(crate) Vec<(String, Place, Node)>);

impl Attributes {
    /// Everything in a table, if it is there.
    pub(crate) fn read<'a>(fields: &Fields<'a>, key: &'a str) -> Self {
        fields
            .table(key)
            .map(|table| Self(table.rest().into_iter().cloned().collect()))
            .unwrap_or_default()
    }

    /// These over others: an attribute given here takes the place of the other's.
    #[must_use]
    pub(crate) fn over(&self, other: &Self) -> Self {
        let kept =
            other.0.iter().filter(|(key, _, _)| !self.0.iter().any(|(own, _, _)| own == key));
        Self(kept.chain(&self.0).cloned().collect())
    }

    /// The values a plugin takes, in its declared order; library items are noted in `used`.
    pub(crate) fn resolve(
        &self,
        plugin: &Descriptor,
        library: &Library,
        used: &mut Vec<String>,
        problems: &Problems,
    ) -> Vec<AttributeValue> {
        for (key, place, _) in &self.0 {
            if !plugin.attributes.iter().any(|attribute| attribute.key == *key) {
                let known = plugin.attributes.iter().map(|attribute| attribute.key.as_ref());
                problems.push(
                    place.error(
                        format!("`{}` has no attribute `{key}`", plugin.id),
                        hint(key, known),
                    ),
                );
            }
        }
        let value = |attribute: &endline_sdk::Attribute| {
            let given = self.0.iter().find(|(key, _, _)| attribute.key == *key);
            let read =
                given.and_then(|(_, _, node)| read_attribute(attribute, node, library, problems));
            read.unwrap_or_else(|| attribute.default_value())
        };
        let values: Vec<_> = plugin.attributes.iter().map(value).collect();
        for (attribute, value) in plugin.attributes.iter().zip(&values) {
            used.extend(item_path(&attribute.kind, value, library));
        }
        values
    }
}

/// The numbers among attribute values, for hooks that take numbers only.
pub(crate) fn numbers(values: &[AttributeValue]) -> Vec<f64> {
    values.iter().filter_map(AttributeValue::number).collect()
}

fn read_attribute(
    attribute: &endline_sdk::Attribute,
    node: &Node,
    library: &Library,
    problems: &Problems,
) -> Option<AttributeValue> {
    match &attribute.kind {
        AttributeKind::Number { min, max, .. } => {
            let Some(quantity) = Quantity::from_si_unit(&attribute.unit) else {
                let message = format!(
                    "attribute `{}` is declared in the unknown unit `{}`",
                    attribute.key, attribute.unit
                );
                problems.push(
                    node.place
                        .error(message, "this is a fault of the plugin; leave the attribute out"),
                );
                return None;
            };
            read_value(node, quantity, Range::Between(*min, *max), problems)
                .map(|value| AttributeValue::Number(value.value))
        }
        AttributeKind::Count { min, max, .. } => {
            let range = Range::Between(f64::from(*min), f64::from(*max));
            let value = read_value(node, Quantity::Ratio, range, problems)?.value;
            if value.fract() != 0.0 {
                let message = format!("`{}` is {value}, not a whole number", attribute.key);
                problems.push(node.place.error(
                    message,
                    format!("write a whole number from {min} to {max}, such as {}", value.round()),
                ));
                return None;
            }
            Some(AttributeValue::Number(value))
        }
        AttributeKind::Choice { words, .. } => {
            let word = if let Content::Text(word) = &node.content { word.as_str() } else { "" };
            if !words.iter().any(|known| known == word) {
                let message = format!("`{}` is not one of its words", attribute.key);
                problems.push(
                    node.place.error(message, format!("write \"{}\"", words.join("\" or \""))),
                );
                return None;
            }
            Some(AttributeValue::Choice(word.to_owned()))
        }
        AttributeKind::Item { library: folder, .. } => {
            let Content::Text(id) = &node.content else {
                let message = format!(
                    "`{}` is {}, not the id of an item in {folder}/",
                    attribute.key,
                    node.content.noun()
                );
                problems.push(
                    node.place.error(message, "write the id in quotes; an empty text is for none"),
                );
                return None;
            };
            let ids = Kind::in_folder(folder).map(|kind| library.ids(kind)).unwrap_or_default();
            if !id.is_empty() && !ids.contains(&id.as_str()) {
                problems.push(node.place.error(format!("no `{id}` in {folder}/"), hint(id, ids)));
                return None;
            }
            Some(AttributeValue::Item(id.clone()))
        }
    }
}

fn item_path(kind: &AttributeKind, value: &AttributeValue, library: &Library) -> Option<String> {
    let AttributeKind::Item { library: folder, .. } = kind else { return None };
    library.entry(Kind::in_folder(folder)?, value.item()?).map(|entry| entry.path.clone())
}
