//! `[[attribute]]` of a text gear type: a length, a pure number, a count or an item of the library.

use endline_sdk::{Attribute, AttributeKind};

use crate::diagnostic::hint;
use crate::fields::{Fields, Range, read_value};
use crate::schema::Kind;
use crate::tree::{Content, Node};
use crate::units::Quantity;

use super::expression::Name;

/// Reserved names: depth, index in a row of parts, functions.
pub(super) const TAKEN: [&str; 5] = ["depth", "i", "min", "max", "sqrt"];

/// Reads an attribute; `None` if a field is missing or wrong, which is reported.
pub(super) fn read(fields: &Fields<'_>) -> Option<Attribute> {
    let key = fields.need_text("key", "write a key such as \"scope\"");
    let help = fields.need_text("help", "write a description in one sentence");
    let kind = kind(fields);
    let (key, (unit, kind)) = (key?, kind?);
    let plain = key.value.starts_with(|c: char| c.is_ascii_lowercase())
        && key.value.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if !plain || TAKEN.contains(&key.value.as_str()) {
        let message = format!("`{}` cannot be the key of an attribute", key.value);
        let help = format!(
            "write small letters, digits and underscores; {} are reserved",
            TAKEN.join(", ")
        );
        return fields.refuse(key.place.error(message, help));
    }
    Some(Attribute { key: key.value.into(), unit: unit.into(), help: help?.value.into(), kind })
}

/// Its name in expressions.
pub(super) fn name(attribute: &Attribute) -> Name {
    let power = match attribute.kind {
        AttributeKind::Number { .. } => Some(i32::from(attribute.unit == "m")),
        AttributeKind::Count { .. } => Some(0),
        AttributeKind::Choice { .. } | AttributeKind::Item { .. } => None,
    };
    Name { key: attribute.key.to_string(), power }
}

/// Unit and kind: an item with `items`, a count with `count`, else a length or a pure number by its `default`.
fn kind(fields: &Fields<'_>) -> Option<(&'static str, AttributeKind)> {
    if fields.get("items").is_some() {
        return item(fields);
    }
    let is_count = fields.flag("count").unwrap_or(false);
    let Some(node) = fields.get("default") else {
        fields.missing("default", "write the default value, such as 1.3 or \"20 m\"");
        return None;
    };
    let quantity = if matches!(node.content, Content::Text(_)) && !is_count {
        Quantity::Length
    } else {
        Quantity::Ratio
    };
    let default = read_value(node, quantity, Range::Any, fields.problems())?.value;
    let Some((min, max)) = range(fields, quantity) else {
        fields.missing(
            "range",
            "write the least and the greatest value, such as [1.05, 3] or [\"1 m\", \"90 m\"]",
        );
        return None;
    };
    if !(min..=max).contains(&default) {
        return fields.refuse(
            node.place.error("the default is outside the range", "change the range or the default"),
        );
    }
    if is_count {
        return count(node, [min, max, default], fields);
    }
    let unit = if quantity == Quantity::Length { "m" } else { "1" };
    Some((unit, AttributeKind::Number { min, max, default }))
}

/// A count, from its least and greatest value and its default.
fn count(
    node: &Node,
    numbers: [f64; 3],
    fields: &Fields<'_>,
) -> Option<(&'static str, AttributeKind)> {
    let whole = |value: f64| value.fract() == 0.0 && (0.0..=1000.0).contains(&value);
    if !numbers.into_iter().all(whole) {
        return fields.refuse(node.place.error(
            "a count is a whole number from 0 to 1000",
            "write whole numbers for default and range",
        ));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
    let [min, max, default] = numbers.map(|value| value as u32);
    Some(("1", AttributeKind::Count { min, max, default }))
}

fn item(fields: &Fields<'_>) -> Option<(&'static str, AttributeKind)> {
    let folder = fields.text("items")?;
    let default = fields.text("default").map_or(String::new(), |text| text.value);
    const FOLDERS: [Kind; 5] = [Kind::Rope, Kind::Trap, Kind::Buoy, Kind::WeakLink, Kind::Anchor];
    let folders = FOLDERS.map(Kind::folder);
    if !folders.contains(&folder.value.as_str()) {
        let message = format!("`{}` is not a folder of items for gear", folder.value);
        return fields.refuse(folder.place.error(message, hint(&folder.value, folders)));
    }
    Some(("", AttributeKind::Item { library: folder.value.into(), default: default.into() }))
}

fn range(fields: &Fields<'_>, quantity: Quantity) -> Option<(f64, f64)> {
    let values = fields.values("range", quantity, &[2])?.value;
    Some((values[0], values[1]))
}
