//! Counters of a run: what the solver did, and what its reader should know.

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
    /// Solver steps accepted above the wanted residual.
    pub unconverged: u64,
    /// Newton passes in all.
    pub passes: u64,
    /// Segments split, each paid for by a merge, as resolution followed the whale.
    pub splits: u64,
    /// Steps in which the whale's motion asked for a posture beyond the joints' ranges, and was held.
    pub postures_held: u64,
    /// Solver steps by what kept them from being longer, in the order of [`LimitedBy::ALL`].
    pub limited_by: [u64; LimitedBy::ALL.len()],
}
