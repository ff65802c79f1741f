//! One solver step: search for contact, balance of forces, and storage.

use super::audit::Audit;
use super::contact::solve;
use super::rejection::{Rejection, StepKind};
use super::stages::Way;
use super::workspace::Workspace;
use crate::balance::Weights;
use crate::contact::{Accepted, ContactPoint, Reports};
use crate::cost::CostPart;
use crate::model::Model;
use crate::parting;
use crate::solver::{SkinTouches, Solver};
use crate::state::State;
use crate::trial::StepContext;
use crate::trial::scheme::Scheme;

/// One solver step of length `dt`: written to `state` if it converges and parts nothing late.
pub(super) fn solver_step(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    dt: f64,
    way: Way,
) -> Result<StepKind, Rejection> {
    let unconverged = workspace.audit.unconverged;
    let done = try_solver_step(model, state, workspace, dt, way);
    // A step counts once, and only if it is accepted.
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
    let Workspace { solver, audit, contacts, body_contacts, rope_touches, balance, .. } = workspace;
    solver.cost.enter(CostPart::Detection);
    contacts.clear();
    body_contacts.clear();
    rope_touches.clear();
    solver.find_contacts(model, state, dt)?;
    let (scheme, untouched) = choose_scheme(model, state, solver, dt, way);
    let context = StepContext { model, state, scheme: &scheme };
    let solved = solve(&context, solver, audit)?;
    audit.unconverged += u64::from(solved.missed.is_none());
    solver.cost.enter(CostPart::Other);
    let is_shortest = dt * 0.5 < model.spec.settings.least_step_s;
    if !is_shortest && parting::too_late(model, state, solver.tension()) {
        return Err(Rejection::PartsTooLate);
    }
    let accepted = Accepted {
        model,
        scheme: &scheme,
        trial: &solver.trial,
        in_lanes: solver.system.in_lanes(),
    };
    let mut reports = Reports {
        rope_on_skin: &mut *contacts,
        body_on_skin: &mut *body_contacts,
        rope_on_rope: rope_touches,
    };
    solver.contacts.accept(&accepted, state, &mut reports)?;
    count_contacts(model, solver, contacts, audit);
    if model.spec.settings.balance {
        let second_stage = untouched && matches!(way, Way::SecondStage { .. });
        let context = StepContext { model, state, scheme: &scheme };
        let skin = SkinTouches { rope: contacts, bodies: body_contacts };
        let weights = Weights { h_s: 1.0 / scheme.rate, earlier: scheme.earlier, second_stage };
        balance.take(&solver.source_forces(&context, &skin), weights);
    }
    solver.store(model, &scheme, state);
    let ropes_through = solver.contacts.rope_on_rope.count_through();
    audit.ropes_through = audit.ropes_through.max(ropes_through);
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
        StepKind::InContact { missed: solved.missed.unwrap_or(1.0), passes: solved.passes }
    })
}

/// The time scheme of a solver step, and whether nothing may touch in it.
fn choose_scheme(
    model: &Model,
    state: &State,
    solver: &Solver,
    dt: f64,
    way: Way,
) -> (Scheme, bool) {
    let contacts = &solver.contacts;
    let by_rope_alone = !contacts.is_touching_besides_ropes();
    let untouched = by_rope_alone && !contacts.rope_on_rope.touching;
    let rests = untouched || by_rope_alone && contacts.rope_on_rope.rest(model, state);
    let gives_momentum = model.whale_is_towed();
    let scheme = match way {
        Way::Multistep if rests && !gives_momentum => Scheme::bdf2(dt, state.rope.earlier_dt_s),
        _ if !untouched || gives_momentum => Scheme::backward_euler(dt),
        Way::SecondStage { whole_s } => Scheme::second_stage(whole_s),
        Way::Multistep | Way::Damped | Way::FirstStage => Scheme::backward_euler(dt),
    };
    (scheme, untouched)
}

/// Counts an accepted step with rope near the whale, and its least distances.
fn count_contacts(model: &Model, solver: &Solver, contacts: &[ContactPoint], audit: &mut Audit) {
    if !solver.contacts.rope_touches_skin() || model.spec.friction.is_none() {
        return;
    }
    audit.contact_steps += 1;
    let deepest = contacts.iter().map(|contact| {
        0.5 * model.rope_of_segment(contact.segment).diameter_m - contact.distance_m
    });
    audit.max_penetration_m = deepest.fold(audit.max_penetration_m, f64::max);
    let nearest = contacts.iter().map(|contact| contact.distance_m).reduce(f64::min);
    audit.least_distance_m =
        [audit.least_distance_m, nearest].into_iter().flatten().reduce(f64::min);
}
