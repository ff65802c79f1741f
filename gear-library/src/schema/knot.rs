//! The figures of a knot or splice.

use super::{Field, need};
use crate::fields::Range::Between;
use crate::units::Quantity as Q;

/// Every figure, in the order shown.
pub(super) const FIELDS: &[Field] = &[need(
    "strength_left",
    Q::Ratio,
    Between(0.05, 1.0),
    "strength of the rope at this knot or splice, as a share",
)];
