//! What the run of an encounter came to, whatever observation it is held against: searches among the same encounters share it.

use endline_gear::{PathPlace, RopeEnd, Site};
use endline_sim::metrics::EventKind;
use serde::{Deserialize, Serialize};

use crate::encounters::Encounter;
use crate::run::Run;
use crate::study::{Opened, Played};

use super::ending::Ending;

/// Differences of wraps and twist that are kept [turns].
const TURNS: f64 = 0.25;

/// Differences of the logarithms of lengths that are kept.
const LENGTHS: f64 = 0.2;

/// A run at its end.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ended {
    /// How it ended.
    pub ending: Ending,
    /// How it would have ended before, at every look at which something that an observer tells had changed.
    pub on_the_way: Vec<Ending>,
    /// The part that rope touched first; empty where it touched none.
    pub first_part: String,
    /// Why it does not count; empty where it does.
    pub fault: String,
    /// Time simulated [s].
    pub simulated_s: f64,
    /// Hash of the last state.
    pub state_hash: String,
}

impl Ended {
    /// Runs an encounter to its end.
    pub(super) fn of(opened: &Opened, encounter: &Encounter) -> Self {
        let mut on_the_way: Vec<Ending> = Vec::new();
        let look = |run: &Run| {
            let now = Ending::of(run);
            if !now.is_free() && on_the_way.last().is_none_or(|last| differ(last, &now)) {
                on_the_way.push(now);
            }
        };
        match opened.play_watched(0, encounter, 0.0, look) {
            Ok(played) => Self { on_the_way, ..Self::played(&played) },
            Err(error) => Self { fault: error.to_string(), ..Self::default() },
        }
    }

    /// Runs an encounter on a finer resolution.
    pub(super) fn finer(opened: &Opened, encounter: &Encounter) -> Self {
        match opened.play_finer(0, encounter) {
            Ok(played) => Self::played(&played),
            Err(error) => Self { fault: error.to_string(), ..Self::default() },
        }
    }

    fn played(played: &Played) -> Self {
        let report = &played.report;
        let events = played.run.metrics().events();
        let first = events.iter().find(|event| event.kind == EventKind::Contact);
        let fault = || report.stopped.clone().unwrap_or_else(|| report.invalid_because.join("; "));
        Self {
            ending: Ending::of(&played.run),
            on_the_way: Vec::new(),
            first_part: first.map(|event| event.subject.clone()).unwrap_or_default(),
            fault: if report.is_valid() { String::new() } else { fault() },
            simulated_s: report.simulated_s,
            state_hash: report.state_hash.clone(),
        }
    }
}

/// Whether somebody who tells of two endings tells them apart.
fn differ(one: &Ending, other: &Ending) -> bool {
    let apart = |one: f64, other: f64, by: f64| (one - other).abs() > by;
    let length = |ending: &Ending| libm::log(ending.behind_m.max(1.0));
    strands(one).ne(strands(other))
        || sites(one).ne(sites(other))
        || one.sites.iter().zip(&other.sites).any(|(a, b)| apart(a.wraps, b.wraps, TURNS))
        || apart(one.twist, other.twist, TURNS)
        || apart(length(one), length(other), LENGTHS)
}

fn strands(ending: &Ending) -> impl Iterator<Item = (&[PathPlace], [Option<RopeEnd>; 2])> {
    ending.strands.iter().map(|strand| (strand.places.as_slice(), strand.ends))
}

fn sites(ending: &Ending) -> impl Iterator<Item = (Site, bool)> {
    ending.sites.iter().map(|at| (at.site, at.tight))
}
