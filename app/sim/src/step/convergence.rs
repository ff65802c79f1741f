//! When the Newton passes of a step without contact have converged.

use crate::model::Model;
use crate::solver::Tolerance;

/// Passes every free solver step takes, unless the first, clear of the seabed, moved so little that a second would change nothing
/// of note.
pub(super) const LEAST_PASSES: usize = 2;
/// Passes after which a free solver step counts as not converged.
const MOST_PASSES: usize = 12;
/// Move of a pass at which a free solver step has converged [m].
const CONVERGED_M: f64 = 1e-3;
/// Distance left to go at which a step of rope that resists bending has converged; its passes converge linearly [m].
const BENT_CONVERGED_M: f64 = 1e-5;
/// Passes after which such a step counts as not converged.
const BENT_MOST_PASSES: usize = 40;
/// Move of the last pass with contact above which the step is redone shorter [m].
pub(super) const CONTACT_CONVERGED_M: f64 = 1e-3;

/// How long Newton goes on: rope that bends is solved for only roughly in each pass.
pub(super) struct Convergence {
    bends: bool,
    /// Passes after which the step counts as not converged.
    pub most_passes: usize,
    converged_m: f64,
    moved_before_m: f64,
}

impl Convergence {
    /// The tolerance of a model at its present resolution.
    pub fn new(model: &Model, tolerance: &Tolerance) -> Self {
        let bends = model.bends();
        let (most_passes, converged_m) =
            if bends { (BENT_MOST_PASSES, BENT_CONVERGED_M) } else { (MOST_PASSES, CONVERGED_M) };
        let converged_m = converged_m.min(tolerance.move_m);
        Self { bends, most_passes, converged_m, moved_before_m: f64::INFINITY }
    }

    /// Whether little enough is left to go after a pass that moved so far.
    pub fn is_reached(&mut self, pass: usize, moved_m: f64) -> bool {
        // Of moves that shrink by θ each pass, θ/(1-θ) of the last is left.
        let shrinkage = if self.bends { (moved_m / self.moved_before_m).min(0.9999) } else { 0.5 };
        self.moved_before_m = moved_m;
        pass >= LEAST_PASSES && moved_m * shrinkage / (1.0 - shrinkage) < self.converged_m
    }
}
