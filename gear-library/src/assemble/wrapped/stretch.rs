//! A stretch of a wrapped line.

use endline_sim::DVec3;

/// A wrap, or the way between two.
pub(super) struct Stretch {
    /// Places it goes through [m].
    pub way: Vec<DVec3>,
    /// Unstretched rope along it [m]; `None` until shared out.
    pub rope_m: Option<f64>,
    /// Longest segment of a wrap [m]; `None` for the way between.
    pub fine_m: Option<f64>,
}
