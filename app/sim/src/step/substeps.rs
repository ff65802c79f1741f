//! Divides the model's step into solver steps.
//!
//! A step of the model (`settings.step_s`, one input) is one solver step while the rope is free, or several if accuracy asks for
//! it (`step_control.rs`), each in two stages (`stages.rs`). In contact, solver steps are at most `settings.contact_step_s`.
//! Gear that stands still takes none (`rest.rs`).
//! A step that does not converge, or in which a link would part late, is repeated shorter (`substep_policy.rs`).
//! The run ends if a step of `settings.least_step_s` is rejected.

use super::Stop;
use super::moving;
use super::rejection::StepKind;
use super::rest;
use super::solver_step::solver_step;
use super::substep_policy::{AfterRejection, SubstepPolicy};
use super::workspace::Workspace;
use crate::cost::CostPart;
use crate::model::{Model, Whale};
use crate::remesh::remesh;
use crate::solver::Solver;
use crate::state::{LimitedBy, State, WhaleState};
use crate::step_control::{self, Taken};
use crate::whale::drive::EndPose;
use crate::whale::hitch;
use crate::whale::kinetic::{Times, centre_of};

/// How many times a step of the model may be undone and repeated with shorter solver steps.
const MOST_TAKEN_BACK: usize = 3;

/// Advances the gear to the end of the model's step. Of several gears, those that stand still are held.
pub(super) fn advance(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
) -> Result<(), Stop> {
    if moving::is_possible(model) {
        if workspace.choice.choose(model, state, whale) {
            return moving::advance(model, state, workspace, whale);
        }
        workspace.leave_moving(model);
    }
    advance_all(model, state, workspace, whale)
}

/// Solver steps to the end of the model's step; all are undone and repeated shorter if the error of one is far above its target.
pub(super) fn advance_all(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
) -> Result<(), Stop> {
    if model.node_count == 0 && model.spec.bodies.is_empty() {
        return Ok(()); // a whale alone: there is nothing to solve
    }
    let settings = &model.spec.settings;
    let balance = workspace.balance;
    for taken_back in 0..=MOST_TAKEN_BACK {
        workspace.begin_step();
        let remeshed = remesh(model, state, &mut workspace.remesh);
        if taken_back == 0 {
            workspace.audit.take_lengths(&remeshed);
        }
        workspace.solver.contacts.pieces.forget();
        let near = near_whale(model, state, workspace, whale);
        if !near && rest::stands_still(model, state) {
            rest::hold(model, state, workspace);
            return Ok(());
        }
        let rope_touches = state.rope.rope_grips.len();
        let policy = SubstepPolicy::new(settings, near, model.whale_is_towed(), rope_touches);
        let may_take_back = taken_back < MOST_TAKEN_BACK;
        if solver_steps(model, state, workspace, whale, policy, may_take_back)? {
            break;
        }
        workspace.audit.halved += 1;
        workspace.balance = balance;
        take_back(state, workspace);
    }
    rest::count_still(model, state, workspace);
    Ok(())
}

/// Returns to the start of the model's step, with the shorter solver step.
fn take_back(state: &mut State, workspace: &Workspace) {
    let (step_s, limit) = (state.step_control.step_s, state.step_control.limit);
    if let Some(before) = &workspace.before {
        state.clone_from(before);
    }
    (state.step_control.step_s, state.step_control.limit) = (step_s, limit);
}

/// Whether rope or a body may come near the whale in this step.
fn near_whale(
    model: &Model,
    state: &State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
) -> bool {
    let Solver { contacts, trial, cost, .. } = &mut workspace.solver;
    let Some([from, to]) = whale.filter(|_| contacts.rope_on_skin.is_some()) else { return false };
    cost.enter(CostPart::Whale);
    EndPose::take_step(&mut contacts.poses, model, [from, to]);
    trial.hitches.move_to(model, [&contacts.poses[0].bones, &contacts.poses[1].bones]);
    cost.enter(CostPart::Detection);
    let near = contacts.find_near_whale(model, state);
    cost.enter(CostPart::Other);
    near
}

