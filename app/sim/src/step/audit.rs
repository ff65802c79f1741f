//! Counters of a run: what the solver did, and what its reader should know.

use crate::remesh::Remeshed;
use crate::state::LimitedBy;

/// What a run did that its reader should know; see `docs/physics.md`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Audit {
    /// Rope passed through skin, found by an exact test over every sub-move.
    pub tunnelled: u64,
    /// Deepest the rope's surface sank into the skin [m].
    pub max_penetration_m: f64,
    /// Rope passed through rope, found by an exact test over every sub-move.
    pub ropes_crossed: u64,
    /// Most pairs of segments at a time that run through each other since the start, and are left alone.
    pub ropes_through: u64,
    /// Most rope at a time that has lain within bodies since the start, and does not touch them [m].
    pub rope_within_m: f64,
    /// Bodies passed through skin, found by an exact test of their axes over every solver step.
    pub bodies_crossed: u64,
    /// Solver steps, away from the whale, that had rope on rope.
    pub rope_steps: u64,
    /// Nearest that the rope's centre line came to skin it touched [m]; `None` where it never touched.
    pub least_distance_m: Option<f64>,
    /// Numbers that were not finite.
    pub non_finite: u64,
    /// Solver steps taken.
    pub solver_steps: u64,
    /// Solver steps that had rope near the whale.
    pub contact_steps: u64,
    /// Solver steps that were redone shorter.
    pub halved: u64,
    /// Solver steps with rope on skin, rope, obstacles or bodies.
    pub touching_steps: u64,
    /// Solver steps accepted above the wanted residual.
    pub unconverged: u64,
    /// Solver steps accepted above the wanted residual at whose end something parted.
    pub unconverged_parted: u64,
    /// Tensions of a line that stand alone in time (`step/peaks.rs`).
    pub spikes: u64,
    /// Newton passes in all.
    pub passes: u64,
    /// Segments split, each paid for by a merge, as resolution followed the whale.
    pub splits: u64,
    /// Times at which segment lengths were looked at with rope near the whale.
    pub resolution_looks: u64,
    /// Those of them that left a segment near the whale longer than wanted by a quarter or more.
    pub resolution_missed: u64,
    /// Greatest ratio of a segment's length near the whale to the one wanted.
    pub resolution_ratio: f64,
    /// Steps in which the whale's motion asked for a posture beyond the joints' ranges, and was held.
    pub postures_held: u64,
    /// Solver steps by what kept them from being longer, in the order of [`LimitedBy::ALL`].
    pub limited_by: [u64; LimitedBy::ALL.len()],
}

/// Ratio of a segment's length to the one wanted from which resolution counts as missed.
pub const RESOLUTION_MISSED: f64 = 1.25;

impl Audit {
    /// Takes in a look at the lengths of segments.
    pub(super) fn take_lengths(&mut self, remeshed: &Remeshed) {
        self.splits += remeshed.splits;
        if let Some(ratio) = remeshed.near_ratio {
            self.resolution_looks += 1;
            self.resolution_missed += u64::from(ratio >= RESOLUTION_MISSED);
            self.resolution_ratio = self.resolution_ratio.max(ratio);
        }
    }
}
