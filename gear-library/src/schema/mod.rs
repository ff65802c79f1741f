//! What each kind of library file holds: its figures with quantity, range and help.
//!
//! One table per kind, in a file of its own, serves the reader, the checks and the help shown beside a
//! field.

mod act;
mod box_gear;
mod buoy;
mod friction;
mod knot;
mod rope;
mod site;
mod weak_link;
mod whale;

use crate::fields::Range;
use crate::units::Quantity;

/// The kinds of library files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Rope, in `ropes/`.
    Rope,
    /// Trap, in `traps/`.
    Trap,
    /// Buoy, in `buoys/`.
    Buoy,
    /// Weak link, in `weak-links/`.
    WeakLink,
    /// Anchor, in `anchors/`.
    Anchor,
    /// Knot or splice, in `knots/`.
    Knot,
    /// Place at sea, in `sites/`.
    Site,
    /// Friction of a rope material on a whale, in `friction/`.
    Friction,
    /// Whale, in `whales/`.
    Whale,
    /// Act of a whale, in `acts/`.
    Act,
    /// Assembly of gear, in `assemblies/`.
    Assembly,
}

/// A figure of a kind of file.
#[derive(Debug, PartialEq)]
pub struct Field {
    /// Key; `head.mouth` is the key `mouth` in the table `head`.
    pub key: &'static str,
    /// What it measures.
    pub quantity: Quantity,
    /// Values it may take.
    pub range: Range,
    /// Whether it must be there.
    pub needed: bool,
    /// Help shown beside it.
    pub help: &'static str,
}

/// A text of a kind of file.
#[derive(Debug, PartialEq)]
pub struct Word {
    /// Key.
    pub key: &'static str,
    /// Words it may be; empty where any will do.
    pub allowed: &'static [&'static str],
    /// Help shown beside it.
    pub help: &'static str,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 11] = [
        Self::Rope,
        Self::Trap,
        Self::Buoy,
        Self::WeakLink,
        Self::Knot,
        Self::Anchor,
        Self::Site,
        Self::Friction,
        Self::Whale,
        Self::Act,
        Self::Assembly,
    ];

    /// Its folder of the library.
    #[must_use]
    pub fn folder(self) -> &'static str {
        self.names().0
    }

    /// The word of a file's `kind` field.
    #[must_use]
    pub fn word(self) -> &'static str {
        self.names().1
    }

    /// The kind whose files lie in a folder.
    #[must_use]
    pub fn in_folder(folder: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.folder() == folder)
    }

    /// Its figures, in the order shown.
    #[must_use]
    pub fn fields(self) -> &'static [Field] {
        match self {
            Self::Rope => rope::FIELDS,
            Self::Trap | Self::Anchor => box_gear::FIELDS,
            Self::Buoy => buoy::FIELDS,
            Self::WeakLink => weak_link::FIELDS,
            Self::Knot => knot::FIELDS,
            Self::Site => site::FIELDS,
            Self::Friction => friction::FIELDS,
            Self::Whale => whale::FIELDS,
            Self::Act => act::FIELDS,
            Self::Assembly => &[],
        }
    }

    /// Its texts that must be there, besides the name.
    #[must_use]
    pub fn words(self) -> &'static [Word] {
        match self {
            Self::Rope => &[Word {
                key: "material",
                allowed: &[],
                help: "rope material: an item of friction/, such as pp or sink",
            }],
            Self::Buoy => &[Word {
                key: "shape",
                allowed: &["sphere", "bullet", "low-drag", "cylinder"],
                help: "sphere, bullet (rounded ends), low-drag (spheroid) or cylinder",
            }],
            _ => &[],
        }
    }

    fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::Rope => ("ropes", "rope"),
            Self::Trap => ("traps", "trap"),
            Self::Buoy => ("buoys", "buoy"),
            Self::WeakLink => ("weak-links", "weak-link"),
            Self::Knot => ("knots", "knot"),
            Self::Anchor => ("anchors", "anchor"),
            Self::Site => ("sites", "site"),
            Self::Friction => ("friction", "friction"),
            Self::Whale => ("whales", "whale"),
            Self::Act => ("acts", "act"),
            Self::Assembly => ("assemblies", "assembly"),
        }
    }
}

const fn need(key: &'static str, quantity: Quantity, range: Range, help: &'static str) -> Field {
    Field { key, quantity, range, needed: true, help }
}

const fn may(key: &'static str, quantity: Quantity, range: Range, help: &'static str) -> Field {
    Field { key, quantity, range, needed: false, help }
}

/// A share of a whole.
const SHARE: Range = Range::Between(0.0, 1.0);
/// A coefficient of drag or added mass.
const COEFFICIENT: Range = Range::Between(0.0, 10.0);
