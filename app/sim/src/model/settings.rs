//! Steps, tolerances and switches of a run, and the probes that it records.

use endline_sdk::LineEnd;
use glam::DVec3;

use super::rope::{Hitch, RopeOnRope};

/// Target lengths of segments, which depend on the distance to the whale.
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

/// Default tolerance of normal force and friction, as a share of the greatest.
pub const CONTACT_TOLERANCE: f64 = 0.02;

/// Steps and tolerances.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Step between inputs [s]; the solver subdivides it where necessary.
    pub step_s: f64,
    /// Whether the error of each step controls the solver step; otherwise the solver uses the whole step where it can.
    pub auto_step: bool,
    /// Longest step while rope is near the whale [s].
    pub contact_step_s: f64,
    /// Tolerance of normal force and friction in a solver step near the whale, as a share of the greatest; the other
    /// tolerances of such a step are proportional to it (`solver/stopping.rs`).
    pub contact_tolerance: f64,
    /// Shortest solver step; a run that needs a shorter one stops [s].
    pub least_step_s: f64,
    /// Target segment lengths near and far from the whale; `None` for fixed lengths.
    pub resolution: Option<Resolution>,
    /// Duration of the run [s].
    pub duration_s: f64,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Whether the run starts from the declared positions, without statics.
    pub as_placed: bool,
    /// Whether rope touches the bodies of the gear as well as obstacles.
    pub rope_on_bodies: bool,
    /// Whether the bodies of the gear touch the whale.
    pub bodies_on_whale: bool,
    /// Whether the bodies of the gear touch each other.
    pub bodies_on_bodies: bool,
    /// Contact of rope with rope; `None` if ropes pass through each other.
    pub rope_on_rope: Option<RopeOnRope>,
    /// Whether momentum and energy of the gear are recorded by source ([`Balance`](crate::balance::Balance)); the state does
    /// not depend on it.
    pub balance: bool,
    /// Whether gear that stands still is held until something can move it (`step/rest.rs`). The gear library sets it.
    pub holds_still: bool,
    /// Whether neither rope nor link parts, whatever its tension.
    pub unbreakable: bool,
    /// Whether moves near skin are shortened where their path would cross it. Off only to demonstrate what is missed by tests
    /// at the end of each step alone.
    pub swept: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            step_s: 0.01,
            auto_step: false,
            contact_step_s: 0.01 / 3.0,
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
            holds_still: false,
            unbreakable: false,
            swept: true,
        }
    }
}

/// A quantity recorded during the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Id.
    pub id: String,
    /// Quantity.
    pub target: ProbeTarget,
}

/// Quantity of a probe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProbeTarget {
    /// Tension at an end of a line [N].
    EndTension(usize, LineEnd),
    /// Tension of a line at an unstretched length from its end A [N].
    TensionAt(usize, f64),
    /// A coordinate of a line at an unstretched length from its end A: 0 x, 1 y, 2 z [m].
    LineAt(usize, f64, usize),
    /// Greatest height of a line above the seabed, excluding this unstretched length at each end [m].
    Height(usize, f64),
    /// Mechanical energy of all rope and bodies [J].
    Energy(EnergyForm),
    /// A coordinate of the midpoint of a line by unstretched length: 0 x, 1 y, 2 z [m].
    LineMiddle(usize, usize),
    /// A coordinate of a joint: 0 x, 1 y, 2 z [m].
    Joint(usize, usize),
    /// A coordinate of a point of a body [m].
    Body {
        /// Index of the body.
        body: usize,
        /// The point in the body's frame [m].
        offset_m: DVec3,
        /// 0 x, 1 y, 2 z.
        axis: usize,
    },
    /// A coordinate of the origin of the whale's axes: 0 x, 1 y, 2 z [m].
    WhaleOrigin(usize),
    /// A coordinate of a point of the whale's skin: 0 x, 1 y, 2 z [m].
    Skin(Hitch, usize),
    /// A figure of the whale's motion or effort.
    Whale(WhaleFigure),
}

/// A figure of the whale's motion or effort; all but the speed are zero for a whale that is not kinetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WhaleFigure {
    /// Speed along its own axis [m/s].
    Speed,
    /// Thrust of its flukes [N].
    Thrust,
    /// Power of that thrust [W].
    Power,
    /// Drag of the water on its body, without gear [N].
    BodyDrag,
    /// Sum of the normal forces of rope on its skin in the last step [N].
    ContactForce,
}

/// A form of mechanical energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyForm {
    /// Sum of the three.
    Total,
    /// Translation and rotation.
    Kinetic,
    /// Potential energy of weight, relative to z = 0; buoyancy is not included.
    Height,
    /// Axial strain.
    Stretch,
}
