//! Rope against the skinned whale: detection that cannot miss, response inside the rope solve.

pub mod body_on_body;
pub mod body_on_skin;
pub(crate) mod law;
pub mod rope_on_rope;
pub mod rope_on_skin;
pub mod rope_on_solid;

pub use body_on_body::bodies_touching;

use endline_sdk::Region;
use glam::DVec3;

/// One place where rope presses on skin, at the end of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactPoint {
    /// Index of the line.
    pub line: usize,
    /// Index of the segment in the model's layout.
    pub segment: usize,
    /// Where on the segment, 0 at its first node, 1 at its second.
    pub fraction: f64,
    /// Index of the skin triangle.
    pub triangle: usize,
    /// Barycentric place on the triangle.
    pub barycentric: [f64; 3],
    /// Region of the triangle.
    pub region: Region,
    /// Place on the rope's centre line [m].
    pub position: DVec3,
    /// Unit normal from skin to rope.
    pub normal: DVec3,
    /// Distance of the centre line from the skin [m].
    pub distance_m: f64,
    /// Length of rope it stands for [m].
    pub length_m: f64,
    /// Whether it is a knot, splice or link that presses.
    pub is_knot: bool,
    /// Normal force [N].
    pub normal_force_n: f64,
    /// Friction force of skin on rope [N].
    pub friction_n: DVec3,
    /// Slip of rope over skin in the last solver step [m].
    pub slip_m: DVec3,
    /// Length of that solver step [s].
    pub dt_s: f64,
}

/// What rope on rope and on obstacles may miss is so many times less: their grips creep by what passes leave.
pub(crate) const GRIP_STRICTER: f64 = 10.0;
/// What rope on bodies of the rig may miss is so many times less: the two answer each other from pass to pass, and momentum is lost by
/// what they differ.
pub(crate) const ANSWER_STRICTER: f64 = 100.0;

/// What contact misses after a pass.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactMissed {
    /// Greatest difference between push and friction as solved for and as they are [N].
    pub gap_n: f64,
    /// Greatest push and friction [N].
    pub greatest_n: f64,
}

impl ContactMissed {
    /// The worse of two.
    pub fn and(self, other: Self) -> Self {
        Self {
            gap_n: self.gap_n.max(other.gap_n),
            greatest_n: self.greatest_n.max(other.greatest_n),
        }
    }
}
