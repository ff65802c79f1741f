//! The points at which two segments may press on each other.

use glam::{DMat3, DVec3};

use crate::geometry::segment_pair::nearest;

/// Stretch that two segments share, as a share of their contact distance, from which on two points bear.
const STRETCH_SHARE: f64 = 1.0;
/// Difference of distance at the ends of the stretch, as a share of the contact distance, up to which both bear.
const LEVEL_SHARE: f64 = 0.15;
/// Least sine of the angle between ropes that cross, for the length over which they bear.
const LEAST_SINE: f64 = 0.25;

/// A point of a pair of segments.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct RopeContactPoint {
    /// Fraction along each segment.
    pub fractions: [f64; 2],
    /// Whether it is where the two are nearest, and not at a fixed place of the first.
    pub is_nearest: bool,
    /// Length over which the ropes bear on each other here [m].
    pub length: f64,
    /// Stretch of the grip when the step began [m].
    pub kept: DVec3,
    /// Depth that is forgiven [m].
    pub forgiven_m: f64,
    /// Normal force that the last solution found [N].
    pub solved_n: Option<f64>,
    /// Push and friction on the first rope where it was assembled last, and `-d force / d move` [N], [N/m].
    pub force: DVec3,
    /// Direction of the push there.
    pub normal: DVec3,
    pub block: DMat3,
    /// Push and friction by the last solution [N].
    pub solved: DVec3,
}

/// The one or two points of a pair at these places, for a contact distance `contact_distance`; the second has no length where there is one,
/// as there always is for an `only` point.
///
/// Near the end of a segment the neighbour bears part of a crossing: each has the part of the bearing length that is on it.
pub(crate) fn points_of(
    one: [DVec3; 2],
    other: [DVec3; 2],
    contact_distance: f64,
    only: bool,
) -> [RopeContactPoint; 2] {
    let near = nearest(one, other);
    let (u, v) = (one[1] - one[0], other[1] - other[0]);
    let (long, sine) = (u.length(), u.cross(v).length() / (u.length() * v.length()).max(1e-30));
    let share =
        |place: DVec3| ((place - one[0]).dot(u) / u.length_squared().max(1e-30)).clamp(0.0, 1.0);
    let (from, to) = (share(other[0]), share(other[1]));
    let (low, high) = (from.min(to), from.max(to));
    let stretch = (high - low) * long;
    let point = |s: f64| {
        let place = one[0].lerp(one[1], s);
        let closest = nearest([place, place], other);
        (
            closest.distance,
            RopeContactPoint {
                fractions: [s, closest.fractions[1]],
                length: 0.5 * stretch,
                ..RopeContactPoint::default()
            },
        )
    };
    if stretch > STRETCH_SHARE * contact_distance && !only {
        let (ends, level) =
            ([point(low), point(high)], near.distance + LEVEL_SHARE * contact_distance);
        if ends.iter().all(|(distance, _)| *distance < level) {
            return ends.map(|(_, point)| point);
        }
    }
    let whole = contact_distance / sine.max(LEAST_SINE);
    let length = whole
        * share_within(near.fractions[0], whole / long)
        * share_within(near.fractions[1], whole / v.length());
    let single = RopeContactPoint {
        fractions: near.fractions,
        is_nearest: true,
        length,
        ..RopeContactPoint::default()
    };
    [single, RopeContactPoint::default()]
}

/// The point of a knot's ball at a fraction of the first segment: against the second, or against another ball at a fraction of that,
/// with middles and ends at these places. A knot bears as rope does that crosses at a right angle.
pub(crate) fn point_of_ball(
    [one, other]: [[DVec3; 2]; 2],
    [at, other_at]: [Option<f64>; 2],
    contact_distance: f64,
) -> RopeContactPoint {
    let near = nearest(one, other).fractions[1];
    let stretch = contact_distance / other[0].distance(other[1]).max(1e-30);
    let borne = if other_at.is_some() { 1.0 } else { share_within(near, stretch) };
    RopeContactPoint {
        fractions: [at.unwrap_or(0.0), other_at.unwrap_or(near)],
        length: contact_distance * borne,
        ..RopeContactPoint::default()
    }
}

/// How much of a stretch about a fraction of a segment lies within the segment, both as shares of its length.
fn share_within(at: f64, stretch: f64) -> f64 {
    let half = 0.5 * stretch.min(1.0);
    ((at + half).min(1.0) - (at - half).max(0.0)) / (2.0 * half)
}

impl RopeContactPoint {
    /// Its fractions with the segments at other places, where it follows them.
    pub fn followed(&self, one: [DVec3; 2], other: [DVec3; 2]) -> [f64; 2] {
        if self.is_nearest {
            return nearest(one, other).fractions;
        }
        let place = one[0].lerp(one[1], self.fractions[0]);
        [self.fractions[0], nearest([place, place], other).fractions[1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along_x(length: f64, height: f64) -> [DVec3; 2] {
        [DVec3::new(0.0, 0.0, height), DVec3::new(length, 0.0, height)]
    }

    #[test]
    fn ropes_that_cross_bear_at_one_point() {
        let other = [DVec3::new(0.03, -0.05, 0.0), DVec3::new(0.03, 0.02, 0.0)];
        let [point, none] = points_of(along_x(0.1, 0.009), other, 0.01, false);
        assert!(point.is_nearest && none.length == 0.0);
        assert!(
            (point.fractions[0] - 0.3).abs() < 1e-12
                && (point.fractions[1] - 5.0 / 7.0).abs() < 1e-12
        );
        assert!((point.length - 0.01).abs() < 1e-12);
    }

    #[test]
    fn ropes_side_by_side_bear_at_both_ends_of_what_they_share() {
        let other = [DVec3::new(0.14, 0.0, 0.0), DVec3::new(0.04, 0.0, 0.0005)];
        let points = points_of(along_x(0.1, 0.009), other, 0.01, false);
        assert!(
            (points[0].fractions[0] - 0.4).abs() < 1e-12
                && (points[1].fractions[0] - 1.0).abs() < 1e-12
        );
        assert!(
            (points[0].fractions[1] - 1.0).abs() < 1e-3
                && (points[1].fractions[1] - 0.4).abs() < 1e-3
        );
        assert!(points.iter().all(|point| (point.length - 0.03).abs() < 1e-12));
    }

    /// Over a node where two segments meet, both together bear as one does in its middle.
    #[test]
    fn what_crosses_at_a_node_is_borne_once() {
        let other = |x: f64| [DVec3::new(x, -0.05, 0.0), DVec3::new(x, 0.05, 0.0)];
        let length = |x: f64| {
            let ahead = along_x(0.1, 0.009);
            let behind = [DVec3::new(-0.1, 0.0, 0.009), ahead[0]];
            points_of(ahead, other(x), 0.01, false)[0].length
                + points_of(behind, other(x), 0.01, false)[0].length
        };
        assert!(
            (length(0.0) - 0.01).abs() < 1e-12 && (length(0.05) - 0.015).abs() < 1e-12,
            "{} {}",
            length(0.0),
            length(0.05)
        );
    }
}
