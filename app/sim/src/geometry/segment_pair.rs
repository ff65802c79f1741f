//! How far two rope segments may move before the distance of their centre lines falls below a limit.
//!
//! Additive continuous collision detection (Li et al. 2021), as in `geometry/sweep.rs`: steps of time that distance and
//! greatest possible approach prove safe.

use glam::DVec3;

use crate::geometry::distance::segment_segment;
use crate::geometry::sweep::{SweptSegment, walk};

/// Where two segments are nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nearest {
    /// Fraction along each.
    pub fractions: [f64; 2],
    /// Distance [m].
    pub distance: f64,
}

/// Where two standing segments are nearest.
pub(crate) fn nearest(one: [DVec3; 2], other: [DVec3; 2]) -> Nearest {
    let (s, t) = segment_segment(one, other);
    Nearest {
        fractions: [s, t],
        distance: one[0].lerp(one[1], s).distance(other[0].lerp(other[1], t)),
    }
}

/// No distance between the two can shrink by more than this over the move [m].
pub(crate) fn greatest_approach(one: &SweptSegment, other: &SweptSegment) -> f64 {
    let [a, b, c, d] = [one.a1 - one.a0, one.b1 - one.b0, other.a1 - other.a0, other.b1 - other.b0];
    let shared = (a + b + c + d) / 4.0;
    let most = |first: DVec3, second: DVec3| {
        (first - shared).length_squared().max((second - shared).length_squared()).sqrt()
    };
    most(a, b) + most(c, d)
}

/// The largest proved fraction of the move, 1 for all of it, along which the centre lines stay farther apart than `separation`,
/// where they are `first` apart to begin with (or more); a pair nearer than twice that is asked for half its first distance.
pub(crate) fn safe_fraction(
    one: &SweptSegment,
    other: &SweptSegment,
    separation: f64,
    first: f64,
) -> f64 {
    walk(first, separation.min(first / 2.0), greatest_approach(one, other), |at| {
        nearest(one.at(at), other.at(at)).distance
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A level segment along x that falls on one along y at height zero.
    fn falling(from: f64, to: f64) -> [SweptSegment; 2] {
        let at = |z: f64| [DVec3::new(-0.5, 0.0, z), DVec3::new(0.4, 0.1, z)];
        let ([a0, b0], [a1, b1]) = (at(from), at(to));
        let (a, b) = (DVec3::new(0.0, -0.3, 0.0), DVec3::new(0.0, 0.7, 0.0));
        [SweptSegment { a0, b0, a1, b1 }, SweptSegment { a0: a, b0: b, a1: a, b1: b }]
    }

    #[test]
    fn a_falling_segment_stops_above_the_other() {
        let (from, to, separation) = (0.5, -0.5, 0.001);
        let [one, other] = falling(from, to);
        let safe = safe_fraction(&one, &other, separation, from);
        let touch = (from - separation) / (from - to);
        assert!(safe < touch && safe > touch * 0.85, "{safe} against {touch}");
    }

    #[test]
    fn what_moves_away_together_or_not_at_all_is_free() {
        for (from, to) in [(0.5, 0.6), (0.5, 0.5), (0.01, 0.01)] {
            let [mut one, mut other] = falling(from, to);
            for end in [&mut one.a1, &mut one.b1, &mut other.a1, &mut other.b1] {
                *end += DVec3::new(30.0, -7.0, 100.0);
            }
            assert_eq!(safe_fraction(&one, &other, 0.001, from).to_bits(), 1.0_f64.to_bits());
        }
    }
}
