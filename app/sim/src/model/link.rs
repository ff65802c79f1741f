//! Weak links.

use endline_sdk::LineEnd;

/// A weak link at one end of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Id.
    pub id: String,
    /// Index of its line.
    pub line: usize,
    /// At which end.
    pub end: LineEnd,
    /// Tension above which it parts [N].
    pub rating_n: f64,
    /// Whether it can part at all (weak links on).
    pub enabled: bool,
}
