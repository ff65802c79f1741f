//! Boxes that hold for several steps: those around groups of segments, grown by a slack.
//!
//! What is near something is looked for among these boxes and kept as a list of neighbours (Verlet 1967, Physical Review 159, 98). As long as
//! each group lies in its held box, every two boxes that meet belong to held boxes that meet: `A ⊆ A'` and `B ⊆ B'`, so `A ∩ B ⊆ A' ∩ B'`, and as
//! much for boxes grown by a reach, since rounding keeps the order of numbers. A list among held boxes therefore leaves nothing out, and what it
//! holds too much is told by the boxes of the step: what is found does not depend on how long a list was kept.

use glam::DVec3;

use crate::broad_phase::pieces::{Piece, Pieces};
use crate::whale::Bounds;

/// Steps of the present speed for which held boxes are laid out.
const STEPS: f64 = 10.0;
/// Least slack [m].
const LEAST_SLACK_M: f64 = 0.04;
/// Slack beyond which too much would be near: boxes then hold for one step alone [m].
const MOST_SLACK_M: f64 = 0.4;

impl Pieces {
    /// Lays out the held boxes anew, about the boxes of a step that goes from one place to another.
    #[cold]
    pub(crate) fn hold(&mut self, from: &[DVec3], to: impl Fn(usize) -> DVec3) {
        let moves = from.iter().enumerate().map(|(node, place)| place.distance_squared(to(node)));
        let slack_m = STEPS * moves.fold(0.0, f64::max).sqrt();
        let slack_m = if slack_m <= MOST_SLACK_M { slack_m.max(LEAST_SLACK_M) } else { 0.0 };
        for piece in &mut self.pieces {
            piece.held = piece.groups.map(|group| group.grown(slack_m));
            piece.held_whole = piece.held.iter().fold(Bounds::EMPTY, |all, one| all.join(*one));
        }
        self.holding += 1;
    }
}

impl Piece {
    /// Whether each of its groups lies in its held box.
    #[inline(always)]
    pub(crate) fn is_held(&self) -> bool {
        let pairs = self.held.iter().zip(&self.groups);
        pairs.fold(true, |all, (held, group)| all & held.holds(group))
    }
}
