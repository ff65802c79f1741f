//! Statics: the shape and tensions at rest, before any dynamics.
//!
//! Newton on the same forces as dynamics, with velocities zero, from the model's first guess by
//! pseudo-transient continuation: the matrix carries a pseudo-mass `σM` that keeps each pass short and
//! fades. Two ways are tried in turn. *Foretold*: rope is judged taut or slack by the last linear solve, whole
//! steps are taken, `σ` follows the ratio of residuals; quick, and free to swing a taut rope far. *Searched*: rope is
//! judged where it lies and each step is searched for balance; slower, and sure where much rope lies slack.
//! Rope lies on the seabed without friction; bodies hold by their grip.
//! Reference: Kelley and Keyes 1998, Convergence analysis of pseudo-transient continuation
//! (doi:10.1137/S0036142996304796).

use crate::model::Model;
use crate::solver::{Scheme, Solver};
use crate::state::State;

/// Passes before each way gives up.
const MOST_PASSES: [(Way, usize); 2] = [(Way::Foretold, 250), (Way::Searched, 800)];
/// Residual at which the rig is at rest [N].
const TOLERANCE_N: f64 = 1e-4;
/// First pseudo-mass: a free node then moves about `g/σ` in a pass [1/s²].
const FIRST_PSEUDO_MASS: f64 = 10.0;
/// Range of the pseudo-mass [1/s²].
const PSEUDO_MASS: (f64, f64) = (1e-9, 1e6);
/// Range of its change in a pass, foretold.
const CHANGE: (f64, f64) = (0.3, 2.0);
/// Share of a step below which it grows, searched, by the first factor; else it shrinks by the second.
const SHORT: f64 = 0.3;
const GROWTH: f64 = 3.0;
const SHRINKAGE: f64 = 0.3;
/// Longest move of a node in one pass [m].
const LONGEST_MOVE_M: f64 = 2.0;

/// How a pass is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    Foretold,
    Searched,
}

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
    let mut trace_n = Vec::new();
    let mut settled = None;
    for (way, most_passes) in MOST_PASSES {
        let tried = attempt(model, way, most_passes, &mut trace_n);
        if tried.1 < TOLERANCE_N {
            settled = Some(tried);
            break;
        }
        settled = Some(match settled {
            Some(best) if best.1 < tried.1 => best,
            _ => tried,
        });
    }
    let (state, residual_n) = settled.unwrap_or_else(|| (State::start(model), f64::INFINITY));
    Settled { state, residual_n, converged: residual_n < TOLERANCE_N, trace_n }
}

/// Newton from the first guess in one way: the state reached and its residual.
fn attempt(model: &Model, way: Way, most_passes: usize, trace_n: &mut Vec<f64>) -> (State, f64) {
    let mut state = State::start(model);
    let mut solver = Solver::new(model);
    let mut pseudo_mass = FIRST_PSEUDO_MASS;
    let mut scheme = Scheme::statics(pseudo_mass);
    solver.begin(model, &state, &scheme);
    let mut residual = balance(model, &state, &mut solver, &scheme, way);
    for _ in 0..most_passes {
        trace_n.push(residual);
        if residual < TOLERANCE_N || !residual.is_finite() {
            break;
        }
        solver.solve(model);
        let longest = LONGEST_MOVE_M / solver.longest().max(LONGEST_MOVE_M);
        let share = if way == Way::Searched { solver.search_free(model, &scheme, longest) } else { longest };
        solver.advance(model, share);
        solver.measure_flow(model);
        let next = balance(model, &state, &mut solver, &scheme, way);
        let change = match way {
            Way::Foretold => (next / residual).clamp(CHANGE.0, CHANGE.1),
            Way::Searched if share < SHORT => GROWTH,
            Way::Searched => SHRINKAGE,
        };
        pseudo_mass = (pseudo_mass * change).clamp(PSEUDO_MASS.0, PSEUDO_MASS.1);
        scheme = Scheme::statics(pseudo_mass);
        residual = next;
    }
    if residual.is_finite() {
        solver.keep(model, &scheme, &mut state);
        state.rest();
    }
    (state, residual)
}

/// Assembles forces and matrix at the trial places; the residual.
fn balance(model: &Model, state: &State, solver: &mut Solver, scheme: &Scheme, way: Way) -> f64 {
    match way {
        Way::Foretold => solver.assemble(model, state, scheme),
        Way::Searched => solver.assemble_searchable(model, state, scheme),
    }
    solver.residual(model)
}
