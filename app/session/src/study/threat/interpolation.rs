//! Linear interpolation between breaking strengths, and averages over the strengths of many lines.
//!
//! A curve is a list of values at ascending strengths. Between two strengths its value is linear, and outside them it is that of the nearest
//! one. Both the value at a strength and the mean over lines are `Σ c_k v_k`, with coefficients `c_k ≥ 0` that sum to 1.

use super::noaa::LineShare;

/// Ascending breaking strengths [lbf], at least one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Strengths(Vec<f64>);

impl Strengths {
    /// Of ascending strengths [lbf]; `None` for an empty list.
    pub fn new(ascending_lbf: Vec<f64>) -> Option<Self> {
        (!ascending_lbf.is_empty()).then_some(Self(ascending_lbf))
    }

    /// All strengths [lbf].
    pub fn all(&self) -> &[f64] {
        &self.0
    }

    /// The least strength [lbf].
    pub fn least(&self) -> f64 {
        self.0.first().copied().unwrap_or_default()
    }

    /// The greatest strength [lbf].
    pub fn greatest(&self) -> f64 {
        self.0.last().copied().unwrap_or_default()
    }

    /// Whether a strength [lbf] lies between the least and the greatest, or is one of them.
    pub fn contains(&self, strength_lbf: f64) -> bool {
        (self.least()..=self.greatest()).contains(&strength_lbf)
    }

    /// Index of a strength [lbf] that is in the list, to 1e-9 of itself.
    pub fn find(&self, strength_lbf: f64) -> Option<usize> {
        self.0.iter().position(|own| (own - strength_lbf).abs() <= 1e-9 * strength_lbf.abs())
    }

    /// Coefficients of the value at a strength [lbf], one for each strength of the list.
    pub fn coefficients(&self, strength_lbf: f64) -> Vec<f64> {
        self.mean_coefficients([(strength_lbf, 1.0)])
    }

    /// Coefficients of the mean over lines, each with its strength [lbf] and its share of all lines; the shares need not sum to 1.
    fn mean_coefficients(&self, lines: impl IntoIterator<Item = (f64, f64)>) -> Vec<f64> {
        let mut found = vec![0.0; self.0.len()];
        let mut all = 0.0;
        for (strength_lbf, share) in lines {
            let inside_lbf = strength_lbf.clamp(self.least(), self.greatest());
            let above = self.0.partition_point(|own| *own < inside_lbf).min(self.0.len() - 1);
            let below = above.saturating_sub(usize::from(self.0[above] > inside_lbf));
            let span = self.0[above] - self.0[below];
            let part = if span > 0.0 { (inside_lbf - self.0[below]) / span } else { 0.0 };
            found[below] += share * (1.0 - part);
            found[above] += share * part;
            all += share;
        }
        found.iter_mut().for_each(|coefficient| *coefficient /= all);
        found
    }

    /// Coefficients of the mean over the lines of a trawl. With a cap [lbf], each stronger line has the strength of the cap.
    pub fn of_lines(&self, lines: &[LineShare], cap_lbf: Option<f64>) -> Vec<f64> {
        let most_lbf = cap_lbf.unwrap_or(f64::INFINITY);
        self.mean_coefficients(
            lines.iter().map(|line| (line.strength_lbf.min(most_lbf), line.share)),
        )
    }
}

/// `Σ c_k v_k` of coefficients and values of one length.
pub(super) fn combined(coefficients: &[f64], values: impl IntoIterator<Item = f64>) -> f64 {
    coefficients.iter().zip(values).map(|(coefficient, value)| coefficient * value).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strengths() -> Strengths {
        Strengths::new(vec![600.0, 1000.0, 2000.0]).unwrap()
    }

    #[test]
    fn a_value_between_two_strengths_is_linear_and_constant_outside_them() {
        let values = [0.1, 0.3, 0.8];
        for (strength_lbf, expected) in [
            (600.0, 0.1),
            (700.0, 0.15),
            (1000.0, 0.3),
            (1500.0, 0.55),
            (2000.0, 0.8),
            (500.0, 0.1),
            (9000.0, 0.8),
        ] {
            let coefficients = strengths().coefficients(strength_lbf);
            let value = combined(&coefficients, values);
            assert!((value - expected).abs() < 1e-12, "{strength_lbf}: {value}");
            assert!((coefficients.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{coefficients:?}");
        }
        assert_eq!(Strengths::new(vec![900.0]).unwrap().coefficients(1700.0), [1.0]);
        assert_eq!(Strengths::new(Vec::new()), None);
    }

    /// By hand: a quarter at 700 lbf, half at 1500 lbf, a quarter at 3000 lbf, which counts as 2000 lbf; then with a cap of 1000 lbf.
    #[test]
    fn coefficients_of_lines_sum_to_one_with_and_without_a_cap() {
        let lines = [(700.0, 0.25), (1500.0, 0.5), (3000.0, 0.25)]
            .map(|(strength_lbf, share)| LineShare { strength_lbf, share });
        let free = strengths().of_lines(&lines, None);
        let capped = strengths().of_lines(&lines, Some(1000.0));
        let expected = [[0.1875, 0.0625 + 0.25, 0.25 + 0.25], [0.1875, 0.8125, 0.0]];
        for (found, expected) in [free, capped].iter().zip(expected) {
            assert!((found.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{found:?}");
            for (one, other) in found.iter().zip(expected) {
                assert!((one - other).abs() < 1e-12, "{found:?}");
            }
        }
    }
}
