//! Compass bearings of a scenario.

use std::f64::consts::FRAC_PI_2;

use crate::fields::{Fields, Range};
use crate::units::Quantity;

/// The compass bearing under a key; east where there is none [rad].
pub(super) fn bearing<'a>(fields: &Fields<'a>, key: &'a str) -> f64 {
    fields.value(key, Quantity::Angle, Range::Any).map_or(FRAC_PI_2, |angle| angle.value)
}
