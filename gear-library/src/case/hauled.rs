//! A case in which the gear of its scenario is hauled from its first buoy: `[haul]`.

use crate::fields::{Fields, Range};
use crate::limits;
use crate::units::Quantity;

/// How gear is hauled in a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseHaul {
    /// Speed of the hauler, where it is not the usual one [m/s].
    pub speed_m_s: Option<f64>,
    /// Height of the block over the sea surface, where it is not the usual one [m].
    pub block_m: Option<f64>,
    /// The haul ends with so many traps aboard; with all where it is not given.
    pub aboard: Option<u64>,
}

/// Reads `[haul]`.
pub(super) fn read(fields: &Fields<'_>) -> CaseHaul {
    let value = |key, quantity, range| fields.value(key, quantity, range).map(|value| value.value);
    let haul = CaseHaul {
        speed_m_s: value("speed", Quantity::Speed, Range::Between(0.01, 5.0)),
        block_m: value("height", Quantity::Length, Range::Between(0.0, 20.0)),
        aboard: fields.count("aboard", &limits::TRAPS).map(|count| count.value),
    };
    fields.finish();
    haul
}
