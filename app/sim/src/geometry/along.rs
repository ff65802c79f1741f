//! Where a segment of rope is nearest to a solid.
//!
//! The distance from a convex shape along a straight segment is a convex function of the fraction along it: its least
//! value is found by golden section, and where the segment lies along a flat face, the two ends of the stretch that is
//! as near as that by bisection: there rope bears on an edge.

/// Golden section: `(√5 - 1)/2`.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Halvings of golden section and bisection.
const PASSES: usize = 26;
/// Distances that differ by less count as equal [m].
const AS_NEAR_M: f64 = 3e-4;

/// The stretch of a segment that is nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NearestStretch {
    /// Fraction at which it is nearest.
    pub at: f64,
    /// First and last fraction that is as near as that.
    pub ends: (f64, f64),
}

/// Where a convex `distance` is least between two fractions. If the interval of least distance is shorter than `shortest`, only that place is returned.
pub(crate) fn nearest_stretch(
    distance: impl Fn(f64) -> f64,
    (first, last): (f64, f64),
    shortest: f64,
) -> NearestStretch {
    let (at, least) = golden(&distance, first, last);
    let level = least + AS_NEAR_M;
    // By convexity the stretch ends before any fraction at which it is not as near.
    let ends_by = |at: f64| !(first..=last).contains(&at) || distance(at) > level;
    if ends_by(at - 0.5 * shortest) && ends_by(at + 0.5 * shortest) {
        return NearestStretch { at, ends: (at, at) };
    }
    let low = cross(&distance, at, first, level);
    let high = cross(&distance, at, last, level);
    NearestStretch { at, ends: (low, high) }
}

/// The least distance between two fractions.
pub(crate) fn least(distance: impl Fn(f64) -> f64, (first, last): (f64, f64)) -> f64 {
    golden(&distance, first, last).1
}

fn golden(distance: &impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> (f64, f64) {
    let (mut left, mut right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_left, mut at_right) = (distance(left), distance(right));
    for _ in 0..PASSES {
        if at_left <= at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - GOLDEN * (high - low);
            at_left = distance(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + GOLDEN * (high - low);
            at_right = distance(right);
        }
    }
    let at = 0.5 * (low + high);
    (at, distance(at))
}

/// The fraction between `inside`, where the distance is below a level, and `end` where it reaches it; `end` if it does not.
fn cross(distance: &impl Fn(f64) -> f64, mut inside: f64, end: f64, level: f64) -> f64 {
    let mut outside = end;
    if distance(end) <= level {
        return end;
    }
    for _ in 0..PASSES {
        let middle = 0.5 * (inside + outside);
        if distance(middle) <= level {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::geometry::shape::SolidShape;

    #[test]
    fn rope_across_a_box_bears_on_both_edges() {
        let shape = SolidShape::Box(DVec3::new(0.25, 1.0, 0.1));
        let (from, to) = (DVec3::new(-1.0, 0.0, 0.104), DVec3::new(1.0, 0.0, 0.104));
        let stretch = nearest_stretch(|at| shape.distance(from.lerp(to, at)), (0.0, 1.0), 0.0);
        assert!(
            (stretch.ends.0 - 0.375).abs() < 2e-3 && (stretch.ends.1 - 0.625).abs() < 2e-3,
            "{stretch:?}"
        );
    }

    #[test]
    fn rope_past_a_post_is_nearest_at_one_point() {
        let shape = SolidShape::Cylinder { radius_m: 0.05, half_length_m: 1.0 };
        let (from, to) = (DVec3::new(-0.5, 0.06, 0.0), DVec3::new(0.3, 0.06, 0.1));
        let stretch = nearest_stretch(|at| shape.distance(from.lerp(to, at)), (0.0, 1.0), 0.0);
        assert!((stretch.at - 0.625).abs() < 1e-3, "{stretch:?}");
    }
}
