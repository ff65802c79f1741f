//! The rounds of a search: first a sample of the priors alone, which files and the command line call the net, then a generation of
//! every local search, variations of the nearest elites and a few more draws.

use std::ops::Range;

use endline_gear::Law;

use crate::encounters::draw;

use super::climb::{Climb, variation};
use super::elites::{Elites, Trial};
use super::ending::RunEnding;
use super::question::Question;

/// Greatest number of draws that are added together before the first local search.
pub(super) const DRAWS_AT_ONCE: u32 = 32;

/// Draws in every later round.
const DRAWS_BESIDE: u32 = 8;

/// Variations of elites in every later round.
const VARIATIONS: u32 = 8;

/// Local searches at a time.
const CLIMBS: usize = 4;

/// A round that comes next.
pub(super) struct Round {
    /// Name of its local searches' runs.
    pub(super) name: String,
    /// Points that local searches ask for, then variations of elites.
    pub(super) local: Vec<Vec<f64>>,
    /// Draws from the priors, by their place in the sequence.
    pub(super) draws: Range<u32>,
}

/// Points of the scrambled Sobol sequence in the unit cube of encounters.
#[derive(Clone, Copy)]
pub(super) struct SobolPoints {
    seed: u64,
    dimensions: usize,
}

impl SobolPoints {
    /// The point at a place.
    pub(super) fn at(&self, number: u32) -> Vec<f64> {
        draw::sobol_point(self.seed, number, self.dimensions)
    }
}

/// The state of a search, from which the next round follows.
pub(super) struct Rounds<'a> {
    pub(super) question: &'a Question,
    /// Dimensions of the unit cube.
    dimensions: usize,
    /// Dimensions with a continuous law.
    free: Vec<usize>,
    /// Draws before the first local search.
    first: u32,
    round: u32,
    /// Draws from the priors so far, each with its point.
    pub(super) prior_sample: Vec<(Vec<f64>, Trial)>,
    pub(super) elites: Elites,
    climbs: Vec<Climb>,
    /// Number of points of each local search in the current round.
    shares: Vec<usize>,
    begun: u64,
    /// Number of trials so far.
    pub(super) trials: usize,
}

impl<'a> Rounds<'a> {
    pub(super) fn new(question: &'a Question, first: usize) -> Self {
        let study = &question.opened.study;
        let varied = draw::dimensions(study);
        let is_free = |prior: usize| !matches!(study.priors[prior].law, Law::Choice(_));
        Self {
            question,
            dimensions: varied.len(),
            free: (0..varied.len()).filter(|dimension| is_free(varied[*dimension])).collect(),
            first: u32::try_from(first).unwrap_or(u32::MAX),
            round: 0,
            prior_sample: Vec::new(),
            elites: Elites::default(),
            climbs: Vec::new(),
            shares: Vec::new(),
            begun: 0,
            trials: 0,
        }
    }

    /// The points of draws.
    pub(super) fn sobol_points(&self) -> SobolPoints {
        SobolPoints { seed: self.question.seed, dimensions: self.dimensions }
    }

    /// The draws before the first local search, in parts, up to a number of trials.
    pub(super) fn first_draws(&self, trials: usize) -> impl Iterator<Item = Range<u32>> + use<> {
        let first = self.first;
        let until = first.min(u32::try_from(trials).unwrap_or(u32::MAX));
        (0..until)
            .step_by(DRAWS_AT_ONCE as usize)
            .map(move |from| from..from.saturating_add(DRAWS_AT_ONCE).min(first))
    }

    /// The next round, after the first draws.
    pub(super) fn next(&mut self) -> Round {
        let from = u32::try_from(self.prior_sample.len()).unwrap_or(u32::MAX);
        let name = format!("round-{:05}", self.round);
        self.shares.clear();
        self.climbs.retain(|climb| !climb.is_over());
        while self.climbs.len() < CLIMBS && self.begin() {}
        let mut local = Vec::new();
        for climb in &mut self.climbs {
            let generation = climb.generation();
            self.shares.push(generation.len());
            local.extend(generation);
        }
        local.extend(self.variations());
        Round { name, local, draws: from..from.saturating_add(DRAWS_BESIDE) }
    }

    /// Variations of the nearest elites.
    fn variations(&self) -> Vec<Vec<f64>> {
        let one = |(number, elite)| {
            let number = self.round.wrapping_mul(VARIATIONS).wrapping_add(number);
            variation(elite, &self.free, self.question.seed, number)
        };
        (0..VARIATIONS).zip(self.elites.nearest()).map(one).collect()
    }

    /// Begins a local search from the next elite; false if there is none.
    fn begin(&mut self) -> bool {
        let Some(elite) = self.elites.next_start() else { return false };
        elite.begun += 1;
        self.begun += 1;
        let seed = self.question.seed.wrapping_mul(1_000_003).wrapping_add(self.begun);
        let climb = Climb::begin(elite, &self.free, seed);
        let begins = climb.is_some();
        self.climbs.extend(climb);
        begins
    }

    /// Adds the runs of a round.
    pub(super) fn take(&mut self, round: &Round, local: &[RunEnding], draws: &[RunEnding]) {
        let observation = &self.question.observation;
        let held: Vec<Trial> = local.iter().map(|ended| Trial::of(observation, ended)).collect();
        for (point, trial) in round.local.iter().zip(&held) {
            self.elites.take(self.question, point, trial);
        }
        let mut rest = held.as_slice();
        for (climb, share) in self.climbs.iter_mut().zip(&self.shares) {
            let (own, others) = rest.split_at(*share);
            climb.take(own);
            rest = others;
        }
        self.trials += local.len();
        self.take_draws(draws);
    }

    /// Adds the runs of the next draws.
    pub(super) fn take_draws(&mut self, draws: &[RunEnding]) {
        let points = self.sobol_points();
        for ended in draws {
            let number = u32::try_from(self.prior_sample.len()).unwrap_or(u32::MAX);
            let point = points.at(number);
            let trial = Trial::of(&self.question.observation, ended);
            self.elites.take(self.question, &point, &trial);
            self.prior_sample.push((point, trial));
        }
        self.trials += draws.len();
        self.round += 1;
    }

    /// The least distance so far.
    pub(super) fn best(&self) -> Option<f64> {
        self.elites.best.values().map(|elite| elite.trial.distance).reduce(f64::min)
    }
}
