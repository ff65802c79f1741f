//! Delivered strength: what a line or weak link holds as it is fished, as a budget of named factors.
//!
//! `S = S₀ · m · w · e · k`
//!
//! | symbol | factor |
//! |---|---|
//! | `S₀` | strength or rating as its source states it [N] |
//! | `m` | mean of new pieces over `S₀`: above 1 where a table prints a minimum, below 1 where a rule prints a maximum |
//! | `w` | strength that wear leaves |
//! | `e` | strength left at the weaker of its ends, by knot or splice |
//! | `k` | scale of a line that is made to deliver a strength (`delivered_strength`) |
//!
//! `S` is the mean over pieces; pieces differ by a normal law with coefficient of variation `c`, and a run draws one of
//! them. Ropes that come off whales hold less than new ones by wear and knots together: Knowlton et al. 2016
//! (doi:10.1111/cobi.12590).

use crate::confidence::Confidence;
use crate::entry::Entry;

/// Deviations of the normal law within which nine pieces of ten lie.
const NINE_OF_TEN: f64 = 1.645;

/// What a piece of a line, or a weak link, holds, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct StrengthBudget {
    /// Its id in the model, such as `endline-top`.
    pub part: String,
    /// The rope or weak link it is of.
    pub item: String,
    /// Strength as the item's source states it.
    pub stated: StrengthFigure,
    /// What is left of it, factor by factor; a factor of 1 that nobody named is left out.
    pub factors: Vec<StrengthFactor>,
    /// Coefficient of variation between pieces, where it has one [1].
    pub variation: Option<StrengthFigure>,
    /// What this run drew between pieces, over the mean [1].
    pub drawn: f64,
}

/// A factor of a budget.
#[derive(Clone, Debug, PartialEq)]
pub struct StrengthFactor {
    /// What it is for.
    pub name: String,
    /// The factor.
    pub figure: StrengthFigure,
}

/// A number of a budget, with where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct StrengthFigure {
    /// Strength [N] or factor [1].
    pub value: f64,
    /// Source.
    pub source: String,
    /// How sure it is.
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

    /// A figure that the user writes for this gear.
    pub(crate) fn chosen(value: f64, source: &str) -> Self {
        Self { value, source: source.to_owned(), confidence: Confidence::Assumed }
    }
}

impl StrengthBudget {
    /// Mean strength delivered [N].
    #[must_use]
    pub fn delivered_n(&self) -> f64 {
        self.factors.iter().fold(self.stated.value, |left, factor| left * factor.figure.value)
    }

    /// The strengths between which nine pieces of ten lie [N].
    #[must_use]
    pub fn nine_of_ten_n(&self) -> [f64; 2] {
        let spread = NINE_OF_TEN * self.variation.as_ref().map_or(0.0, |figure| figure.value);
        [1.0 - spread, 1.0 + spread].map(|share| share * self.delivered_n())
    }

    /// Strength of the piece that this run drew [N].
    #[must_use]
    pub fn drawn_n(&self) -> f64 {
        self.drawn * self.delivered_n()
    }

    /// How sure the least sure of its numbers is.
    #[must_use]
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
    fn a_budget_is_the_product_of_its_factors_and_as_sure_as_the_least_sure() {
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
            drawn: 1.05,
        };
        // 12,000 × 0.74 × 0.9 = 7,992; of it ± 16.45 %.
        assert!((budget.delivered_n() - 7992.0).abs() < 1e-9);
        let [least, most] = budget.nine_of_ten_n();
        assert!((least - 6677.316).abs() < 1e-6 && (most - 9306.684).abs() < 1e-6);
        assert!((budget.drawn_n() - 8391.6).abs() < 1e-9);
        assert_eq!(budget.confidence(), Confidence::Estimate);
    }
}
