//! Points near elites: local searches and variations.
//!
//! A local search is CMA-ES over the continuous dimensions of an encounter, from an elite whose acts and other choices it keeps.
//! Variations exchange a choice, and so reach encounters with other acts.
//! References: Hansen 2016, The CMA evolution strategy: a tutorial (arXiv 1604.00772); Mouret and Clune 2015, Illuminating search
//! spaces by mapping elites (arXiv 1504.04909).

use fcmaes_core::{Cmaes, CmaesParams, Fitness};

use crate::encounters::draw;

use super::elites::{Elite, PROGRESS, Trial};

/// Step at the start of a first search, as a share of the priors' ranges; each later one from the same kind begins with half of it.
const STEP: f64 = 0.12;

/// Least step at the start.
const LEAST_STEP: f64 = 0.01;

/// Generations without progress after which a search ends.
const STALE: u32 = 5;

/// Evaluations by which the strategy sets its damping; searches end after fewer.
const EVALUATIONS: u64 = 1000;

/// A local search under way.
pub(super) struct Climb {
    /// The elite's point, whose continuous dimensions change.
    point: Vec<f64>,
    /// Dimensions that change.
    free: Vec<usize>,
    strategy: Cmaes,
    best: f64,
    stale: u32,
}

impl Climb {
    /// Begins from an elite; `None` if no dimension is continuous.
    pub(super) fn begin(elite: &Elite, free: &[usize], seed: u64) -> Option<Self> {
        let point = &elite.point;
        if free.is_empty() {
            return None;
        }
        let guess: Vec<f64> = free.iter().map(|dimension| point[*dimension]).collect();
        let bounds = [vec![0.0; free.len()], vec![1.0; free.len()]];
        let within = Fitness::bounded(free.len(), 1, &bounds[0], &bounds[1]);
        let params = CmaesParams {
            popsize: 0,
            max_evaluations: EVALUATIONS,
            seed,
            ..CmaesParams::default()
        };
        let halvings = i32::try_from(elite.begun.saturating_sub(1)).unwrap_or(i32::MAX);
        let step = (STEP * 0.5_f64.powi(halvings)).max(LEAST_STEP);
        let strategy = Cmaes::new(within, &guess, &[step], &params);
        let best = elite.trial.cost();
        Some(Self { point: point.clone(), free: free.to_vec(), strategy, best, stale: 0 })
    }

    /// The next generation, as whole points.
    pub(super) fn generation(&mut self) -> Vec<Vec<f64>> {
        let whole = |own: Vec<f64>| {
            let mut point = self.point.clone();
            for (dimension, share) in self.free.iter().zip(own) {
                point[*dimension] = share.clamp(0.0, 1.0);
            }
            point
        };
        self.strategy.ask().into_iter().map(whole).collect()
    }

    /// Updates the strategy with the trials of its generation.
    pub(super) fn take(&mut self, trials: &[Trial]) {
        let costs: Vec<f64> = trials.iter().map(Trial::cost).collect();
        let best = costs.iter().copied().fold(f64::INFINITY, f64::min);
        self.stale = if best < self.best - PROGRESS { 0 } else { self.stale + 1 };
        self.best = self.best.min(best);
        self.strategy.tell(&costs);
    }

    /// Whether it has converged or makes no progress.
    pub(super) fn is_over(&self) -> bool {
        self.stale >= STALE || self.best < PROGRESS || self.strategy.stop() != 0
    }
}

/// Greatest change of a continuous dimension of a variation, as a share of its law.
const OFF: f64 = 0.08;

/// Variation `number` of an elite, of which `free` are the continuous dimensions: one of its choices exchanged, and small changes of
/// the rest.
pub(super) fn variation(elite: &Elite, free: &[usize], seed: u64, number: u32) -> Vec<f64> {
    let mut point = elite.point.clone();
    let chances = draw::sobol_point(seed ^ 0x5851_f42d_4c95_7f2d, number, point.len() + 1);
    for dimension in free {
        let off = OFF * (2.0 * chances[*dimension] - 1.0);
        point[*dimension] = (point[*dimension] + off).clamp(0.0, 1.0);
    }
    let choices: Vec<usize> =
        (0..point.len()).filter(|dimension| !free.contains(dimension)).collect();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a place in a short list"
    )]
    let place = (chances[elite.point.len()] * choices.len() as f64) as usize;
    if let Some(choice) = choices.get(place) {
        point[*choice] = chances[*choice];
    }
    point
}
