//! Claims: whether the sign holds.
//!
//! Several comparisons are adjusted by Holm. Of `m` probabilities `p_1 ≤ … ≤ p_m`, each under its own hypothesis of no difference, the
//! adjusted one is `max_{j ≤ i} min(1, (m - j + 1) p_j)`: if those below 0.05 are taken as differences, the probability that any of them
//! is none is at most 0.05, whatever their dependence.
//! Reference: Holm 1979, A simple sequentially rejective multiple test procedure (Scandinavian Journal of Statistics 6).

use endline_gear::Claim;
use schemars::JsonSchema;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::study::runs::Runs;

use super::bootstrap;
use super::indicators::{EventIndicator, EventIndicators};
use super::interval::{Interval, Rate, z95};
use super::paired::Paired;
use super::weighted::WeightedMean;

/// The result of a claim.
#[derive(Clone, Copy, Debug, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The whole interval of the difference has the claimed sign.
    Holds,
    /// The whole interval has the other sign.
    Opposite,
    /// The whole interval has one sign, but among as many claims chance alone may give that.
    Alone,
    /// The interval holds zero.
    Open,
}

impl Verdict {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Holds => "the sign holds",
            Self::Opposite => "the sign is the other way round",
            Self::Alone => "not settled: the sign holds for this claim alone, not among all",
            Self::Open => "not settled: the interval holds zero",
        }
    }
}

/// A claim and what was counted.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct ClaimFinding {
    /// Id.
    pub id: String,
    /// The statement.
    pub says: String,
    /// Its source.
    pub source: String,
    /// Event and options that should have more.
    pub more: String,
    /// Event and options that should have less.
    pub less: String,
    /// Rate that should be greater.
    pub more_rate: Rate,
    /// Rate that should be less.
    pub less_rate: Rate,
    /// Difference of the two.
    pub difference: f64,
    /// Its interval.
    pub interval: Interval,
    /// Probability of a difference at least as great by chance.
    pub probability: f64,
    /// That probability among all claims of the study, by Holm.
    pub adjusted: f64,
    /// Whether the sign holds.
    pub verdict: Verdict,
    /// Whether it was in the study's file before the first run.
    pub registered: bool,
}

/// The findings of every claim of a study, all of them marked as registered.
pub(super) fn assess_all(claims: &[Claim], runs: &Runs) -> Vec<ClaimFinding> {
    let mut found: Vec<ClaimFinding> = claims.iter().map(|claim| assess(claim, runs)).collect();
    let probabilities: Vec<f64> = found.iter().map(|claim| claim.probability).collect();
    for (claim, adjusted) in found.iter_mut().zip(holm(&probabilities)) {
        claim.adjusted = adjusted;
        claim.verdict = verdict(claim.interval, adjusted);
    }
    found
}

fn verdict(interval: Interval, adjusted: f64) -> Verdict {
    match interval {
        Interval { low, high } if low <= 0.0 && high >= 0.0 => Verdict::Open,
        _ if adjusted > 0.05 => Verdict::Alone,
        Interval { low, .. } if low > 0.0 => Verdict::Holds,
        _ => Verdict::Opposite,
    }
}

fn assess(claim: &Claim, runs: &Runs) -> ClaimFinding {
    let indicators = |options: &[String], event| {
        options.iter().map(|option| EventIndicators::of(runs, option, event)).collect::<Vec<_>>()
    };
    let (more, less) =
        (indicators(&claim.more, &claim.event), indicators(&claim.less, &claim.less_event));
    let (difference, interval) = match (more.as_slice(), less.as_slice()) {
        ([more], [less]) => {
            let paired = Paired::of(more, less);
            (paired.difference, paired.difference_interval)
        }
        _ => pooled(&claim.id.value, &more, &less),
    };
    let probability = of_interval(interval);
    let words = |event: &endline_gear::StudyEvent, options: &[String]| {
        format!("{} with {}", event.words(), options.join(", "))
    };
    ClaimFinding {
        id: claim.id.value.clone(),
        says: claim.says.clone(),
        source: claim.source.clone(),
        more: words(&claim.event, &claim.more),
        less: words(&claim.less_event, &claim.less),
        more_rate: rate(&format!("more {}", claim.id.value), &more),
        less_rate: rate(&format!("less {}", claim.id.value), &less),
        difference,
        interval,
        probability,
        adjusted: probability,
        verdict: verdict(interval, probability),
        registered: true,
    }
}

/// The rate over several options, whose interval counts each encounter once.
fn rate(label: &str, indicators: &[EventIndicators]) -> Rate {
    let all = Rate::of(&EventIndicators(
        indicators.iter().flat_map(|indicators| indicators.0.clone()).collect(),
    ));
    if indicators.len() < 2 {
        return all;
    }
    let shares = shares(indicators);
    if all.hits == 0 || all.hits == all.runs {
        // Drawing again what never varies says nothing of chance.
        let counted = if all.hits == 0 { 0 } else { shares.len() as u64 };
        return Rate { interval: Rate::from_counts(counted, shares.len() as u64).interval, ..all };
    }
    let interval = bootstrap::interval(label, shares.len(), |indices| mean(&shares, indices));
    interval.map_or(all, |interval| Rate { interval, ..all })
}

/// Share of the options in which the event occurred, by encounter with a valid run; with its weight.
fn shares(indicators: &[EventIndicators]) -> Vec<(f64, f64)> {
    let encounters = EventIndicators::longest(indicators);
    (0..encounters).filter_map(|encounter| share(indicators, encounter)).collect()
}

fn share(indicators: &[EventIndicators], encounter: usize) -> Option<(f64, f64)> {
    let known: Vec<EventIndicator> = indicators
        .iter()
        .filter_map(|indicators| indicators.0.get(encounter).copied().flatten())
        .collect();
    let weight = known.first()?.weight;
    Some((
        known.iter().filter(|indicator| indicator.occurred).count() as f64 / known.len() as f64,
        weight,
    ))
}

fn mean(values: &[(f64, f64)], indices: &[usize]) -> Option<f64> {
    let drawn: Vec<(f64, f64)> = indices.iter().map(|index| values[*index]).collect();
    Some(WeightedMean::of(&drawn).mean)
}

/// Several options together: the difference of shares within each encounter, encounters drawn again for the interval.
fn pooled(label: &str, more: &[EventIndicators], less: &[EventIndicators]) -> (f64, Interval) {
    let differences: Vec<(f64, f64)> = (0..EventIndicators::longest(more.iter().chain(less)))
        .filter_map(|encounter| {
            let ((more, weight), (less, _)) = (share(more, encounter)?, share(less, encounter)?);
            Some((more - less, weight))
        })
        .collect();
    let difference = WeightedMean::of(&differences).mean;
    let mean = |indices: &[usize]| mean(&differences, indices);
    let interval = bootstrap::interval(&format!("claim {label}"), differences.len(), mean);
    (difference, interval.unwrap_or(Interval { low: -1.0, high: 1.0 }))
}

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
fn of_interval(Interval { low, high }: Interval) -> f64 {
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
