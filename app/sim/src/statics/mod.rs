//! Statics: the shape and tensions at rest, before any dynamics.
//!
//! By continuation from an easy state, coarse gear first ([`coarse`]). *Held*: bodies that lie on the seabed stay as
//! they were laid, and lines find their shape from arcs of their own length ([`guess`]). *Released*: the bodies lean into
//! their grip on the seabed. *Refined*: the shape is carried over to the gear as it is. Each is tried in several ways in
//! turn, the quick one first ([`ways`]): Newton ([`newton`]), creeping ([`creep`]), soft rope made stiff ([`relax`]).
//! Where no balance is found, the gear is settled in a weaker current first ([`ease`]).
//! Where gear does not come to rest, the pull on its held bodies against what they hold says whether it drags
//! ([`outcome`]). All that with rope that passes through bodies; where some then lies in one, it is lifted out ([`on_bodies`]), and rope that
//! lies in other rope is moved beside it ([`on_ropes`]).

mod coarse;
mod creep;
mod ease;
mod guess;
mod lengths;
mod newton;
mod on_bodies;
mod on_ropes;
pub mod outcome;
mod relax;
mod trail;
mod ways;

use crate::model::Model;
use crate::state::State;
use crate::whale::pilot;
use coarse::Coarse;
use newton::{Attempt, FAR, Hold, NEAR, Reached};
pub use outcome::{Drag, Outcome, Unfound, Worst};
use trail::Trail;
use ways::{HELD, REFINED, RELEASED, Way};

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
    /// Residual after each pass, those of coarser gear among them [N].
    pub trace_n: Vec<f64>,
}

impl Settled {
    /// This gear at rest with another whale: that of a model whose gear, water and seabed are the same, up to the
    /// strengths of ropes and links. Statics do not look at the whale, unless a line is made fast to it.
    #[must_use]
    pub fn with_whale_of(&self, model: &Model) -> Self {
        let mut settled = self.clone();
        let start = State::start(model);
        (settled.state.whale, settled.state.link_parted_s) = (start.whale, start.link_parted_s);
        pilot::begin(model, &mut settled.state);
        settled
    }

    /// What was found and where the greatest force is left, for a message.
    #[must_use]
    pub fn why(&self) -> String {
        match (&self.outcome, &self.worst) {
            (Outcome::NotFound(_), Some(worst)) => {
                format!("{}; {:.3e} N is left at {}", self.outcome, worst.force_n, worst.part)
            }
            (outcome, _) => outcome.to_string(),
        }
    }
}

/// Finds the state at rest under the model's water at time zero.
#[must_use]
pub fn settle(model: &Model) -> Settled {
    let mut trail = Trail::default();
    let mut found = find(model, &mut trail);
    if matches!(found.outcome, Outcome::NotFound(_)) {
        found = ease::find_eased(model, &mut trail).unwrap_or(found);
    }
    on_bodies::lift(model, &mut found, &mut trail);
    on_ropes::part(model, &mut found);
    told(model, found, trail)
}

/// What was found for gear of some fineness.
struct Found {
    /// The first guess, from which grips are measured while bodies are held.
    first: State,
    /// With bodies held, and from which grips are measured where they are released.
    held: State,
    /// Where it ended: released where it is at rest, held where it drags.
    end: Reached,
    outcome: Outcome,
}

/// Coarse gear first, then as it is.
fn find(model: &Model, trail: &mut Trail) -> Found {
    let Some(coarse) = Coarse::of(model) else { return find_anew(model, trail) };
    let found = find(&coarse.model, trail);
    if trail.is_spent() {
        return carry(model, &coarse, found, trail);
    }
    refine(model, &coarse, &found, trail).unwrap_or_else(|| find_anew(model, trail))
}

