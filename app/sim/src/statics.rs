//! Statics: the shape and tensions at rest, before any dynamics.
//!
//! Newton on the same forces as dynamics, with velocities zero, from the model's first guess by
//! pseudo-transient continuation: the matrix carries a pseudo-mass `σM` that keeps each pass short and
//! fades. There are two ways. *Foretold*: rope is judged taut or slack by the last linear solve, whole
//! steps are taken, `σ` follows the ratio of residuals; quick, and free to swing a taut rope far. *Searched*: rope is
//! judged where it lies and each step is searched for balance; slower, and sure where much rope lies slack.
//! Where the quick way fails, rope is softened until the rig comes to rest and then stiffened stage by stage: a stiff
//! rope far from its shape answers a move of millimetres with kilonewtons, a soft one lets its weight decide.
//! Rope lies on the seabed without friction; bodies hold by their grip.
//! Reference: Kelley and Keyes 1998, Convergence analysis of pseudo-transient continuation
//! (doi:10.1137/S0036142996304796).

use crate::model::Model;
use crate::solver::{Scheme, Solver};
use crate::state::State;

/// The quick way with its passes before it gives up.
const QUICK: (Way, usize) = (Way::Foretold, 150);
/// The sure way with its passes.
const SURE: (Way, usize) = (Way::Searched, 1000);
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

/// Stiffness of the softest rope, tried in turn [N].
const SOFTEST_N: [f64; 4] = [100.0, 30.0, 300.0, 1000.0];
/// Greatest growth of stiffness from stage to stage; its root is taken where a stage does not come to rest.
const GREATEST_FACTOR: f64 = 6.0;
/// Growth below which a stage is also tried the sure way.
const NARROW: f64 = 1.3;
/// Most stages.
const MOST_STAGES: usize = 24;

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
    let start = State::start(model);
    let (mut state, mut residual_n) = attempt(model, &start, QUICK, &mut trace_n);
    for softest_n in SOFTEST_N {
        if residual_n < TOLERANCE_N {
            break;
        }
        let stiffened = stiffen(model, &start, softest_n, &mut trace_n);
        let tried = approach(model, &stiffened, &mut trace_n);
        if tried.1 < residual_n {
            (state, residual_n) = tried;
        }
    }
    Settled { state, residual_n, converged: residual_n < TOLERANCE_N, trace_n }
}

/// Softens the rope until it comes to rest, then stiffens it stage by stage, each from the last that came to rest.
fn stiffen(model: &Model, start: &State, softest_n: f64, trace_n: &mut Vec<f64>) -> State {
    let stiffest = model.spec.ropes.iter().map(|rope| rope.axial_stiffness_n).fold(0.0, f64::max);
    let (mut state, residual_n) = approach(&softened(model, softest_n), start, trace_n);
    if residual_n >= TOLERANCE_N {
        return start.clone();
    }
    let mut stiffness_n = softest_n;
    let mut factor = GREATEST_FACTOR;
    for _ in 0..MOST_STAGES {
        let next_n = stiffness_n * factor;
        if next_n >= stiffest {
            break;
        }
        let soft = softened(model, next_n);
        let (reached, residual_n) = if factor < NARROW { approach(&soft, &state, trace_n) } else { attempt(&soft, &state, QUICK, trace_n) };
        if residual_n < TOLERANCE_N {
            (state, stiffness_n) = (reached, next_n);
            factor = (factor * factor).min(GREATEST_FACTOR);
        } else {
            factor = factor.sqrt();
        }
    }
    state
}

/// The model with no rope stiffer than `stiffness_n`.
fn softened(model: &Model, stiffness_n: f64) -> Model {
    let mut soft = model.clone();
    for rope in &mut soft.spec.ropes {
        let share = (stiffness_n / rope.axial_stiffness_n).min(1.0);
        rope.axial_stiffness_n *= share;
        rope.axial_stiffening_n *= share;
    }
    soft
}

/// Tries the ways in turn from a state; the better end.
fn approach(model: &Model, from: &State, trace_n: &mut Vec<f64>) -> (State, f64) {
    let quick = attempt(model, from, QUICK, trace_n);
    if quick.1 < TOLERANCE_N {
        return quick;
    }
    let sure = attempt(model, from, SURE, trace_n);
    if sure.1 < quick.1 { sure } else { quick }
}

/// Newton from a state in one way: the state reached and its residual.
fn attempt(model: &Model, from: &State, (way, most_passes): (Way, usize), trace_n: &mut Vec<f64>) -> (State, f64) {
    let mut state = from.clone();
    let mut solver = Solver::new(model);
    let mut pseudo_mass = FIRST_PSEUDO_MASS;
    let mut scheme = Scheme::statics(pseudo_mass);
    solver.begin(model, &state, &scheme);
    let mut residual = balance(model, &state, &mut solver, &scheme, way);
    for _ in 0..most_passes {
        if residual < TOLERANCE_N {
            // What was foretold may call a segment slack that is not.
            residual = balance(model, &state, &mut solver, &scheme, Way::Searched);
        }
        trace_n.push(residual);
        if residual < TOLERANCE_N || !residual.is_finite() {
            break;
        }
        solver.solve(model);
        let longest = solver.share_past_solids(LONGEST_MOVE_M / solver.longest().max(LONGEST_MOVE_M));
        let share = if way == Way::Searched { solver.search_free(model, &state, &scheme, longest) } else { longest };
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
