//! Two options on the same encounters.
//!
//! Of `n` encounters, `b` had the event with the option only, `c` with the other only, `a` with both.
//! Difference `(b - c)/n`, interval by Bonett and Price: with `p = (b+1)/(n+2)`, `q = (c+1)/(n+2)`,
//! `p - q ± z √((p + q - (p - q)²)/(n + 2))`. Ratio of rates `(a+b)/(a+c)`, interval on its logarithm with variance
//! `(b + c)/((a+b)(a+c))`, half added to each of `b` and `c`. McNemar's exact test: `b` of `b + c` by even chance.
//! Encounters of unequal weight count by their effective number for the difference (`weighted.rs`). If few encounters of large weight
//! differ, the interval is extended to that from the intervals of the two rates, `b/n` and `c/n`, by their squares (Zou and Donner 2008).
//! The binomial distribution function is then the incomplete beta function, `P(k of n) = I_½(n - k, k + 1)`, equal to it for integers.
//! Reference: Bonett and Price 2012 (doi:10.3102/1076998611411915); Lachenbruch and Lynch 1998; Zou and Donner 2008 (doi:10.1002/sim.3095); McNemar 1947 (doi:10.1007/BF02295996).

use schemars::JsonSchema;
use serde::Serialize;
use statrs::distribution::{Beta, ContinuousCDF};

use super::indicators::{EventIndicator, EventIndicators};
use super::interval::{Interval, Rate, are_few, is_uneven, z95};
use super::weighted::WeightedMean;

/// An option compared with another.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Paired {
    /// Encounters in which both runs are valid.
    pub encounters: u64,
    /// With the event in both.
    pub both: u64,
    /// With the event with the option only.
    pub only_this: u64,
    /// With the event with the other only.
    pub only_other: u64,
    /// Rate with the option less rate with the other.
    pub difference: f64,
    /// Its interval, extended for encounters that the study may have missed (`interval.rs`).
    pub difference_interval: Interval,
    /// Its interval without that extension.
    pub difference_as_met: Interval,
    /// Rate with the option over rate with the other; none where the other has no event.
    pub ratio: Option<f64>,
    /// Its interval, extended in the same way.
    pub ratio_interval: Option<Interval>,
    /// Its interval without that extension.
    pub ratio_as_met: Option<Interval>,
    /// McNemar's exact two-sided probability of a difference at least as great by even chance.
    pub mcnemar: f64,
    /// Probability that the event is rarer with the option than with the other.
    pub fewer: f64,
}

impl Paired {
    /// Compares the indicators of an option with those of another.
    pub fn of(this: &EventIndicators, other: &EventIndicators) -> Self {
        let both = this.0.iter().zip(&other.0).filter_map(|(this, other)| {
            let (this, other) = ((*this)?, (*other)?);
            Some(([this.occurred, other.occurred], this.weight))
        });
        let both: Vec<([bool; 2], f64)> = both.collect();
        let mut counts = [[0_u64; 2]; 2];
        both.iter()
            .for_each(|([this, other], _)| counts[usize::from(*this)][usize::from(*other)] += 1);
        let shares = shares(&both);
        let times = |number: f64| shares.map(|row| row.map(|share| number * share));
        let differences: Vec<(f64, f64)> = both
            .iter()
            .map(|([this, other], weight)| (f64::from(*this) - f64::from(*other), *weight))
            .collect();
        let effective = WeightedMean::of(&differences).effective;
        let for_ratio = effective_for_ratio(&both, shares).unwrap_or(effective);
        Self::from_effective(counts, times(effective), times(for_ratio)).widened(&both, shares)
    }

    /// Whether the interval of the difference excludes zero.
    pub fn is_distinct(&self) -> bool {
        let Interval { low, high } = self.difference_interval;
        low > 0.0 || high < 0.0
    }

    /// With intervals that reach as far as those of the two rates of encounters that differ, where there are few of them.
    fn widened(mut self, both: &[([bool; 2], f64)], [[_, c], [_, a]]: [[f64; 2]; 2]) -> Self {
        let rate = |wanted: [bool; 2]| {
            let indicator = |(occurred, weight): &([bool; 2], f64)| {
                Some(EventIndicator { occurred: *occurred == wanted, weight: *weight })
            };
            Rate::of(&EventIndicators(both.iter().map(indicator).collect()))
        };
        let differ = |(occurred, weight): &([bool; 2], f64)| {
            (f64::from(occurred[0] != occurred[1]), *weight)
        };
        if !is_uneven(both) || !are_few(&both.iter().map(differ).collect::<Vec<_>>()) {
            return self;
        }
        let (more, fewer) = (rate([true, false]), rate([false, true]));
        let reach = |one: f64, other: f64| (one * one + other * other).sqrt();
        let low = self.difference
            - reach(more.rate - more.interval.low, fewer.interval.high - fewer.rate);
        let high = self.difference
            + reach(more.interval.high - more.rate, fewer.rate - fewer.interval.low);
        let (low, high) = (low.max(-1.0), high.min(1.0));
        self.difference_interval = self.difference_interval.with(Interval { low, high });
        let other = a + c;
        self.ratio_interval = self.ratio_interval.map(|interval| {
            interval.with(Interval { low: (1.0 + low / other).max(0.0), high: 1.0 + high / other })
        });
        self
    }

