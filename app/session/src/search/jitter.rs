//! Neighbours of an encounter: every quantity off by as little as nobody could tell, and rope as rough or smooth as it may be.

use endline_gear::units::Quantity;
use endline_gear::{Law, Prior};

use crate::encounters::Encounter;
use crate::encounters::draw::{self, Drawn};

use super::question::Question;

/// Prior of the scale of friction.
const FRICTION: &str = "friction.attributes.coefficient_scale";

/// Neighbour `number` of the encounter at a point.
pub(super) fn neighbour(question: &Question, point: &[f64], number: u32) -> Encounter {
    let priors = &question.opened.study.priors;
    let seed = question.seed ^ 0x9e37_79b9_7f4a_7c15;
    let shares = draw::sobol_point(seed, number, priors.len());
    let mut encounter = Encounter::at_point(&question.opened.study, point);
    for ((prior, drawn), share) in priors.iter().zip(&mut encounter.drawn).zip(shares) {
        *drawn = jittered(prior, drawn, share);
    }
    encounter
}

/// A drawn value and a little more or less; any level of friction's scale, where it is drawn by levels.
fn jittered(prior: &Prior, drawn: &Drawn, share: f64) -> Drawn {
    let is_friction = prior.name.value == FRICTION;
    let (ends, quantity) = match &prior.law {
        Law::Choice(_) if is_friction => return draw::at_share(prior, share),
        Law::Choice(_) => return drawn.clone(),
        Law::Uniform { low, high, quantity } | Law::Normal { low, high, quantity, .. } => {
            ([*low, *high], *quantity)
        }
        Law::Bins { edges, quantity, .. } => ([edges[0], edges[edges.len() - 1]], *quantity),
    };
    let Some(value) = drawn.number else { return drawn.clone() };
    let way = 2.0 * share - 1.0;
    let moved =
        if is_friction { value * libm::exp2(way) } else { value + way * off_by(quantity, value) };
    draw::number(prior.name.value.clone(), moved.clamp(ends[0], ends[1]), quantity)
}

/// How far a quantity may be off: 2 cm, 0.1 s, a degree, 2 cm/s; a twentieth of any other.
fn off_by(quantity: Quantity, value: f64) -> f64 {
    match quantity {
        Quantity::Length => 0.02,
        Quantity::Time => 0.1,
        Quantity::Angle => 1.0_f64.to_radians(),
        Quantity::Speed => 0.02,
        _ => 0.05 * value.abs(),
    }
}
