//! The figures of a weak link.

use super::{Field, may, need};
use crate::fields::Range::{Between, Positive};
use crate::units::Quantity as Q;

/// Every figure, in the order shown.
pub(super) const FIELDS: &[Field] = &[
    need("rating", Q::Force, Positive, "tension above which it parts, as its source states it"),
    may(
        "mean_factor",
        Q::Ratio,
        Between(0.5, 1.5),
        "mean strength of links over the stated rating: below 1 where the rating is a legal maximum",
    ),
    may(
        "spread",
        Q::Ratio,
        Between(0.0, 0.5),
        "coefficient of variation of that tension between links; drawn for each link",
    ),
    may(
        "breadth",
        Q::Length,
        Between(0.001, 0.5),
        "breadth of it: it jams at a gap that is narrower; without one it is as broad as the rope",
    ),
];
