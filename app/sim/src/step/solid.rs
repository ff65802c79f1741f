//! A solver step with rope on obstacles or bodies.

use super::audit::Audit;
use super::context::StepContext;
use super::convergence::{CONTACT_CONVERGED_M, LEAST_PASSES};
use super::rejection::Rejection;
use crate::solver::{CONTACT_WANTED_M, Solver};

/// Passes of such a step that trust the contacts that the last solve predicted; later ones search along the line.
const PREDICTED_PASSES: usize = 8;
/// Passes after which a step with rope on obstacles or bodies ends.
const MOST_SOLID_PASSES: usize = 30;

/// Newton with rope on obstacles or bodies.
pub(super) fn solid_step(
    context: &StepContext<'_>,
    solver: &mut Solver,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    let StepContext { model, state, scheme } = *context;
    let mut last_m = f64::INFINITY;
    for pass in 1..=MOST_SOLID_PASSES {
        if pass == PREDICTED_PASSES + 1 {
            // The predicted contacts led astray: begin again.
            solver.begin(model, state, scheme);
            solver.solid.follow_again();
        }
        let passed = if pass <= PREDICTED_PASSES {
            solver.pass(model, state, scheme)
        } else {
            solver.line_searched_pass(model, state, scheme)
        };
        audit.passes += 1;
        if !passed.finite {
            audit.non_finite += 1;
            return Err(Rejection::NotFinite);
        }
        last_m = passed.longest_m;
        let settled = last_m < CONTACT_WANTED_M
            && solver.pushes_are_settled()
            && solver.pull_is_settled(model, scheme);
        if pass >= LEAST_PASSES && settled && !solver.strayed_to_solids(state, scheme.dt) {
            break;
        }
    }
    if last_m > CONTACT_CONVERGED_M {
        return Err(Rejection::NotConverged);
    }
    audit.unconverged += u64::from(last_m > CONTACT_WANTED_M);
    solver
        .went_through(state)
        .map_or(Ok(()), |(segment, solid)| Err(Rejection::WentThrough(segment, solid)))
}
