//! The range a value must lie in.

use crate::limits::Limit;
use crate::units::{Quantity, format_si};

/// The range a value must lie in, with whether the least value itself is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// Between the two, both allowed.
    Between(f64, f64),
    /// Within a limit, whose reason is told.
    Within(&'static Limit),
}

impl Range {
    /// Whether it holds a value in the SI unit.
    pub(super) fn holds(self, value: f64) -> bool {
        match self {
            Self::Any => value.is_finite(),
            Self::Positive => value > 0.0 && value.is_finite(),
            Self::NotNegative => value >= 0.0 && value.is_finite(),
            Self::Between(least, most) => (least..=most).contains(&value),
            Self::Within(limit) => limit.holds(value),
        }
    }

    /// In words, for messages and for help on a field: `above zero`.
    #[must_use]
    pub fn words(self, quantity: Quantity) -> String {
        match self {
            Self::Any => "any number".to_owned(),
            Self::Positive => "above zero".to_owned(),
            Self::NotNegative => "zero or above".to_owned(),
            Self::Between(least, most) => {
                format!("between {} and {}", format_si(least, quantity), format_si(most, quantity))
            }
            Self::Within(Limit { least, most, .. }) => Self::Between(*least, *most).words(quantity),
        }
    }
}
