//! Claims: whether the sign holds.

use endline_gear::Claim;
use serde::Serialize;

use crate::study::table::Table;

use super::bootstrap;
use super::interval::{Interval, Rate};
use super::marks::Marks;
use super::paired::Paired;

/// What came of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The whole interval of the difference has the claimed sign.
    Holds,
    /// The whole interval has the other sign.
    Opposite,
    /// The interval holds zero.
    Open,
}

impl Verdict {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Holds => "the sign holds",
            Self::Opposite => "the sign is the other way round",
            Self::Open => "not settled: the interval holds zero",
        }
    }
}

/// A claim and what was counted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClaimFinding {
    /// Id.
    pub id: String,
    /// The statement.
    pub says: String,
    /// Who states it.
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
    /// Whether the sign holds.
    pub verdict: Verdict,
}

/// Looks at a claim.
pub(super) fn look(claim: &Claim, table: &Table) -> ClaimFinding {
    let marks = |options: &[String], event| {
        options.iter().map(|option| Marks::of(table, option, event)).collect::<Vec<_>>()
    };
    let (more, less) = (marks(&claim.more, &claim.event), marks(&claim.less, &claim.less_event));
    let (difference, interval) = match (more.as_slice(), less.as_slice()) {
        ([more], [less]) => {
            let paired = Paired::of(more, less);
            (paired.difference, paired.difference_interval)
        }
        _ => pooled(&claim.id.value, &more, &less),
    };
    let verdict = match interval {
        Interval { low, .. } if low > 0.0 => Verdict::Holds,
        Interval { high, .. } if high < 0.0 => Verdict::Opposite,
        _ => Verdict::Open,
    };
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
        verdict,
    }
}

/// The rate over several options, whose interval counts each encounter once.
fn rate(label: &str, marks: &[Marks]) -> Rate {
    let all = Rate::of(&Marks(marks.iter().flat_map(|marks| marks.0.clone()).collect()));
    if marks.len() < 2 {
        return all;
    }
    let shares = shares(marks);
    if all.hits == 0 || all.hits == all.runs {
        // Drawing again what never varies says nothing of chance.
        let counted = if all.hits == 0 { 0 } else { shares.len() as u64 };
        return Rate { interval: Rate::from_counts(counted, shares.len() as u64).interval, ..all };
    }
    let interval = bootstrap::interval(label, shares.len(), |indices| mean(&shares, indices));
    interval.map_or(all, |interval| Rate { interval, ..all })
}

/// Share of the options in which the event came, by encounter with any run that counts.
fn shares(marks: &[Marks]) -> Vec<f64> {
    let encounters = marks.iter().map(|marks| marks.0.len()).max().unwrap_or_default();
    (0..encounters).filter_map(|encounter| share(marks, encounter)).collect()
}

fn share(marks: &[Marks], encounter: usize) -> Option<f64> {
    let known: Vec<bool> =
        marks.iter().filter_map(|marks| marks.0.get(encounter).copied().flatten()).collect();
    (!known.is_empty())
        .then(|| known.iter().filter(|hit| **hit).count() as f64 / known.len() as f64)
}

fn mean(values: &[f64], indices: &[usize]) -> Option<f64> {
    Some(indices.iter().map(|index| values[*index]).sum::<f64>() / indices.len() as f64)
}

/// Several options together: the difference of shares within each encounter, encounters drawn again for the interval.
fn pooled(label: &str, more: &[Marks], less: &[Marks]) -> (f64, Interval) {
    let encounters = more.iter().chain(less).map(|marks| marks.0.len()).max().unwrap_or_default();
    let differences: Vec<f64> = (0..encounters)
        .filter_map(|encounter| Some(share(more, encounter)? - share(less, encounter)?))
        .collect();
    let mean = |indices: &[usize]| mean(&differences, indices);
    let all: Vec<usize> = (0..differences.len()).collect();
    let difference = if all.is_empty() { 0.0 } else { mean(&all).unwrap_or_default() };
    let interval = bootstrap::interval(&format!("claim {label}"), differences.len(), mean);
    (difference, interval.unwrap_or(Interval { low: -1.0, high: 1.0 }))
}
