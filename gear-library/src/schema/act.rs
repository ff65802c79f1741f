//! The figures of an act of a whale.

use super::{Field, may, need};
use crate::fields::Range::Between;
use crate::units::Quantity as Q;

/// Every figure, in the order shown.
pub(super) const FIELDS: &[Field] = &[
    need(
        "fade",
        Q::Time,
        Between(0.1, 30.0),
        "time to get from what the whale did into the act, and out of it again",
    ),
    may(
        "turn_rate",
        Q::TurnRate,
        Between(0.01, 1.0),
        "greatest rate of turn to a bank or climb; 15 deg/s where not given",
    ),
];
