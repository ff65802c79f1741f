//! Steps, tolerances and switches of a run.

use super::rope::RopeOnRope;

/// Lengths that segments are given as the whale comes and goes; the number of segments of each line stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Near skin [m].
    pub near_m: f64,
    /// Near the edges of flippers and flukes [m].
    pub edge_m: f64,
    /// Far from the whale [m].
    pub far_m: f64,
}

impl Default for Resolution {
    fn default() -> Self {
        Self { near_m: 0.05, edge_m: 0.0125, far_m: 1.0 }
    }
}

/// What push and friction may miss by unless a run says otherwise, as a share of the greatest.
pub const CONTACT_TOLERANCE: f64 = 0.02;

/// Steps and tolerances.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Step between inputs [s]; the solver divides it where it must.
    pub step_s: f64,
    /// Whether the solver step is chosen from the error of each step; else it is the whole step wherever nothing forbids it.
    pub auto_step: bool,
    /// Longest step while rope is near the whale [s].
    pub contact_step_s: f64,
    /// What push and friction may miss by in a solver step near the whale, as a share of the greatest; all that such a step may miss by
    /// is in proportion to it (`solver/newton.rs`).
    pub contact_tolerance: f64,
    /// Shortest step before a run gives up [s].
    pub least_step_s: f64,
    /// How segment lengths follow the whale; `None` where they stay as they are.
    pub resolution: Option<Resolution>,
    /// Length of the run [s].
    pub duration_s: f64,
    /// Seed of everything drawn at random.
    pub seed: u64,
    /// Whether the run starts as its parts are placed, without statics before it.
    pub as_placed: bool,
    /// Whether rope touches the bodies of the rig too, and not obstacles alone.
    pub rope_on_bodies: bool,
    /// Whether the bodies of the rig touch the whale.
    pub bodies_on_whale: bool,
    /// Whether the bodies of the rig touch each other.
    pub bodies_on_bodies: bool,
    /// How rope touches rope; `None` where ropes pass through each other.
    pub rope_on_rope: Option<RopeOnRope>,
    /// Whether momentum and energy of the gear are told by source ([`Balance`](crate::balance::Balance)); no number of a state
    /// depends on it.
    pub balance: bool,
    /// Whether every move near skin is cut short where its path would cross: always, but to show what tests at the end of
    /// each step alone let through.
    pub swept: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            step_s: 0.01,
            auto_step: false,
            contact_step_s: 0.002,
            contact_tolerance: CONTACT_TOLERANCE,
            least_step_s: 1e-6,
            resolution: None,
            duration_s: 60.0,
            seed: 1,
            rope_on_bodies: false,
            bodies_on_whale: true,
            bodies_on_bodies: true,
            rope_on_rope: None,
            as_placed: false,
            balance: false,
            swept: true,
        }
    }
}
