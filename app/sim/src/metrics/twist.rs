//! Twist: how often the two legs of a bight turn about each other beyond the whale.
//!
//! The *legs* of a strand are its rope beyond the outermost segments that touch, one to either end or to the first cut. Both are walked from
//! the whale outwards, level with each other: the leg that is behind in the mean direction `t` of the two goes on. Where the
//! legs lie side by side, the arrow `u` from one to the other turns about `t`, and the twist is the sum of these turns:
//!
//! ```text
//! twist = sum of atan2(t . (u x u'), u . u' - (u . t)(u' . t)) / 2 pi
//! ```
//!
//! It is above zero for right-handed legs, whichever leg comes first. Definitions and reasons: `docs/entanglement.md`.

use std::f64::consts::TAU;

use glam::DVec3;

use super::outcome::LOST_S;
use super::wraps::ends_of;
use crate::contact::ContactPoint;
use crate::model::Model;
use crate::state::State;
use crate::strands::Strands;

/// Legs farther apart than this are not side by side [m]; estimate.
pub const BESIDE_M: f64 = 0.5;

/// Twists of the legs of every strand.
#[derive(Clone, Debug)]
pub(super) struct TwistMeter {
    strands: Vec<Twist>,
}

/// The twist of a strand's legs, and where they begin.
#[derive(Clone, Copy, Debug, Default)]
struct Twist {
    span: Option<Span>,
    turns: f64,
    peak_turns: f64,
}

/// The outermost segments of a strand that touched when it last did.
#[derive(Clone, Copy, Debug)]
struct Span {
    first: usize,
    last: usize,
    time_s: f64,
}

impl TwistMeter {
    pub(super) fn new(strands: &Strands) -> Self {
        Self { strands: vec![Twist::default(); strands.lists().len()] }
    }

    /// Measures the legs of all strands that touch the whale, or did less than [`LOST_S`] ago.
    pub(super) fn fold(
        &mut self,
        model: &Model,
        state: &State,
        strands: &Strands,
        contacts: &[ContactPoint],
    ) {
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let place = strands.places[contact.segment];
            self.strands[place.strand].take(place.order, state.time_s);
        }
        for (twist, segments) in self.strands.iter_mut().zip(strands.lists()) {
            twist.span = twist.span.filter(|span| state.time_s - span.time_s < LOST_S);
            let rope = Rope { model, state, strands, segments };
            twist.turns = twist.span.map_or(0.0, |span| rope.twist(&span));
            if twist.turns.abs() > twist.peak_turns.abs() {
                twist.peak_turns = twist.turns;
            }
        }
    }

    /// Twist of the legs of a strand now, and the greatest at any time, with their signs [turns].
    pub(super) fn of(&self, strand: usize) -> [f64; 2] {
        self.strands.get(strand).map_or([0.0; 2], |twist| [twist.turns, twist.peak_turns])
    }
}

impl Twist {
    /// Takes in a segment that touches.
    fn take(&mut self, order: usize, time_s: f64) {
        let now = self.span.filter(|span| span.time_s.total_cmp(&time_s).is_eq());
        let (first, last) = now.map_or((order, order), |span| (span.first, span.last));
        self.span = Some(Span { first: first.min(order), last: last.max(order), time_s });
    }
}

/// A strand as it lies.
struct Rope<'a> {
    model: &'a Model,
    state: &'a State,
    strands: &'a Strands,
    segments: &'a [usize],
}

/// A place on a leg: on the way from `here` to `to`, the outer end of segment `order`.
#[derive(Clone, Copy)]
struct Leg {
    order: usize,
    onward: bool,
    here: DVec3,
    to: DVec3,
}

impl Rope<'_> {
    /// Twist of the legs beyond a span [turns].
    fn twist(&self, span: &Span) -> f64 {
        let (Some(mut one), Some(mut other)) =
            (self.leg(span.first.checked_sub(1), false), self.leg(span.last.checked_add(1), true))
        else {
            return 0.0;
        };
        let (mut turned, mut apart) = (0.0, other.here - one.here);
        loop {
            let (way, other_way) = (one.way(), other.way());
            let along = (way + other_way).normalize_or_zero();
            let behind = if apart.dot(along) > 0.0 { &mut one } else { &mut other };
            let Some(next) = self.go_on(*behind) else { break };
            *behind = next;
            let now = other.here - one.here;
            if way.dot(other_way) > 0.0 && apart.length().max(now.length()) < BESIDE_M {
                turned += turn(apart, now, along);
            }
            apart = now;
        }
        turned / TAU
    }

    /// The leg from a segment on, to the end of the strand or to its start; `None` where there is no such segment, or it is cut.
    fn leg(&self, order: Option<usize>, onward: bool) -> Option<Leg> {
        let order = order?;
        let segment = *self.segments.get(order)?;
        let [from, to] = ends_of(self.model, self.state, self.strands, segment);
        let [here, to] = if onward { [from, to] } else { [to, from] };
        (!self.state.rope.cut[segment]).then_some(Leg { order, onward, here, to })
    }

    /// The leg from the outer end of its segment on, which is its end where no other follows; `None` from there.
    fn go_on(&self, leg: Leg) -> Option<Leg> {
        let next = if leg.onward { leg.order.checked_add(1) } else { leg.order.checked_sub(1) };
        let end = (leg.here != leg.to).then_some(Leg { here: leg.to, ..leg });
        self.leg(next, leg.onward).filter(|_| end.is_some()).or(end)
    }
}

impl Leg {
    fn way(&self) -> DVec3 {
        (self.to - self.here).normalize_or_zero()
    }
}

/// The angle about a unit vector from one vector to another, in (-pi, pi] [rad].
fn turn(from: DVec3, to: DVec3, about: DVec3) -> f64 {
    let across = from.dot(to) - from.dot(about) * to.dot(about);
    libm::atan2(about.dot(from.cross(to)), across)
}
