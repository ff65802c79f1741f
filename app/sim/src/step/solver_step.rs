//! One solver step: free rope in two linear solves, rope in contact by Newton.

use super::audit::Audit;
use super::contact::{contact_step, end_path, short_contact_step};
use super::context::StepContext;
use super::free::{FreeOutcome, free_step, lines_step};
use super::rejection::{Rejection, StepKind};
use super::rope::rope_step;
use super::solid::solid_step;
use super::workspace::Workspace;
use crate::contact::ContactPoint;
use crate::contact::workspace::ContactWorkspace;
use crate::cost::CostPart;
use crate::model::Model;
use crate::parting;
use crate::solver::{Scheme, Solver};
use crate::state::State;

/// Step up to which Newton with contact searches along every pass [s].
const SHORT_S: f64 = 1.3e-4;
/// What such a step counts as having missed of what is allowed.
const SEARCHED_MISSED: f64 = 0.2;

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
    let unconverged = workspace.audit.unconverged;
    let done = try_solver_step(model, state, workspace, dt, was_halved);
    // A step counts once however many poses it was solved at, and only where it is kept.
    let missed = done.is_ok() && workspace.audit.unconverged > unconverged;
    let audit = &mut workspace.audit;
    audit.unconverged = unconverged + u64::from(missed);
    let parted = done == Ok(StepKind::Parted);
    audit.unconverged_parted += u64::from(missed && parted);
    done
}

fn try_solver_step(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    dt: f64,
    was_halved: bool,
) -> Result<StepKind, Rejection> {
    let unconverged = workspace.audit.unconverged;
    let Workspace { solver, contact, audit, contacts, rope_touches, .. } = workspace;
    solver.cost.enter(CostPart::Detection);
    let mut near = contact.as_mut().filter(|work| !work.near.pairs.is_empty());
    let may_touch =
        near.as_mut().is_some_and(|work| look(state, work, solver.trial.hitches.span[1], dt));
    contacts.clear();
    rope_touches.clear();
    let on_solid = solver.gather_solids(state, dt);
    let on_rope = solver.gather_ropes(model, state, dt);
    if on_rope && is_long(model, dt) {
        return Err(Rejection::RopesMeet);
    }
    let untouched = !may_touch && !on_solid && !on_rope;
    let gives_momentum = near.is_some() && model.whale_is_kinetic();
    let scheme = if was_halved || !untouched || gives_momentum {
        Scheme::backward_euler(dt)
    } else {
        Scheme::bdf2(dt, state.rope.earlier_dt_s)
    };
    let is_shortest = dt * 0.5 < model.spec.settings.least_step_s;
    let free = untouched && solver.suits_lanes(model);
    let context = StepContext { model, state, scheme: &scheme };
    let mut missed = 0.0;
    let solve = if untouched { CostPart::FreeRope } else { CostPart::Contact };
    solver.cost.enter(solve);
    if free && free_step(&context, solver, audit)? == FreeOutcome::Clear {
        if let Some(work) = near.as_deref_mut() {
            solver.take_places();
            end_path(state, solver, work, audit)?;
        }
    } else {
        // Rope that met something on its way is solved again with that.
        solver.cost.enter(if free { CostPart::Contact } else { solve });
        missed = solve_by_lines(&context, solver, (near.as_deref_mut(), may_touch), audit)?;
    }
    solver.cost.enter(solve);
    if !is_shortest && parting::too_late(model, state, solver.tension()) {
        return Err(Rejection::PartsTooLate);
    }
    keep_contacts(model, state, near.filter(|_| may_touch), dt, Reports { contacts, audit })?;
    solver.report_ropes(state, rope_touches);
    solver.keep(model, &scheme, state);
    audit.ropes_crossed += solver.ropes.crossings;
    audit.ropes_through = audit.ropes_through.max(solver.ropes.count_through());
    audit.solver_steps += 1;
    audit.touching_steps += u64::from(!untouched);
    let converged = audit.unconverged == unconverged;
    workspace.take_tensions(model, &state.rope.tension, converged);
    if parting::part(model, state) {
        state.rope.earlier_dt_s = 0.0;
        return Ok(StepKind::Parted);
    }
    Ok(if untouched { StepKind::Free } else { StepKind::InContact { missed } })
}

/// Looks for what may touch skin in a solver step that ends at a share of the model's step, by the velocities of rope; whether
/// anything may.
pub(super) fn look(state: &State, work: &mut ContactWorkspace, goal: f64, dt: f64) -> bool {
    let rope = &state.rope;
    work.target.clear();
    work.target.extend(
        rope.position.iter().zip(&rope.velocity).map(|(place, velocity)| *place + *velocity * dt),
    );
    work.near.look(&rope.position, &work.target, goal);
    work.near.may_touch()
}

/// Whether a step is longer than contact allows.
fn is_long(model: &Model, dt: f64) -> bool {
    dt > model.spec.settings.contact_step_s * (1.0 + 1e-9)
}

/// Solves a step with rope near the whale, rope, obstacles or bodies, line after line; how much of what Newton is allowed in a
/// short step it missed by.
fn solve_by_lines(
    context: &StepContext<'_>,
    solver: &mut Solver,
    (near, may_touch): (Option<&mut ContactWorkspace>, bool),
    audit: &mut Audit,
) -> Result<f64, Rejection> {
    let StepContext { model, state, scheme } = *context;
    match near {
        Some(work) if may_touch => {
            if scheme.dt > SHORT_S && model.spec.settings.swept && !solver.ropes.touching {
                return short_contact_step(context, solver, work, audit);
            }
            solver.begin(model, state, scheme);
            contact_step(context, solver, work, audit).map(|()| SEARCHED_MISSED)
        }
        Some(work) => {
            solve_untouched(context, solver, audit)?;
            end_path(state, solver, work, audit)?;
            Ok(0.0)
        }
        None => solve_untouched(context, solver, audit).map(|()| 0.0),
    }
}

/// Solves a step with rope near rope, obstacles or bodies, and none on skin.
fn solve_untouched(
    context: &StepContext<'_>,
    solver: &mut Solver,
    audit: &mut Audit,
) -> Result<(), Rejection> {
    let StepContext { model, state, scheme } = *context;
    solver.begin(model, state, scheme);
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
