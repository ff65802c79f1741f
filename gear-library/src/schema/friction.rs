//! The figures of the friction of a rope material on a whale.

use super::{COEFFICIENT, Field, need};
use crate::units::Quantity as Q;

/// Every figure, in the order shown.
pub(super) const FIELDS: &[Field] = &[
    need("rostrum", Q::Ratio, COEFFICIENT, "on the rostrum with its callosities"),
    need("baleen", Q::Ratio, COEFFICIENT, "on the baleen plates"),
    need("lips", Q::Ratio, COEFFICIENT, "on the lower lips"),
    need("head", Q::Ratio, COEFFICIENT, "on the rest of the head"),
    need("skin", Q::Ratio, COEFFICIENT, "on body, peduncle, flippers and flukes"),
];
