//! One solver step: what may touch, the balance of forces, and what is kept of it.

use super::audit::Audit;
use super::contact::solve;
use super::rejection::{Rejection, StepKind};
use super::stages::Way;
use super::workspace::Workspace;
use crate::balance::Weights;
use crate::contact::ContactPoint;
use crate::contact::body_on_skin::BodyContact;
use crate::contact::rope_on_skin::ContactWorkspace;
use crate::cost::CostPart;
use crate::model::Model;
use crate::parting;
use crate::solver::{Skin, SkinTouches, Solver};
use crate::state::State;
use crate::trial::StepContext;
use crate::trial::scheme::Scheme;

/// One solver step of length `dt`: kept in `state` where it converges and parts nothing late.
pub(super) fn solver_step(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    dt: f64,
    way: Way,
) -> Result<StepKind, Rejection> {
    let unconverged = workspace.audit.unconverged;
    let done = try_solver_step(model, state, workspace, dt, way);
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
    way: Way,
) -> Result<StepKind, Rejection> {
    let Workspace {
        solver, contact, audit, contacts, body_contacts, rope_touches, balance, ..
    } = workspace;
    solver.cost.enter(CostPart::Detection);
    let mut near = contact.as_mut().filter(|work| !work.near.pairs.is_empty());
    let may_touch =
        near.as_mut().is_some_and(|work| look(state, work, solver.trial.hitches.span[1], dt));
    if let Some(segment) = near.as_ref().and_then(|work| work.near.crossed()) {
        return Err(Rejection::Crossed(segment));
    }
    contacts.clear();
    body_contacts.clear();
    rope_touches.clear();
    let on_skin = solver.look_at_bodies(state, dt);
    let on_body = solver.gather_body_pairs(model, state, dt);
    solver.pieces.measure_drift(state, dt);
    let on_solid = solver.gather_solids(state, dt);
    let on_rope = solver.gather_ropes(model, state, dt);
    if let Some(segments) = solver.ropes.crowded {
        return Err(Rejection::RopesCrowded(segments));
    }
    let by_rope_alone = !may_touch && !on_solid && !on_skin && !on_body;
    let untouched = by_rope_alone && !on_rope;
    let rests = untouched || by_rope_alone && solver.ropes.rest(model, state);
    let gives_momentum = near.is_some() && model.whale_is_towed();
    let scheme = match way {
        Way::Multistep if rests && !gives_momentum => Scheme::bdf2(dt, state.rope.earlier_dt_s),
        _ if !untouched || gives_momentum => Scheme::backward_euler(dt),
        Way::SecondStage { whole_s } => Scheme::second_stage(whole_s),
        Way::Multistep | Way::Damped | Way::FirstStage => Scheme::backward_euler(dt),
    };
    let context = StepContext { model, state, scheme: &scheme };
    let solved = solve(&context, solver, near.as_deref_mut(), may_touch, audit)?;
    audit.unconverged += u64::from(solved.missed.is_none());
    solver.cost.enter(CostPart::Other);
    let is_shortest = dt * 0.5 < model.spec.settings.least_step_s;
    if !is_shortest && parting::too_late(model, state, solver.tension()) {
        return Err(Rejection::PartsTooLate);
    }
    keep_contacts(model, state, near.filter(|_| may_touch), dt, Reports { contacts, audit })?;
    keep_bodies(model, state, solver, dt, body_contacts)?;
    solver.report_ropes(state, dt, rope_touches);
    if model.spec.settings.balance {
        let second_stage = untouched && matches!(way, Way::SecondStage { .. });
        let context = StepContext { model, state, scheme: &scheme };
        let skin = SkinTouches { rope: contacts, bodies: body_contacts };
        let weights = Weights { h_s: 1.0 / scheme.rate, earlier: scheme.earlier, second_stage };
        balance.take(&solver.given(&context, &skin), weights);
    }
    solver.keep(model, &scheme, state);
    audit.ropes_through = audit.ropes_through.max(solver.ropes.count_through());
    let within = state.rope.within.iter().map(|within| within.to_m - within.from_m);
    audit.rope_within_m = audit.rope_within_m.max(within.sum());
    audit.solver_steps += 1;
    audit.touching_steps += u64::from(!untouched);
    workspace.take_tensions(model, &state.rope.tension, solved.missed.is_some());
    if parting::part(model, state) {
        state.rope.earlier_dt_s = 0.0;
        return Ok(StepKind::Parted);
    }
    Ok(if untouched {
        StepKind::Free
    } else {
        StepKind::InContact { missed: solved.missed.unwrap_or(1.0) }
    })
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

/// Keeps friction and reports contacts of bodies on skin.
fn keep_bodies(
    model: &Model,
    state: &mut State,
    solver: &mut Solver,
    dt: f64,
    contacts: &mut Vec<BodyContact>,
) -> Result<(), Rejection> {
    let touching = solver.body_skin.as_deref_mut().filter(|work| work.touching);
    let (Some(work), Some(friction)) = (touching, &model.spec.friction) else {
        state.body_grips.clear();
        return Ok(());
    };
    work.keep(friction, dt, &mut state.body_grips, contacts).map_err(Rejection::Plugin)
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
    touching: Skin<'_>,
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
