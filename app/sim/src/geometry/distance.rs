//! Distance of a rope segment's centre line from a skin triangle: unsigned, 0 where they cross.
//!
//! Nothing here distinguishes inside from outside, so thin edges need no special case.
//! A segment or triangle that has shrunk to a line or a point is measured as such.

use glam::DVec3;

/// Where a segment and a triangle are nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Distance, 0 where they cross [m].
    pub distance: f64,
    /// Place on the segment, 0 at its first end, 1 at its second.
    pub fraction: f64,
    /// Place on the triangle; each in 0 to 1, summing to 1.
    pub barycentric: [f64; 3],
}

/// Squared area over squared edge lengths below which a triangle counts as a line.
const FLAT: f64 = 1e-24;

/// Edges in the order of the corners opposite.
const EDGES: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

/// Barycentric share above which a place is inside an edge for certain.
const SURELY_INSIDE: f64 = 1e-9;

/// Nearest places of a segment and a triangle.
///
/// An edge, or either of its corners, can be nearest to the segment only where the segment reaches beyond that edge;
/// the other edges are left out.
pub fn segment_triangle(segment: [DVec3; 2], triangle: [DVec3; 3]) -> Nearest {
    segment_triangle_in(Plane::of(triangle).as_ref(), segment, &triangle)
}

/// The nearest places of a segment and a triangle whose plane is precomputed.
#[inline(always)]
pub(crate) fn segment_triangle_in(
    plane: Option<&Plane>,
    segment: [DVec3; 2],
    triangle: &[DVec3; 3],
) -> Nearest {
    let Some(plane) = plane else {
        return nearest_of_edges(segment, triangle, [true; 3]);
    };
    let ends = segment.map(|end| plane.place(end));
    if let Some(crossing) = crossing(ends) {
        return crossing;
    }
    let beyond =
        [0, 1, 2].map(|corner| ends.iter().any(|(_, place)| place[corner] < SURELY_INSIDE));
    let mut best = nearest_of_edges(segment, triangle, beyond);
    for ((height, barycentric), fraction) in ends.into_iter().zip([0.0, 1.0]) {
        if height.abs() < best.distance && inside(barycentric) {
            best = Nearest { distance: height.abs(), fraction, barycentric };
        }
    }
    best
}

/// Nearest place on a triangle to a point: distance and barycentric place.
pub fn point_triangle(point: DVec3, triangle: [DVec3; 3]) -> (f64, [f64; 3]) {
    point_triangle_in(Plane::of(triangle).as_ref(), point, &triangle, f64::INFINITY)
        .unwrap_or((f64::INFINITY, [1.0, 0.0, 0.0]))
}

/// Distance of a point from a triangle whose plane is precomputed, and the barycentric place nearest to it; `None`
/// where the distance is certainly `most` or more.
#[inline(always)]
pub(crate) fn point_triangle_in(
    plane: Option<&Plane>,
    point: DVec3,
    triangle: &[DVec3; 3],
    most: f64,
) -> Option<(f64, [f64; 3])> {
    let mut beyond = [true; 3];
    if let Some(plane) = plane {
        let from = point - plane.corner;
        let height = from.dot(plane.normal);
        if height.abs() >= most {
            return None;
        }
        let barycentric = plane.barycentric(from);
        if inside(barycentric) {
            return Some((height.abs(), barycentric));
        }
        beyond = barycentric.map(|share| share < SURELY_INSIDE);
    }
    Some(nearest_edge(point, triangle, beyond))
}

/// The nearest place to a point on a set of edges, each named by the corner opposite.
#[inline(always)]
fn nearest_edge(point: DVec3, triangle: &[DVec3; 3], wanted: [bool; 3]) -> (f64, [f64; 3]) {
    let (mut least, mut barycentric) = (f64::INFINITY, [1.0, 0.0, 0.0]);
    for (opposite, [from, to]) in EDGES.into_iter().enumerate() {
        if !wanted[opposite] {
            continue;
        }
        let (along, out) = (triangle[to] - triangle[from], point - triangle[from]);
        let t = share(along.dot(out), along.length_squared());
        let square = (point - triangle[from].lerp(triangle[to], t)).length_squared();
        if square < least {
            least = square;
            barycentric = [0.0; 3];
            barycentric[from] = 1.0 - t;
            barycentric[to] = t;
        }
    }
    (least.sqrt(), barycentric)
}

/// Nearest places on two segments, as fractions along each.
pub fn segment_segment(first: [DVec3; 2], second: [DVec3; 2]) -> (f64, f64) {
    segment_segment_in(first, second)
}

