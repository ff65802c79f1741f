//! Relaxing: the slow and sure way to rest, for gear whose shape is far from the first guess.
//!
//! Two ways of passes. *Predicted*: rope is judged taut or slack by the last linear solve, whole steps are taken, the
//! pseudo-mass `σ` follows the ratio of residuals. *Searched*: rope is judged where it lies and each step is searched for
//! balance; slower, and sure where much rope lies slack. Where neither gets there, rope is softened until the gear comes
//! to rest and then stiffened stage by stage, each from the last that came to rest.

use super::newton::{Attempt, FAR, Hold, Newton, Reached, TOLERANCE_N, Way};
use super::trail::Trail;
use crate::model::Model;
use crate::state::State;

/// The quick way with its passes before it gives up.
const QUICK: (Way, usize) = (Way::Predicted, 150);
/// The sure way with its passes.
const SURE: (Way, usize) = (Way::Searched, 1000);
/// Range of its change in a pass, predicted.
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

/// Finds a state at rest for gear laid as in `laid`.
pub(super) fn relax(model: &Model, laid: &State, hold: Hold, trail: &mut Trail) -> Reached {
    let anew = Attempt { laid, guess: laid, hold, on_bodies_n_m2: None, pseudo_mass: FAR };
    let mut best = quick(model, &anew, trail);
    for softest_n in SOFTEST_N {
        if best.at_rest() || trail.is_spent() {
            break;
        }
        let stiffened = stiffen(model, &anew, softest_n, trail);
        let tried = approach(model, &Attempt { guess: &stiffened, ..anew }, trail);
        if tried.residual_n < best.residual_n {
            best = tried;
        }
    }
    best
}

/// The quick way alone.
pub(super) fn quick(model: &Model, from: &Attempt, trail: &mut Trail) -> Reached {
    attempt(model, &Attempt { pseudo_mass: FAR, ..*from }, QUICK, trail)
}

/// Softens the rope until it comes to rest, then stiffens it stage by stage, each from the last that came to rest.
fn stiffen(model: &Model, anew: &Attempt, softest_n: f64, trail: &mut Trail) -> State {
    let stiffest_n = model.spec.ropes.iter().map(|rope| rope.axial_stiffness_n).fold(0.0, f64::max);
    let softest = approach(&softened(model, softest_n), anew, trail);
    if !softest.at_rest() {
        return anew.laid.clone();
    }
    let (mut state, mut stiffness_n, mut factor) = (softest.state, softest_n, GREATEST_FACTOR);
    for _ in 0..MOST_STAGES {
        let next_n = stiffness_n * factor;
        if next_n >= stiffest_n || trail.is_spent() {
            break;
        }
        let (soft, from) = (softened(model, next_n), Attempt { guess: &state, ..*anew });
        let reached = if factor < NARROW {
            approach(&soft, &from, trail)
        } else {
            attempt(&soft, &from, QUICK, trail)
        };
        if reached.at_rest() {
            (state, stiffness_n) = (reached.state, next_n);
            factor = (factor * factor).min(GREATEST_FACTOR);
        } else {
            factor = factor.sqrt();
        }
    }
    state
}

/// The model with no rope stiffer than `stiffness_n`.
fn softened(model: &Model, stiffness_n: f64) -> Model {
    let mut soft = model.with_lines(model.spec.lines.clone());
    for rope in &mut soft.spec.ropes {
        let share = (stiffness_n / rope.axial_stiffness_n).min(1.0);
        rope.axial_stiffness_n *= share;
        rope.axial_stiffening_n *= share;
    }
    soft
}

/// Tries the ways in turn from a guess; the better end.
fn approach(model: &Model, from: &Attempt, trail: &mut Trail) -> Reached {
    let quick = attempt(model, from, QUICK, trail);
    if quick.at_rest() {
        return quick;
    }
    let sure = attempt(model, from, SURE, trail);
    if sure.residual_n < quick.residual_n { sure } else { quick }
}

/// Newton from a guess in one way.
fn attempt(
    model: &Model,
    from: &Attempt,
    (way, most_passes): (Way, usize),
    trail: &mut Trail,
) -> Reached {
    let mut newton = Newton::new(model, from);
    let mut residual_n = newton.balance(way);
    for _ in 0..most_passes {
        if residual_n < TOLERANCE_N {
            // What was predicted may call a segment slack that is not.
            residual_n = newton.balance(Way::Searched);
        }
        trail.pass(model, residual_n);
        if residual_n < TOLERANCE_N || !residual_n.is_finite() || trail.is_spent() {
            break;
        }
        newton.solve();
        let longest = newton
            .solver
            .share_past_solids(LONGEST_MOVE_M / newton.solver.longest().max(LONGEST_MOVE_M));
        let share = if way == Way::Searched { newton.line_search(longest) } else { longest };
        newton.solver.advance(model, share);
        newton.solver.measure_flow(model);
        let next_n = newton.balance(way);
        let change = match way {
            Way::Predicted => (next_n / residual_n).clamp(CHANGE.0, CHANGE.1),
            Way::Searched if share < SHORT => GROWTH,
            Way::Searched => SHRINKAGE,
        };
        newton.change_mass(change);
        residual_n = next_n;
    }
    newton.reached(residual_n)
}
