//! The seabed.

use glam::DVec3;

/// The seabed: a plane with stiffness and friction.
#[derive(Clone, Debug, PartialEq)]
pub struct Seabed {
    /// A point of the plane is `(0, 0, -depth)` [m].
    pub depth_m: f64,
    /// Upward unit normal.
    pub normal: DVec3,
    /// Stiffness under rope, per metre of rope [N/m²].
    pub rope_stiffness_n_m2: f64,
    /// Stiffness under one foot of a body [N/m].
    pub foot_stiffness_n_m: f64,
    /// Friction of rope.
    pub rope_friction: f64,
}

impl Seabed {
    /// Its height at a place east and north [m].
    #[must_use]
    pub fn height_at(&self, place: DVec3) -> f64 {
        -self.depth_m - (self.normal.x * place.x + self.normal.y * place.y) / self.normal.z
    }
}
