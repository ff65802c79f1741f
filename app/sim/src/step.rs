//! One step of a run: from inputs to the next state.
//!
//! A step of the model (`settings.step_s`, one input) is divided into solver steps: whole while the
//! rope is free, `settings.contact_step_s` while rope is near the whale, halved where a solver step does
//! not converge or where a link would part late. Halving stops at `settings.least_step_s`, which ends the run.

use endline_sdk::Controls;

use crate::contact::ContactPoint;
use crate::model::Model;
use crate::parting::{self, Parting};
use crate::solver::{Scheme, Solver};
use crate::state::State;

/// Passes every solver step takes at least.
const LEAST_PASSES: usize = 2;
/// Passes after which a solver step counts as not converged.
const MOST_PASSES: usize = 12;
/// Move of a pass at which a solver step has converged [m].
const CONVERGED_M: f64 = 1e-3;

/// All that enters a step from outside; recorded, so that a run replays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Input {
    /// The pilot's controls.
    pub controls: Controls,
}

/// Scratch of the solver and what the last step left for readers; dropping it between two steps changes no bit.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Places where rope pressed on skin at the end of the last step.
    pub contacts: Vec<ContactPoint>,
    /// Greatest tension of each segment over the solver steps of the last step [N].
    pub peak_tension_n: Vec<f64>,
    /// Counters of the run so far.
    pub audit: Audit,
    solver: Solver,
    before: Option<State>,
}

/// What a run did that its reader should know; see `docs/physics.md`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Audit {
    /// Rope passed through skin, found by an exact test over every sub-move.
    pub tunnelled: u64,
    /// Deepest the rope's surface sank into the skin [m].
    pub max_penetration_m: f64,
    /// Numbers that were not finite.
    pub non_finite: u64,
    /// Solver steps taken.
    pub solver_steps: u64,
    /// Solver steps that had rope near the whale.
    pub contact_steps: u64,
    /// Solver steps that were redone shorter.
    pub halved: u64,
    /// Solver steps accepted above the wanted residual.
    pub unconverged: u64,
    /// Newton passes in all.
    pub passes: u64,
}

/// Why a run cannot go on.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// Time at which it stopped [s].
    pub time_s: f64,
    /// Which part, such as `line endline-top` or a plugin's id.
    pub part: String,
    /// The reason, for the user.
    pub reason: String,
}

/// Why a solver step must be redone shorter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Refused {
    NotFinite,
    NotConverged,
    PartsTooLate,
}

impl Workspace {
    /// Scratch for a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        Self {
            contacts: Vec::new(),
            peak_tension_n: vec![0.0; model.segment_count],
            audit: Audit::default(),
            solver: Solver::new(model),
            before: None,
        }
    }
}

/// Advances `state` by the model's step.
///
/// # Errors
/// With the part and the reason, where the run cannot go on; `state` is then as it was before the step.
pub fn step(model: &Model, _input: &Input, state: &mut State, workspace: &mut Workspace) -> Result<(), Stop> {
    match &mut workspace.before {
        Some(before) => before.clone_from(state),
        none => *none = Some(state.clone()),
    }
    workspace.peak_tension_n.fill(0.0);
    let settings = &model.spec.settings;
    let end = settings.step_s * (state.step + 1) as f64;
    let mut halvings = 0_u32;
    while end - state.time_s > 1e-9 * settings.step_s {
        let left = end - state.time_s;
        let longest = settings.step_s / f64::from(1_u32 << halvings.min(30));
        let dt = left / (left / longest - 1e-9).ceil().max(1.0);
        match solver_step(model, state, workspace, dt, halvings > 0) {
            Ok(()) => halvings = halvings.saturating_sub(1),
            Err(_) if 0.5 * dt >= settings.least_step_s => {
                halvings += 1;
                workspace.audit.halved += 1;
            }
            Err(why) => {
                let stop = give_up(model, state, workspace, why);
                if let Some(before) = &workspace.before {
                    state.clone_from(before);
                }
                return Err(stop);
            }
        }
    }
    state.time_s = end;
    state.step += 1;
    Ok(())
}

/// One solver step of length `dt`: kept in `state` where it converges and parts nothing late.
fn solver_step(model: &Model, state: &mut State, workspace: &mut Workspace, dt: f64, careful: bool) -> Result<(), Refused> {
    let scheme = if careful { Scheme::backward_euler(dt) } else { Scheme::bdf2(dt, state.rope.earlier_dt_s) };
    let solver = &mut workspace.solver;
    solver.begin(model, state, &scheme);
    let mut passes = 0;
    loop {
        let passed = solver.pass(model, state, &scheme);
        passes += 1;
        workspace.audit.passes += 1;
        if !passed.finite {
            workspace.audit.non_finite += 1;
            return Err(Refused::NotFinite);
        }
        if passes >= LEAST_PASSES && passed.longest_m < CONVERGED_M {
            break;
        }
        if passes >= MOST_PASSES {
            return Err(Refused::NotConverged);
        }
    }
    if dt * 0.5 >= model.spec.settings.least_step_s && parting::too_late(model, state, solver.tension()) {
        return Err(Refused::PartsTooLate);
    }
    solver.keep(model, &scheme, state);
    workspace.audit.solver_steps += 1;
    for (peak, tension) in workspace.peak_tension_n.iter_mut().zip(&state.rope.tension) {
        *peak = peak.max(*tension);
    }
    if parting::part(model, state) == Parting::Some {
        state.rope.earlier_dt_s = 0.0;
    }
    Ok(())
}

/// The reason a run ends where even the shortest step is refused.
fn give_up(model: &Model, state: &State, workspace: &Workspace, why: Refused) -> Stop {
    let part = workspace.solver.worst_line(model).map_or_else(|| "model".into(), |line| format!("line {}", model.spec.lines[line].id));
    let reason = match why {
        Refused::NotFinite => "its numbers are no longer finite at the shortest step; check stiffness, mass and current of this part",
        Refused::NotConverged => "no balance of forces was found at the shortest step; check strength and stiffness of this part",
        Refused::PartsTooLate => "it parts faster than the shortest step can follow",
    };
    Stop { time_s: state.time_s, part, reason: reason.into() }
}
