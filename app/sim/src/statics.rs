//! Statics: the shape and tensions at rest, before any dynamics.
//!
//! Newton on the same forces as dynamics, with velocities zero, from the model's first guess. Two ways are
//! tried in turn. *Newton* with pseudo-transient continuation: the matrix carries a pseudo-mass `σM` that keeps each
//! pass short and follows the ratio of residuals; quick. *Relaxing*: backward Euler steps in water, each from
//! standing still, as long as they converge and longer each time, until they are so long that inertia and drag are
//! nothing; slower, and sure where much rope lies slack or the current is weak.
//! Rope lies on the seabed without friction; bodies hold by their grip.
//! Reference: Kelley and Keyes 1998, Convergence analysis of pseudo-transient continuation
//! (doi:10.1137/S0036142996304796).

use crate::model::Model;
use crate::solver::{Scheme, Solver};
use crate::state::State;

/// Passes before Newton gives up.
const NEWTON_PASSES: usize = 250;
/// Residual at which the rig is at rest [N].
const TOLERANCE_N: f64 = 1e-4;
/// First pseudo-mass: a free node then moves about `g/σ` in a pass [1/s²].
const FIRST_PSEUDO_MASS: f64 = 10.0;
/// Range of the pseudo-mass [1/s²].
const PSEUDO_MASS: (f64, f64) = (1e-9, 1e6);
/// Range of its change in a pass.
const CHANGE: (f64, f64) = (0.3, 2.0);
/// Longest move of a node in one pass [m].
const LONGEST_MOVE_M: f64 = 2.0;
/// Steps before relaxing gives up.
const RELAXING_STEPS: usize = 400;
/// Passes before a relaxing step is made shorter.
const RELAXING_PASSES: usize = 12;
/// First and longest relaxing step [s].
const RELAXING_STEP_S: (f64, f64) = (0.05, 1e7);
/// Growth of the step after one that converged, and its cut after one that did not.
const GROWTH: f64 = 1.5;
const CUT: f64 = 0.25;
/// Move of a pass at which a relaxing step has converged [m].
const CONVERGED_M: f64 = 1e-4;

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
    let mut best = newton(model, &mut trace_n);
    if best.1 >= TOLERANCE_N {
        let relaxed = relax(model, &mut trace_n);
        if relaxed.1 < best.1 || !best.1.is_finite() {
            best = relaxed;
        }
    }
    let (state, residual_n) = best;
    Settled { state, residual_n, converged: residual_n < TOLERANCE_N, trace_n }
}

/// Newton with a pseudo-mass from the first guess: the state reached and its residual.
fn newton(model: &Model, trace_n: &mut Vec<f64>) -> (State, f64) {
    let mut state = State::start(model);
    let mut solver = Solver::new(model);
    let mut pseudo_mass = FIRST_PSEUDO_MASS;
    let mut scheme = Scheme::statics(pseudo_mass);
    solver.begin(model, &state, &scheme);
    solver.assemble(model, &state, &scheme);
    let mut residual = solver.residual(model);
    for _ in 0..NEWTON_PASSES {
        trace_n.push(residual);
        if residual < TOLERANCE_N || !residual.is_finite() {
            break;
        }
        solver.solve(model);
        solver.advance(model, LONGEST_MOVE_M / solver.longest().max(LONGEST_MOVE_M));
        solver.measure_flow(model);
        solver.assemble(model, &state, &scheme);
        let next = solver.residual(model);
        pseudo_mass = (pseudo_mass * (next / residual).clamp(CHANGE.0, CHANGE.1)).clamp(PSEUDO_MASS.0, PSEUDO_MASS.1);
        scheme = Scheme::statics(pseudo_mass);
        residual = next;
    }
    if residual.is_finite() {
        solver.keep(model, &scheme, &mut state);
        state.rest();
    }
    (state, residual)
}

/// Ever longer steps from standing still: the state reached and its residual.
fn relax(model: &Model, trace_n: &mut Vec<f64>) -> (State, f64) {
    let mut state = State::start(model);
    let mut solver = Solver::new(model);
    let mut dt = RELAXING_STEP_S.0;
    let mut residual = f64::INFINITY;
    for _ in 0..RELAXING_STEPS {
        let scheme = Scheme::relaxing(dt);
        if relaxing_step(model, &state, &mut solver, &scheme) {
            solver.keep(model, &scheme, &mut state);
            state.rest();
            residual = residual_at(model, &state, &mut solver);
            trace_n.push(residual);
            dt = (dt * GROWTH).min(RELAXING_STEP_S.1);
        } else {
            dt *= CUT;
        }
        if residual < TOLERANCE_N {
            break;
        }
    }
    (state, residual)
}

/// One relaxing step; whether it converged.
fn relaxing_step(model: &Model, state: &State, solver: &mut Solver, scheme: &Scheme) -> bool {
    solver.begin(model, state, scheme);
    for _ in 0..RELAXING_PASSES {
        let passed = solver.pass(model, state, scheme);
        if !passed.finite {
            return false;
        }
        if passed.longest_m < CONVERGED_M && solver.pull_is_settled(model, scheme) {
            return true;
        }
    }
    false
}

/// Greatest force out of balance in a state at rest [N].
fn residual_at(model: &Model, state: &State, solver: &mut Solver) -> f64 {
    let scheme = Scheme::statics(FIRST_PSEUDO_MASS);
    solver.begin(model, state, &scheme);
    solver.assemble_searchable(model, state, &scheme);
    solver.residual(model)
}
