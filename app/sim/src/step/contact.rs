//! Where a solver step ended: whether its path leads through skin, rope or solids, and whether rope is pinched.
//!
//! Newton goes where it likes (`solver/newton.rs`); what counts is the straight path from where the step began to where it ended.

use super::audit::Audit;
use super::rejection::Rejection;
use crate::contact::body_on_skin::path::Refused;
use crate::contact::rope_on_skin::ContactWorkspace;
use crate::cost::CostPart;
use crate::model::Model;
use crate::solver::{NewtonEnd, Skin, Solved, Solver};
use crate::state::State;
use crate::trial::StepContext;

/// Most times a step is solved again with rope that came near to something that its drift would not have brought it near to.
const MOST_GATHERED: usize = 4;

/// Solves a step, again where rope met something that was not looked at.
pub(super) fn solve(
    context: &StepContext<'_>,
    solver: &mut Solver,
    mut near: Skin<'_>,
    may_touch: bool,
    audit: &mut Audit,
) -> Result<Solved, Rejection> {
    let StepContext { model, state, scheme } = *context;
    for _ in 0..MOST_GATHERED {
        if solver.ropes.touching && is_long(model, scheme.dt) && !solver.ropes.rest(model, state) {
            return Err(Rejection::RopesMeet);
        }
        let mut skin = near.as_deref_mut().filter(|_| may_touch);
        solver.begin_step(context, skin.as_deref_mut());
        let solved = solver.solve_step(context, skin);
        let solved = solved.map_err(|end| reject(end, audit))?;
        audit.passes += solved.passes as u64;
        solver.cost.enter(CostPart::Detection);
        if !solver.met_more(context, solved.moved_m) {
            audit.rope_steps += u64::from(solver.ropes.touching && !may_touch);
            end_path(state, solver, near, audit)?;
            return Ok(solved);
        }
    }
    Err(Rejection::NotConverged)
}

/// Whether a step is longer than contact allows.
fn is_long(model: &Model, dt: f64) -> bool {
    dt > model.spec.settings.contact_step_s * (1.0 + 1e-9)
}

/// Ends a step on the straight path from where it began, where that is free and leaves nothing pinched.
fn end_path(
    state: &State,
    solver: &mut Solver,
    near: Skin<'_>,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    if let Some(work) = near {
        solver.take_places();
        leave_skin(state, solver, work, audit)?;
    }
    if let Some(segments) = solver.crushed_ropes(true) {
        return Err(Rejection::RopesPinched(segments));
    }
    audit.ropes_crossed += solver.end_ropes(state).ok_or(Rejection::NotConverged)?;
    if let Some(bodies) = solver.meeting_bodies(state) {
        return Err(Rejection::BodiesMeet(bodies));
    }
    audit.bodies_crossed += solver.end_bodies(state).map_err(|refused| match refused {
        Refused::Through(body, triangle) => Rejection::BodyPinched(body, triangle),
        Refused::NotLooked => Rejection::NotConverged,
        Refused::Strayed => Rejection::Strayed,
    })?;
    solver
        .went_through(state)
        .map_or(Ok(()), |(segment, solid)| Err(Rejection::WentThrough(segment, solid)))
}

/// The same with skin.
fn leave_skin(
    state: &State,
    solver: &Solver,
    work: &mut ContactWorkspace,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    if let Some((segment, triangle)) = work.pinched(&state.rope.position) {
        return Err(Rejection::Pinched(segment, triangle));
    }
    if work.strayed(solver.places()) {
        return Err(Rejection::Strayed);
    }
    let crossings = work.near.end(&state.rope.position, solver.places());
    audit.tunnelled += crossings.ok_or(Rejection::NotConverged)?;
    Ok(())
}

/// Why a step is refused that Newton ended so.
fn reject(end: NewtonEnd, audit: &mut Audit) -> Rejection {
    match end {
        NewtonEnd::NotConverged => Rejection::NotConverged,
        NewtonEnd::NotFinite => {
            audit.non_finite += 1;
            Rejection::NotFinite
        }
        NewtonEnd::Crushed(segment, triangle) => Rejection::Pinched(segment, triangle),
        NewtonEnd::BodyCrushed(body, triangle) => Rejection::BodyPinched(body, triangle),
        NewtonEnd::BodiesCrushed(bodies) => Rejection::BodiesMeet(bodies),
        NewtonEnd::CrushedRopes(segments) => Rejection::RopesPinched(segments),
        NewtonEnd::CrowdedRopes(segments) => Rejection::RopesCrowded(segments),
        NewtonEnd::Plugin(failed) => Rejection::Plugin(failed),
    }
}
