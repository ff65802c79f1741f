//! Kendall's τ between the experts' table of 2019 and simulated risks.
//!
//! `τ_b = (C - D) / √((n₀ - n₁)(n₀ - n₂))`: of the `n₀ = n(n-1)/2` pairs of rows, `C` stand in the same order in both, `D` in
//! the opposite one; `n₁` and `n₂` are tied in one and in the other. It is 1 where the orders are the same, -1 where they are opposite.
//! Its interval covers chance: encounters are drawn again.
//! Reference: Kendall 1945, The treatment of ties in ranking problems, Biometrika 33 (doi:10.1093/biomet/33.3.239).

use schemars::JsonSchema;
use serde::Serialize;

use crate::study::stats::{EventIndicator, EventIndicators, Interval, bootstrap};

use super::Threat;
use super::experts::ExpertTable;

/// Agreement in order.
#[derive(Clone, Debug, JsonSchema, PartialEq, Serialize)]
pub struct Tau {
    /// Kendall's τ_b.
    pub tau: f64,
    /// Its interval of 95 % by chance; none where most samples have no order.
    pub interval: Option<Interval>,
    /// Rows that both have.
    pub rows: usize,
    /// Pairs of rows that the simulation leaves in no order.
    pub ties: usize,
}

/// The agreement of simulated rows with the experts' table; none where they share too little for an order.
pub(super) fn against(experts: &ExpertTable, rows: &[(Threat, EventIndicators)]) -> Option<Tau> {
    let shared: Vec<(f64, &EventIndicators)> = rows
        .iter()
        .filter_map(|(row, indicators)| Some((experts.find(row.key())?.risk, indicators)))
        .collect();
    let opinions: Vec<f64> = shared.iter().map(|(risk, _)| *risk).collect();
    let risks = |indices: Option<&[usize]>| -> Vec<f64> {
        shared.iter().map(|(_, indicators)| rate(indicators, indices)).collect()
    };
    let simulated = risks(None);
    let count = shared.iter().map(|(_, indicators)| indicators.0.len()).max()?;
    Some(Tau {
        tau: tau(&opinions, &simulated)?,
        interval: bootstrap::interval("threat", count, |indices| {
            tau(&opinions, &risks(Some(indices)))
        }),
        rows: shared.len(),
        ties: pairs(&simulated).filter(|[one, other]| order(*one, *other) == 0).count(),
    })
}

/// Weighted rate in encounters drawn again, or in each once.
fn rate(indicators: &EventIndicators, indices: Option<&[usize]>) -> f64 {
    let sum = |indicators: &mut dyn Iterator<Item = &Option<EventIndicator>>| {
        indicators.flatten().fold((0.0, 0.0), |(hits, all), indicator| {
            (hits + f64::from(indicator.occurred) * indicator.weight, all + indicator.weight)
        })
    };
    let (hits, all) = match indices {
        None => sum(&mut indicators.0.iter()),
        Some(indices) => sum(&mut indices.iter().filter_map(|index| indicators.0.get(*index))),
    };
    if all > 0.0 { hits / all } else { 0.0 }
}

/// Kendall's τ_b of two lists of one length; none where one is all ties.
fn tau(ones: &[f64], others: &[f64]) -> Option<f64> {
    let (mut sum, mut first, mut second) = (0, 0, 0);
    for ([a, b], [c, d]) in pairs(ones).zip(pairs(others)) {
        let (one, other) = (order(a, b), order(c, d));
        sum += one * other;
        first += one * one;
        second += other * other;
    }
    (first > 0 && second > 0)
        .then(|| f64::from(sum) / (f64::from(first) * f64::from(second)).sqrt())
}

fn pairs(values: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    (0..values.len()).flat_map(move |one| (0..one).map(move |other| [values[one], values[other]]))
}

/// 1, 0 or -1; rates that differ by rounding alone are tied.
fn order(one: f64, other: f64) -> i32 {
    let same = (one - other).abs() <= 1e-12 * one.abs().max(other.abs());
    i32::from(!same && one > other) - i32::from(!same && one < other)
}

#[cfg(test)]
mod tests {
    use super::super::tests::row;
    use super::*;

    #[test]
    fn tau_of_lists_worked_out_by_hand() {
        // Of 6 pairs 5 agree and 1 is turned round.
        assert_eq!(tau(&[1.0, 2.0, 3.0, 4.0], &[1.0, 2.0, 4.0, 3.0]), Some(4.0 / 6.0));
        assert_eq!(tau(&[1.0, 2.0, 3.0], &[9.0, 5.0, 1.0]), Some(-1.0));
        // One pair is tied in the second: 2 / √(3 · 2).
        let tied = tau(&[1.0, 2.0, 3.0], &[1.0, 1.0, 2.0]).unwrap();
        assert!((tied - 2.0 / 6.0_f64.sqrt()).abs() < 1e-15, "{tied}");
        assert_eq!(tau(&[1.0, 2.0], &[3.0, 3.0]), None);
    }

    #[test]
    fn rows_are_compared_with_those_of_the_experts_by_rope_device_and_traps() {
        let poll = ExpertTable::read(
            "poll.csv",
            "Rope,RopeDiam,TrawlLen,BuoylineDevice,Risk\n3/8in,0.375,3,NA,0.6\n1/2in,0.5,3,NA,0.7\n5/8in,0.625,3,NA,0.8\n",
        )
        .unwrap();
        let indicators =
            |hits: usize| EventIndicators::even((0..100).map(|index| Some(index < hits)));
        let rows =
            [("3/8in", 0.375, 10), ("1/2in", 0.5, 60), ("5/8in", 0.625, 40), ("1in", 1.0, 0)].map(
                |(rope, diameter, hits)| {
                    (row(rope, diameter, 3, "NA", hits), indicators(hits as usize))
                },
            );
        let tau = against(&poll, &rows).unwrap();
        assert_eq!((tau.rows, tau.ties), (3, 0));
        assert!((tau.tau - 1.0 / 3.0).abs() < 1e-15);
        let Interval { low, high } = tau.interval.unwrap();
        // 60 against 40 of the same 100 encounters is the same order in nearly every sample.
        assert!(low > 0.3 && high < 0.4, "{low} {high}");
    }
}
