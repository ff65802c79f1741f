//! Normal force on the whale beyond what rope can press.
//!
//! Rope bent by `θ` under a tension `T` presses on what it is bent about with normal forces that sum to `T θ`: `π T` about an edge.
//! What else acts on rope (weight, buoyancy, drag, inertia) is held by skin too. By the balance of forces its sum over a stretch in
//! touch is at most `R + 2 T`: `R` the sum of normal forces and friction as vectors, `T` the tension at either end. So the normal
//! forces of a stretch sum to at most
//!
//! `N ≤ T (θ + 2) + R`   [N]
//!
//! where `T` is the greatest tension of the stretch and of the segments next to it [N], and `θ` the sum of the angles between its
//! segments [rad]. More than that is skin that presses rope from two sides, or a balance that was not found.
//! A stretch is rope of one line in touch with gaps of one segment at most.
//!
//! A mouth that closes on rope, or into whose corner rope was drawn like a wedge, does press it from two sides, and friction holds it there
//! when the rope pulls no longer. The part of the normal forces on a segment that cancels, `Σ |N| - |Σ N|`, is therefore left out
//! where lips or the inside of the mouth take part in it. Elsewhere it counts: skin does not close on rope of itself.

use std::sync::Arc;

use endline_sdk::Region;
use glam::DVec3;

use crate::contact::ContactPoint;
use crate::model::Model;
use crate::state::State;

/// Segments without touch that part two stretches.
const GAP: usize = 2;

/// Normal force over time: all of it, and what rope cannot press.
#[derive(Clone, Debug, Default)]
pub(super) struct PressMeter {
    /// Whether each triangle is inside the mouth.
    inside: Arc<[bool]>,
    /// All [N s].
    all: f64,
    /// Beyond what rope can press [N s].
    beyond: f64,
    /// Contacts in the order of their segments; scratch.
    order: Vec<usize>,
}

impl PressMeter {
    /// Of a whale with these triangles inside its mouth.
    pub fn new(inside: Arc<[bool]>) -> Self {
        Self { inside, ..Self::default() }
    }

    /// Takes in the contacts at the end of a step.
    pub fn fold(&mut self, model: &Model, state: &State, contacts: &[ContactPoint], dt_s: f64) {
        let Self { inside, all, beyond, order } = self;
        order.clear();
        order.extend(0..contacts.len());
        order.sort_unstable_by_key(|index| (contacts[*index].segment, *index));
        let next_to = |one: &usize, next: &usize| {
            let (one, next) = (&contacts[*one], &contacts[*next]);
            one.line == next.line && next.segment <= one.segment + GAP
        };
        for stretch in order.chunk_by(next_to) {
            let stretch = stretch.iter().map(|index| &contacts[*index]);
            let normal_n: f64 = stretch.clone().map(|contact| contact.normal_force_n).sum();
            *all += normal_n * dt_s;
            let by_rope_n = normal_n - in_the_mouth_n(inside, stretch.clone());
            *beyond += (by_rope_n - most_n(model, state, stretch)).max(0.0) * dt_s;
        }
    }

    /// Share of the normal force, over time, that is beyond what rope can press.
    pub fn beyond_share(&self) -> f64 {
        if self.all > 0.0 { self.beyond / self.all } else { 0.0 }
    }
}

/// Normal force by which the mouth presses rope from two sides, segment by segment [N].
fn in_the_mouth_n<'a>(inside: &[bool], stretch: impl Iterator<Item = &'a ContactPoint>) -> f64 {
    let mut own = Segment::default();
    let mut sum_n = 0.0;
    for contact in stretch {
        if contact.segment != own.segment {
            sum_n += std::mem::take(&mut own).clamped_n();
            own.segment = contact.segment;
        }
        own.all_n += contact.normal_force_n;
        own.resultant_n += contact.normal * contact.normal_force_n;
        own.in_mouth |=
            contact.region == Region::Lips || inside.get(contact.triangle) == Some(&true);
    }
    sum_n + own.clamped_n()
}

/// Normal forces on a segment.
#[derive(Clone, Copy, Debug, Default)]
struct Segment {
    segment: usize,
    all_n: f64,
    resultant_n: DVec3,
    in_mouth: bool,
}

impl Segment {
    fn clamped_n(self) -> f64 {
        if self.in_mouth { (self.all_n - self.resultant_n.length()).max(0.0) } else { 0.0 }
    }
}

/// What the rope of a stretch can press at most [N].
fn most_n<'a>(
    model: &Model,
    state: &State,
    stretch: impl DoubleEndedIterator<Item = &'a ContactPoint> + Clone,
) -> f64 {
    let [Some(first), Some(last)] = [stretch.clone().next(), stretch.clone().next_back()] else {
        return 0.0;
    };
    let own = &model.line_segments[first.line];
    let from = first.segment.saturating_sub(1).max(own.start);
    let to = (last.segment + 1).min(own.end - 1);
    let shift = model.line_nodes[first.line].start - own.start;
    let along = |segment: usize| {
        let node = segment + shift;
        state.rope.position[node + 1] - state.rope.position[node]
    };
    let turn: f64 = (from..to).map(|segment| angle(along(segment), along(segment + 1))).sum();
    let tension_n = state.rope.tension[from..=to].iter().copied().fold(0.0, f64::max);
    let resultant: DVec3 =
        stretch.map(|contact| contact.normal * contact.normal_force_n + contact.friction_n).sum();
    tension_n * (turn + 2.0) + resultant.length()
}

/// Angle between two vectors [rad].
fn angle(one: DVec3, other: DVec3) -> f64 {
    libm::atan2(one.cross(other).length(), one.dot(other))
}
