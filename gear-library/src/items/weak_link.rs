//! A weak link of the library.

use crate::entry::Entry;

/// A weak link.
#[derive(Clone, Debug, PartialEq)]
pub struct WeakLink {
    /// Its file.
    pub entry: Entry,
    /// Tension above which it parts, as its source states it [N].
    pub rating_n: f64,
    /// Mean of links over that rating [1].
    pub mean_factor: f64,
    /// Coefficient of variation of that tension between links [1].
    pub spread: f64,
    /// Its breadth; zero where it is no broader than the rope [m].
    pub breadth_m: f64,
}

impl WeakLink {
    /// From a file's figures; `None` where one is missing, which is reported.
    pub(crate) fn from_entry(entry: Entry) -> Option<Self> {
        Some(Self {
            rating_n: entry.value("rating")?,
            mean_factor: entry.value("mean_factor").unwrap_or(1.0),
            spread: entry.value("spread").unwrap_or(0.0),
            breadth_m: entry.value("breadth").unwrap_or(0.0),
            entry,
        })
    }
}
