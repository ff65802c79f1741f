//! Statics: the shape and tensions at rest, before any dynamics.

use crate::model::Model;
use crate::state::State;

/// A rig at rest.
#[derive(Clone, Debug)]
pub struct Settled {
    /// The state to start dynamics from.
    pub state: State,
    /// Greatest force out of balance at any node or body [N].
    pub residual_n: f64,
    /// Whether the residual came below the tolerance.
    pub converged: bool,
    /// Residual after each pass [N].
    pub trace_n: Vec<f64>,
}

/// Finds the state at rest under the model's current.
#[must_use]
pub fn settle(model: &Model) -> Settled {
    Settled { state: State::start(model), residual_n: f64::INFINITY, converged: false, trace_n: Vec::new() }
}
