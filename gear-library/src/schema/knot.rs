//! The figures of a knot or splice.

use super::{Field, may, need};
use crate::fields::Range::Between;
use crate::units::Quantity as Q;

/// Every figure, in the order shown.
pub(super) const FIELDS: &[Field] = &[
    need(
        "strength_left",
        Q::Ratio,
        Between(0.05, 1.0),
        "strength of the rope at this knot or splice, as a share",
    ),
    may("bulk", Q::Ratio, Between(1.0, 8.0), "breadth of it, over the rope's diameter"),
];
