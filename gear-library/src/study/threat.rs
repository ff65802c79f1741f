//! The row of a threat table that an option stands for, by the columns of NOAA's decision support tool.

use crate::diagnostic::At;
use crate::fields::{Fields, Problems, Range};
use crate::limits;
use crate::tree::Node;
use crate::units::Quantity;

/// What an option, or a value of an axis, says of its row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ThreatLabels {
    rope: Option<String>,
    diameter_m: Option<f64>,
    traps: Option<u64>,
    device: Option<String>,
}

/// A row of a threat table.
#[derive(Clone, Debug, PartialEq)]
pub struct ThreatRow {
    /// Rope by the table's own name, such as `3/8in` or `1,700` (column `Rope`).
    pub rope: String,
    /// Its diameter [m] (column `RopeDiam`, in inches there).
    pub diameter_m: f64,
    /// Traps of the trawl (column `TrawlLen`).
    pub traps: u64,
    /// Device in the endline, or `NA` (column `BuoylineDevice`).
    pub device: String,
}

impl ThreatLabels {
    /// The row, where everything about it is said.
    #[must_use]
    pub fn row(&self) -> Option<ThreatRow> {
        Some(ThreatRow {
            rope: self.rope.clone()?,
            diameter_m: self.diameter_m?,
            traps: self.traps?,
            device: self.device.clone()?,
        })
    }

    /// What two values of axes say together; the later one's where both say it.
    pub(super) fn joined(one: &Self, other: &Self) -> Self {
        Self {
            rope: other.rope.clone().or_else(|| one.rope.clone()),
            diameter_m: other.diameter_m.or(one.diameter_m),
            traps: other.traps.or(one.traps),
            device: other.device.clone().or_else(|| one.device.clone()),
        }
    }
}

/// Reads `threat` of an option.
pub(super) fn read(node: Option<&Node>, problems: &Problems) -> ThreatLabels {
    let Some(node) = node else { return ThreatLabels::default() };
    let fields = Fields::of(node, problems);
    let text = |key| fields.text(key).map(|At { value, .. }| value);
    let labels = ThreatLabels {
        rope: text("rope"),
        diameter_m: fields
            .value("diameter", Quantity::Length, Range::Positive)
            .map(|diameter| diameter.value),
        traps: fields.count("traps", &limits::TRAPS).map(|traps| traps.value),
        device: text("device"),
    };
    fields.finish();
    labels
}
