//! Distribution of the greatest tension of a run.

use schemars::JsonSchema;
use serde::Serialize;

use crate::study::runs::{RunRow, Runs};

use super::bootstrap;
use super::interval::Interval;
use super::weighted::quantile;

/// Greatest tensions of an option's runs [N].
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Tensions {
    /// Of every run that counts, sorted [N], each with what its encounter counts for.
    pub sorted_n: Vec<(f64, f64)>,
    /// Median of the differences from the baseline's run in the same encounter [N].
    pub median_difference_n: Option<f64>,
    /// Its interval [N].
    pub median_difference_interval_n: Option<Interval>,
}

impl Tensions {
    /// The tensions of an option, compared with another's.
    pub fn of(runs: &Runs, option: &str, baseline: &str) -> Self {
        let tension = |run: &RunRow| Some((run.peak_tension_n?, run.weight));
        let [own, other] = [option, baseline].map(|option| runs.by_encounter(option, tension));
        let mut sorted_n: Vec<(f64, f64)> = own.iter().flatten().copied().collect();
        sort(&mut sorted_n);
        let differences: Vec<(f64, f64)> = own
            .iter()
            .zip(&other)
            .filter_map(|(own, other)| {
                let ((own, weight), (other, _)) = ((*own)?, (*other)?);
                Some((own - other, weight))
            })
            .collect();
        let median_of =
            |indices: &[usize]| median(indices.iter().map(|index| differences[*index]).collect());
        Self {
            sorted_n,
            median_difference_n: median(differences.clone()),
            median_difference_interval_n: bootstrap::interval(
                &format!("tension {option}"),
                differences.len(),
                median_of,
            ),
        }
    }

    /// The tension below which a share of the runs stays [N].
    pub fn quantile_n(&self, share: f64) -> Option<f64> {
        quantile(&self.sorted_n, share)
    }

    /// Share of runs whose greatest tension is above a strength.
    pub fn share_above(&self, strength_n: f64) -> f64 {
        let weight = |least: f64| {
            let above = self.sorted_n.iter().filter(|(tension, _)| *tension > least);
            above.map(|(_, weight)| weight).sum::<f64>()
        };
        let all = weight(f64::NEG_INFINITY);
        if all > 0.0 { weight(strength_n) / all } else { 0.0 }
    }
}

fn sort(values: &mut [(f64, f64)]) {
    values.sort_by(|(one, _), (other, _)| one.total_cmp(other));
}

fn median(mut values: Vec<(f64, f64)>) -> Option<f64> {
    sort(&mut values);
    quantile(&values, 0.5)
}
