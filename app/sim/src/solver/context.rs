//! What every part of a solver step reads.

use super::scheme::Scheme;
use crate::model::Model;
use crate::state::State;

/// The model, the state at the start of a solver step, and the scheme that integrates over it.
#[derive(Clone, Copy)]
pub(crate) struct StepContext<'a> {
    /// The model.
    pub model: &'a Model,
    /// The state at the start of the solver step.
    pub state: &'a State,
    /// The scheme of the solver step.
    pub scheme: &'a Scheme,
}
