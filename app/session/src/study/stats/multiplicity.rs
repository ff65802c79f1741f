//! Several comparisons at once: Holm's adjustment.
//!
//! Of `m` probabilities `p_1 ≤ … ≤ p_m`, each under its own hypothesis of no difference, the adjusted one is
//! `max_{j ≤ i} min(1, (m - j + 1) p_j)`: with those below 0.05 taken as differences, the probability that any of them is
//! none is at most 0.05, however they hang together.
//! Reference: Holm 1979, A simple sequentially rejective multiple test procedure (Scandinavian Journal of Statistics 6).

use statrs::distribution::{ContinuousCDF, Normal};

use super::interval::{Interval, z95};

/// Adjusted probabilities, in the order given.
pub(super) fn holm(probabilities: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..probabilities.len()).collect();
    order.sort_by(|one, other| probabilities[*one].total_cmp(&probabilities[*other]));
    let mut adjusted = vec![0.0; probabilities.len()];
    let mut least = 0.0_f64;
    for (place, index) in order.into_iter().enumerate() {
        let left = (probabilities.len() - place) as f64;
        least = least.max((left * probabilities[index]).min(1.0));
        adjusted[index] = least;
    }
    adjusted
}

/// Two-sided probability of an interval of 95 % as far from zero or farther, taken as normal.
pub(super) fn of_interval(Interval { low, high }: Interval) -> f64 {
    let deviation = (high - low) / (2.0 * z95());
    if deviation <= 0.0 {
        return if low.abs() > 0.0 { 0.0 } else { 1.0 };
    }
    2.0 * Normal::standard().cdf(-(0.5 * (low + high)).abs() / deviation)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 0.01 · 4, 0.02 · 3, then 0.03 · 2 = 0.06 too, and 0.6.
    #[test]
    fn probabilities_are_adjusted_step_by_step() {
        let adjusted = holm(&[0.03, 0.01, 0.6, 0.02]);
        for (found, expected) in adjusted.iter().zip([0.06, 0.04, 0.6, 0.06]) {
            assert!((found - expected).abs() < 1e-12, "{adjusted:?}");
        }
        assert_eq!(holm(&[]), Vec::<f64>::new());
        assert_eq!(holm(&[0.9, 0.8]), [1.0, 1.0]);
    }

    #[test]
    fn an_interval_that_ends_at_zero_has_one_in_twenty() {
        assert!((of_interval(Interval { low: 0.0, high: 0.2 }) - 0.05).abs() < 1e-9);
        assert!((of_interval(Interval { low: -0.1, high: 0.1 }) - 1.0).abs() < 1e-9);
        assert!(of_interval(Interval { low: 0.1, high: 0.2 }) < 1e-6);
    }
}
