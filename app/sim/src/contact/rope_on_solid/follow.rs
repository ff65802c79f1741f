//! Contact points within a segment follow the nearest points of a solid in the first passes of a step.

use glam::DVec3;

use crate::contact::rope_on_solid::points::SolidContactPoint;
use crate::contact::rope_on_solid::{MARGIN_M, Pair, RopeOnSolid};
use crate::geometry::Pose;
use crate::geometry::along::nearest_stretch;
use crate::geometry::shape::SolidShape;
use crate::solids::{Carrier, Solid};
use crate::state::State;

/// Stretch along a flat face from which on rope bears at both of its ends [m].
const TWO_POINTS_M: f64 = 0.02;
/// Passes in which contact points within segments follow the nearest point.
const FOLLOWING_PASSES: usize = 4;

impl RopeOnSolid {
    /// Lets the contact points within segments follow the nearest points, in the first passes of a step.
    pub fn follow_all(&mut self, state: &State, places: &[DVec3], pose: impl Fn(&Carrier) -> Pose) {
        self.passes += 1;
        if self.passes > FOLLOWING_PASSES {
            return;
        }
        let mut pairs = std::mem::take(&mut self.pairs);
        for pair in &mut pairs {
            let solid = &self.solids[pair.solid];
            let pose = pose(&solid.carrier);
            self.follow(state, solid, pair, [places[pair.node], places[pair.node + 1]], &pose);
        }
        self.pairs = pairs;
    }

    pub(crate) fn follow(
        &self,
        state: &State,
        solid: &Solid,
        pair: &mut Pair,
        places: [DVec3; 2],
        pose: &Pose,
    ) {
        let fractions = self.inner_points(solid, pair, places, pose);
        for (point, fraction) in pair.inner.iter_mut().zip(fractions) {
            let was_open = point.open;
            point.open = fraction.is_some();
            if fraction.is_some() {
                point.fraction = fraction;
            }
            if point.open && !was_open {
                *point = self.regrip(
                    state,
                    solid,
                    SolidContactPoint { predicted_n: 0.0, kept: DVec3::ZERO, ..*point },
                );
            }
        }
    }

    /// Fractions of a segment at which it touches a solid between its nodes.
    fn inner_points(
        &self,
        solid: &Solid,
        pair: &Pair,
        [a, b]: [DVec3; 2],
        pose: &Pose,
    ) -> [Option<f64>; 2] {
        let length = self.length_of(pair.node);
        let (low, high) = pair.range;
        if low >= high || solid.radius_m.is_infinite() {
            return [None; 2];
        }
        let (a, b) = (pose.inward(a), pose.inward(b));
        if solid.shape.least_bend_radius(a, b) >= length {
            return [None; 2];
        }
        if least_by_tangents(&solid.shape, a, b)
            > self.radius_m[pair.line] + self.margin_m.min(MARGIN_M)
        {
            return [None; 2];
        }
        let distance = |at: f64| solid.shape.distance(a.lerp(b, at));
        let stretch = nearest_stretch(distance, pair.range, TWO_POINTS_M / length);
        if solid.shape.bend_radius(a.lerp(b, stretch.at)) >= length {
            return [None; 2];
        }
        let within = |at: f64| (at > low + 1e-6 && at < high - 1e-6).then_some(at);
        let (first, last) = stretch.ends;
        if (last - first) * length > TWO_POINTS_M {
            [within(first), within(last)]
        } else {
            [within(stretch.at), None]
        }
    }
}

/// No more than the least distance between two places from a convex shape, by the tangents there: `max(d_a + g_a t, d_b - g_b (1 - t))`.
fn least_by_tangents(shape: &SolidShape, a: DVec3, b: DVec3) -> f64 {
    let (at_a, at_b) = (shape.nearest(a), shape.nearest(b));
    let (down, up) = (at_a.normal.dot(b - a), at_b.normal.dot(b - a));
    if down >= 0.0 {
        return at_a.distance;
    }
    if up <= 0.0 {
        return at_b.distance;
    }
    // Where the two tangents meet.
    let t = ((at_b.distance - up - at_a.distance) / (down - up)).clamp(0.0, 1.0);
    (at_a.distance + down * t).min(at_b.distance - up * (1.0 - t))
}
