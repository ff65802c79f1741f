//! A solver step in which rope touches water and seabed only.

use super::audit::Audit;
use super::context::StepContext;
use super::convergence::Convergence;
use super::rejection::Rejection;
use crate::solids::workspace;
use crate::solver::{FreePass, Solver, TENSION_GAP_N, TENSION_GAP_SHARE, Tolerance};

/// Move below which one pass is enough [m].
const ONE_PASS_M: f64 = 1e-3;
/// Difference between solved and true tension below which one pass is enough [N].
const ONE_PASS_GAP_N: f64 = 0.02;
/// Difference between solved and true tension below which one pass is enough, as a share of the greatest tension.
const ONE_PASS_GAP_SHARE: f64 = 1e-4;

/// What free rope met in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FreeOutcome {
    /// Nothing but water and seabed.
    Clear,
    /// An obstacle, a body or rope that its drift would not have brought it near to.
    Met,
}

/// Newton where only water and seabed touch the rope; what it met beyond.
pub(super) fn free_step(
    context: &StepContext<'_>,
    solver: &mut Solver,
    audit: &mut Audit,
) -> Result<FreeOutcome, Rejection> {
    let StepContext { model, state, scheme } = *context;
    solver.begin_free(model, state, scheme);
    let tolerance = solver.tolerance();
    let (mut convergence, at_once) = (Convergence::new(model, &tolerance), !model.bends());
    let mut moved_m = 0.0;
    for pass in 1..=convergence.most_passes {
        let passed = solver.pass_free(model, state, scheme, 1.0);
        audit.passes += 1;
        moved_m += passed.longest_m;
        if !passed.finite {
            audit.non_finite += 1;
            return Err(Rejection::NotFinite);
        }
        let rests = convergence.is_reached(pass, passed.longest_m);
        let settled = passed.gap_n.max(passed.flipped_n)
            <= TENSION_GAP_N.min(tolerance.gap_n).max(TENSION_GAP_SHARE * passed.greatest_n);
        if (rests && settled) || (at_once && is_exact(&passed, &tolerance)) {
            // Rope that kept to its drift has met nothing but what was gathered.
            let strayed = moved_m > workspace::MARGIN_M && solver.strayed_free(state, scheme.dt);
            let met = strayed || solver.met_ropes_free(model, state, moved_m);
            return Ok(if met { FreeOutcome::Met } else { FreeOutcome::Clear });
        }
    }
    Err(Rejection::NotConverged)
}

/// Whether another pass would change nothing of note.
fn is_exact(passed: &FreePass, tolerance: &Tolerance) -> bool {
    let gap_n = ONE_PASS_GAP_N.min(tolerance.gap_n).max(ONE_PASS_GAP_SHARE * passed.greatest_n);
    !passed.near_seabed
        && passed.longest_m < ONE_PASS_M.min(tolerance.move_m)
        && passed.gap_n.max(passed.flipped_n) < gap_n
}

/// Newton line by line, where ropes, bodies or obstacles are near but nothing touches.
pub(super) fn lines_step(
    context: &StepContext<'_>,
    solver: &mut Solver,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    let StepContext { model, state, scheme } = *context;
    let mut convergence = Convergence::new(model, &solver.tolerance());
    for pass in 1..=convergence.most_passes {
        let passed = solver.pass(model, state, scheme);
        audit.passes += 1;
        if !passed.finite {
            audit.non_finite += 1;
            return Err(Rejection::NotFinite);
        }
        if convergence.is_reached(pass, passed.longest_m) && solver.pull_is_settled(model, scheme) {
            return Ok(());
        }
    }
    Err(Rejection::NotConverged)
}
