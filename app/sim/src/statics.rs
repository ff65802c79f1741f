//! Statics: the shape and tensions at rest, before any dynamics.
//!
//! Newton on the same forces as dynamics, with velocities zero, from the model's first guess by
//! pseudo-transient continuation: the matrix carries a pseudo-mass `σM` that keeps each pass short and
//! fades as the residual falls (`σ` follows the ratio of residuals). Rope lies on the seabed without
//! friction; bodies hold by their grip.
//! Reference: Kelley and Keyes 1998, Convergence analysis of pseudo-transient continuation
//! (doi:10.1137/S0036142996304796).

use crate::model::Model;
use crate::solver::{Scheme, Solver};
use crate::state::State;

/// Passes before statics gives up.
const MOST_PASSES: usize = 600;
/// Residual at which the rig is at rest [N].
const TOLERANCE_N: f64 = 1e-4;
/// First pseudo-mass: a free node then moves about `g/σ` in a pass [1/s²].
const FIRST_PSEUDO_MASS: f64 = 10.0;
/// Range of the pseudo-mass [1/s²].
const PSEUDO_MASS: (f64, f64) = (1e-9, 1e6);
/// Longest move of a node in one pass [m].
const LONGEST_MOVE_M: f64 = 2.0;

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
    let mut state = State::start(model);
    let mut solver = Solver::new(model);
    let mut pseudo_mass = FIRST_PSEUDO_MASS;
    let mut scheme = Scheme::statics(pseudo_mass);
    let mut trace_n: Vec<f64> = Vec::new();
    solver.begin(model, &state, &scheme);
    solver.assemble(model, &state, &scheme);
    let mut residual = solver.residual(model);
    while trace_n.len() < MOST_PASSES && residual.is_finite() {
        trace_n.push(residual);
        if residual < TOLERANCE_N {
            break;
        }
        solver.solve(model);
        let share = LONGEST_MOVE_M / solver.longest().max(LONGEST_MOVE_M);
        solver.advance(model, share);
        solver.measure_flow(model);
        solver.assemble(model, &state, &scheme);
        let next = solver.residual(model);
        pseudo_mass = (pseudo_mass * (next / residual).clamp(0.3, 2.0)).clamp(PSEUDO_MASS.0, PSEUDO_MASS.1);
        scheme = Scheme::statics(pseudo_mass);
        residual = next;
    }
    let converged = residual < TOLERANCE_N;
    if residual.is_finite() {
        solver.keep(model, &scheme, &mut state);
        state.rest();
    }
    Settled { state, residual_n: residual, converged, trace_n }
}
