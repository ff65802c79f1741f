//! Counters of a run.

use crate::remesh::Remeshed;
use crate::state::LimitedBy;

/// Counters of a run that its reader should know; see `docs/physics.md`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Audit {
    /// Rope passed through skin, found by an exact test over every sub-move.
    pub tunnelled: u64,
    /// Deepest the rope's surface sank into the skin [m].
    pub max_penetration_m: f64,
    /// Rope passed through rope, found by an exact test over every sub-move.
    pub ropes_crossed: u64,
    /// Largest number of pairs of segments at a time that have passed through each other since the start, and are ignored.
    pub ropes_through: u64,
    /// Largest length of rope at a time that has been within bodies since the start, and does not touch them [m].
    pub rope_within_m: f64,
    /// Bodies passed through skin, found by an exact test of their axes over every solver step.
    pub bodies_crossed: u64,
    /// Solver steps, away from the whale, that had rope on rope.
    pub rope_steps: u64,
    /// Least distance of the rope's centre line from skin it touched [m]; `None` if it never touched.
    pub least_distance_m: Option<f64>,
    /// Numbers that were not finite.
    pub non_finite: u64,
    /// Steps of the model without a solver step, in which gear that stood still was held.
    pub held_steps: u64,
    /// Solver steps taken.
    pub solver_steps: u64,
    /// Solver steps that had rope near the whale.
    pub contact_steps: u64,
    /// Solver steps that were redone shorter.
    pub halved: u64,
    /// Solver steps with rope on skin, rope, obstacles or bodies.
    pub touching_steps: u64,
    /// Solver steps accepted with an error above the tolerance.
    pub unconverged: u64,
    /// Solver steps accepted with an error above the tolerance, at whose end something parted.
    pub unconverged_parted: u64,
    /// Isolated tensions of a line (`step/peaks.rs`).
    pub spikes: u64,
    /// Newton passes in all.
    pub passes: u64,
    /// Segments split, each paid for by a merge, as resolution followed the whale.
    pub splits: u64,
    /// Number of checks of segment lengths with rope near the whale.
    pub resolution_looks: u64,
    /// Checks that left a segment near the whale longer than its target by a quarter or more.
    pub resolution_missed: u64,
    /// Greatest ratio of a segment's length near the whale to its target.
    pub resolution_ratio: f64,
    /// Steps in which the whale's motion requested a posture beyond the ranges of the joints, and was limited.
    pub postures_held: u64,
    /// Solver steps by what limited their length, in the order of [`LimitedBy::ALL`].
    pub limited_by: [u64; LimitedBy::ALL.len()],
}

/// Ratio of a segment's length to its target from which resolution counts as missed.
pub const RESOLUTION_MISSED: f64 = 1.25;

impl Audit {
    /// Records a check of the lengths of segments.
    pub(super) fn take_lengths(&mut self, remeshed: &Remeshed) {
        self.splits += remeshed.splits;
        if let Some(ratio) = remeshed.near_ratio {
            self.resolution_looks += 1;
            self.resolution_missed += u64::from(ratio >= RESOLUTION_MISSED);
            self.resolution_ratio = self.resolution_ratio.max(ratio);
        }
    }
}
