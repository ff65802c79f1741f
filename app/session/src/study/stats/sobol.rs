//! First-order Sobol indices from the encounters of a study: the share of an event's variance that an input explains alone.
//!
//! `S = Var(E[y | x]) / Var(y)`. The encounters are divided into classes of equal number by `x`, or by its levels; with the unbiased
//! variance `s_g²` within class `g` of weight `W_g`, `S = 1 - Σ (W_g / W) s_g² / s²`. What chance alone gives is the 95th
//! percentile of the index with the classes dealt out at random, so that an index not above it says nothing.
//! References: Sobol' 1993; Saltelli et al. 2008, Global Sensitivity Analysis; given-data estimates: Plischke, Borgonovo and Smith
//! 2013 (doi:10.1016/j.ejor.2012.11.047).

use schemars::JsonSchema;
use serde::Serialize;

use super::bootstrap::Draws;
use super::weighted::{WeightedMean, kish};

/// Classes into which a number's range is divided, at most.
const CLASSES: usize = 16;
/// Encounters of a class, at least.
const LEAST: usize = 8;
/// Number of random assignments of classes.
const DEALS: usize = 200;

/// The share of an event's variance that an input explains alone, and its permutation baseline.
#[derive(Clone, Copy, Debug, Default, JsonSchema, PartialEq, Serialize)]
pub struct SobolIndex {
    /// The index; 0 where the event does not vary. Slightly below 0 by chance.
    pub index: f64,
    /// The 95th percentile of the index with classes assigned at random.
    pub by_chance: f64,
}

impl SobolIndex {
    /// First-order Sobol index and its permutation baseline; an index below the baseline is omitted.
    pub fn words(&self) -> [String; 2] {
        if self.index == 0.0 && self.by_chance == 0.0 {
            return ["not known", "the event does not vary in these encounters"].map(str::to_owned);
        }
        let by_chance = format!("{:.1} %", 100.0 * self.by_chance.max(0.0));
        if self.index > self.by_chance {
            [format!("{:.1} %", 100.0 * self.index), format!("by chance up to {by_chance}")]
        } else {
            ["no more than chance".to_owned(), format!("which gives up to {by_chance}")]
        }
    }

    /// Of values with their weights, by the class of each.
    pub fn of(label: &str, classes: &[usize], values: &[(f64, f64)]) -> Self {
        let mut dealt = classes.to_vec();
        let mut draws = Draws::of(&format!("sobol {label}"));
        let mut by_chance: Vec<f64> = (0..DEALS)
            .map(|_| {
                draws.shuffle(&mut dealt);
                explained(&dealt, values)
            })
            .collect();
        by_chance.sort_by(f64::total_cmp);
        Self { index: explained(classes, values), by_chance: by_chance[DEALS * 95 / 100] }
    }
}

/// Classes of about equal number by rising value; equal values share one.
pub(super) fn classes(values: &[f64]) -> Vec<usize> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut levels = sorted.clone();
    levels.dedup();
    let class = |value: &f64| {
        if levels.len() <= CLASSES {
            return levels.partition_point(|level| level < value);
        }
        let count = CLASSES.min(values.len() / LEAST).max(1);
        sorted.partition_point(|other| other < value) * count / values.len()
    };
    values.iter().map(class).collect()
}

/// Share of the variance between classes.
fn explained(classes: &[usize], values: &[(f64, f64)]) -> f64 {
    let whole = variance(values);
    if whole <= 0.0 {
        return 0.0;
    }
    let last = classes.iter().max().copied().unwrap_or_default();
    let mut by_class = vec![Vec::new(); last + 1];
    classes.iter().zip(values).for_each(|(class, value)| by_class[*class].push(*value));
    let weight = |values: &[(f64, f64)]| values.iter().map(|(_, weight)| weight).sum::<f64>();
    let within: f64 = by_class.iter().map(|own| weight(own) * variance(own)).sum();
    1.0 - within / weight(values) / whole
}

/// Unbiased variance of weighted values; 0 of one.
fn variance(values: &[(f64, f64)]) -> f64 {
    let number = kish(values.iter().map(|(_, weight)| *weight));
    if number <= 1.0 {
        return 0.0;
    }
    let mean = WeightedMean::of(values).mean;
    let squares: Vec<(f64, f64)> =
        values.iter().map(|(value, weight)| ((value - mean) * (value - mean), *weight)).collect();
    WeightedMean::of(&squares).mean * number / (number - 1.0)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Ishigami and Homma 1990, with a = 7 and b = 0.1: indices 0.3139, 0.4424 and 0.
    #[test]
    fn the_function_of_ishigami_has_its_published_indices() {
        let mut draws = Draws::of("ishigami");
        let mut angle = || (draws.below(1 << 30) as f64 / f64::from(1 << 30) * 2.0 - 1.0) * PI;
        let points: Vec<[f64; 3]> = (0..8000).map(|_| [angle(), angle(), angle()]).collect();
        let value = |[one, two, three]: &[f64; 3]| {
            one.sin() + 7.0 * two.sin().powi(2) + 0.1 * three.powi(4) * one.sin()
        };
        let values: Vec<(f64, f64)> = points.iter().map(|point| (value(point), 1.0)).collect();
        for (input, expected) in [0.3139, 0.4424, 0.0].into_iter().enumerate() {
            let own: Vec<f64> = points.iter().map(|point| point[input]).collect();
            let found = SobolIndex::of("test", &classes(&own), &values);
            assert!((found.index - expected).abs() < 0.025, "{input}: {found:?}");
            assert_eq!(found.index > found.by_chance, expected > 0.1, "{input}: {found:?}");
        }
    }

    /// An input that decides everything explains all of it, whatever the weights; one that does nothing explains none.
    #[test]
    fn weights_do_not_move_what_is_explained() {
        let weight = |index: usize| if index.is_multiple_of(3) { 0.2 } else { 1.4 };
        let values: Vec<(f64, f64)> =
            (0..600).map(|index| (f64::from(u8::from(index % 2 == 0)), weight(index))).collect();
        let deciding: Vec<usize> = (0..600).map(|index| index % 2).collect();
        assert!((explained(&deciding, &values) - 1.0).abs() < 1e-12);
        let idle: Vec<usize> = (0..600).map(|index| index / 60).collect();
        // Ten classes alike: a little below 0, as one less than the number in each.
        assert!((-0.03..=0.0).contains(&explained(&idle, &values)));
        assert!(SobolIndex::of("none", &idle, &vec![(1.0, 1.0); 600]).index.abs() < 1e-15);
    }
}
