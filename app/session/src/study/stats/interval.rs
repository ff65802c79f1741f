//! The rate of an event with its interval.
//!
//! Wilson's score interval for `k` of `n`, with `z` the normal quantile: `(k + z²/2 ± z √(k(n-k)/n + z²/4)) / (n + z²)`.
//! Encounters of unequal weight count by their effective number (`weighted.rs`). With few events of large weight, that number reflects
//! small weights only. The interval is then extended to that of Fay and Feuer, which allows for one more event of the largest weight.
//! With `y` the sum of the weights of events, `v` that of their squares and `w` the largest weight of any encounter, its upper end is the
//! quantile of the gamma law of mean `y + w` and variance `v + w²`.
//!
//! For a share among encounters with a property, such as held whales, another encounter of the largest weight changes both counts. The
//! interval is then extended to those of Wilson with one more such encounter, with the event and without it.
//! Reference: Wilson 1927 (doi:10.1080/01621459.1927.10502953); Brown, Cai and DasGupta 2001 (doi:10.1214/ss/1009213286);
//! Fay and Feuer 1997 (doi:10.1002/(SICI)1097-0258(19970415)16:7<791::AID-SIM500>3.0.CO;2-#).

use schemars::JsonSchema;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, Gamma, Normal};

use super::indicators::EventIndicators;
use super::weighted::WeightedMean;

/// An interval of 95 %.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// `0.2 to 3.1 %`, with a no-break space before the sign.
    pub fn percents(self) -> String {
        format!("{:.1} to {:.1}\u{a0}%", 100.0 * self.low, 100.0 * self.high)
    }

    /// The smallest interval that contains both.
    pub(super) fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
}

/// The rate of an event in the valid runs.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Rate {
    /// Runs with the event.
    pub hits: u64,
    /// Valid runs.
    pub runs: u64,
    /// Number of encounters of equal weight that would give the same precision; `runs` for equal weights.
    pub effective: f64,
    /// Weighted share of the runs; 0 without runs.
    pub rate: f64,
    /// Its interval, extended for events that the study may have missed among encounters of large weight.
    pub interval: Interval,
    /// Its interval without that extension; the same for equal weights.
    pub as_met: Interval,
}

/// With fewer such events than this, the interval is extended; counted are events of at least half the largest weight.
const FEW: usize = 10;

/// Quantile of the standard normal law for an interval of 95 %.
pub(in crate::study) fn z95() -> f64 {
    Normal::standard().inverse_cdf(0.975)
}

impl Rate {
    /// The rate of indicators.
    pub fn of(indicators: &EventIndicators) -> Self {
        let known = || indicators.0.iter().flatten();
        let (hits, runs) =
            (known().filter(|indicator| indicator.occurred).count() as u64, known().count() as u64);
        let values = indicators.values();
        let WeightedMean { mean, effective } = WeightedMean::of(&values);
        let mut rate = Self::from_share(hits, runs, mean, effective);
        if is_uneven(&values) {
            let without: Vec<(f64, f64)> =
                values.iter().map(|(occurred, weight)| (1.0 - occurred, *weight)).collect();
            if are_few(&values) {
                rate.interval.high = rate.interval.high.max(most(&values));
            }
            if are_few(&without) {
                rate.interval.low = rate.interval.low.min(1.0 - most(&without));
            }
        }
        rate
    }

    /// The share of encounters with an event among those that have another property; the indicators are of these alone.
    pub fn among(indicators: &EventIndicators) -> Self {
        let values = indicators.values();
        let share = |values: &[(f64, f64)]| {
            let hits = values.iter().filter(|(occurred, _)| *occurred > 0.0).count();
            let WeightedMean { mean, effective } = WeightedMean::of(values);
            Self::from_share(hits as u64, values.len() as u64, mean, effective)
        };
        let mut rate = share(&values);
        if is_uneven(&values) {
            let greatest = values.iter().map(|(_, weight)| *weight).fold(0.0, f64::max);
            for occurred in [0.0, 1.0] {
                let one_more = [values.as_slice(), &[(occurred, greatest)]].concat();
                rate.interval = rate.interval.with(share(&one_more).interval);
            }
        }
        rate
    }

