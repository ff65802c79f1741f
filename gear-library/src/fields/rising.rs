//! Two rising values: the least and the most of something.

use super::Fields;
use crate::tree::Content;
use crate::units::Quantity;

/// Reads two rising values, none below zero, if they are there.
pub fn rising(
    fields: &Fields<'_>,
    key: &'static str,
    quantity: Quantity,
    example: &str,
) -> Option<[f64; 2]> {
    let node = fields.get(key)?;
    if matches!(&node.content, Content::List(items) if items.len() != 2) {
        let help = format!("write the least and the most, {example}");
        fields.problems().push(node.place.error(format!("`{key}` is not two values"), help));
        return None;
    }
    let values = fields.values(key, quantity, &[2])?;
    match values.value.as_slice() {
        [least, most] if *least >= 0.0 && least <= most => Some([*least, *most]),
        _ => {
            let help = format!("write the least and the most, {example}");
            fields
                .problems()
                .push(values.place.error(format!("`{key}` are no two rising values"), help));
            None
        }
    }
}
