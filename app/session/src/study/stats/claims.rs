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
    let marks = |options: &[String], event| options.iter().map(|option| Marks::of(table, option, event)).collect::<Vec<_>>();
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
    let told = |event: &endline_gear::Event, options: &[String]| format!("{} with {}", event.words(), options.join(", "));
    ClaimFinding {
        id: claim.id.value.clone(),
        says: claim.says.clone(),
        source: claim.source.clone(),
        more: told(&claim.event, &claim.more),
        less: told(&claim.less_event, &claim.less),
        more_rate: Rate::of(&Marks(more.into_iter().flat_map(|marks| marks.0).collect())),
        less_rate: Rate::of(&Marks(less.into_iter().flat_map(|marks| marks.0).collect())),
        difference,
        interval,
        verdict,
    }
}

/// Several options together: the difference of shares within each encounter, encounters drawn again for the interval.
fn pooled(label: &str, more: &[Marks], less: &[Marks]) -> (f64, Interval) {
    let share = |marks: &[Marks], encounter: usize| {
        let known: Vec<bool> = marks.iter().filter_map(|marks| marks.0.get(encounter).copied().flatten()).collect();
        (!known.is_empty()).then(|| known.iter().filter(|hit| **hit).count() as f64 / known.len() as f64)
    };
    let encounters = more.iter().chain(less).map(|marks| marks.0.len()).max().unwrap_or_default();
    let differences: Vec<f64> = (0..encounters).filter_map(|encounter| Some(share(more, encounter)? - share(less, encounter)?)).collect();
    let mean = |indices: &[usize]| Some(indices.iter().map(|index| differences[*index]).sum::<f64>() / indices.len() as f64);
    let all: Vec<usize> = (0..differences.len()).collect();
    let difference = if all.is_empty() { 0.0 } else { mean(&all).unwrap_or_default() };
    let interval = bootstrap::interval(&format!("claim {label}"), differences.len(), mean);
    (difference, interval.unwrap_or(Interval { low: -1.0, high: 1.0 }))
}
