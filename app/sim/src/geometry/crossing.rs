//! The audit: whether a moving segment meets a moving triangle, from the roots of coplanarity.
//!
//! Independent of the distance and sweep code on purpose: first contact of a segment and a triangle
//! is an end passing the face or the segment passing an edge, and either needs four moving points
//! in one plane, a cubic in time.

use glam::DVec3;

use crate::geometry::sweep::{SweptSegment, SweptTriangle};
use crate::whale::Bounds;

/// Slack on fractions and barycentric shares, so that a hit on a shared edge is not lost between neighbours.
const SLACK: f64 = 1e-9;

/// Halvings that take 0..1 to the rounding of 1.
const HALVINGS: usize = 53;
/// Growth of boxes, as a share of their size and over it [m], well above [`SLACK`].
const REACH: f64 = 1e-6;

/// A point that moves straight: start and displacement.
#[derive(Clone, Copy)]
struct Mover {
    start: DVec3,
    shift: DVec3,
}

impl Mover {
    fn between(start: DVec3, end: DVec3) -> Self {
        Self { start, shift: end - start }
    }

    fn at(self, time: f64) -> DVec3 {
        self.start + self.shift * time
    }

    fn from(self, other: Self) -> Self {
        Self { start: self.start - other.start, shift: self.shift - other.shift }
    }
}

/// First fraction of the move at which the segment and the triangle have a point in common, if any.
///
/// Both move straight from start to end. 0 where they already cross at the start.
pub fn first_meeting(segment: &SweptSegment, triangle: &SweptTriangle) -> Option<f64> {
    if !reach_each_other(segment, triangle) {
        return None;
    }
    if pierces(segment.at(0.0), triangle[0]) {
        return Some(0.0);
    }
    let rope = [Mover::between(segment.a0, segment.a1), Mover::between(segment.b0, segment.b1)];
    let skin = [0, 1, 2].map(|corner| Mover::between(triangle[0][corner], triangle[1][corner]));
    let mut first = f64::INFINITY;
    for end in rope {
        first = first.min(end_meets_face(end, skin));
    }
    for from in 0..3 {
        first = first.min(segment_meets_edge(rope, [skin[from], skin[(from + 1) % 3]]));
    }
    (first <= 1.0).then_some(first)
}

/// First fraction of the move at which two rope segments have a point in common, if any.
///
/// Both move straight from start to end.
pub fn first_crossing(one: &SweptSegment, other: &SweptSegment) -> Option<f64> {
    let [first, second] =
        [one, other].map(|swept| Bounds::around(&[swept.a0, swept.b0, swept.a1, swept.b1]));
    if !first.grown(REACH * (1.0 + second.longest())).meets(&second) {
        return None;
    }
    let [rope, edge] = [one, other]
        .map(|swept| [Mover::between(swept.a0, swept.a1), Mover::between(swept.b0, swept.b1)]);
    let first = segment_meets_edge(rope, edge);
    (first <= 1.0).then_some(first)
}

/// Whether the boxes around the two moves have a point in common.
fn reach_each_other(segment: &SweptSegment, triangle: &SweptTriangle) -> bool {
    let rope = Bounds::around(&[segment.a0, segment.b0, segment.a1, segment.b1]);
    let skin = Bounds::around(&triangle[0]).join(Bounds::around(&triangle[1]));
    rope.grown(REACH * (1.0 + skin.longest())).meets(&skin)
}

/// Whether a standing segment passes through a standing triangle (sign test of five volumes).
pub fn pierces([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
    let volume = |u: DVec3, v: DVec3, w: DVec3, x: DVec3| (v - u).cross(w - u).dot(x - u);
    if volume(a, b, c, p) * volume(a, b, c, q) > 0.0 {
        return false;
    }
    let sides = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)];
    let any = sides.iter().any(|&side| side != 0.0);
    any && (sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0))
}

/// First time a moving point lies on a moving triangle, or infinity.
fn end_meets_face(end: Mover, skin: [Mover; 3]) -> f64 {
    let cubic = Cubic::coplanar(skin[1].from(skin[0]), skin[2].from(skin[0]), end.from(skin[0]));
    cubic.first_root(|time| {
        let [a, b, c] = skin.map(|corner| corner.at(time));
        let normal = (b - a).cross(c - a);
        let point = end.at(time);
        let square = normal.length_squared();
        [(b, c), (c, a), (a, b)]
            .iter()
            .all(|&(from, to)| (to - from).cross(point - from).dot(normal) >= -SLACK * square)
    })
}

/// First time a moving segment meets a moving edge, or infinity.
fn segment_meets_edge(rope: [Mover; 2], edge: [Mover; 2]) -> f64 {
    let cubic =
        Cubic::coplanar(rope[1].from(rope[0]), edge[1].from(edge[0]), edge[0].from(rope[0]));
    cubic.first_root(|time| {
        let (u, v) = (rope[1].at(time) - rope[0].at(time), edge[1].at(time) - edge[0].at(time));
        let gap = edge[0].at(time) - rope[0].at(time);
        let normal = u.cross(v);
        let square = normal.length_squared();
        let within = |part: f64| part >= -SLACK * square && part <= (1.0 + SLACK) * square;
        square > 0.0 && within(gap.cross(v).dot(normal)) && within(gap.cross(u).dot(normal))
    })
}

/// A cubic in time, `c[0] + c[1] t + c[2] t² + c[3] t³`, and its rounding error.
struct Cubic {
    c: [f64; 4],
    noise: f64,
}

