//! Distance of a convex core with a curved side from segments and triangles, to rounding.
//!
//! With the core's nearest place `P(q)` to any place `q` in closed form:
//!
//! - Half the squared distance from the places `q(t) = a + t d` of a segment is convex in `t` with the derivative `(q - P(q))·d`, which rises:
//!   its root is bracketed and closed in on.
//! - The distance of the core from a triangle's plane is that of the core's lowest place over it. Where that lies over the triangle, it is the
//!   distance of the triangle; elsewhere an edge is nearest. Where the plane cuts the core, either an edge meets the core, or all that is
//!   cut lies within the triangle, and so does any one place of it.

use glam::DVec3;
use parry3d::shape::SupportMap;

use crate::geometry::distance::point_triangle;

/// Passes in which a root is closed in on; ten or so do.
const PASSES: usize = 80;
/// Shorter distances count as zero [m].
const NOTHING_M: f64 = 1e-12;

/// A closed convex set about its origin.
pub(crate) trait Convex: SupportMap {
    /// Its place that is nearest to another place of its frame: that itself where it lies within.
    fn nearest(&self, place: DVec3) -> DVec3;
}

/// The nearest places of a core and a segment, on the core and on the segment; one and the same where they meet.
pub(crate) fn nearest_to_segment(core: &impl Convex, [a, b]: [DVec3; 2]) -> [DVec3; 2] {
    let along = b - a;
    let slope = |share: f64| {
        let place = a + along * share;
        (place - core.nearest(place)).dot(along)
    };
    let place = a + along * root_of_rising(slope);
    [core.nearest(place), place]
}

/// Where between zero and one a function that rises passes zero; the end that is nearest to it where it does not.
///
/// False position, which halves the value kept where the same end stays (Dowell and Jarratt 1971, doi:10.1007/BF01934364), and bisection
/// where that has not halved the bracket in three passes.
fn root_of_rising(value: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    let (mut at_low, mut at_high) = (value(low), value(high));
    if at_low >= 0.0 {
        return low;
    }
    if at_high <= 0.0 {
        return high;
    }
    let (mut width, mut last) = (2.0, 0.0);
    for pass in 0..PASSES {
        let is_slow = pass % 3 == 2 && {
            let slow = high - low > 0.5 * width;
            width = high - low;
            slow
        };
        let between = low - at_low * (high - low) / (at_high - at_low);
        let at = if is_slow { 0.5 * (low + high) } else { between.clamp(low, high) };
        if at <= low || at >= high {
            return at;
        }
        let found = value(at);
        if found == 0.0 {
            return at;
        }
        if found < 0.0 {
            (low, at_low) = (at, found);
            at_high *= if last < 0.0 { 0.5 } else { 1.0 };
        } else {
            (high, at_high) = (at, found);
            at_low *= if last > 0.0 { 0.5 } else { 1.0 };
        }
        last = found;
        if high - low <= f64::EPSILON {
            break;
        }
    }
    0.5 * (low + high)
}

/// The nearest places of a core and a triangle: distance, place on the triangle, place on the core; `None` where they meet.
pub(crate) fn nearest_to_triangle(
    core: &impl Convex,
    corners: [DVec3; 3],
) -> Option<(f64, [f64; 3], DVec3)> {
    let [a, b, c] = corners;
    if let Some(normal) = (b - a).cross(c - a).try_normalize() {
        let sides = [normal, -normal].map(|side| core.local_support_point(side));
        let [above, below] = sides.map(|place| (place - a).dot(normal));
        let is_cut = above >= 0.0 && below <= 0.0;
        let (place, height) = if is_cut {
            (sides[1].lerp(sides[0], below / (below - above).min(-f64::MIN_POSITIVE)), 0.0)
        } else if below > 0.0 {
            (sides[1], below)
        } else {
            (sides[0], -above)
        };
        let (distance, barycentric) = point_triangle(place, corners);
        if distance <= height + NOTHING_M {
            return (!is_cut).then_some((distance, barycentric, place));
        }
    }
    let mut best = (f64::INFINITY, [1.0, 0.0, 0.0], a);
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        let [on_core, _] = nearest_to_segment(core, [corners[from], corners[to]]);
        let (distance, barycentric) = point_triangle(on_core, corners);
        if distance < best.0 {
            best = (distance, barycentric, on_core);
        }
    }
    (best.0 > NOTHING_M).then_some(best)
}
