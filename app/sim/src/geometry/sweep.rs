//! How far a rope segment and a skin triangle may move before their distance falls below a limit.
//!
//! Additive continuous collision detection (Li et al. 2021): steps of time that distance and
//! greatest possible approach prove safe, so that a path cut short here never crosses the skin.

use glam::DVec3;

use crate::geometry::distance::segment_triangle;

/// A rope segment over one move: both ends go straight from start to end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SweptSegment {
    /// First end at the start [m].
    pub a0: DVec3,
    /// Second end at the start [m].
    pub b0: DVec3,
    /// First end at the end [m].
    pub a1: DVec3,
    /// Second end at the end [m].
    pub b1: DVec3,
}

impl SweptSegment {
    /// The segment at a fraction of the move, 0 at the start.
    pub fn at(&self, fraction: f64) -> [DVec3; 2] {
        [self.a0.lerp(self.a1, fraction), self.b0.lerp(self.b1, fraction)]
    }
}

/// A triangle over one move: corners at the start and at the end [m].
pub type SweptTriangle = [[DVec3; 3]; 2];

/// The search stops once this share of the first gap is left.
const STOP_AT_SHARE: f64 = 0.1;
/// Largest number of time steps of the search; it then returns what it has proved.
const MOST_STEPS: usize = 100;

/// Squared area over squared edge lengths below which a triangle's normal is not trusted.
const NEEDLE: f64 = 1e-16;

/// The largest proved fraction of the move, 1 for all of it, along which the centre line stays
/// farther than `separation` from the triangle; a pair that starts nearer than twice that is asked
/// for half its first distance, and a pair that starts crossed gets 0.
pub fn safe_fraction(segment: &SweptSegment, triangle: &SweptTriangle, separation: f64) -> f64 {
    let approach = greatest_approach(segment, triangle);
    if height(segment.at(0.0), triangle[0]) > separation + approach {
        return 1.0;
    }
    let first = segment_triangle(segment.at(0.0), triangle[0]).distance;
    advance(segment, triangle, separation, first, approach)
}

/// Height of a segment over a triangle's plane, 0 where it reaches through: no more than their distance.
fn height(segment: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> f64 {
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let square = normal.length_squared();
    let [from, to] = segment.map(|end| (end - a).dot(normal));
    let plain = from * to > 0.0 && square > NEEDLE * ab.length_squared() * ac.length_squared();
    if plain { from.abs().min(to.abs()) / square.sqrt() } else { 0.0 }
}

/// As [`safe_fraction`] where the first distance, or a lower bound of it, is known.
pub fn safe_fraction_from(
    segment: &SweptSegment,
    triangle: &SweptTriangle,
    separation: f64,
    first: f64,
) -> f64 {
    advance(segment, triangle, separation, first, greatest_approach(segment, triangle))
}

/// The walk from a first distance that keeps the separation, or half that distance where it is less.
fn advance(
    segment: &SweptSegment,
    triangle: &SweptTriangle,
    separation: f64,
    first: f64,
    approach: f64,
) -> f64 {
    walk(first, separation.min(first / 2.0), approach, |at| {
        segment_triangle(segment.at(at), triangle_at(triangle, at)).distance
    })
}

/// Steps of time that the distance left and the greatest possible approach prove safe: the largest proved fraction of a move along
/// which two things that are `first` apart to begin with (or more) stay farther apart than `keep`, by their distance at a fraction.
pub(crate) fn walk(first: f64, keep: f64, approach: f64, distance: impl Fn(f64) -> f64) -> f64 {
    if first - keep > approach {
        return 1.0;
    }
    let stop = STOP_AT_SHARE * (first - keep);
    let mut safe = 0.0;
    let mut step = (1.0 - STOP_AT_SHARE) * (first - keep) / approach;
    for _ in 0..MOST_STEPS {
        let next = safe + step;
        if next >= 1.0 {
            return 1.0;
        }
        let gap = distance(next) - keep;
        if safe > 0.0 && gap < stop {
            return safe;
        }
        safe = next;
        step = (1.0 - STOP_AT_SHARE) * gap / approach;
    }
    safe
}

/// No distance between the two can shrink by more than this over the move [m].
pub fn greatest_approach(segment: &SweptSegment, triangle: &SweptTriangle) -> f64 {
    let rope = [segment.a1 - segment.a0, segment.b1 - segment.b0];
    let skin = [0, 1, 2].map(|corner| triangle[1][corner] - triangle[0][corner]);
    let shared = (rope[0] + rope[1]) / 4.0 + (skin[0] + skin[1] + skin[2]) / 6.0;
    let most = |moves: &[DVec3]| {
        moves.iter().map(|step| (*step - shared).length_squared()).fold(0.0, f64::max).sqrt()
    };
    most(&rope) + most(&skin)
}

/// The triangle at a fraction of the move.
#[inline(always)]
pub fn triangle_at(triangle: &SweptTriangle, fraction: f64) -> [DVec3; 3] {
    [0, 1, 2].map(|corner| triangle[0][corner].lerp(triangle[1][corner], fraction))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: [DVec3; 3] =
        [DVec3::new(0.0, 0.0, 0.0), DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.0, 1.0, 0.0)];

    fn falling(from: f64, to: f64) -> SweptSegment {
        let at = |x: f64, z: f64| DVec3::new(x, 0.2, z);
        SweptSegment { a0: at(0.1, from), b0: at(0.6, from), a1: at(0.1, to), b1: at(0.6, to) }
    }

    /// A level segment that falls on a level triangle: the touch is known in closed form.
    #[test]
    fn a_falling_segment_stops_above_the_face() {
        let (from, to, separation) = (0.5, -0.5, 0.001);
        let safe = safe_fraction(&falling(from, to), &[FLAT, FLAT], separation);
        let touch = (from - separation) / (from - to);
        assert!(safe < touch && safe > touch * 0.85, "{safe} against {touch}");
    }

    #[test]
    fn what_moves_away_or_stays_is_free() {
        assert_eq!(
            safe_fraction(&falling(0.5, 0.6), &[FLAT, FLAT], 0.001).to_bits(),
            1.0_f64.to_bits()
        );
        assert_eq!(
            safe_fraction(&falling(0.5, 0.5), &[FLAT, FLAT], 0.001).to_bits(),
            1.0_f64.to_bits()
        );
    }

    /// Moving both by the same displacement approaches nothing, however far it is.
    #[test]
    fn a_shared_move_is_free() {
        let mut segment = falling(0.01, 0.01);
        let far = DVec3::new(30.0, -7.0, 100.0);
        segment.a1 += far;
        segment.b1 += far;
        let safe = safe_fraction(&segment, &[FLAT, FLAT.map(|corner| corner + far)], 0.001);
        assert_eq!(safe.to_bits(), 1.0_f64.to_bits());
    }

    #[test]
    fn a_crossed_pair_may_not_move() {
        let crossed = SweptSegment {
            a0: DVec3::new(0.2, 0.2, 0.1),
            b0: DVec3::new(0.2, 0.2, -0.1),
            a1: DVec3::new(0.4, 0.2, 0.1),
            b1: DVec3::new(0.4, 0.2, -0.1),
        };
        assert_eq!(safe_fraction(&crossed, &[FLAT, FLAT], 0.001).to_bits(), 0.0_f64.to_bits());
    }

    /// A pair that starts nearer than the separation can still slide along and leave.
    #[test]
    fn a_near_pair_is_not_stuck() {
        let safe = safe_fraction(&falling(0.000_5, 0.01), &[FLAT, FLAT], 0.001);
        assert!(safe > 0.01, "{safe}");
    }
}
