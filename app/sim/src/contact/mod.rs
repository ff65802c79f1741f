//! Rope against the skinned whale: detection that cannot miss, response inside the rope solve.

mod account;
pub(crate) mod barrier;
pub mod bodies;
pub(crate) mod body_pairs;
mod crease;
pub mod crossing;
pub mod distance;
pub(crate) mod friction_arrays;
mod grain;
mod kept;
pub(crate) mod near;
pub(crate) mod pieces;
pub(crate) mod placed;
pub(crate) mod points;
mod polygon;
pub mod ropes;
pub(crate) mod site;
pub(crate) mod skin_friction;
pub mod step_sums;
pub mod sweep;
pub(crate) mod touch;
pub(crate) mod workspace;

pub use body_pairs::bodies_touching;
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
