//! A solver step with rope on rope, away from the whale.
//!
//! Newton with every move cut where ropes would cross (`solver/rope_contact_newton.rs`). Where rope came near rope that its drift would not
//! have brought it near to, the step is done again with that looked at too.

use super::audit::Audit;
use super::context::StepContext;
use super::convergence::CONTACT_CONVERGED_M;
use super::rejection::Rejection;
use crate::cost::CostPart;
use crate::solver::{CONTACT_WANTED_M, RopeContactEnd, Solver};

/// Most times a step is done again with more rope looked at.
const MOST_GATHERED: usize = 4;

/// A solver step that the solver has just begun.
pub(super) fn rope_step(
    context: &StepContext<'_>,
    solver: &mut Solver,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    let StepContext { model, state, scheme } = *context;
    for again in 0..MOST_GATHERED {
        if again > 0 {
            solver.begin(model, state, scheme);
        }
        solver.cost.enter(CostPart::Detection);
        solver.set_out(state);
        solver.ropes.begin();
        solver.drift_in_rope_contact();
        solver.open_ropes(state);
        solver.cost.enter(CostPart::Contact);
        balance(context, solver, audit)?;
        let on_solids = solver.strayed_to_solids(state, scheme.dt);
        if !solver.met_more_ropes(model, state) && !on_solids {
            audit.rope_steps += 1;
            return solver
                .went_through(state)
                .map_or(Ok(()), |(segment, solid)| Err(Rejection::WentThrough(segment, solid)));
        }
    }
    Err(Rejection::NotConverged)
}

/// Newton to the balance of forces.
fn balance(
    context: &StepContext<'_>,
    solver: &mut Solver,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    let StepContext { model, state, scheme } = *context;
    match solver.solve_rope_contact(model, state, scheme) {
        RopeContactEnd::Ended { last_m, passes } => {
            audit.passes += passes as u64;
            if last_m > CONTACT_CONVERGED_M {
                return Err(Rejection::NotConverged);
            }
            audit.unconverged += u64::from(last_m > CONTACT_WANTED_M);
        }
        RopeContactEnd::NotFinite => {
            audit.non_finite += 1;
            return Err(Rejection::NotFinite);
        }
        RopeContactEnd::Crushed(segments) => return Err(Rejection::RopesPinched(segments)),
    }
    solver.crushed_ropes(true).map_or(Ok(()), |segments| Err(Rejection::RopesPinched(segments)))
}