    /// From counts by whether the event occurred with the option and with the other.
    pub fn from_counts(counts: [[u64; 2]; 2]) -> Self {
        let effective = counts.map(|row| row.map(|count| count as f64));
        Self::from_effective(counts, effective, effective)
    }

    /// From counts and the effective numbers of the same, for the difference and for the ratio.
    fn from_effective(
        [[neither, only_other], [only_this, both]]: [[u64; 2]; 2],
        [[d, c], [b, a]]: [[f64; 2]; 2],
        for_ratio: [[f64; 2]; 2],
    ) -> Self {
        let n = a + b + c + d;
        let difference = if n <= 0.0 { 0.0 } else { (b - c) / n };
        let (p, q) = ((b + 1.0) / (n + 2.0), (c + 1.0) / (n + 2.0));
        let half = z95() * ((p + q - (p - q) * (p - q)) / (n + 2.0)).sqrt();
        let difference_interval =
            Interval { low: (p - q - half).max(-1.0), high: (p - q + half).min(1.0) };
        let (ratio, ratio_interval) = ratio(for_ratio);
        Self {
            encounters: neither + only_other + only_this + both,
            both,
            only_this,
            only_other,
            difference,
            difference_interval,
            difference_as_met: difference_interval,
            ratio,
            ratio_interval,
            ratio_as_met: ratio_interval,
            mcnemar: mcnemar(b, c),
            fewer: probability_fewer(b, c),
        }
    }
}

/// Shares of the weight by whether the event occurred with the option and with the other.
fn shares(both: &[([bool; 2], f64)]) -> [[f64; 2]; 2] {
    let all: f64 = both.iter().map(|(_, weight)| weight).sum();
    let mut shares = [[0.0; 2]; 2];
    for ([this, other], weight) in both {
        shares[usize::from(*this)][usize::from(*other)] += weight / all;
    }
    shares
}

/// Plain encounters that would know the ratio as well: the variance of its logarithm for one, over that of the weighted
/// encounters, `Σ w² (y/A - z/B)²` with `A = Σ w y`, `B = Σ w z`; none where either is nothing.
fn effective_for_ratio(both: &[([bool; 2], f64)], [[_, c], [b, a]]: [[f64; 2]; 2]) -> Option<f64> {
    let all: f64 = both.iter().map(|(_, weight)| weight).sum();
    let (this, other) = (a + b, a + c);
    let one = |([y, z], weight): &([bool; 2], f64)| {
        let part = weight / all * (f64::from(*y) / this - f64::from(*z) / other);
        part * part
    };
    let variance: f64 = both.iter().map(one).sum();
    (this > 0.0 && other > 0.0 && variance > 0.0).then(|| (b + c) / (this * other) / variance)
}

fn ratio([[_, only_other], [only_this, both]]: [[f64; 2]; 2]) -> (Option<f64>, Option<Interval>) {
    let (this, other) = (both + only_this, both + only_other);
    if other <= 0.0 {
        return (None, None);
    }
    let (this_half, other_half) = (this + 0.5, other + 0.5);
    let deviation = ((only_this + only_other + 1.0) / (this_half * other_half)).sqrt();
    let (middle, factor) = (this_half / other_half, (z95() * deviation).exp());
    (
        Some(this / other),
        Some(Interval {
            low: if this > 0.0 { middle / factor } else { 0.0 },
            high: middle * factor,
        }),
    )
}

fn mcnemar(only_this: f64, only_other: f64) -> f64 {
    let (least, most) = (only_this.min(only_other), only_this.max(only_other));
    Beta::new(most, least + 1.0).map_or(1.0, |even| (2.0 * even.cdf(0.5)).min(1.0))
}

/// Probability that an event is rarer with one option than with another, from the encounters with the event with the option only and with
/// the other only. With Jeffreys' prior, the share `s` of the former among both is `Beta(b + ½, c + ½)`; the event is rarer where `s < ½`
/// (Jeffreys 1946, doi:10.1098/rspa.1946.0056).
fn probability_fewer(only_this: f64, only_other: f64) -> f64 {
    if only_this.total_cmp(&only_other).is_eq() {
        return 0.5;
    }
    Beta::new(only_this + 0.5, only_other + 0.5).map_or(0.5, |share| share.cdf(0.5))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_option_and_itself_differ_by_exactly_nothing() {
        let indicators = EventIndicators::even(
            (0..300).map(|index| (index % 17 != 0).then_some(index % 3 == 0)),
        );
        let same = Paired::of(&indicators, &indicators);
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
