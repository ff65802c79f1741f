//! Probes: quantities that a run follows.

use endline_sdk::LineEnd;
use glam::DVec3;

/// A quantity to follow through the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Id.
    pub id: String,
    /// What it reads.
    pub target: ProbeTarget,
}

/// What a probe reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProbeTarget {
    /// Tension at an end of a line [N].
    EndTension(usize, LineEnd),
    /// Tension of a line at an unstretched length from its end A [N].
    TensionAt(usize, f64),
    /// A coordinate of a line at an unstretched length from its end A: 0 x, 1 y, 2 z [m].
    LineAt(usize, f64, usize),
    /// Greatest height of a line above the seabed, with this unstretched length left out at each end [m].
    Height(usize, f64),
    /// Mechanical energy of all rope and bodies [J].
    Energy(EnergyForm),
    /// A coordinate of the middle of a line by unstretched length: 0 x, 1 y, 2 z [m].
    LineMiddle(usize, usize),
    /// A coordinate of a joint: 0 x, 1 y, 2 z [m].
    Joint(usize, usize),
    /// A coordinate of a point of a body [m].
    Body {
        /// Which body.
        body: usize,
        /// The point in the body's frame [m].
        offset_m: DVec3,
        /// 0 x, 1 y, 2 z.
        axis: usize,
    },
    /// A figure of the whale's motion or effort.
    Whale(WhaleFigure),
}

/// A figure of the whale's motion or effort; of a whale that is not kinetic all but its speed are zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WhaleFigure {
    /// Speed along its own axis [m/s].
    Speed,
    /// Thrust of its flukes [N].
    Thrust,
    /// Power of that thrust [W].
    Power,
    /// Drag of the water on its body, gear apart [N].
    BodyDrag,
}

/// A form of mechanical energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyForm {
    /// All three together.
    Total,
    /// Of motion and turning.
    Kinetic,
    /// Of height above z = 0; buoyancy is not counted.
    Height,
    /// Of stretch.
    Stretch,
}
