//! Continuation in current and in stiffness, for gear that does not converge from the initial guess.
//!
//! A family of problems `F(x, λ) = 0` [N] leads from one that converges to the actual one at `λ = 1`; each solution is the
//! guess for the next. In *current*, `λ` is a share of it: the gear is settled in a weaker current first. Where a solution
//! fails, it most often fails at one velocity and converges 1 % beside it. In *stiffness*, `λ` is a share of the axial
//! stiffness of rope: it is decreased until the gear converges, then increased in stages, each from the last that converged.
//! Two kinds of passes are used. With *predicted* passes, the last linear solution determines which rope is taut, steps are not
//! shortened, and the pseudo-mass follows the ratio of residuals. With *searched* passes, the actual position determines it,
//! and a line search shortens each step; they are slower, but converge where much rope is slack.
//! Reference: Allgower and Georg 2003, Introduction to Numerical Continuation Methods, chapter 2.

use glam::DVec3;

use super::newton::{
    Attempt, FAR, Hold, IterationLog, NEAR, Newton, PassKind, Reached, TOLERANCE_N,
};
use super::strategy::REFINED;
use super::{Found, Outcome, find, strategy};
use crate::model::Model;
use crate::state::State;

/// Shares of the current, tried in turn.
const SHARES: [f64; 4] = [0.99, 0.97, 0.9, 0.75];

/// Gear at rest, reached from a weaker current; `None` without current or without convergence.
pub(super) fn continue_in_current(model: &Model, log: &mut IterationLog) -> Option<Found> {
    if model.spec.water.current.surface_m_s == DVec3::ZERO {
        return None;
    }
    SHARES.iter().find_map(|share| from_share(model, *share, log))
}

/// Settles the gear in a share of the current, then in the whole.
fn from_share(model: &Model, share: f64, log: &mut IterationLog) -> Option<Found> {
    let mut own = IterationLog::short();
    let found = find(&model.with_current_times(share), &mut own);
    let [first, held, guess] =
        [&found.first, &found.held, &found.end.state].map(|state| carried(model, state));
    let end = (found.outcome == Outcome::AtRest).then(|| {
        let attempt = Attempt {
            laid: &held,
            guess: &guess,
            hold: Hold::Released,
            on_bodies_n_m2: None,
            pseudo_mass: NEAR,
        };
        strategy::try_all(&REFINED, model, &attempt, &mut own)
    });
    log.add(own);
    let end = end.filter(|end| end.at_rest())?;
    Some(Found { first, held, end, outcome: Outcome::AtRest })
}

/// Transfers a state of the gear alone to the complete model.
fn carried(model: &Model, state: &State) -> State {
    State { rope: state.rope.clone(), bodies: state.bodies.clone(), ..State::start(model) }
}

/// Predicted passes and their greatest number.
const PREDICTED: (PassKind, usize) = (PassKind::Predicted, 150);

/// Searched passes and their greatest number.
const SEARCHED: (PassKind, usize) = (PassKind::Searched, 1000);

/// Range of the factor of the pseudo-mass in a predicted pass.
const CHANGE: (f64, f64) = (0.3, 2.0);

/// Share of a searched step below which the pseudo-mass grows by `GROWTH`; otherwise it shrinks by `SHRINKAGE`.
const SHORT: f64 = 0.3;

const GROWTH: f64 = 3.0;

const SHRINKAGE: f64 = 0.3;

/// Longest move of a node in one pass [m].
const LONGEST_MOVE_M: f64 = 2.0;

/// Initial stiffnesses, tried in turn [N].
const SOFTEST_N: [f64; 4] = [100.0, 30.0, 300.0, 1000.0];

/// Greatest ratio of stiffnesses of consecutive stages; its square root is used after a stage that does not converge.
const GREATEST_FACTOR: f64 = 6.0;

/// Ratio below which a stage is also tried with searched passes.
const NARROW: f64 = 1.3;

/// Greatest number of stages.
const MOST_STAGES: usize = 24;