/// Solver steps to the end of the model's step, shortened where one is rejected; returns `false` if the error of a step is far above
/// its target and the step of the model may be undone.
fn solver_steps(
    model: &Model,
    state: &mut State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
    mut policy: SubstepPolicy<'_>,
    may_take_back: bool,
) -> Result<bool, Stop> {
    let settings = &model.spec.settings;
    let start = settings.step_s * state.step as f64;
    let end = settings.step_s * (state.step + 1) as f64;
    let share = |time: f64| ((time - start) / settings.step_s).clamp(0.0, 1.0);
    workspace.stages.clear();
    while end - state.time_s > 1e-9 * settings.step_s {
        let left = end - state.time_s;
        let substep = policy.next(&state.step_control, left, || {
            workspace.solver.cost.enter(CostPart::Detection);
            workspace.solver.contacts.stays_clear(state, left)
        });
        let (dt, way) =
            workspace.stages.next(state, substep.length_s, substep.is_halved, !substep.by_contact);
        workspace.solver.trial.hitches.span = [share(state.time_s), share(state.time_s + dt)];
        let earlier_dt = state.rope.earlier_dt_s;
        match solver_step(model, state, workspace, dt, way) {
            Ok(kind) => {
                measure_skin(model, state, workspace, whale, dt);
                policy.accepted(&substep, dt, kind, &mut state.step_control);
                workspace.audit.limited_by[substep.limit as usize] += 1;
                let taken = workspace.stages.keep(state, way, kind, [earlier_dt, dt]);
                if taken.is_some_and(|taken| choose_next(model, state, kind, taken))
                    && may_take_back
                {
                    return Ok(false);
                }
            }
            Err(why) => {
                let contacts = &mut workspace.solver.contacts;
                contacts.reject();
                let on_ropes = contacts.rope_on_rope.touching;
                match policy.rejected(&why, dt, on_ropes, &mut state.step_control) {
                    AfterRejection::LimitByContact => {}
                    AfterRejection::Shorten => {
                        if why.calls_for_search() {
                            workspace.solver.cost.enter(CostPart::Detection);
                            let passed = share(state.time_s);
                            workspace.solver.contacts.find_near_whale_again(model, state, passed);
                        }
                        workspace.audit.halved += 1;
                    }
                    AfterRejection::End => return Err(why.stop(model, state, &workspace.solver)),
                }
            }
        }
    }
    Ok(true)
}

/// Sums over the step of the model what rope and bodies do to skin in a solver step that is accepted.
fn measure_skin(
    model: &Model,
    state: &State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
    dt: f64,
) {
    if let Some(whale) = &model.spec.whale {
        workspace.sums.take(&whale.skin, &workspace.contacts, dt);
        workspace.body_sums.take(&workspace.body_contacts, dt);
        take_mouth(whale, workspace, dt);
    }
    feel(model, state, workspace, whale, dt);
}

/// Adds the load that opens the whale's mouth in the last solver step.
fn take_mouth(whale: &Whale, workspace: &mut Workspace, dt: f64) {
    let Some(mouth) = &mut workspace.mouth else { return };
    let rope = workspace.contacts.iter().map(|contact| {
        let push = contact.normal * contact.normal_force_n;
        (contact.triangle, contact.position, -(push + contact.friction_n))
    });
    let bodies = workspace.body_contacts.iter().map(|contact| {
        let push = contact.normal * contact.normal_force_n;
        (contact.triangle, contact.position, -(push + contact.friction_n))
    });
    let bones = &workspace.solver.contacts.poses[1].bones;
    mouth.take(&whale.skin, bones, rope.chain(bodies), dt);
}

/// Adds the impulse of rope on a kinetic whale in the last solver step.
fn feel(
    model: &Model,
    state: &State,
    workspace: &mut Workspace,
    whale: Option<&[WhaleState; 2]>,
    dt: f64,
) {
    let Some(kinetic) = model.spec.whale.as_ref().and_then(|whale| whale.kinetic.as_ref()) else {
        return;
    };
    let Some([_, after]) = whale else { return };
    let centre = centre_of(kinetic, after);
    let end_s = model.spec.settings.step_s * (state.step + 1) as f64;
    let times = Times { dt, left: (end_s - state.time_s).max(0.0) };
    workspace.pulled.add_contacts(&workspace.contacts, centre, times);
    workspace.pulled.add_bodies(&workspace.body_contacts, centre, times);
    for (force, place) in hitch::pulls(model, state) {
        workspace.pulled.add(force, place - centre, times);
    }
}

/// Chooses the next step; returns whether this one should be undone.
fn choose_next(model: &Model, state: &mut State, kind: StepKind, taken: Taken) -> bool {
    if !step_control::chooses(model) {
        return false;
    }
    let settings = &model.spec.settings;
    let (restart_s, limit) = match kind {
        StepKind::Free => return step_control::choose(model, state, taken),
        StepKind::Parted => (step_control::PARTED_S, LimitedBy::Parting),
        StepKind::InContact { .. } => (settings.contact_step_s, LimitedBy::Contact),
    };
    if settings.auto_step {
        state.step_control.restart(restart_s.min(settings.step_s), limit);
    } else {
        state.step_control.restart(0.0, LimitedBy::Inputs);
    }
    false
}
