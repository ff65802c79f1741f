//! The rate of an event with its interval.
//!
//! Wilson's score interval for `k` of `n`, with `z` the normal quantile: `(k + z²/2 ± z √(k(n-k)/n + z²/4)) / (n + z²)`.
//! Encounters of unlike weight count by their effective number (`weighted.rs`).
//! Reference: Wilson 1927 (doi:10.1080/01621459.1927.10502953); Brown, Cai and DasGupta 2001 (doi:10.1214/ss/1009213286).

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, Normal};

use super::marks::Marks;
use super::weighted::WeightedMean;

/// An interval of 95 %.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// How often an event came in the runs that count.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rate {
    /// Runs with the event.
    pub hits: u64,
    /// Runs that count.
    pub runs: u64,
    /// Plain encounters that would know the rate as well; `runs` where all count alike.
    pub effective: f64,
    /// Share of the runs by their weights; 0 of none.
    pub rate: f64,
    /// Its interval.
    pub interval: Interval,
}

/// Quantile of the standard normal law for an interval of 95 %.
pub(super) fn z95() -> f64 {
    Normal::standard().inverse_cdf(0.975)
}

impl Rate {
    /// The rate of marks.
    #[must_use]
    pub fn of(marks: &Marks) -> Self {
        let known = || marks.0.iter().flatten();
        let (hits, runs) =
            (known().filter(|mark| mark.came).count() as u64, known().count() as u64);
        let WeightedMean { mean, effective } = WeightedMean::of(&marks.values());
        Self::from_share(hits, runs, mean, effective)
    }

    /// The rate of `hits` in `runs` that all count alike.
    #[must_use]
    pub fn from_counts(hits: u64, runs: u64) -> Self {
        let share = if runs == 0 { 0.0 } else { hits as f64 / runs as f64 };
        Self::from_share(hits, runs, share, runs as f64)
    }

    /// A share known as well as from `effective` runs.
    fn from_share(hits: u64, runs: u64, rate: f64, effective: f64) -> Self {
        if effective <= 0.0 {
            let interval = Interval { low: 0.0, high: 1.0 };
            return Self { hits, runs, effective: 0.0, rate: 0.0, interval };
        }
        let (k, n, z) = (rate * effective, effective, z95());
        let middle = k + 0.5 * z * z;
        let half = z * (k * (n - k) / n + 0.25 * z * z).max(0.0).sqrt();
        let end = |value: f64| (value / (n + z * z)).clamp(0.0, 1.0);
        let interval = Interval {
            low: if hits == 0 { 0.0 } else { end(middle - half) },
            high: if hits == runs { 1.0 } else { end(middle + half) },
        };
        Self { hits, runs, effective, rate, interval }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
