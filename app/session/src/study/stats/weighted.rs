//! Encounters of unequal weight: those drawn from a proposal by importance sampling.
//!
//! With weights `w_i`, a mean is `m = Σ w_i y_i / Σ w_i` and its variance `V = Σ w_i² (y_i - m)² / (Σ w_i)²`. Where `σ²` is
//! the variance of `y` itself, `n = σ² / V` encounters of equal weight would give the same precision: the *effective
//! number* for that mean, which every interval for counts uses. Equal weights give the number of encounters. For constant `y` it is
//! Kish's `(Σ w_i)² / Σ w_i²`.
//! References: Kish 1965, Survey Sampling, section 11.2; Owen 2013, Monte Carlo theory, section 9.2; Kott and Liu 2009.

/// A weighted mean.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct WeightedMean {
    /// The mean; 0 without values.
    pub mean: f64,
    /// Effective number of encounters.
    pub effective: f64,
}

impl WeightedMean {
    /// Of values with their weights.
    pub fn of(values: &[(f64, f64)]) -> Self {
        let sum = |of: &dyn Fn(f64, f64) -> f64| {
            values.iter().map(|(value, weight)| of(*value, *weight)).sum::<f64>()
        };
        let all = sum(&|_, weight| weight);
        if all <= 0.0 {
            return Self::default();
        }
        let mean = sum(&|value, weight| weight * value) / all;
        let spread = sum(&|value, weight| weight * (value - mean) * (value - mean)) / all;
        let squares = sum(&|value, weight| weight * weight * (value - mean) * (value - mean));
        let effective = if squares > 0.0 {
            spread * all * all / squares
        } else {
            kish(values.iter().map(|(_, weight)| *weight))
        };
        Self { mean, effective }
    }
}

/// Effective number of encounters for a constant value.
pub(super) fn kish(weights: impl Iterator<Item = f64>) -> f64 {
    let (sum, squares) = weights
        .fold((0.0, 0.0), |(sum, squares), weight| (sum + weight, squares + weight * weight));
    if squares > 0.0 { sum * sum / squares } else { 0.0 }
}

/// The value below which a share of the weight of sorted values lies.
pub(super) fn quantile(sorted: &[(f64, f64)], share: f64) -> Option<f64> {
    let all: f64 = sorted.iter().map(|(_, weight)| weight).sum();
    let mut below = 0.0;
    let found = sorted.iter().find(|(_, weight)| {
        below += weight;
        below >= share * all
    });
    found.or(sorted.last()).map(|(value, _)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_weights_give_the_plain_mean_and_number() {
        let values: Vec<(f64, f64)> = (0..40).map(|index| (f64::from(index % 4), 2.5)).collect();
        let found = WeightedMean::of(&values);
        assert!((found.mean - 1.5).abs() < 1e-12 && (found.effective - 40.0).abs() < 1e-9);
        assert!((kish(values.iter().map(|(_, weight)| *weight)) - 40.0).abs() < 1e-9);
        assert_eq!(WeightedMean::of(&[]), WeightedMean::default());
    }

    /// By hand: 1 with weight 3 and 0 with weight 1: mean 3/4, V = (9/16 + 9/16)/16, σ² = 3/16.
    #[test]
    fn two_values_by_hand() {
        let found = WeightedMean::of(&[(1.0, 3.0), (0.0, 1.0)]);
        assert!((found.mean - 0.75).abs() < 1e-15);
        assert!((found.effective - (3.0 / 16.0) / (18.0 / 256.0)).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn quantiles_go_by_weight() {
        let sorted = [(1.0, 1.0), (2.0, 8.0), (3.0, 1.0)];
        assert_eq!(
            [0.05, 0.5, 0.95].map(|share| quantile(&sorted, share)),
            [Some(1.0), Some(2.0), Some(3.0)]
        );
        assert_eq!(quantile(&[], 0.5), None);
    }
}
