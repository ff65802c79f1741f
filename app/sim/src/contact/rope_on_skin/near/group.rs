//! The pairs of one segment of rope, and its travel relative to their skin.
//!
//! With `d` the mean move of the skin's corners over a step of the model and `e` the greatest deviation of any corner from it, a
//! segment whose ends move by `u` while the skin makes a share `s` of its step approaches any of its triangles by at most
//! `max |u - s d| + s e`. The sum of these bounds since a distance was measured is subtracted from it; pairs are measured again only
//! where the remainder leaves room for a touch.

use std::ops::Range;

use glam::DVec3;

use crate::geometry::placed::Placed;

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
            skin_move: DVec3::ZERO,
            spread: 0.0,
            clear: 0.0,
            far: 0.0,
            moved: 0.0,
            moving: 0.0,
        }
    }

    /// Sets the mean and the spread of the moves of its skin.
    pub fn follow_skin<'a>(&mut self, skin: impl Iterator<Item = &'a Placed> + Clone) {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for corner_move in skin.clone().flat_map(Placed::corner_moves) {
            (low, high) = (low.min(corner_move), high.max(corner_move));
        }
        self.skin_move = low.midpoint(high);
        self.spread = skin
            .flat_map(Placed::corner_moves)
            .map(|corner_move| corner_move.distance_squared(self.skin_move))
            .fold(0.0, f64::max)
            .sqrt();
    }

    /// Bound of the move of the segment relative to its skin while that makes a share of its step [m].
    pub fn relative_move(&self, from: &[DVec3], to: &[DVec3], share: f64) -> f64 {
        let skin = self.skin_move * share;
        let end = |node: usize| (to[node] - from[node] - skin).length_squared();
        end(self.node).max(end(self.node + 1)).sqrt() + self.spread * share
    }
}
