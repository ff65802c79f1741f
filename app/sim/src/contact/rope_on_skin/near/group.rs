//! The pairs of one segment of rope, and its travel relative to their skin.
//!
//! With `d` the mean move of the skin's corners over a step of the model and `e` the greatest deviation of any corner from it, a
//! segment whose ends move by `u` while the skin makes a share `s` of its step approaches any of its triangles by at most
//! `max |u - s d| + s e`. The sum of these bounds since a distance was measured is subtracted from it; pairs are measured again only
//! where the remainder leaves room for a touch.

use std::ops::Range;

use glam::DVec3;

use crate::geometry::sweep::SweptTriangle;
use crate::simd::greater;

/// Least separation on a path, as a share of the rope's radius.
const MIN_SEPARATION_SHARE: f64 = 0.08;

/// How a triangle of skin moves over the model's step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SkinMove {
    /// Of its corners [m].
    corners: [DVec3; 3],
    /// The least and the greatest of each component of these.
    low: DVec3,
    high: DVec3,
}

impl SkinMove {
    /// The move of a triangle.
    pub fn of([start, end]: SweptTriangle) -> Self {
        let corners = [0, 1, 2].map(|corner| end[corner] - start[corner]);
        let [a, b, c] = corners;
        Self { corners, low: a.min(b).min(c), high: a.max(b).max(c) }
    }
}

/// A segment near skin.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub segment: usize,
    /// Its first node.
    pub node: usize,
    /// Its pairs in `Near::pairs`.
    pub pairs: Range<usize>,
    /// Its pairs that may touch in this solver step, in `Near::active`.
    pub active: Range<usize>,
    /// Contact distance: the rope's radius [m].
    pub radius: f64,
    /// The greatest of it and of the segment's knots [m].
    pub reach: f64,
    /// Least separation from skin on a path [m].
    pub min_separation: f64,
    /// Mean move of its skin over the model's step, and the greatest departure of a corner from it [m].
    skin_move: DVec3,
    spread: f64,
    /// Lower bound of the distance of all its pairs before it had moved at all [m].
    pub clear: f64,
    /// Lower bound of the distance of its pairs that are not active, at the start of the solver step [m].
    pub far: f64,
    /// Its travel relative to its skin in the solver steps so far [m].
    pub moved: f64,
    /// Its move relative to its skin in this solver step, to the trial [m].
    pub moving: f64,
}

impl Group {
    /// A segment with its first pair.
    pub fn new(segment: usize, node: usize, [radius, reach]: [f64; 2], first_pair: usize) -> Self {
        Self {
            segment,
            node,
            pairs: first_pair..first_pair + 1,
            active: 0..0,
            radius,
            reach,
            min_separation: MIN_SEPARATION_SHARE * radius,
            skin_move: DVec3::ZERO,
            spread: 0.0,
            clear: 0.0,
            far: 0.0,
            moved: 0.0,
            moving: 0.0,
        }
    }

    /// Sets the mean and the spread of the moves of its skin.
    #[inline(always)]
    pub fn follow_skin<'a>(&mut self, skin: impl Iterator<Item = &'a SkinMove> + Clone) {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for triangle in skin.clone() {
            (low, high) = (low.min(triangle.low), high.max(triangle.high));
        }
        let mean = low.midpoint(high);
        let mut greatest = 0.0_f64;
        for corner_move in skin.flat_map(|triangle| &triangle.corners) {
            greatest = greater(greatest, corner_move.distance_squared(mean));
        }
        (self.skin_move, self.spread) = (mean, greatest.sqrt());
    }

    /// Bound of the move of the segment relative to its skin while that makes a share of its step [m].
    #[inline(always)]
    pub fn relative_move(&self, from: &[DVec3], to: &[DVec3], share: f64) -> f64 {
        let skin = self.skin_move * share;
        let end = |node: usize| (to[node] - from[node] - skin).length_squared();
        end(self.node).max(end(self.node + 1)).sqrt() + self.spread * share
    }
}
