//! The encounter's own quantities and the values they take.

use crate::fields::Range;
use crate::items::YEAR_S;
use crate::units::Quantity;

/// What a known prior takes.
#[derive(Clone, Copy)]
pub(super) enum Takes {
    /// Numbers of a quantity within a range.
    Number(Quantity, Range),
    /// Words.
    Word,
}

/// The encounter's own quantities.
pub(super) const KNOWN: [(&str, Takes); 17] = [
    ("age", Takes::Number(Quantity::Time, Range::Between(0.0, 120.0 * YEAR_S))),
    ("answer", Takes::Word),
    ("answer_above", Takes::Number(Quantity::Force, Range::NotNegative)),
    ("behaviour", Takes::Word),
    ("condition", Takes::Number(Quantity::Ratio, Range::Between(0.65, 1.5))),
    ("depth", Takes::Number(Quantity::Length, Range::Between(0.0, 6000.0))),
    ("flipper_raise", Takes::Number(Quantity::Ratio, Range::Between(-1.0, 1.0))),
    ("flipper_sweep", Takes::Number(Quantity::Ratio, Range::Between(-1.0, 1.0))),
    ("flipper_twist", Takes::Number(Quantity::Ratio, Range::Between(-1.0, 1.0))),
    ("gape", Takes::Number(Quantity::Ratio, Range::Between(0.0, 1.0))),
    ("heading", Takes::Number(Quantity::Angle, Range::Any)),
    ("length", Takes::Number(Quantity::Length, Range::Between(1.0, 35.0))),
    ("offset", Takes::Number(Quantity::Length, Range::Between(-100.0, 100.0))),
    ("pitch", Takes::Number(Quantity::Angle, Range::Any)),
    ("roll", Takes::Number(Quantity::Angle, Range::Any)),
    ("speed", Takes::Number(Quantity::Speed, Range::Between(0.0, 15.0))),
    ("tide", Takes::Number(Quantity::Speed, Range::Between(0.0, 10.0))),
];
