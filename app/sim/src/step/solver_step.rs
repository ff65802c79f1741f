//! One solver step: free rope in two linear solves, rope in contact by Newton.

use super::audit::Audit;
use super::contact::contact_step;
use super::context::StepContext;
use super::free::{FreeOutcome, free_step, lines_step};
use super::rejection::{Rejection, StepKind};
use super::rope::rope_step;
use super::solid::solid_step;
use super::workspace::Workspace;
use crate::contact::ContactPoint;
use crate::contact::workspace::ContactWorkspace;
use crate::model::Model;
use crate::parting;
use crate::solver::{Scheme, Solver};
use crate::state::State;

/// One solver step of length `dt`: kept in `state` where it converges and parts nothing late.
///
/// A step that was halved goes by backward Euler, which damps what did not converge.
pub(super) fn solver_step(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    dt: f64,
    was_halved: bool,
) -> Result<StepKind, Rejection> {
    let Workspace { solver, contact, audit, contacts, rope_touches, peak_tension_n, .. } =
        workspace;
    let mut touching = contact.as_mut();
    if touching.as_mut().is_none_or(|work| !gather(model, state, work, dt)) {
        touching = None;
    }
    contacts.clear();
    rope_touches.clear();
    let on_solid = solver.gather_solids(state, dt);
    let on_rope = solver.gather_ropes(model, state, dt);
    if on_rope && is_long(model, dt) {
        return Err(Rejection::RopesMeet);
    }
    let untouched = touching.is_none() && !on_solid && !on_rope;
    let scheme = if was_halved || !untouched {
        Scheme::backward_euler(dt)
    } else {
        Scheme::bdf2(dt, state.rope.earlier_dt_s)
    };
    let is_shortest = dt * 0.5 < model.spec.settings.least_step_s;
    let free = untouched && solver.suits_lanes(model);
    let context = StepContext { model, state, scheme: &scheme };
    if free && free_step(&context, solver, audit)? == FreeOutcome::Clear {
        if !is_shortest && parting::too_late(model, state, solver.tension_free()) {
            return Err(Rejection::PartsTooLate);
        }
        state.rope.friction.clear();
        solver.keep_free(model, &scheme, state);
    } else {
        solve_by_lines(&context, solver, touching.as_deref_mut(), audit)?;
        if !is_shortest && parting::too_late(model, state, solver.tension()) {
            return Err(Rejection::PartsTooLate);
        }
        keep_contacts(model, state, touching, dt, Reports { contacts, audit })?;
        solver.report_ropes(state, rope_touches);
        solver.keep(model, &scheme, state);
    }
    audit.ropes_crossed += solver.ropes.crossings;
    audit.ropes_through = audit.ropes_through.max(solver.ropes.count_through());
    audit.solver_steps += 1;
    for (peak, tension) in peak_tension_n.iter_mut().zip(&state.rope.tension) {
        *peak = peak.max(*tension);
    }
    if parting::part(model, state) {
        state.rope.earlier_dt_s = 0.0;
        return Ok(StepKind::Parted);
    }
    Ok(if untouched { StepKind::Free } else { StepKind::InContact })
}

/// Gathers rope near the whale for a solver step; whether there is any.
fn gather(model: &Model, state: &State, work: &mut ContactWorkspace, dt: f64) -> bool {
    let [start, end] = &work.bones;
    work.near.begin(
        model,
        [start, end],
        &state.rope.position,
        |node| state.rope.velocity[node] * dt,
        &state.rope.cut,
    )
}

/// Whether a step is longer than contact allows.
fn is_long(model: &Model, dt: f64) -> bool {
    dt > model.spec.settings.contact_step_s * (1.0 + 1e-9)
}

/// Solves a step with rope near the whale, rope, obstacles or bodies, line after line.
fn solve_by_lines(
    context: &StepContext<'_>,
    solver: &mut Solver,
    touching: Option<&mut ContactWorkspace>,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    let StepContext { model, state, scheme } = *context;
    solver.begin(model, state, scheme);
    if let Some(work) = touching {
        return contact_step(context, solver, work, audit);
    }
    if solver.ropes.touching {
        return rope_step(context, solver, audit);
    }
    if solver.solid.pairs.is_empty() {
        lines_step(context, solver, audit)?;
    } else {
        solid_step(context, solver, audit)?;
    }
    if !solver.met_ropes(model, state) {
        return Ok(());
    }
    if is_long(model, scheme.dt) {
        return Err(Rejection::RopesMeet);
    }
    solver.begin(model, state, scheme);
    rope_step(context, solver, audit)
}

/// Where a solver step reports what touched.
struct Reports<'a> {
    contacts: &'a mut Vec<ContactPoint>,
    audit: &'a mut Audit,
}

/// Keeps friction and reports contacts of an accepted step.
fn keep_contacts(
    model: &Model,
    state: &mut State,
    touching: Option<&mut ContactWorkspace>,
    dt: f64,
    Reports { contacts, audit }: Reports<'_>,
) -> Result<(), Rejection> {
    let (Some(work), Some(friction)) = (touching, &model.spec.friction) else {
        state.rope.friction.clear();
        return Ok(());
    };
    work.keep(model, friction, dt, state, contacts).map_err(Rejection::Plugin)?;
    audit.contact_steps += 1;
    let deepest = contacts.iter().map(|contact| {
        0.5 * model.rope_of_segment(contact.segment).diameter_m - contact.distance_m
    });
    audit.max_penetration_m = deepest.fold(audit.max_penetration_m, f64::max);
    let nearest = contacts.iter().map(|contact| contact.distance_m).reduce(f64::min);
    audit.least_distance_m =
        [audit.least_distance_m, nearest].into_iter().flatten().reduce(f64::min);
    Ok(())
}
