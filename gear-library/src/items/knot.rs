//! A knot or splice of the library.

use crate::entry::Entry;

/// A knot or splice.
#[derive(Clone, Debug, PartialEq)]
pub struct Knot {
    /// Its file.
    pub entry: Entry,
    /// Strength of the rope at it, as a share of the rope's own [1].
    pub strength_left: f64,
}

impl Knot {
    /// From a file's figures; `None` where one is missing, which is reported.
    pub(crate) fn from_entry(entry: Entry) -> Option<Self> {
        Some(Self { strength_left: entry.value("strength_left")?, entry })
    }
}
