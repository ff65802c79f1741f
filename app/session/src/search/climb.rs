//! A local search: CMA-ES over what is continuous in an encounter, from an elite; acts and other choices stay as the elite's.
//!
//! Reference: Hansen 2016, The CMA evolution strategy: a tutorial (arXiv 1604.00772).

use fcmaes_core::{Cmaes, CmaesParams, Fitness};

use super::elites::Elite;
use super::trial::{PROGRESS, Trial};

/// Step at the start of a first search, as a share of the priors' ranges; each later one from the same kind begins with half of it.
const STEP: f64 = 0.12;

/// Least step at the start.
const LEAST_STEP: f64 = 0.01;

/// Generations without progress after which a search ends.
const STALE: u32 = 5;

/// Evaluations by which the strategy sets its damping; searches end long before.
const EVALUATIONS: u64 = 1000;

/// A local search under way.
pub(super) struct Climb {
    /// The elite's point; what is continuous in it changes.
    point: Vec<f64>,
    /// Dimensions that change.
    free: Vec<usize>,
    strategy: Cmaes,
    best: f64,
    stale: u32,
}

impl Climb {
    /// Begins from an elite; `None` where nothing is continuous.
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
        let best = elite.trial.aim();
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

    /// Takes in what the generation came to.
    pub(super) fn take(&mut self, trials: &[Trial]) {
        let aims: Vec<f64> = trials.iter().map(Trial::aim).collect();
        let best = aims.iter().copied().fold(f64::INFINITY, f64::min);
        self.stale = if best < self.best - PROGRESS { 0 } else { self.stale + 1 };
        self.best = self.best.min(best);
        self.strategy.tell(&aims);
    }

    /// Whether it is worth no further generation.
    pub(super) fn is_over(&self) -> bool {
        self.stale >= STALE || self.best < PROGRESS || self.strategy.stop() != 0
    }
}
