//! One step of a run: from inputs to the next state.

use endline_sdk::Controls;

use crate::contact::ContactPoint;
use crate::model::Model;
use crate::state::State;

/// All that enters a step from outside; recorded, so that a run replays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Input {
    /// The pilot's controls.
    pub controls: Controls,
}

/// Scratch of the solver and what the last step left for readers; dropping it between two steps changes no bit.
pub struct Workspace {
    /// Places where rope pressed on skin at the end of the last step.
    pub contacts: Vec<ContactPoint>,
    /// Counters of the run so far.
    pub audit: Audit,
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

impl Workspace {
    /// Scratch for a model.
    #[must_use]
    pub fn new(_model: &Model) -> Self {
        Self { contacts: Vec::new(), audit: Audit::default() }
    }
}

/// Advances `state` by the model's step.
///
/// # Errors
/// With the part and the reason, where the run cannot go on; `state` is then as it was before the step.
pub fn step(model: &Model, _input: &Input, state: &mut State, _workspace: &mut Workspace) -> Result<(), Stop> {
    state.time_s += model.spec.settings.step_s;
    state.step += 1;
    Ok(())
}
