//! Gear for which no balance is found, led to it from a weaker current.
//!
//! Continuation in the strength of the current: the gear is settled in a share of it, and its shape there is the guess
//! for the whole (Allgower and Georg 2003, Introduction to Numerical Continuation Methods, chapter 2). Where a search fails, it most often
//! fails at one speed and succeeds 1 % beside it.

use glam::DVec3;

use super::newton::{Attempt, Hold, NEAR};
use super::outcome::Outcome;
use super::trail::Trail;
use super::ways::{self, REFINED};
use super::{Found, find};
use crate::model::Model;
use crate::state::State;

/// Shares of the current, tried in turn.
const SHARES: [f64; 4] = [0.99, 0.97, 0.9, 0.75];

/// The gear at rest, reached from a weaker current; nothing where there is none or it does not lead there.
pub(super) fn find_eased(model: &Model, trail: &mut Trail) -> Option<Found> {
    if model.spec.water.current.surface_m_s == DVec3::ZERO {
        return None;
    }
    SHARES.iter().find_map(|share| from_share(model, *share, trail))
}

fn from_share(model: &Model, share: f64, trail: &mut Trail) -> Option<Found> {
    let mut own = Trail::short();
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
        ways::try_all(&REFINED, model, &attempt, &mut own)
    });
    trail.add(own);
    let end = end.filter(|end| end.at_rest())?;
    Some(Found { first, held, end, outcome: Outcome::AtRest })
}

/// A state of the gear alone, carried over to the model with all that it has.
fn carried(model: &Model, state: &State) -> State {
    State { rope: state.rope.clone(), bodies: state.bodies.clone(), ..State::start(model) }
}
