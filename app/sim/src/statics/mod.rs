//! Statics: the shape and tensions at rest, before any dynamics.
//!
//! By continuation from an easy state. *Held*: bodies that lie on the seabed stay as they were laid, and lines find
//! their shape from arcs of their own length ([`guess`]) by Newton ([`newton`]); where that fails, by way of soft rope
//! ([`relax`]). *Released*: the bodies lean into their grip on the seabed, with tethers that fade where they must slide.
//! Where gear does not come to rest, the pull on its held bodies against what they hold says whether it drags ([`outcome`]).

mod guess;
mod newton;
pub mod outcome;
mod relax;

use crate::model::Model;
use crate::state::State;
use crate::whale::pilot;
use newton::{Hold, Reached, descend};
pub use outcome::{Drag, Outcome, Worst};

/// Passes of Newton from the first guess.
const HELD_PASSES: usize = 200;
/// Passes of Newton after the bodies are released, with each tether.
const RELEASED_PASSES: usize = 60;
/// Tethers that the bodies are released on where they do not come to rest without, one after the other [N/m].
const TETHERS_N_M: [f64; 4] = [1000.0, 30.0, 1.0, 0.0];

/// A rig at rest, or the nearest to it that was found.
#[derive(Clone, Debug)]
pub struct Settled {
    /// The state to start dynamics from.
    pub state: State,
    /// What was found.
    pub outcome: Outcome,
    /// Greatest force out of balance at any node or body [N].
    pub residual_n: f64,
    /// Where that is.
    pub worst: Option<Worst>,
    /// Whether the rig is at rest.
    pub converged: bool,
    /// Residual after each pass [N].
    pub trace_n: Vec<f64>,
}

impl Settled {
    /// What was found and where the greatest force is left, for a message.
    #[must_use]
    pub fn why(&self) -> String {
        match (&self.outcome, &self.worst) {
            (Outcome::NotFound, Some(worst)) => format!("{}: {:.3e} N is left at {}", self.outcome, worst.force_n, worst.part),
            (outcome, _) => outcome.to_string(),
        }
    }
}

/// Finds the state at rest under the model's water at time zero.
#[must_use]
pub fn settle(model: &Model) -> Settled {
    let mut trace_n = Vec::new();
    let held = hold(model, &mut trace_n);
    let released = release(model, &held, &mut trace_n);
    if released.at_rest() {
        return told(model, released, Outcome::AtRest, trace_n);
    }
    match outcome::drags(model, &held).filter(|_| held.at_rest()) {
        Some(drag) => told(model, held, Outcome::Drags(drag), trace_n),
        None => told(model, released, Outcome::NotFound, trace_n),
    }
}

/// The lines' shape with bodies held as they were laid.
fn hold(model: &Model, trace_n: &mut Vec<f64>) -> Reached {
    let first = guess::first_guess(model);
    let held = descend(model, &first, &first, Hold::Laid, HELD_PASSES, trace_n);
    if held.at_rest() {
        return held;
    }
    sure(model, Hold::Laid, trace_n)
}

/// The sure way, and Newton again from where it ends.
fn sure(model: &Model, hold: Hold, trace_n: &mut Vec<f64>) -> Reached {
    let laid = if hold == Hold::Laid { guess::straight(model) } else { State::start(model) };
    let relaxed = relax::relax(model, &laid, hold, trace_n);
    if relaxed.at_rest() {
        return relaxed;
    }
    let polished = descend(model, &laid, &relaxed.state, hold, HELD_PASSES, trace_n);
    if polished.residual_n < relaxed.residual_n { polished } else { relaxed }
}

/// The same with the bodies released.
fn release(model: &Model, held: &Reached, trace_n: &mut Vec<f64>) -> Reached {
    if held.at_rest() {
        let mut reached = descend(model, &held.state, &held.state, Hold::Tethered(0.0), RELEASED_PASSES, trace_n);
        if reached.at_rest() {
            return reached;
        }
        reached.state.clone_from(&held.state);
        for tether in TETHERS_N_M {
            reached = descend(model, &held.state, &reached.state, Hold::Tethered(tether), RELEASED_PASSES, trace_n);
        }
        if reached.at_rest() || outcome::drags(model, held).is_some() {
            return reached;
        }
    }
    sure(model, Hold::Tethered(0.0), trace_n)
}

fn told(model: &Model, mut reached: Reached, outcome: Outcome, trace_n: Vec<f64>) -> Settled {
    let (worst, converged) = (outcome::worst(model, &reached), outcome == Outcome::AtRest);
    pilot::begin(model, &mut reached.state);
    Settled { state: reached.state, outcome, residual_n: reached.residual_n, worst, converged, trace_n }
}