impl Cubic {
    /// Volume spanned by three moving vectors.
    fn coplanar(u: Mover, v: Mover, w: Mover) -> Self {
        let cross = [
            u.start.cross(v.start),
            u.start.cross(v.shift) + u.shift.cross(v.start),
            u.shift.cross(v.shift),
        ];
        let c = [
            cross[0].dot(w.start),
            cross[0].dot(w.shift) + cross[1].dot(w.start),
            cross[1].dot(w.shift) + cross[2].dot(w.start),
            cross[2].dot(w.shift),
        ];
        let size = |mover: Mover| mover.start.length() + mover.shift.length();
        Self { c, noise: 1e-15 * size(u) * size(v) * size(w) }
    }

    fn at(&self, t: f64) -> f64 {
        ((self.c[3] * t + self.c[2]) * t + self.c[1]) * t + self.c[0]
    }

    /// Times in 0..1 between which the cubic rises or falls throughout, ends included.
    fn turns(&self) -> ([f64; 4], usize) {
        let mut times = [0.0; 4];
        let mut count = 1;
        let (a, half, c) = (3.0 * self.c[3], self.c[2], self.c[1]);
        let root = (half * half - a * c).max(0.0).sqrt();
        let far = -(half + root.copysign(half));
        let mut inner = [far / a, c / far];
        if inner[0] > inner[1] {
            inner.swap(0, 1);
        }
        for time in inner {
            if time > 0.0 && time < 1.0 {
                times[count] = time;
                count += 1;
            }
        }
        times[count] = 1.0;
        (times, count + 1)
    }

    /// First root in 0..1 that `holds` accepts, or infinity; where the cubic only grazes zero counts too.
    fn first_root(&self, holds: impl Fn(f64) -> bool) -> f64 {
        let (times, count) = self.turns();
        for pair in times[..count].windows(2) {
            let (low, high) = (self.at(pair[0]), self.at(pair[1]));
            if low.abs() <= self.noise && holds(pair[0]) {
                return pair[0];
            }
            if low * high < 0.0 {
                let time = self.bisect(pair[0], pair[1]);
                if holds(time) {
                    return time;
                }
            }
            if high.abs() <= self.noise && holds(pair[1]) {
                return pair[1];
            }
        }
        f64::INFINITY
    }

    /// The root between two times of opposite sign, to the rounding of times in 0..1.
    fn bisect(&self, mut low: f64, mut high: f64) -> f64 {
        let rising = self.at(low) < 0.0;
        for _ in 0..HALVINGS {
            let middle = low + (high - low) / 2.0;
            if (self.at(middle) < 0.0) == rising { low = middle } else { high = middle }
        }
        high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: [DVec3; 3] =
        [DVec3::new(0.0, 0.0, 0.0), DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.0, 1.0, 0.0)];

    fn meeting(start: [[f64; 3]; 2], end: [[f64; 3]; 2]) -> Option<f64> {
        let [a0, b0] = start.map(DVec3::from);
        let [a1, b1] = end.map(DVec3::from);
        first_meeting(&SweptSegment { a0, b0, a1, b1 }, &[FLAT, FLAT])
    }

    /// A segment that falls end first meets the face at the time its lower end reaches it.
    #[test]
    fn an_end_meets_the_face() {
        let time =
            meeting([[0.2, 0.2, 0.3], [0.2, 0.2, 0.9]], [[0.2, 0.2, -0.7], [0.2, 0.2, -0.1]]);
        assert!((time.unwrap() - 0.3).abs() < 1e-12);
    }

    /// A standing segment swept sideways meets the edge y = 0 a quarter of the way.
    #[test]
    fn a_segment_meets_an_edge() {
        let time =
            meeting([[0.4, -0.1, -1.0], [0.4, -0.1, 1.0]], [[0.4, 0.3, -1.0], [0.4, 0.3, 1.0]]);
        assert!((time.unwrap() - 0.25).abs() < 1e-12);
    }

    #[test]
    fn a_miss_is_a_miss() {
        assert_eq!(
            meeting([[0.8, 0.8, 0.3], [0.9, 0.8, 0.9]], [[0.8, 0.8, -0.7], [0.9, 0.8, -0.1]]),
            None
        );
        assert_eq!(
            meeting([[0.2, 0.2, 0.3], [0.3, 0.2, 0.3]], [[0.2, 0.2, 0.1], [0.3, 0.2, 0.1]]),
            None
        );
    }

    /// In and out again within one move: both ends of the move are clear, the meeting is not.
    #[test]
    fn a_turning_edge_that_passes_and_returns_is_seen() {
        let segment = SweptSegment {
            a0: DVec3::new(-0.5, 0.3, 0.2),
            b0: DVec3::new(0.5, 0.3, 0.2),
            a1: DVec3::new(0.5, 0.3, 0.2),
            b1: DVec3::new(1.5, 0.3, 0.2),
        };
        let lifted = FLAT.map(|corner| corner + DVec3::Z * 0.4);
        let time = first_meeting(&segment, &[FLAT, lifted]);
        assert!((time.unwrap() - 0.5).abs() < 1e-12, "{time:?}");
    }

    #[test]
    fn a_crossed_start_is_at_once() {
        assert_eq!(
            meeting([[0.2, 0.2, 0.3], [0.2, 0.2, -0.3]], [[0.2, 0.2, 0.3], [0.2, 0.2, -0.3]]),
            Some(0.0)
        );
    }
}
