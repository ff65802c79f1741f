//! Rope that lies on bodies: a bridle across its trap, a gangion beside it, a leadline over an anchor.
//!
//! The gear is first at rest with rope that passes through bodies, which most gear never does. Where a length of it lies in a body, the balance is
//! found again from there with bodies that push, softly at first. Where that leads to none, rope stays as it is: it is then taken as stowed within
//! the body (`contact/rope_on_solid/excluded.rs`), and touches it once it has come out.

use super::Found;
use super::newton::{Attempt, FAR, Hold, Reached};
use super::outcome::Outcome;
use super::trail::Trail;
use super::ways::{Way, try_all};
use crate::model::Model;
use crate::solids::lies_in_body;

/// Ways to rest with bodies that push: of four shipped assemblies with rope in a body, three come to rest.
const WAYS: [Way; 2] = [Way::Turn(60), Way::Fall];
/// Stiffness of bodies under rope, by its length, from soft to as stiff as steps of 10 ms have it [N/m²].
const STIFFNESS_N_M2: [f64; 2] = [2e4, 2e5];

/// Finds the balance again with bodies that push, where rope lies in one.
pub(super) fn lift(model: &Model, found: &mut Found, trail: &mut Trail) {
    if found.outcome != Outcome::AtRest || !lies_in_body(model, &found.end.state) {
        return;
    }
    for stiffness_n_m2 in STIFFNESS_N_M2 {
        match lifted(model, found, stiffness_n_m2, trail) {
            Some(lifted) => found.end = lifted,
            None => break,
        }
    }
}

fn lifted(model: &Model, found: &Found, stiffness_n_m2: f64, trail: &mut Trail) -> Option<Reached> {
    let attempt = Attempt {
        laid: &found.held,
        guess: &found.end.state,
        hold: Hold::Released,
        on_bodies_n_m2: Some(stiffness_n_m2),
        pseudo_mass: FAR,
    };
    let lifted = try_all(&WAYS, model, &attempt, trail);
    lifted.at_rest().then_some(lifted)
}