#[inline(always)]
fn segment_segment_in(first: [DVec3; 2], second: [DVec3; 2]) -> (f64, f64) {
    let (u, v, w) = (first[1] - first[0], second[1] - second[0], first[0] - second[0]);
    let (uu, vv) = (u.length_squared(), v.length_squared());
    let (uv, uw, vw) = (u.dot(v), u.dot(w), v.dot(w));
    if uu <= f64::MIN_POSITIVE {
        return (0.0, share(vw, vv));
    }
    if vv <= f64::MIN_POSITIVE {
        return (share(-uw, uu), 0.0);
    }
    let skew = uu * vv - uv * uv;
    let s = if skew > 0.0 { share(uv * vw - uw * vv, skew) } else { 0.0 };
    let t = (uv * s + vw) / vv;
    if t < 0.0 {
        (share(-uw, uu), 0.0)
    } else if t > 1.0 {
        (share(uv - uw, uu), 1.0)
    } else {
        (s, t)
    }
}

/// A ratio held to 0..1, 0 where the whole is nothing.
fn share(part: f64, whole: f64) -> f64 {
    if whole <= f64::MIN_POSITIVE { 0.0 } else { (part / whole).clamp(0.0, 1.0) }
}

/// The nearest of a set of edges, each named by the corner opposite; infinite distance if the set is empty.
#[inline(always)]
fn nearest_of_edges(segment: [DVec3; 2], triangle: &[DVec3; 3], wanted: [bool; 3]) -> Nearest {
    let mut best = Nearest { distance: f64::INFINITY, fraction: 0.0, barycentric: [1.0, 0.0, 0.0] };
    let mut least = f64::INFINITY;
    for (opposite, [from, to]) in EDGES.into_iter().enumerate() {
        if !wanted[opposite] {
            continue;
        }
        let (s, t) = segment_segment_in(segment, [triangle[from], triangle[to]]);
        let gap = segment[0].lerp(segment[1], s) - triangle[from].lerp(triangle[to], t);
        if gap.length_squared() < least {
            least = gap.length_squared();
            best.fraction = s;
            best.barycentric = [0.0; 3];
            best.barycentric[from] = 1.0 - t;
            best.barycentric[to] = t;
        }
    }
    best.distance = least.sqrt();
    best
}

/// A triangle's plane, ready to place points against the triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    corner: DVec3,
    normal: DVec3,
    across: [DVec3; 2],
}

impl Plane {
    /// `None` where the triangle has shrunk to a line or a point.
    #[inline(always)]
    pub fn of([a, b, c]: [DVec3; 3]) -> Option<Self> {
        let (ab, ac) = (b - a, c - a);
        let normal = ab.cross(ac);
        let square = normal.length_squared();
        if square <= FLAT * ab.length_squared() * ac.length_squared() {
            return None;
        }
        let across = [ac.cross(normal) / square, normal.cross(ab) / square];
        Some(Self { corner: a, normal: normal / square.sqrt(), across })
    }

    /// Height over the plane.
    fn height(&self, point: DVec3) -> f64 {
        (point - self.corner).dot(self.normal)
    }

    /// No more than a segment's distance from the triangle: how far it stays on one side of the plane.
    #[inline(always)]
    pub fn gap(&self, segment: [DVec3; 2]) -> f64 {
        let [from, to] = segment.map(|end| self.height(end));
        if from * to > 0.0 { from.abs().min(to.abs()) } else { 0.0 }
    }

    /// Whether a segment stays on one side of the plane, at this distance from it or more.
    #[inline(always)]
    pub fn is_beyond(&self, segment: [DVec3; 2], most: f64) -> bool {
        let [from, to] = segment.map(|end| self.height(end));
        (from >= most && to >= most) || (from <= -most && to <= -most)
    }

    /// Height over the plane and barycentric place of the foot.
    fn place(&self, point: DVec3) -> (f64, [f64; 3]) {
        let from = point - self.corner;
        (from.dot(self.normal), self.barycentric(from))
    }

    /// Barycentric place of the foot of a point that lies there from the first corner.
    fn barycentric(&self, from: DVec3) -> [f64; 3] {
        let (v, w) = (from.dot(self.across[0]), from.dot(self.across[1]));
        [1.0 - v - w, v, w]
    }
}

fn inside(barycentric: [f64; 3]) -> bool {
    barycentric.iter().all(|&share| share >= 0.0)
}

/// Where a segment passes through the triangle, from the places of its ends over the plane.
#[inline(always)]
fn crossing([(from, start), (to, end)]: [(f64, [f64; 3]); 2]) -> Option<Nearest> {
    if from * to > 0.0 || (from - to).abs() <= f64::MIN_POSITIVE {
        return None;
    }
    let fraction = from / (from - to);
    let barycentric =
        [0, 1, 2].map(|corner| start[corner] + fraction * (end[corner] - start[corner]));
    inside(barycentric).then_some(Nearest { distance: 0.0, fraction, barycentric })
}

#[cfg(test)]
#[path = "distance_tests.rs"]
mod tests;
