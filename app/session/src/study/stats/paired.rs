//! Two options on the same encounters.
//!
//! Of `n` encounters, `b` had the event with the option only, `c` with the other only, `a` with both.
//! Difference `(b - c)/n`, interval by Bonett and Price: with `p = (b+1)/(n+2)`, `q = (c+1)/(n+2)`,
//! `p - q ± z √((p + q - (p - q)²)/(n + 2))`. Ratio of rates `(a+b)/(a+c)`, interval on its logarithm with variance
//! `(b + c)/((a+b)(a+c))`, half added to each of `b` and `c`. McNemar's exact test: `b` of `b + c` by even chance.
//! Reference: Bonett and Price 2012 (doi:10.3102/1076998611411915); Lachenbruch and Lynch 1998; McNemar 1947 (doi:10.1007/BF02295996).

use serde::Serialize;
use statrs::distribution::{Binomial, DiscreteCDF};

use super::better::probability_fewer;
use super::interval::{Interval, z95};
use super::marks::Marks;

/// An option compared with another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Paired {
    /// Encounters in which both runs count.
    pub encounters: u64,
    /// With the event in both.
    pub both: u64,
    /// With the event with the option only.
    pub only_this: u64,
    /// With the event with the other only.
    pub only_other: u64,
    /// Rate with the option less rate with the other.
    pub difference: f64,
    /// Its interval.
    pub difference_interval: Interval,
    /// Rate with the option over rate with the other; none where the other has no event.
    pub ratio: Option<f64>,
    /// Its interval.
    pub ratio_interval: Option<Interval>,
    /// McNemar's exact two-sided probability of a difference at least as great by even chance.
    pub mcnemar: f64,
    /// Probability that the event is rarer with the option than with the other.
    pub fewer: f64,
}

impl Paired {
    /// Compares the marks of an option with those of another.
    #[must_use]
    pub fn of(this: &Marks, other: &Marks) -> Self {
        let mut counts = [[0_u64; 2]; 2];
        for pair in this.0.iter().zip(&other.0) {
            if let (Some(this), Some(other)) = pair {
                counts[usize::from(*this)][usize::from(*other)] += 1;
            }
        }
        Self::from_counts(counts)
    }

    /// From counts by whether the event came with the option and with the other.
    #[must_use]
    pub fn from_counts([[neither, only_other], [only_this, both]]: [[u64; 2]; 2]) -> Self {
        let encounters = neither + only_other + only_this + both;
        let (n, b, c) = (encounters as f64, only_this as f64, only_other as f64);
        let difference = if encounters == 0 { 0.0 } else { (b - c) / n };
        let (p, q) = ((b + 1.0) / (n + 2.0), (c + 1.0) / (n + 2.0));
        let half = z95() * ((p + q - (p - q) * (p - q)) / (n + 2.0)).sqrt();
        let difference_interval =
            Interval { low: (p - q - half).max(-1.0), high: (p - q + half).min(1.0) };
        let (ratio, ratio_interval) = ratio(both, only_this, only_other);
        Self {
            encounters,
            both,
            only_this,
            only_other,
            difference,
            difference_interval,
            ratio,
            ratio_interval,
            mcnemar: mcnemar(only_this, only_other),
            fewer: probability_fewer(only_this, only_other),
        }
    }
}

fn ratio(both: u64, only_this: u64, only_other: u64) -> (Option<f64>, Option<Interval>) {
    let (this, other) = ((both + only_this) as f64, (both + only_other) as f64);
    if other <= 0.0 {
        return (None, None);
    }
    let (this_half, other_half) = (this + 0.5, other + 0.5);
    let deviation = (((only_this + only_other) as f64 + 1.0) / (this_half * other_half)).sqrt();
    let (middle, factor) = (this_half / other_half, (z95() * deviation).exp());
    (
        Some(this / other),
        Some(Interval {
            low: if this > 0.0 { middle / factor } else { 0.0 },
            high: middle * factor,
        }),
    )
}

fn mcnemar(only_this: u64, only_other: u64) -> f64 {
    let Ok(even) = Binomial::new(0.5, only_this + only_other) else { return 1.0 };
    (2.0 * even.cdf(only_this.min(only_other))).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_option_and_itself_differ_by_exactly_nothing() {
        let marks = Marks(
            (0..300)
                .map(|index| if index % 17 == 0 { None } else { Some(index % 3 == 0) })
                .collect(),
        );
        let same = Paired::of(&marks, &marks);
        assert_eq!(same.difference.to_bits(), 0.0_f64.to_bits());
        assert_eq!(same.ratio.map(f64::to_bits), Some(1.0_f64.to_bits()));
        assert_eq!((same.only_this, same.only_other, same.encounters), (0, 0, 282));
        assert!((same.mcnemar - 1.0).abs() < 1e-12 && (same.fewer - 0.5).abs() < 1e-12);
    }

    /// By hand: 2 of 12 by even chance, two-sided: 2 (1 + 12 + 66) / 4096.
    #[test]
    fn mcnemar_is_the_binomial_by_even_chance() {
        let paired = Paired::from_counts([[30, 10], [2, 8]]);
        assert!((paired.mcnemar - 2.0 * 79.0 / 4096.0).abs() < 1e-12, "{}", paired.mcnemar);
        assert!((paired.difference + 8.0 / 50.0).abs() < 1e-15);
        assert!(paired.fewer > 0.98, "{}", paired.fewer);
    }
}
