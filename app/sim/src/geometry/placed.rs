//! A triangle of skin near rope at a moment of the model's step, prepared for distances.
//!
//! A ball around it and its plane show for most rope that it is too far; both are made once for each place of the skin and
//! serve every segment that is near.

use glam::DVec3;

use crate::geometry::distance::{Nearest, Plane, point_triangle_in, segment_triangle_in};
use crate::geometry::norm;
use crate::geometry::sweep::{SweptTriangle, triangle_at};

/// Growth of balls over rounding: a factor, and a length [m].
const GROWN: f64 = 1.0 + 1e-12;
const ROUNDING_M: f64 = 1e-9;

/// A triangle near rope.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    /// Its index in the skin.
    pub triangle: u32,
    /// Corners at the start and the end of the model's step.
    pub sweep: SweptTriangle,
    /// Share of that step at which its corners are evaluated.
    pub stands: f64,
    /// Corners now.
    pub now: [DVec3; 3],
    ball: Ball,
    /// `None` for a degenerate triangle.
    plane: Option<Plane>,
}

/// A ball around a triangle, grown over rounding.
#[derive(Clone, Copy, Debug)]
struct Ball {
    centre: DVec3,
    radius: f64,
}

impl Placed {
    /// A triangle of the skin at a share of the model's step.
    pub fn new(triangle: u32, sweep: SweptTriangle, share: f64) -> Self {
        let now = triangle_at(&sweep, share);
        Self { triangle, sweep, stands: share, now, ball: Ball::around(now), plane: Plane::of(now) }
    }

    /// Evaluates its corners at a share of the model's step.
    #[expect(clippy::float_cmp, reason = "the same share, to the bit, is the same place")]
    #[inline(always)]
    pub fn stand(&mut self, share: f64) {
        if self.stands != share {
            self.stands = share;
            self.now = triangle_at(&self.sweep, share);
            (self.ball, self.plane) = (Ball::around(self.now), Plane::of(self.now));
        }
    }

    /// Moves of its corners over the model's step [m].
    pub fn corner_moves(&self) -> [DVec3; 3] {
        let [start, end] = self.sweep;
        [0, 1, 2].map(|corner| end[corner] - start[corner])
    }

    /// Move of a place on it over the model's step [m].
    pub fn move_of(&self, barycentric: [f64; 3]) -> DVec3 {
        on_triangle(self.corner_moves(), barycentric)
    }

    /// Nearest places of a segment and the triangle.
    #[inline(always)]
    pub fn nearest_to(&self, segment: [DVec3; 2]) -> Nearest {
        segment_triangle_in(self.plane.as_ref(), segment, &self.now)
    }

    /// Nearest place on it to a point: distance and barycentric place; `None` where it is no nearer than `most`.
    #[inline(always)]
    pub fn nearest_to_point(&self, point: DVec3, most: f64) -> Option<(f64, [f64; 3])> {
        let reach = most + self.ball.radius;
        if point.distance_squared(self.ball.centre) > reach * reach {
            return None;
        }
        point_triangle_in(self.plane.as_ref(), point, &self.now, most)
    }

    /// Whether its ball or its plane shows that a segment is no nearer than `most`, which is above zero.
    #[inline(always)]
    pub fn is_beyond(&self, segment: [DVec3; 2], most: f64) -> bool {
        if self.plane.as_ref().is_some_and(|plane| plane.is_beyond(segment, most)) {
            return true;
        }
        let [from, to] = segment;
        let (along, centre) = (to - from, self.ball.centre - from);
        let (square, ahead) = (along.length_squared(), centre.dot(along));
        let reach = most + self.ball.radius;
        if ahead <= 0.0 {
            centre.length_squared() >= reach * reach
        } else if ahead >= square {
            (centre - along).length_squared() >= reach * reach
        } else {
            (centre.length_squared() - reach * reach) * square >= ahead * ahead
        }
    }

    /// No more than a segment's distance from it, below zero where that bounds nothing [m].
    #[inline(always)]
    pub fn gap(&self, segment: [DVec3; 2]) -> f64 {
        let [from, to] = segment;
        let (along, centre) = (to - from, self.ball.centre - from);
        let fraction =
            (centre.dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let round = norm::distance(centre, along * fraction) - self.ball.radius;
        self.plane.as_ref().map_or(round, |plane| round.max(plane.gap(segment)))
    }
}

/// A barycentric place on a triangle.
pub(crate) fn on_triangle(corners: [DVec3; 3], barycentric: [f64; 3]) -> DVec3 {
    corners[0] * barycentric[0] + corners[1] * barycentric[1] + corners[2] * barycentric[2]
}

impl Ball {
    #[inline(always)]
    fn around(corners: [DVec3; 3]) -> Self {
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let square =
            corners.iter().map(|corner| corner.distance_squared(centre)).fold(0.0, f64::max);
        Self { centre, radius: square.sqrt() * GROWN + ROUNDING_M }
    }
}
