//! Solution of a solver step and the check of its path.
//!
//! The iterations are free to move anywhere (`solver/newton.rs`); what is checked is the straight path from the start of the step to
//! its end.

use super::audit::Audit;
use super::rejection::Rejection;
use crate::contact::failure::Kind;
use crate::cost::CostPart;
use crate::model::Model;
use crate::solver::{NewtonEnd, Solved, Solver};
use crate::trial::StepContext;

/// Largest number of solutions of a step with rope that came near to something that the search by its drift did not find.
const MOST_GATHERED: usize = 4;

/// Solves a step, again if rope reached something that the search did not find.
pub(super) fn solve(
    context: &StepContext<'_>,
    solver: &mut Solver,
    audit: &mut Audit,
) -> Result<Solved, Rejection> {
    let StepContext { model, state, scheme } = *context;
    for _ in 0..MOST_GATHERED {
        let ropes = &solver.contacts.rope_on_rope;
        if ropes.touching && is_long(model, scheme.dt) && !ropes.rest(model, state) {
            return Err(Rejection::RopesMeet);
        }
        solver.begin_step(context);
        let solved = solver.solve_step(context).map_err(|end| match end {
            NewtonEnd::NotConverged => Rejection::NotConverged,
            NewtonEnd::NotFinite => {
                audit.non_finite += 1;
                Rejection::NotFinite
            }
            NewtonEnd::Contact(failure) => failure.into(),
        })?;
        audit.passes += solved.passes as u64;
        solver.cost.enter(CostPart::Detection);
        if !solver.find_more(context, solved.moved_m) {
            let contacts = &solver.contacts;
            audit.rope_steps +=
                u64::from(contacts.rope_on_rope.touching && !contacts.rope_touches_skin());
            check_path(context, solver, audit)?;
            return Ok(solved);
        }
    }
    Err(Rejection::NotConverged)
}

/// Whether a step is longer than contact allows.
fn is_long(model: &Model, dt: f64) -> bool {
    dt > model.spec.settings.contact_step_s * (1.0 + 1e-9)
}

/// Checks that the path is free and leaves nothing pinched.
fn check_path(
    context: &StepContext<'_>,
    solver: &mut Solver,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    let mut crossings = [0; Kind::COUNT];
    let checked = solver.check_path(context, &mut crossings);
    audit.tunnelled += crossings[Kind::RopeOnSkin as usize];
    audit.ropes_crossed += crossings[Kind::RopeOnRope as usize];
    audit.bodies_crossed += crossings[Kind::BodyOnSkin as usize];
    checked.map_err(Rejection::from)
}
