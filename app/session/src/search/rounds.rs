//! The rounds of a search: first a net of Sobol points alone, then a generation of every local search and a few more points.

use endline_gear::Law;

use crate::study::draw;

use super::climb::Climb;
use super::elites::Elites;
use super::question::Question;
use super::trial::Trial;

/// Trials of a round of the net.
const NET: usize = 32;

/// Rounds of the net alone.
const NET_ROUNDS: u32 = 4;

/// Points of the net in every later round.
const NET_BESIDE: usize = 8;

/// Local searches at a time.
const CLIMBS: usize = 4;

/// Which points come next, from what came of those before.
pub(super) struct Rounds<'a> {
    question: &'a Question,
    /// Dimensions of the unit cube.
    dimensions: usize,
    /// Those with a continuous law.
    free: Vec<usize>,
    /// Whether local searches are left out: the net alone, for comparison.
    net_alone: bool,
    round: u32,
    /// Points of the net so far.
    pub(super) net: Vec<Trial>,
    pub(super) elites: Elites,
    climbs: Vec<Climb>,
    /// How many points of the round under way are each local search's.
    shares: Vec<usize>,
    begun: u64,
    done: usize,
}

impl<'a> Rounds<'a> {
    pub(super) fn new(question: &'a Question, net_alone: bool) -> Self {
        let study = &question.opened.study;
        let varied = draw::dimensions(study);
        let is_free = |prior: usize| !matches!(study.priors[prior].law, Law::Choice(_));
        Self {
            question,
            dimensions: varied.len(),
            free: (0..varied.len()).filter(|dimension| is_free(varied[*dimension])).collect(),
            net_alone,
            round: 0,
            net: Vec::new(),
            elites: Elites::default(),
            climbs: Vec::new(),
            shares: Vec::new(),
            begun: 0,
            done: 0,
        }
    }

    /// Trials taken in so far.
    pub(super) fn trials(&self) -> usize {
        self.done
    }

    /// Name of the round that comes next; the net alone has its own.
    pub(super) fn name(&self) -> String {
        let kind = if self.is_net() { "net" } else { "round" };
        format!("{kind}-{:05}", self.round)
    }

    fn is_net(&self) -> bool {
        self.net_alone || self.round < NET_ROUNDS
    }

    /// Points of the next round: those of the local searches first.
    pub(super) fn next(&mut self) -> Vec<Vec<f64>> {
        let mut points = Vec::new();
        self.shares.clear();
        if !self.is_net() {
            self.climbs.retain(|climb| !climb.is_over());
            while self.climbs.len() < CLIMBS && self.begin() {}
            for climb in &mut self.climbs {
                let generation = climb.generation();
                self.shares.push(generation.len());
                points.extend(generation);
            }
        }
        let net = if self.is_net() { NET } else { NET_BESIDE };
        let seed = self.question.seed;
        let index = |number: usize| u32::try_from(self.net.len() + number).unwrap_or(u32::MAX);
        points
            .extend((0..net).map(|number| draw::sobol_point(seed, index(number), self.dimensions)));
        points
    }

    /// Begins a local search from the worthiest elite; false where there is none.
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

    /// Takes in what the points of the round came to.
    pub(super) fn take(&mut self, points: &[Vec<f64>], trials: Vec<Trial>) {
        for (point, trial) in points.iter().zip(&trials) {
            self.elites.take(self.question, point, trial);
        }
        let mut rest = trials.as_slice();
        for (climb, share) in self.climbs.iter_mut().zip(&self.shares) {
            let (own, others) = rest.split_at(*share);
            climb.take(own);
            rest = others;
        }
        self.net.extend(rest.iter().cloned());
        self.done += trials.len();
        self.round += 1;
    }

    /// The least distance so far.
    pub(super) fn best(&self) -> Option<f64> {
        self.elites.0.values().map(|elite| elite.trial.distance).reduce(f64::min)
    }
}
