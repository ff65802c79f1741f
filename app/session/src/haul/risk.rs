//! Probability that a part parts in a haul.
//!
//! A piece of rope or a link holds `S Z`, with `S` the mean it delivers where it is loaded (wear, and a knot or splice in the
//! segment at it) and `Z` normal with mean 1 and the coefficient of variation `c` of its item. With `u = max T/S` over its segments and the
//! haul, it parts with the probability `Φ((u - 1)/c)`; pieces vary by themselves, so that one or more part with `1 - Π (1 - pᵢ)`.
//! `T` is one record of one sea: the probability is that over pieces of rope, not over seas.

use statrs::distribution::{ContinuousCDF, Normal};

/// Probability that a part parts that is used to a share of what it delivers in the mean, by its coefficient of variation.
#[must_use]
pub fn parts(used: f64, variation: f64) -> f64 {
    match Normal::new(1.0, variation) {
        Ok(law) if variation > 0.0 => law.cdf(used),
        _ => f64::from(u8::from(used >= 1.0)),
    }
}

/// Probability that at least one of parts parts.
#[must_use]
pub fn any(probabilities: impl IntoIterator<Item = f64>) -> f64 {
    // 1 - Π(1 - p), which keeps small ones: ln(1 - p) summed.
    -probabilities.into_iter().map(|p| (-p).ln_1p()).sum::<f64>().exp_m1()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_at_its_mean_parts_in_one_haul_of_two_and_at_two_deviations_below_in_one_of_44() {
        assert!((parts(1.0, 0.12) - 0.5).abs() < 1e-12);
        assert!((parts(0.76, 0.12) - 0.022_750).abs() < 1e-6);
        assert!((parts(0.99, 0.0), parts(1.0, 0.0)) == (0.0, 1.0));
    }

    #[test]
    fn any_of_several_is_one_less_none_and_keeps_what_is_small() {
        assert!((any([0.1, 0.2, 0.3]) - (1.0 - 0.9 * 0.8 * 0.7)).abs() < 1e-12);
        assert!((any([1e-18, 2e-18]) / 3e-18 - 1.0).abs() < 1e-9);
        assert!((any([0.2, 1.0]) - 1.0).abs() < 1e-12);
    }
}