/// From what was found for coarser gear; nothing where that does not lead there.
fn refine(model: &Model, coarse: &Coarse, found: &Found, trail: &mut Trail) -> Option<Found> {
    let [first, held, guess] =
        [&found.first, &found.held, &found.end.state].map(|state| coarse.carry(model, state));
    let (laid, hold) = match found.outcome {
        Outcome::AtRest => (&held, Hold::Released),
        Outcome::Drags(_) => (&first, Hold::Laid),
        Outcome::NotFound(_) => return None,
    };
    let end = ways::try_all(
        &REFINED,
        model,
        &Attempt { laid, guess: &guess, hold, on_bodies_n_m2: None, pseudo_mass: NEAR },
        trail,
    );
    if !end.at_rest() {
        return None;
    }
    let outcome = if hold == Hold::Laid {
        Outcome::Drags(outcome::drags(model, &end)?)
    } else {
        Outcome::AtRest
    };
    Some(Found { first, held, end, outcome })
}

/// What was found for coarser gear as it is, where it is time to give up.
fn carry(model: &Model, coarse: &Coarse, found: Found, trail: &mut Trail) -> Found {
    let [first, held, guess] =
        [&found.first, &found.held, &found.end.state].map(|state| coarse.carry(model, state));
    let (laid, hold) = if matches!(found.outcome, Outcome::Drags(_)) {
        (&first, Hold::Laid)
    } else {
        (&held, Hold::Released)
    };
    let attempt = Attempt { laid, guess: &guess, hold, on_bodies_n_m2: None, pseudo_mass: NEAR };
    let end = newton::descend(model, &attempt, 1, trail);
    let outcome = match found.outcome {
        Outcome::AtRest if !end.at_rest() => Outcome::NotFound(Unfound::Fine),
        outcome => outcome,
    };
    Found { first, held, end, outcome }
}

/// From the first guess.
fn find_anew(model: &Model, trail: &mut Trail) -> Found {
    let first = guess::first_guess(model);
    let held = ways::try_all(
        &HELD,
        model,
        &Attempt {
            laid: &first,
            guess: &first,
            hold: Hold::Laid,
            on_bodies_n_m2: None,
            pseudo_mass: FAR,
        },
        trail,
    );
    let attempt = Attempt {
        laid: &held.state,
        guess: &held.state,
        hold: Hold::Released,
        on_bodies_n_m2: None,
        pseudo_mass: FAR,
    };
    if !held.at_rest() {
        let end = ways::take(Way::Soften, model, &attempt, trail);
        let outcome =
            if end.at_rest() { Outcome::AtRest } else { Outcome::NotFound(Unfound::Held) };
        return Found { first, held: held.state, end, outcome };
    }
    let grip = outcome::grip(model, &held);
    let drag = grip.clone().filter(Drag::is_lost);
    // Where the pull is greater than the hold, most often there is no rest: the quick ways are enough.
    let ways = if drag.is_some() { &RELEASED[..2] } else { &RELEASED };
    let released = release(ways, model, &attempt, trail);
    let (outcome, end) = match drag {
        _ if released.at_rest() => (Outcome::AtRest, released),
        Some(drag) => (Outcome::Drags(drag), held.clone()),
        None => (Outcome::NotFound(Unfound::Released(grip)), released),
    };
    Found { first, held: held.state, end, outcome }
}

/// Lets laid bodies go; where that overturns one, once more with bodies that slide before they turn.
fn release(ways: &[Way], model: &Model, attempt: &Attempt, trail: &mut Trail) -> Reached {
    let released = ways::try_all(ways, model, attempt, trail);
    if released.at_rest() && !outcome::overturned(model, attempt.laid, &released.state) {
        return released;
    }
    let slid = ways::take(Way::Slide, model, attempt, trail);
    if slid.at_rest() { slid } else { released }
}

fn told(model: &Model, found: Found, trail: Trail) -> Settled {
    let Found { mut end, outcome, .. } = found;
    let (worst, converged) = (outcome::worst(model, &end), outcome == Outcome::AtRest);
    pilot::begin(model, &mut end.state);
    Settled {
        state: end.state,
        outcome,
        residual_n: end.residual_n,
        worst,
        converged,
        trace_n: trail.residual_n,
    }
}
