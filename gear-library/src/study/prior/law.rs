//! Distributions of priors, and their words.

use crate::units::{self, Quantity};

/// A distribution. Numbers are SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Even between two values.
    Uniform {
        /// Least.
        low: f64,
        /// Greatest.
        high: f64,
        /// What it measures.
        quantity: Quantity,
    },
    /// Normal, cut off at two values.
    Normal {
        /// Mean before cutting off.
        mean: f64,
        /// Standard deviation before cutting off.
        deviation: f64,
        /// Least.
        low: f64,
        /// Greatest.
        high: f64,
        /// What it measures.
        quantity: Quantity,
    },
    /// Even within each of several ranges that follow one another, with a share for each; shares add up to 1.
    Bins {
        /// Ends of the ranges, rising; one more than there are ranges.
        edges: Vec<f64>,
        /// Shares of the ranges.
        shares: Vec<f64>,
        /// What it measures.
        quantity: Quantity,
    },
    /// One of a few values by their weights, which add up to 1; in the order of their texts.
    Choice(Vec<(Level, f64)>),
}

impl Law {
    /// A drawn number [SI] as the file would have it, to three figures: `1.18 m/s`; a level by its own text.
    #[must_use]
    pub fn written(&self, number: f64) -> String {
        let rounded: f64 = format!("{number:.2e}").parse().unwrap_or(number);
        match self {
            Self::Uniform { quantity, .. }
            | Self::Normal { quantity, .. }
            | Self::Bins { quantity, .. } => in_words(rounded, *quantity),
            Self::Choice(levels) => {
                let is_drawn = |level: &Level| {
                    level.number.is_some_and(|known| known.total_cmp(&number).is_eq())
                };
                levels
                    .iter()
                    .find(|(level, _)| is_drawn(level))
                    .map_or_else(|| rounded.to_string(), |(level, _)| level.text.clone())
            }
        }
    }

    /// In words, such as `even from 0.6 m/s to 1.6 m/s`.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Uniform { low, high, quantity } => {
                format!("even from {} to {}", in_words(*low, *quantity), in_words(*high, *quantity))
            }
            Self::Normal { mean, deviation, low, high, quantity } => {
                let [mean, deviation, low, high] =
                    [mean, deviation, low, high].map(|value| in_words(*value, *quantity));
                format!("normal about {mean} with deviation {deviation}, from {low} to {high}")
            }
            Self::Bins { edges, shares, quantity } => {
                let range = |(ends, share): (&[f64], &f64)| {
                    let [low, high] = [ends[0], ends[1]].map(|end| in_words(end, *quantity));
                    format!("{:.0} % from {low} to {high}", 100.0 * share)
                };
                edges.windows(2).zip(shares).map(range).collect::<Vec<_>>().join(", ")
            }
            Self::Choice(levels) => {
                let level = |(level, weight): &(Level, f64)| {
                    format!("{} {:.0} %", level.text, 100.0 * weight)
                };
                levels.iter().map(level).collect::<Vec<_>>().join(", ")
            }
        }
    }
}

/// A value with its unit: angles in degrees, all else in SI.
fn in_words(value: f64, quantity: Quantity) -> String {
    if quantity == Quantity::Angle {
        return format!("{} deg", value.to_degrees().round());
    }
    units::format_si(value, quantity)
}

/// A value that may be chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// As written.
    pub text: String,
    /// Its number [SI]; none for a word.
    pub number: Option<f64>,
    /// Whether it stands in a file without quotes.
    pub plain: bool,
}
