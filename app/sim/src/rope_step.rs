//! A solver step with rope on rope, away from the whale.
//!
//! Newton with every move cut where ropes would cross (`solver/tied.rs`). Where rope came near rope that its drift would not
//! have brought it near to, the step is done again with that looked at too.

use crate::model::Model;
use crate::solver::{CONTACT_WANTED_M, Scheme, Solver, Tied};
use crate::state::State;
use crate::step::Audit;
use crate::substep::{CONTACT_CONVERGED_M, Refused};

/// Most times a step is done again with more rope looked at.
const MOST_GATHERED: usize = 4;

/// A solver step that the solver has just begun.
pub(crate) fn rope_step(
    model: &Model,
    state: &State,
    solver: &mut Solver,
    scheme: &Scheme,
    audit: &mut Audit,
) -> Result<(), Refused> {
    for again in 0..MOST_GATHERED {
        if again > 0 {
            solver.begin(model, state, scheme);
        }
        solver.set_out(state);
        solver.ropes.begin();
        solver.drift_tied();
        solver.open_ropes(state);
        balance(model, state, solver, scheme, audit)?;
        let on_solids = solver.strayed_to_solids(state, scheme.dt);
        if !solver.met_more_ropes(model, state) && !on_solids {
            audit.rope_steps += 1;
            return solver
                .went_through(state)
                .map_or(Ok(()), |(segment, solid)| Err(Refused::WentThrough(segment, solid)));
        }
    }
    Err(Refused::NotConverged)
}

/// Newton to the balance of forces.
fn balance(
    model: &Model,
    state: &State,
    solver: &mut Solver,
    scheme: &Scheme,
    audit: &mut Audit,
) -> Result<(), Refused> {
    match solver.solve_tied(model, state, scheme) {
        Tied::Ended { last_m, passes } => {
            audit.passes += passes as u64;
            if last_m > CONTACT_CONVERGED_M {
                return Err(Refused::NotConverged);
            }
            audit.unconverged += u64::from(last_m > CONTACT_WANTED_M);
        }
        Tied::NotFinite => {
            audit.non_finite += 1;
            return Err(Refused::NotFinite);
        }
        Tied::Crushed(segments) => return Err(Refused::RopesPinched(segments)),
    }
    solver.crushed_ropes(true).map_or(Ok(()), |segments| Err(Refused::RopesPinched(segments)))
}
