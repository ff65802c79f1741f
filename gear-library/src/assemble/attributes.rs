//! Resolves attributes of files: checked values in the order that a plugin declares.

use endline_sdk::{Attribute, AttributeKind, AttributeValue, Descriptor};

use crate::assembly::Attributes;
use crate::diagnostic::hint;
use crate::fields::{Problems, Range, read_value};
use crate::library::Library;
use crate::schema::Kind;
use crate::tree::{Content, Node};
use crate::units::Quantity;

impl Attributes {
    /// The values in the declared order; files of library items are added to `used`.
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
        let value = |attribute: &Attribute| {
            let written = self.0.iter().find(|(key, _, _)| attribute.key == *key);
            let read =
                written.and_then(|(_, _, node)| read_attribute(attribute, node, library, problems));
            read.unwrap_or_else(|| attribute.default_value())
        };
        let values: Vec<_> = plugin.attributes.iter().map(value).collect();
        for (attribute, value) in plugin.attributes.iter().zip(&values) {
            used.extend(item_path(&attribute.kind, value, library));
        }
        values
    }
}

/// The numbers among attribute values, for hooks with numbers only.
pub(super) fn numbers(values: &[AttributeValue]) -> Vec<f64> {
    values.iter().filter_map(AttributeValue::number).collect()
}

/// The value of one attribute; `None` if it is invalid, which is reported.
fn read_attribute(
    attribute: &Attribute,
    node: &Node,
    library: &Library,
    problems: &Problems,
) -> Option<AttributeValue> {
    match &attribute.kind {
        AttributeKind::Number { min, max, .. } => {
            let range = Range::Between(*min, *max);
            number(attribute, node, range, problems).map(AttributeValue::Number)
        }
        AttributeKind::Count { min, max, .. } => {
            count(attribute, node, [*min, *max], problems).map(AttributeValue::Number)
        }
        AttributeKind::Choice { words, .. } => {
            let word = if let Content::Text(word) = &node.content { word.as_str() } else { "" };
            if !words.iter().any(|known| known == word) {
                let message = format!("`{}` is not one of its words", attribute.key);
                let help = format!("write \"{}\"", words.join("\" or \""));
                return problems.refuse(node.place.error(message, help));
            }
            Some(AttributeValue::Choice(word.to_owned()))
        }
        AttributeKind::Item { library: folder, .. } => {
            let ids = Kind::in_folder(folder).map(|kind| library.ids(kind)).unwrap_or_default();
            item(attribute, node, folder, ids, problems).map(AttributeValue::Item)
        }
    }
}

/// A number in the attribute's SI unit.
fn number(attribute: &Attribute, node: &Node, range: Range, problems: &Problems) -> Option<f64> {
    let Some(quantity) = Quantity::from_si_unit(&attribute.unit) else {
        let (key, unit) = (&attribute.key, &attribute.unit);
        let message = format!("attribute `{key}` is declared in the unknown unit `{unit}`");
        let help = "this is an error of the plugin; remove the attribute";
        return problems.refuse(node.place.error(message, help));
    };
    read_value(node, quantity, range, problems).map(|value| value.value)
}

/// A whole number within a range.
fn count(
    attribute: &Attribute,
    node: &Node,
    [least, most]: [u32; 2],
    problems: &Problems,
) -> Option<f64> {
    let range = Range::Between(f64::from(least), f64::from(most));
    let value = read_value(node, Quantity::Ratio, range, problems)?.value;
    if value.fract() != 0.0 {
        let message = format!("`{}` is {value}, not a whole number", attribute.key);
        let help =
            format!("write a whole number from {least} to {most}, such as {}", value.round());
        return problems.refuse(node.place.error(message, help));
    }
    Some(value)
}

/// The id of an item of a folder of the library, or an empty text.
fn item(
    attribute: &Attribute,
    node: &Node,
    folder: &str,
    ids: Vec<&str>,
    problems: &Problems,
) -> Option<String> {
    let Content::Text(id) = &node.content else {
        let (key, noun) = (&attribute.key, node.content.noun());
        let message = format!("`{key}` is {noun}, not the id of an item in {folder}/");
        return problems
            .refuse(node.place.error(message, "write the id in quotes; an empty text means none"));
    };
    if !id.is_empty() && !ids.contains(&id.as_str()) {
        return problems.refuse(node.place.error(format!("no `{id}` in {folder}/"), hint(id, ids)));
    }
    Some(id.clone())
}

/// Path of the file of a library item.
fn item_path(kind: &AttributeKind, value: &AttributeValue, library: &Library) -> Option<String> {
    let AttributeKind::Item { library: folder, .. } = kind else { return None };
    library.entry(Kind::in_folder(folder)?, value.item()?).map(|entry| entry.path.clone())
}
