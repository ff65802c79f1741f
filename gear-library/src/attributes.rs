//! Attributes of a plugin as a file gives them; they are checked once the plugin is known.

use crate::diagnostic::Place;
use crate::fields::Fields;
use crate::tree::Node;

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
}
