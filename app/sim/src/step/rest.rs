//! Gear that stands still is held as it is until something can move it.
//!
//! Gear stands still if no node and no body is faster than [`STILL_M_S`] at the end of a step of the model, for [`STILL_S`] in a
//! row. Its mean acceleration in that time is below `2 STILL_M_S / STILL_S` = 1e-4 m/s², a hundred-thousandth of its weight. At
//! `STILL_M_S` it would move 0.6 mm in a minute. While it is held its velocities are zero, and a step of the model costs
//! the search for gear near the whale only. A balance that is not stable is held too. Of several gears, each is held apart from the
//! others (`moving.rs`).
//!
//! What can move it, and ends the hold before the step in which it does:
//!
//! | cause | noticed by |
//! |---|---|
//! | the whale comes near | the search over the path of the step of the model (`contact/near_whale.rs`) |
//! | resolution follows the whale | `remesh`, which resets the count of still steps where segments are split |
//! | a gear type cuts a line or releases a link | `parting.rs`, which resets it too |
//! | a tide, waves; an end that is driven, pulled from a time on, or on the whale; a body let go at a time | gear of such a model is never held ([`may_be_held`]) |
//!
//! Slack rope on the seabed has no part in the balance of the rest. Its nodes may move by the tolerance of force, which is a share of
//! the weight of all gear: some millimetres per second, to and fro. They count as still below [`LYING_M_S`].

use glam::DVec3;

use super::workspace::Workspace;
use crate::model::{JointKind, Model, ModelSpec};
use crate::state::State;
use crate::water::current::Tide;

/// Greatest speed of gear that stands still [m/s]; for the spin of bodies [rad/s].
const STILL_M_S: f64 = 1e-5;
/// Greatest speed of the nodes of slack rope on the seabed [m/s].
const LYING_M_S: f64 = 0.01;
/// How long gear has to stand still before it is held [s].
const STILL_S: f64 = 0.2;

/// Whether gear of a model may be held: nothing but the whale and gear types moves it.
pub(crate) fn may_be_held(spec: &ModelSpec) -> bool {
    let water = &spec.water;
    let is_moved = |kind: &JointKind| match kind {
        JointKind::Driven { .. } | JointKind::Whale(_) => true,
        JointKind::Pulled { from_s, .. } => *from_s >= 0.0,
        JointKind::Free | JointKind::Fixed | JointKind::Body { .. } => false,
    };
    spec.settings.holds_still
        && water.waves.is_none()
        && matches!(water.current.tide, Tide::Steady)
        && !spec.joints.iter().any(|joint| is_moved(&joint.kind))
        && spec.bodies.iter().all(|body| body.held_until_s.is_none())
}

/// Whether all gear has stood still long enough to be held.
pub(super) fn stands_still(model: &Model, state: &State) -> bool {
    (0..model.gears.count).all(|gear| gear_stands_still(model, state, gear))
}

/// Whether a gear has stood still long enough to be held.
pub(super) fn gear_stands_still(model: &Model, state: &State, gear: usize) -> bool {
    state.step_control.still_steps[gear] >= least_steps(model)
}

/// Steps of the model in which gear has to stand still.
fn least_steps(model: &Model) -> u32 {
    (STILL_S / model.spec.settings.step_s).ceil() as u32
}

/// Holds the gear over a step of the model. Its velocities become zero in the first such step.
pub(super) fn hold(model: &Model, state: &mut State, workspace: &mut Workspace) {
    let had_solver_step = state.rope.earlier_dt_s > 0.0;
    if had_solver_step {
        state.rest();
    }
    workspace.take_tensions(model, &state.rope.tension, true);
    workspace.audit.held_steps += 1;
}

/// Counts the steps of the model at whose end each gear stands still.
pub(super) fn count_still(model: &Model, state: &mut State, workspace: &Workspace) {
    if !model.may_be_held {
        return;
    }
    for gear in 0..model.gears.count {
        let still = touches_nothing(model, state, workspace, gear) && is_slow(model, state, gear);
        let steps = &mut state.step_control.still_steps[gear];
        *steps = if still { steps.saturating_add(1) } else { 0 };
    }
}

/// Whether a gear touches neither the whale nor rope.
fn touches_nothing(model: &Model, state: &State, workspace: &Workspace, gear: usize) -> bool {
    let gears = &model.gears;
    workspace.contacts.iter().all(|contact| gears.of_line[contact.line] != gear)
        && workspace.body_contacts.iter().all(|contact| gears.of_body[contact.body] != gear)
        && state
            .rope
            .rope_grips
            .iter()
            .all(|grip| grip.lines.iter().all(|line| gears.of_line[*line] != gear))
}

/// Whether no node and no body of a gear is faster than gear that stands still.
fn is_slow(model: &Model, state: &State, gear: usize) -> bool {
    let gears = &model.gears;
    let mut bodies = state.bodies.iter().zip(&gears.of_body);
    let mut lines = (0..).zip(&gears.of_line);
    bodies.all(|(body, of)| {
        *of != gear || is_below(body.velocity, STILL_M_S) && is_below(body.spin, STILL_M_S)
    }) && lines.all(|(line, of)| *of != gear || line_is_slow(model, state, line))
}

fn is_below(velocity: DVec3, limit: f64) -> bool {
    velocity.length_squared() <= limit * limit
}

/// Whether no node of a line is faster than gear that stands still.
fn line_is_slow(model: &Model, state: &State, line: usize) -> bool {
    let rope = &state.rope;
    let is_slack = |segment: usize| rope.tension[segment] <= 0.0;
    let is_on_seabed = |node: usize| {
        let seabed = model.spec.seabed.as_ref();
        seabed.is_some_and(|seabed| seabed.depth_of(rope.position[node]) > 0.0)
    };
    let segments = &model.line_segments[line];
    let lies_slack = |node: usize, next: usize| {
        segments.start < next
            && next < segments.end
            && is_slack(next - 1)
            && is_slack(next)
            && is_on_seabed(node)
    };
    // A segment begins at each node but the last.
    model.line_nodes[line].clone().zip(segments.start..).all(|(node, next)| {
        let velocity = rope.velocity[node];
        is_below(velocity, STILL_M_S) || is_below(velocity, LYING_M_S) && lies_slack(node, next)
    })
}
