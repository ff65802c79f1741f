//! Trials, and the map of elites: the best trial of every kind of story, so that a search finds several different stories.
//!
//! Reference: Mouret and Clune 2015, Illuminating search spaces by mapping elites (arXiv 1504.04909).

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use endline_gear::Observation;

use crate::encounters::Encounter;

use super::distance::{Distance, LIKE};
use super::ending::{Ending, RunEnding};
use super::question::Question;

/// Distance of an invalid run.
pub(super) const INVALID: f64 = 1e3;

/// Least progress of a local search that counts; a cost below it needs no search.
pub(super) const PROGRESS: f64 = 0.05;

/// Weight of the least distance on the way beside that at the end: of runs with equally distant ends, a search prefers the one
/// that was near on the way.
const ON_THE_WAY: f64 = 0.2;

/// A run compared with the observation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Trial {
    /// Distance of its ending from the observation; [`INVALID`] for an invalid run.
    pub(super) distance: f64,
    /// The least distance at any time of the run.
    pub(super) nearest: f64,
    /// The terms of the distance, each with its reason.
    pub(super) terms: Vec<(f64, String)>,
    /// Whether the ending's mirror image is nearer to the observation.
    pub(super) mirrored: bool,
    /// The part that rope touched first; empty if it touched none.
    pub(super) first_part: String,
    /// Where rope is on the whale at its end.
    pub(super) ending: Ending,
    /// Whether the run is valid.
    pub(super) is_valid: bool,
    /// Time simulated [s].
    pub(super) simulated_s: f64,
    /// Hash of the last state.
    pub(super) state_hash: String,
}

impl Trial {
    /// Compares a run with an observation.
    pub(super) fn of(observation: &Observation, ended: &RunEnding) -> Self {
        let at_end = Distance::of(observation, &ended.ending);
        let is_valid = ended.fault.is_empty();
        let distance = if is_valid { at_end.sum() } else { INVALID };
        let before = ended.on_the_way.iter().map(|ending| Distance::of(observation, ending).sum());
        Self {
            distance,
            nearest: before.fold(distance, f64::min),
            mirrored: at_end.mirrored,
            terms: at_end.terms.into_iter().map(|term| (term.cost, term.says)).collect(),
            first_part: ended.first_part.clone(),
            ending: ended.ending.clone(),
            is_valid,
            simulated_s: ended.simulated_s,
            state_hash: ended.state_hash.clone(),
        }
    }

    /// Whether it is a story: something is on the whale at its end, or it is like the observation without.
    pub(super) fn is_story(&self) -> bool {
        !self.ending.is_free() || self.distance <= LIKE
    }

    /// The cost that a search minimises.
    pub(super) fn cost(&self) -> f64 {
        self.distance + ON_THE_WAY * self.nearest
    }
}

/// A kind of story: the part first touched, the acts of the whale before and after the touch, and the quarter from which it came.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Kind {
    /// The part that rope touched first.
    pub first_part: String,
    /// Its own act, then its answer to touch, such as `skim-feed` and `barrel-roll-away`.
    pub acts: Vec<String>,
    /// Quarter of its heading, clockwise from the direction of the current: 0 with it, 2 against it; `None` if no heading is drawn.
    pub quarter: Option<u8>,
}

/// The best trial of a kind.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Elite {
    /// Where in the unit cube of encounters.
    pub(super) point: Vec<f64>,
    /// The trial there.
    pub(super) trial: Trial,
    /// Local searches that have begun from it or its predecessors.
    pub(super) begun: u32,
}

/// Elites by kind.
#[derive(Debug, Default)]
pub(super) struct Elites {
    /// The nearest of every kind.
    pub(super) best: BTreeMap<Kind, Elite>,
    /// Every run that is like the observation, in order of the trials.
    like: Vec<(Kind, Elite)>,
}

impl Kind {
    pub(super) fn of(question: &Question, point: &[f64], trial: &Trial) -> Self {
        let encounter = Encounter::at_point(&question.opened.study, point);
        let quarter = encounter.number("heading").map(|heading| {
            let quarters = (heading / TAU * 4.0 + 0.5).rem_euclid(4.0);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 3")]
            let quarter = quarters as u8;
            quarter
        });
        Self { first_part: trial.first_part.clone(), acts: acts(&encounter), quarter }
    }
}

/// The whale's own act, its answer to touch, then the acts of its pilot; `none` and `swim` are no acts.
fn acts(encounter: &Encounter) -> Vec<String> {
    let of = |is_it: fn(&str) -> bool| {
        let drawn = encounter.drawn.iter().filter(move |drawn| is_it(&drawn.name));
        drawn.map(|drawn| drawn.text.clone()).filter(|act| !matches!(act.as_str(), "none" | "swim"))
    };
    let pilot = of(|name| name.starts_with("whale.pilot.") && name.ends_with(".act"));
    of(|name| name == "behaviour").chain(of(|name| name == "answer")).chain(pilot).collect()
}

impl Elites {
    /// Adds a trial, which becomes the elite of its kind if it costs less.
    pub(super) fn take(&mut self, question: &Question, point: &[f64], trial: &Trial) {
        if trial.first_part.is_empty() || !trial.is_valid {
            return;
        }
        let kind = Kind::of(question, point, trial);
        let begun = self.best.get(&kind).map_or(0, |elite| elite.begun);
        let elite = Elite { point: point.to_vec(), trial: trial.clone(), begun };
        if trial.distance <= LIKE {
            self.like.push((kind.clone(), elite.clone()));
        }
        if self.best.get(&kind).is_none_or(|best| trial.cost() < best.trial.cost()) {
            self.best.insert(kind, elite);
        }
    }

    /// Runs of a kind that are like the observation, the nearest first.
    pub(super) fn like(&self, kind: &Kind) -> Vec<&Elite> {
        let own = self.like.iter().filter(|(other, _)| other == kind);
        let mut own: Vec<&Elite> = own.map(|(_, elite)| elite).collect();
        own.sort_by(|one, other| one.trial.distance.total_cmp(&other.trial.distance));
        own
    }

    /// The elites, the nearest first.
    pub(super) fn nearest(&self) -> Vec<&Elite> {
        let mut elites: Vec<&Elite> = self.best.values().collect();
        elites.sort_by(|one, other| one.trial.cost().total_cmp(&other.trial.cost()));
        elites
    }

    /// The elite from which the next local search begins: the one of least cost, with a penalty of 1, the distance of an ending that is
    /// just like the observation, for each search that has begun from it.
    pub(super) fn next_start(&mut self) -> Option<&mut Elite> {
        let penalised = |elite: &Elite| elite.trial.cost() + LIKE * f64::from(elite.begun);
        let open = self.best.values_mut().filter(|elite| elite.trial.cost() > PROGRESS);
        open.min_by(|one, other| penalised(one).total_cmp(&penalised(other)))
    }
}
