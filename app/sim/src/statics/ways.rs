//! Ways to rest, tried in turn until one leads there.
//!
//! Quick ways come first; how often each is needed and leads there, of 300 rigs drawn at random, stands beside it.

use super::creep::creep;
use super::guess;
use super::newton::{Attempt, Hold, Reached, descend};
use super::relax;
use super::trail::Trail;
use crate::model::Model;
use crate::state::State;

/// A way to rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Newton, by how far passes turn the gear, with so many passes.
    Turn(usize),
    /// Newton, by how the residual falls.
    Fall,
    /// Newton from straight lines, by how the residual falls.
    FallAnew,
    /// Creeping.
    Creep,
    /// Soft rope made stiff.
    Soften,
    /// Newton, laid bodies first sliding upright and then let go.
    Slide,
}

/// With laid bodies held, from the first guess: 223 of 328, 24 of 105, 5 of 81, 58 of 60.
pub(super) const HELD: [Way; 4] = [Way::Turn(80), Way::FallAnew, Way::Fall, Way::Soften];
/// With bodies released, from where they were held; the last two where they hold more than pulls: 376 of 531 with
/// refining, 90 of 155, 27 of 47, 8 of 10.
pub(super) const RELEASED: [Way; 4] = [Way::Turn(80), Way::Fall, Way::Creep, Way::Soften];
/// From the shape of coarser gear.
pub(super) const REFINED: [Way; 3] = [Way::Turn(15), Way::Fall, Way::Creep];

/// With laid bodies that slide upright, and with them let go from there.
const SLIDING: [Way; 2] = [Way::Turn(80), Way::Fall];
const LET_GO: [Way; 2] = [Way::Turn(120), Way::Creep];
/// First pseudo-mass where bodies are let go: it turns a trap by less than its feet are deep in the seabed [1/s²].
const FIRM: f64 = 1e4;

/// Most passes of creeping.
const CREEP_PASSES: usize = 600;
/// Passes of Newton from where soft rope ended.
const POLISH_PASSES: usize = 200;

/// Tries ways in turn until one leads to rest; the best end.
pub(super) fn try_all(
    ways: &[Way],
    model: &Model,
    attempt: &Attempt,
    trail: &mut Trail,
) -> Reached {
    let mut best = take(ways[0], model, attempt, trail);
    for way in &ways[1..] {
        if best.at_rest() || trail.is_spent() {
            break;
        }
        let reached = take(*way, model, attempt, trail);
        if reached.residual_n < best.residual_n {
            best = reached;
        }
    }
    best
}

/// Goes one way.
pub(super) fn take(way: Way, model: &Model, attempt: &Attempt, trail: &mut Trail) -> Reached {
    match way {
        Way::Turn(most_passes) => descend(model, attempt, most_passes, trail),
        Way::Fall => relax::quick(model, attempt, trail),
        Way::FallAnew => {
            let laid = straight(model, attempt.hold);
            relax::quick(model, &Attempt { laid: &laid, guess: &laid, ..*attempt }, trail)
        }
        Way::Creep => creep(model, attempt, CREEP_PASSES, trail),
        Way::Soften => soften(model, attempt, trail),
        Way::Slide => slide(model, attempt, trail),
    }
}

/// Laid bodies let slide before they may turn: rope that was laid taut pulls them to where it is slack, and does not
/// overturn them.
fn slide(model: &Model, attempt: &Attempt, trail: &mut Trail) -> Reached {
    let slid = try_all(&SLIDING, model, &Attempt { hold: Hold::Upright, ..*attempt }, trail);
    try_all(&LET_GO, model, &Attempt { guess: &slid.state, pseudo_mass: FIRM, ..*attempt }, trail)
}

/// Soft rope made stiff, and Newton from where that ends.
fn soften(model: &Model, attempt: &Attempt, trail: &mut Trail) -> Reached {
    let laid = straight(model, attempt.hold);
    let relaxed = relax::relax(model, &laid, attempt.hold, trail);
    if relaxed.at_rest() {
        return relaxed;
    }
    let polished = descend(
        model,
        &Attempt { laid: &laid, guess: &relaxed.state, ..*attempt },
        POLISH_PASSES,
        trail,
    );
    if polished.residual_n < relaxed.residual_n { polished } else { relaxed }
}

/// Straight lines between bodies as they are placed, laid bodies sunk as deep in the seabed as they lie.
fn straight(model: &Model, hold: Hold) -> State {
    if hold == Hold::Laid { guess::straight(model) } else { State::start(model) }
}
