//! Rope against rope: other lines, and the same line where it returns to itself.
//!
//! Two segments touch where their centre lines are closer than the sum `h` of their radii. They press at *points*: at fractions `s`, `t`
//! of the two, apart along the line between them by the law of `law/barrier.rs`, held by an elastic grip that slips at `μN`
//! (`law/elastic_grip.rs`). Where ropes cross there is one point, at which they are closest; where they run along each other, one at each
//! end of their common length (`points.rs`). A knot touches as a ball with its own radius (`broad_phase/knots.rs`).
//!
//! Nothing crosses: every path is checked by additive continuous collision detection (`geometry/segment_pair.rs`) and again by an exact
//! test (`geometry/crossing.rs`). The forces are in `kind.rs`, the linear algebra in `system/coupled.rs`.

mod kind;
pub(crate) mod near;
pub(crate) mod points;

use glam::DVec3;

/// A place where two ropes press on each other, at the end of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RopeTouch {
    /// The two segments in the model's layout.
    pub segments: [usize; 2],
    /// The knots on them that press, by their number in the model, where it is not the rope itself.
    pub knots: [Option<usize>; 2],
    /// Where on each, 0 at its first node, 1 at its second.
    pub fractions: [f64; 2],
    /// Place on the first rope's centre line [m].
    pub position: DVec3,
    /// Unit normal from the second rope to the first.
    pub normal: DVec3,
    /// Distance of the centre lines, or of a knot's middle from one [m].
    pub distance_m: f64,
    /// Normal force [N].
    pub normal_force_n: f64,
    /// Friction force of the second rope on the first [N].
    pub friction_n: DVec3,
    /// Slip of the first rope over the second in the last solver step [m].
    pub slip_m: DVec3,
    /// Length of that solver step [s].
    pub dt_s: f64,
}
