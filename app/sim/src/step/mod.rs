//! One step of a run: from inputs to the next state.

use crate::cost::CostPart;
use crate::gear_hook;
use crate::model::Model;
use crate::state::{State, WhaleState};
use crate::whale::drive::{DriveScratch, drive};
use crate::whale::jaws::MouthLoad;
use crate::whale::pilot;
use endline_sdk::Controls;

pub mod audit;
mod contact;
mod moving;
pub mod peaks;
mod rejection;
pub(crate) mod rest;
mod solver_step;
mod stages;
mod substep_policy;
mod substeps;
pub mod workspace;

pub use audit::Audit;
pub use workspace::Workspace;

/// Advances `state` by the model's step.
/// Errors: with the part and the reason, if the run cannot continue; `state` is then as it was before the step.
pub fn step(
    model: &Model,
    input: &Input,
    state: &mut State,
    workspace: &mut Workspace,
) -> Result<(), Stop> {
    workspace.solver.cost.begin();
    if model.spec.settings.balance {
        workspace.balance.begin(model, state);
    }
    let balance = workspace.balance;
    match &mut workspace.before {
        Some(before) => before.clone_from(state),
        none => *none = Some(state.clone()),
    }
    let done = try_step(model, input, state, workspace);
    if let (Err(_), Some(before)) = (&done, &workspace.before) {
        state.clone_from(before);
        workspace.balance = balance;
    }
    workspace.solver.cost.end();
    done
}

fn try_step(
    model: &Model,
    input: &Input,
    state: &mut State,
    workspace: &mut Workspace,
) -> Result<(), Stop> {
    let mut whale = workspace.whale.take();
    workspace.solver.cost.enter(CostPart::Whale);
    let moved = move_whale(model, input, state, (&mut whale, &mut workspace.drive));
    workspace.solver.cost.enter(CostPart::Other);
    let done = moved.and_then(|held| {
        workspace.audit.postures_held += u64::from(held);
        substeps::advance(model, state, workspace, whale.as_deref())
    });
    workspace.solver.cost.enter(CostPart::Other);
    if let (Some(now), Some([_, after])) = (&mut state.whale, whale.as_deref_mut()) {
        if let Some(whale) = &model.spec.whale {
            [after.contact_force_n, after.contact_port_m] = workspace.sums.by_part();
            after.mouth_moment_n_m = workspace.mouth.as_ref().map_or([0.0; 3], MouthLoad::mean_n_m);
            if let Some(kinetic) = &whale.kinetic {
                workspace.pulled.apply(kinetic, model.spec.settings.step_s, after);
                workspace.balance.take_whale(workspace.pulled.impulse());
            }
        }
        now.clone_from(after);
    }
    workspace.whale = whale;
    done?;
    state.time_s = model.spec.settings.step_s * (state.step + 1) as f64;
    state.step += 1;
    gear_hook::act(model, state, &mut workspace.gear)?;
    workspace.solver.cost.enter(CostPart::Whale);
    pilot::poll(model, state);
    Ok(())
}

/// Lets the whale swim through the step: where it starts and where it ends; whether its posture was held.
fn move_whale(
    model: &Model,
    input: &Input,
    state: &State,
    (whale, scratch): (&mut Option<Box<[WhaleState; 2]>>, &mut DriveScratch),
) -> Result<bool, Stop> {
    let Some(now) = &state.whale else {
        *whale = None;
        return Ok(false);
    };
    let [from, to] = &mut **whale.get_or_insert_with(|| Box::new([now.clone(), now.clone()]));
    from.clone_from(now);
    drive(model, input, from, state.time_s, to, scratch)
}

/// All that enters a step from outside; recorded, so that a run replays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Input {
    /// The pilot's controls.
    pub controls: Controls,
}

/// Why a run cannot continue.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// Time at which it stopped [s].
    pub time_s: f64,
    /// Which part, such as `line endline-top` or a plugin's id.
    pub part: String,
    /// The reason, for the user.
    pub reason: String,
}
