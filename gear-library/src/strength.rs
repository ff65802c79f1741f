//! Delivered strength of lines and weak links in use: a budget of named factors.
//!
//! `S = S₀ · m · w · e · k`
//!
//! | symbol | factor |
//! |---|---|
//! | `S₀` | strength or rating as stated by its source [N] |
//! | `m` | mean of new pieces over `S₀`: above 1 for a minimum of a table, below 1 for a maximum of a rule |
//! | `w` | strength after wear, as a share |
//! | `e` | strength at the weaker end with its knot or splice, as a share |
//! | `k` | scale for a required delivered strength (`delivered_strength`) |
//!
//! `S` is the mean over pieces. Pieces vary normally with the coefficient of variation `c`, and a run draws one of them.
//! Ropes removed from whales are weaker than new ones because of wear and knots: Knowlton et al. 2016
//! (doi:10.1111/cobi.12590).

use crate::entry::{Confidence, Entry};

/// Standard deviations on each side that include 90 % of pieces.
const NINE_OF_TEN: f64 = 1.645;

/// Last part of the id of a line's weak places, such as `endline-top.weak-places`.
pub const WEAK_PLACES: &str = "weak-places";

/// Strength budget of a piece of a line, of its weak places together, or of a weak link.
#[derive(Clone, Debug, PartialEq)]
pub struct StrengthBudget {
    /// Its id in the model, such as `endline-top`; weak places are `endline-top.weak-places`.
    pub part: String,
    /// Id of its rope or weak link, or the number and lengths of weak places, such as `1 weak place at 9.14 m`.
    pub item: String,
    /// Strength as stated by the item's source.
    pub stated: StrengthFigure,
    /// Factors on it, without unstated factors of 1.
    pub factors: Vec<StrengthFactor>,
    /// Coefficient of variation between pieces, if any [1].
    pub variation: Option<StrengthFigure>,
    /// Coefficient of variation between gears of a fleet, if any, which the range over pieces does not include [1].
    pub fleet: Option<StrengthFigure>,
    /// The drawn strength of this run over the mean [1].
    pub drawn: f64,
}

/// A factor of a budget.
#[derive(Clone, Debug, PartialEq)]
pub struct StrengthFactor {
    /// Its name.
    pub name: String,
    /// The factor.
    pub figure: StrengthFigure,
}

/// A number of a budget with its source.
#[derive(Clone, Debug, PartialEq)]
pub struct StrengthFigure {
    /// Strength [N] or factor [1].
    pub value: f64,
    /// Source.
    pub source: String,
    /// Confidence.
    pub confidence: Confidence,
}

impl StrengthFigure {
    /// A figure of a library item by its key.
    pub(crate) fn of(entry: &Entry, key: &str) -> Option<Self> {
        let figure = entry.figure(key)?;
        Some(Self {
            value: figure.value,
            source: figure.source.clone(),
            confidence: figure.confidence,
        })
    }

    /// A figure that the user chose for this gear.
    pub(crate) fn chosen(value: f64, source: &str) -> Self {
        Self { value, source: source.to_owned(), confidence: Confidence::Assumed }
    }
}

impl StrengthBudget {
    /// Mean delivered strength [N].
    pub fn delivered_n(&self) -> f64 {
        self.factors.iter().fold(self.stated.value, |left, factor| left * factor.figure.value)
    }

    /// The range that includes 90 % of pieces [N].
    pub fn nine_of_ten_n(&self) -> [f64; 2] {
        let spread = NINE_OF_TEN * self.variation.as_ref().map_or(0.0, |figure| figure.value);
        [1.0 - spread, 1.0 + spread].map(|share| share * self.delivered_n())
    }

    /// Drawn strength of this run [N].
    pub fn drawn_n(&self) -> f64 {
        self.drawn * self.delivered_n()
    }

    /// The lowest confidence of its numbers.
    pub fn confidence(&self) -> Confidence {
        let factors = self.factors.iter().map(|factor| factor.figure.confidence);
        factors.fold(self.stated.confidence, Ord::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(value: f64, confidence: Confidence) -> StrengthFigure {
        StrengthFigure { value, source: "a source".into(), confidence }
    }

    #[test]
    fn a_budget_is_the_product_of_its_factors_with_their_lowest_confidence() {
        let factor = |value, confidence| StrengthFactor {
            name: "wear".into(),
            figure: figure(value, confidence),
        };
        let budget = StrengthBudget {
            part: "endline".into(),
            item: "sink-3-8".into(),
            stated: figure(12_000.0, Confidence::Measured),
            factors: vec![factor(0.74, Confidence::Estimate), factor(0.9, Confidence::Measured)],
            variation: Some(figure(0.1, Confidence::Estimate)),
            fleet: None,
            drawn: 1.05,
        };
        // 12,000 × 0.74 × 0.9 = 7,992; ± 16.45 %.
        assert!((budget.delivered_n() - 7992.0).abs() < 1e-9);
        let [least, most] = budget.nine_of_ten_n();
        assert!((least - 6677.316).abs() < 1e-6 && (most - 9306.684).abs() < 1e-6);
        assert!((budget.drawn_n() - 8391.6).abs() < 1e-9);
        assert_eq!(budget.confidence(), Confidence::Estimate);
    }
}