    /// The rate of `hits` in `runs` that all count alike.
    pub fn from_counts(hits: u64, runs: u64) -> Self {
        let share = if runs == 0 { 0.0 } else { hits as f64 / runs as f64 };
        Self::from_share(hits, runs, share, runs as f64)
    }

    /// A share known as well as from `effective` runs.
    fn from_share(hits: u64, runs: u64, rate: f64, effective: f64) -> Self {
        if effective <= 0.0 {
            let interval = Interval { low: 0.0, high: 1.0 };
            return Self { hits, runs, effective: 0.0, rate: 0.0, interval, as_met: interval };
        }
        let (k, n, z) = (rate * effective, effective, z95());
        let middle = k + 0.5 * z * z;
        let half = z * (k * (n - k) / n + 0.25 * z * z).max(0.0).sqrt();
        let end = |value: f64| (value / (n + z * z)).clamp(0.0, 1.0);
        let interval = Interval {
            low: if hits == 0 { 0.0 } else { end(middle - half) },
            high: if hits == runs { 1.0 } else { end(middle + half) },
        };
        Self { hits, runs, effective, rate, interval, as_met: interval }
    }
}

/// Whether encounters count for unlike much.
pub(super) fn is_uneven<T>(values: &[(T, f64)]) -> bool {
    let first = values.first().map_or(0.0, |value| value.1);
    values.iter().any(|(_, weight)| (weight - first).abs() > 1e-9 * first)
}

/// Whether few events are of encounters that count for much.
pub(super) fn are_few(values: &[(f64, f64)]) -> bool {
    let greatest = values.iter().map(|(_, weight)| *weight).fold(0.0, f64::max);
    values.iter().filter(|(occurred, weight)| *occurred > 0.0 && *weight >= 0.5 * greatest).count()
        < FEW
}

/// Upper end of the interval of a rare event by Fay and Feuer; 1 if it is unknown.
fn most(values: &[(f64, f64)]) -> f64 {
    let all: f64 = values.iter().map(|(_, weight)| weight).sum();
    let greatest = values.iter().map(|(_, weight)| weight / all).fold(0.0, f64::max);
    let (mean, variance) = values.iter().fold(
        (greatest, greatest * greatest),
        |(mean, variance), (occurred, weight)| {
            let share = occurred * weight / all;
            (mean + share, variance + share * share)
        },
    );
    let law = Gamma::new(mean * mean / variance, mean / variance);
    law.map_or(1.0, |law| law.inverse_cdf(0.975).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal weights: the exact upper end for a Poisson count, 8.767 for three events and 3.689 for none.
    #[test]
    fn the_upper_end_of_few_events_is_that_of_a_poisson_count() {
        for (hits, expected) in [(0, 3.689), (3, 8.767)] {
            let values: Vec<(f64, f64)> =
                (0..1000).map(|index| (f64::from(u8::from(index < hits)), 2.0)).collect();
            assert!((1000.0 * most(&values) - expected).abs() < 2e-3, "{}", 1000.0 * most(&values));
        }
    }

    /// Brown, Cai and DasGupta 2001 and any textbook: 10 of 100 gives 0.0552 to 0.1744.
    #[test]
    fn wilson_agrees_with_published_figures() {
        let rate = Rate::from_counts(10, 100);
        assert!(
            (rate.interval.low - 0.0552).abs() < 1e-4 && (rate.interval.high - 0.1744).abs() < 1e-4,
            "{rate:?}"
        );
        let none = Rate::from_counts(0, 50);
        assert!(
            none.interval.low.abs() < 1e-15 && (none.interval.high - 0.0713).abs() < 1e-4,
            "{none:?}"
        );
        let all = Rate::from_counts(50, 50);
        assert!(
            (all.interval.low - 0.9287).abs() < 1e-4 && (all.interval.high - 1.0).abs() < 1e-15,
            "{all:?}"
        );
    }
}
