//! Obstacles: solid things of a scenario that stand still.

use glam::{DQuat, DVec3};

use crate::geometry::shape::SolidShape;

/// Stiffness of rope pressed on something hard, by length of rope [N/m²]: of the order of the transverse modulus of
/// laid polypropylene, so that a kilonewton over a hand's breadth sinks in by half a millimetre (estimate).
pub const ROPE_ON_HARD_N_M2: f64 = 2e7;

/// A solid that stands still: part of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Id, for reports.
    pub id: String,
    /// Its shape, in its own frame.
    pub shape: SolidShape,
    /// Where its frame's origin lies [m].
    pub position_m: DVec3,
    /// Its frame, to world.
    pub orientation: DQuat,
    /// Coulomb friction of rope and bodies on it.
    pub friction: f64,
    /// Stiffness under rope, by length of rope [N/m²].
    pub stiffness_n_m2: f64,
}
