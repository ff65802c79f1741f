//! The map of elites: the best trial of every kind of story, so that several different stories come out and not one lucky run.
//!
//! Reference: Mouret and Clune 2015, Illuminating search spaces by mapping elites (arXiv 1504.04909).

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::encounters::Encounter;

use super::distance::LIKE;
use super::question::Question;
use super::trial::{PROGRESS, Trial};

/// A kind of story: which part rope touched first, what the whale did before and then, and where it came from.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Kind {
    /// The part that rope touched first.
    pub first_part: String,
    /// What the whale did of its own, then what it answered, such as `skim-feed` and `barrel-roll-away`.
    pub acts: Vec<String>,
    /// Quarter of the compass from where the current flows on clockwise: 0 with it, 2 against it; `None` where no heading is drawn.
    pub quarter: Option<u8>,
}

/// The best trial of a kind.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Elite {
    /// Where in the unit cube of encounters.
    pub(super) point: Vec<f64>,
    /// What it came to.
    pub(super) trial: Trial,
    /// How many local searches have begun from it or its predecessors.
    pub(super) begun: u32,
}

/// Elites by kind.
#[derive(Debug, Default)]
pub(super) struct Elites {
    /// The nearest of every kind.
    pub(super) best: BTreeMap<Kind, Elite>,
    /// Every run that is like the observation, in the order in which they came.
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

/// What the whale does of its own, then what it answers, then the acts of its pilot; `none` and `swim` are no acts.
fn acts(encounter: &Encounter) -> Vec<String> {
    let of = |is_it: fn(&str) -> bool| {
        let drawn = encounter.drawn.iter().filter(move |drawn| is_it(&drawn.name));
        drawn.map(|drawn| drawn.text.clone()).filter(|act| !matches!(act.as_str(), "none" | "swim"))
    };
    let pilot = of(|name| name.starts_with("whale.pilot.") && name.ends_with(".act"));
    of(|name| name == "behaviour").chain(of(|name| name == "answer")).chain(pilot).collect()
}

impl Elites {
    /// Takes in a trial: it becomes the elite of its kind if it is nearer than that.
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
        if self.best.get(&kind).is_none_or(|best| trial.aim() < best.trial.aim()) {
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
        elites.sort_by(|one, other| one.trial.aim().total_cmp(&other.trial.aim()));
        elites
    }

    /// The elite from which the next local search begins: near, not begun from too often, and not as good as it can be.
    pub(super) fn next_start(&mut self) -> Option<&mut Elite> {
        let worth = |elite: &Elite| elite.trial.aim() + f64::from(elite.begun);
        let open = self.best.values_mut().filter(|elite| elite.trial.aim() > PROGRESS);
        open.min_by(|one, other| worth(one).total_cmp(&worth(other)))
    }
}
