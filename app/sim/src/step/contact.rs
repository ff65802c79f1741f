//! A solver step with rope near the whale.
//!
//! With contact (docs/physics.md): skin makes its move and rope drifts on, held off the skin; where that would
//! cross, rope near skin is carried along with it instead, as far as nothing crosses. Then Newton finds the balance
//! at that pose of the skin; where the skin could not make its whole move at once, both are repeated.

use super::audit::Audit;
use super::context::StepContext;
use super::convergence::CONTACT_CONVERGED_M;
use super::rejection::Rejection;
use crate::contact::barrier::PINCHED_SHARE;
use crate::contact::workspace::ContactWorkspace;
use crate::cost::CostPart;
use crate::solver::{CONTACT_WANTED_M, ContactEnd, Solver};
use crate::state::State;

/// Times the skin may be stopped within a solver step.
const MOST_STAGES: usize = 8;
/// Rope that begins a step pinched may end it this much nearer to skin, as a share.
const STILL_PINCHED: f64 = 0.99;

/// A short solver step with rope near the whale, solved by whole passes; how much of what Newton is allowed it missed by.
pub(super) fn short_contact_step(
    context: &StepContext<'_>,
    solver: &mut Solver,
    work: &mut ContactWorkspace,
    audit: &mut Audit,
) -> Result<f64, Rejection> {
    let StepContext { model, state, scheme } = *context;
    solver.begin_short(model, state, scheme, work);
    let converged = match solver.solve_short(model, state, scheme, work) {
        Ok(converged) => converged,
        Err(end) => {
            accept(end, audit)?;
            return Err(Rejection::NotConverged);
        }
    };
    audit.passes += converged.passes as u64;
    if work.nearer_than(PINCHED_SHARE).is_some() {
        return Err(Rejection::NotConverged);
    }
    end_path(state, solver, work, audit)?;
    Ok(converged.missed)
}

/// Ends a step on the straight path from where it began, where that is free.
pub(super) fn end_path(
    state: &State,
    solver: &mut Solver,
    work: &mut ContactWorkspace,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    let outer = solver.cost.enter(CostPart::Detection);
    if work.strayed(solver.places()) {
        return Err(Rejection::Strayed);
    }
    let crossings = work.near.end(&state.rope.position, solver.places());
    audit.tunnelled += crossings.ok_or(Rejection::NotConverged)?;
    solver.cost.enter(outer);
    Ok(())
}

/// Newton with rope near the whale: the skin is moved as far as nothing crosses, and rope is solved at that pose, until
/// the skin has made its whole move.
pub(super) fn contact_step(
    context: &StepContext<'_>,
    solver: &mut Solver,
    work: &mut ContactWorkspace,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    let StepContext { model, state, scheme } = *context;
    work.points.list.clear();
    solver.set_out(state);
    solver.ropes.begin();
    let mut pinched = PINCHED_SHARE;
    for stage in 0..MOST_STAGES {
        solver.cost.enter(CostPart::Detection);
        work.near.measure(solver.places());
        if let Some(segment) = work.near.crossed() {
            return Err(Rejection::Crossed(segment));
        }
        if stage == 0 {
            // Rope that lies there already may stay, and come out again.
            pinched = pinched.min(STILL_PINCHED * work.near.least_share());
        }
        audit.tunnelled += solver.carry(model, work);
        solver.cost.enter(CostPart::Contact);
        solver.open_ropes(state);
        accept(solver.solve_contact(model, state, scheme, work), audit)?;
        if let Some((segment, triangle)) = work.nearer_than(pinched) {
            return Err(Rejection::Pinched(segment, triangle));
        }
        if let Some(segments) = solver.crushed_ropes(true) {
            return Err(Rejection::RopesPinched(segments));
        }
        if work.near.fraction >= work.near.goal - 1e-12 {
            return if solver.met_more_ropes(model, state) {
                Err(Rejection::NotConverged)
            } else {
                Ok(())
            };
        }
    }
    Err(Rejection::NotConverged)
}

/// Counts what Newton at one pose of the skin did, or rejects the step.
fn accept(end: ContactEnd, audit: &mut Audit) -> Result<(), Rejection> {
    match end {
        ContactEnd::Ended { last_m, passes, crossings } => {
            audit.passes += passes as u64;
            audit.tunnelled += crossings;
            if last_m > CONTACT_CONVERGED_M {
                return Err(Rejection::NotConverged);
            }
            audit.unconverged += u64::from(last_m > CONTACT_WANTED_M);
            Ok(())
        }
        ContactEnd::NotFinite => {
            audit.non_finite += 1;
            Err(Rejection::NotFinite)
        }
        ContactEnd::TooFar => Err(Rejection::Strayed),
        ContactEnd::Crushed(segment, triangle) => Err(Rejection::Pinched(segment, triangle)),
        ContactEnd::CrushedRopes(segments) => Err(Rejection::RopesPinched(segments)),
        ContactEnd::Plugin(failed) => Err(Rejection::Plugin(failed)),
    }
}
