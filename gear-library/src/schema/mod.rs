//! The fields of each kind of library file: figures with quantity, range and help.
//!
//! One table per kind serves the reader, the checks and the help shown beside a field.

mod gear;
mod whale;

use strum::{IntoStaticStr, VariantArray};

use crate::fields::Range;
use crate::units::Quantity;

/// The kinds of library files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "kebab-case")]
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
    /// Whether it is required.
    pub needed: bool,
    /// Help shown beside it.
    pub help: &'static str,
}

/// A text of a kind of file.
#[derive(Debug, PartialEq)]
pub struct Word {
    /// Key.
    pub key: &'static str,
    /// Allowed words; empty for any text.
    pub allowed: &'static [&'static str],
    /// Help shown beside it.
    pub help: &'static str,
}

impl Kind {
    /// Every kind.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Its folder in the library.
    pub fn folder(self) -> &'static str {
        match self {
            Self::Rope => "ropes",
            Self::Trap => "traps",
            Self::Buoy => "buoys",
            Self::WeakLink => "weak-links",
            Self::Knot => "knots",
            Self::Anchor => "anchors",
            Self::Site => "sites",
            Self::Friction => "friction",
            Self::Whale => "whales",
            Self::Act => "acts",
            Self::Assembly => "assemblies",
        }
    }

    /// The word of a file's `kind` field.
    pub fn word(self) -> &'static str {
        self.into()
    }

    /// The kind of the files in a folder.
    pub fn in_folder(folder: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|kind| kind.folder() == folder)
    }

    /// Its figures, in the order shown.
    pub fn fields(self) -> &'static [Field] {
        match self {
            Self::Rope => gear::ROPE,
            Self::Trap | Self::Anchor => gear::BOX_GEAR,
            Self::Buoy => gear::BUOY,
            Self::WeakLink => gear::WEAK_LINK,
            Self::Knot => gear::KNOT,
            Self::Site => gear::SITE,
            Self::Friction => whale::FRICTION,
            Self::Whale => whale::WHALE,
            Self::Act => whale::ACT,
            Self::Assembly => gear::ASSEMBLY,
        }
    }

    /// Its required texts, apart from the name.
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
