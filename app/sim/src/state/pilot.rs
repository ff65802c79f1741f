//! What the pilot program has seen and begun.

use crate::in_place::clone_in_place;

/// What a pilot program has seen so far, and which of its entries have begun.
#[derive(Debug, Default, PartialEq)]
pub struct PilotMemory {
    /// What each entry's trigger has seen.
    pub seen: Vec<Seen>,
    /// Entries begun, in the order in which they began.
    pub begun: Vec<Begun>,
}

clone_in_place!(PilotMemory { seen, begun });

/// What the trigger of an entry has seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// When it was met [s].
    pub met_s: Option<f64>,
    /// How far depth or heading was from its own when last looked at [m or rad].
    pub last: Option<f64>,
    /// Whether the entry has begun.
    pub begun: bool,
}

/// An entry that has begun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Begun {
    /// Which.
    pub entry: usize,
    /// When [s].
    pub at_s: f64,
}