/// Solves by continuation in stiffness from the state `laid`.
pub(super) fn continue_in_stiffness(
    model: &Model,
    laid: &State,
    hold: Hold,
    log: &mut IterationLog,
) -> Reached {
    let start = Attempt { laid, guess: laid, hold, on_bodies_n_m2: None, pseudo_mass: FAR };
    let mut best = newton_by_residual(model, &start, log);
    for softest_n in SOFTEST_N {
        if best.at_rest() || log.is_spent() {
            break;
        }
        let stiffened = stiffen(model, &start, softest_n, log);
        let tried = approach(model, &Attempt { guess: &stiffened, ..start }, log);
        if tried.residual_n < best.residual_n {
            best = tried;
        }
    }
    best
}

/// Newton's method controlled by the residual, with predicted passes.
pub(super) fn newton_by_residual(model: &Model, from: &Attempt, log: &mut IterationLog) -> Reached {
    attempt(model, &Attempt { pseudo_mass: FAR, ..*from }, PREDICTED, log)
}

/// Softens rope until the gear converges, then stiffens it in stages, each from the last that converged.
fn stiffen(model: &Model, start: &Attempt, softest_n: f64, log: &mut IterationLog) -> State {
    let stiffest_n = model.spec.ropes.iter().map(|rope| rope.axial_stiffness_n).fold(0.0, f64::max);
    let softest = approach(&softened(model, softest_n), start, log);
    if !softest.at_rest() {
        return start.laid.clone();
    }
    let (mut state, mut stiffness_n, mut factor) = (softest.state, softest_n, GREATEST_FACTOR);
    for _ in 0..MOST_STAGES {
        let next_n = stiffness_n * factor;
        if next_n >= stiffest_n || log.is_spent() {
            break;
        }
        let (soft, from) = (softened(model, next_n), Attempt { guess: &state, ..*start });
        let reached = if factor < NARROW {
            approach(&soft, &from, log)
        } else {
            attempt(&soft, &from, PREDICTED, log)
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

/// The model with a stiffness of rope of at most `stiffness_n`.
fn softened(model: &Model, stiffness_n: f64) -> Model {
    let mut soft = model.with_lines(model.spec.lines.clone());
    for rope in &mut soft.spec.ropes {
        let share = (stiffness_n / rope.axial_stiffness_n).min(1.0);
        rope.axial_stiffness_n *= share;
        rope.axial_stiffening_n *= share;
    }
    soft
}

/// Tries predicted, then searched passes; returns the result with the smaller residual.
fn approach(model: &Model, from: &Attempt, log: &mut IterationLog) -> Reached {
    let predicted = attempt(model, from, PREDICTED, log);
    if predicted.at_rest() {
        return predicted;
    }
    let searched = attempt(model, from, SEARCHED, log);
    if searched.residual_n < predicted.residual_n { searched } else { predicted }
}

/// Newton's method with one kind of passes.
fn attempt(
    model: &Model,
    from: &Attempt,
    (kind, most_passes): (PassKind, usize),
    log: &mut IterationLog,
) -> Reached {
    let mut newton = Newton::new(model, from);
    let mut residual_n = newton.balance(kind);
    for _ in 0..most_passes {
        if residual_n < TOLERANCE_N {
            // The prediction may treat a taut segment as slack.
            residual_n = newton.balance(PassKind::Searched);
        }
        log.pass(model, residual_n);
        if residual_n < TOLERANCE_N || !residual_n.is_finite() || log.is_spent() {
            break;
        }
        newton.solve();
        let longest = newton
            .solver
            .share_past_solids(LONGEST_MOVE_M / newton.solver.longest().max(LONGEST_MOVE_M));
        let share = if kind == PassKind::Searched { newton.line_search(longest) } else { longest };
        newton.solver.advance(model, share);
        newton.solver.measure_flow(model);
        let next_n = newton.balance(kind);
        let change = match kind {
            PassKind::Predicted => (next_n / residual_n).clamp(CHANGE.0, CHANGE.1),
            PassKind::Searched if share < SHORT => GROWTH,
            PassKind::Searched => SHRINKAGE,
        };
        newton.change_mass(change);
        residual_n = next_n;
    }
    newton.reached(residual_n)
}
