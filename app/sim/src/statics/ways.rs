//! Ways to rest, tried in turn until one leads there.
//!
//! Quick ways come first; how often each is needed and leads there, of 300 rigs drawn at random, stands beside it.

use super::creep::creep;
use super::guess;
use super::newton::{Attempt, Hold, Reached, descend};
use super::relax;
use crate::model::Model;
use crate::state::State;

/// A way to rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Newton, by how far passes turn the gear, with so many passes.
    Turn(usize),
    /// Newton, by how the residual falls.
    Fall,
    /// The same from straight lines.
    FallAnew,
    /// Creeping.
    Creep,
    /// Soft rope made stiff.
    Soften,
}

/// With laid bodies held, from the first guess: 223 of 328, 24 of 105, 5 of 81, 58 of 60.
pub(super) const HELD: [Way; 4] = [Way::Turn(80), Way::FallAnew, Way::Fall, Way::Soften];
/// With bodies released, from where they were held; the last two where they hold more than pulls: 376 of 531 with
/// refining, 90 of 155, 27 of 47, 8 of 10.
pub(super) const RELEASED: [Way; 4] = [Way::Turn(80), Way::Fall, Way::Creep, Way::Soften];
/// From the shape of coarser gear.
pub(super) const REFINED: [Way; 3] = [Way::Turn(15), Way::Fall, Way::Creep];

/// Most passes of creeping.
const CREEP_PASSES: usize = 600;
/// Passes of Newton from where soft rope ended.
const POLISH_PASSES: usize = 200;

/// Tries ways in turn until one leads to rest; the best end.
pub(super) fn try_all(ways: &[Way], model: &Model, attempt: &Attempt, trace_n: &mut Vec<f64>) -> Reached {
    let mut best = take(ways[0], model, attempt, trace_n);
    for way in &ways[1..] {
        if best.at_rest() {
            break;
        }
        let reached = take(*way, model, attempt, trace_n);
        if reached.residual_n < best.residual_n {
            best = reached;
        }
    }
    best
}

/// Goes one way.
pub(super) fn take(way: Way, model: &Model, attempt: &Attempt, trace_n: &mut Vec<f64>) -> Reached {
    match way {
        Way::Turn(most_passes) => descend(model, attempt, most_passes, trace_n),
        Way::Fall => relax::quick(model, attempt, trace_n),
        Way::FallAnew => {
            let laid = straight(model, attempt.hold);
            relax::quick(model, &Attempt { laid: &laid, guess: &laid, ..*attempt }, trace_n)
        }
        Way::Creep => creep(model, attempt, CREEP_PASSES, trace_n),
        Way::Soften => soften(model, attempt, trace_n),
    }
}

/// Soft rope made stiff, and Newton from where that ends.
fn soften(model: &Model, attempt: &Attempt, trace_n: &mut Vec<f64>) -> Reached {
    let laid = straight(model, attempt.hold);
    let relaxed = relax::relax(model, &laid, attempt.hold, trace_n);
    if relaxed.at_rest() {
        return relaxed;
    }
    let polished = descend(model, &Attempt { laid: &laid, guess: &relaxed.state, ..*attempt }, POLISH_PASSES, trace_n);
    if polished.residual_n < relaxed.residual_n { polished } else { relaxed }
}

/// Straight lines between bodies as they are placed, laid bodies sunk as deep in the seabed as they lie.
fn straight(model: &Model, hold: Hold) -> State {
    if hold == Hold::Laid { guess::straight(model) } else { State::start(model) }
}
