//! A knot or splice of the library.

use crate::entry::Entry;

/// A knot or splice.
#[derive(Clone, Debug, PartialEq)]
pub struct Knot {
    /// Its file.
    pub entry: Entry,
    /// Strength of the rope at it, as a share of the rope's own [1].
    pub strength_left: f64,
    /// Its breadth over the rope's diameter [1].
    pub bulk: f64,
}

/// Breadth of what holds an end of rope, over the rope's diameter, where no more is known: that of a splice, the least there is (estimate).
pub(crate) const USUAL_BULK: f64 = 1.5;

impl Knot {
    /// From a file's figures; `None` where one is missing, which is reported.
    pub(crate) fn from_entry(entry: Entry) -> Option<Self> {
        Some(Self {
            strength_left: entry.value("strength_left")?,
            bulk: entry.value("bulk").unwrap_or(USUAL_BULK),
            entry,
        })
    }
}
