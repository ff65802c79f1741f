//! Geometry that knows no model of gear: distances, swept paths, exact crossing tests, and shapes.

pub(crate) mod along;
pub(crate) mod core;
pub mod crossing;
pub mod distance;
pub(crate) mod ellipse;
pub(crate) mod norm;
pub(crate) mod placed;
pub(crate) mod segment_pair;
pub mod shape;
pub mod sweep;

use glam::{DQuat, DVec3};

/// Place and orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pub place: DVec3,
    pub orientation: DQuat,
}

impl Pose {
    /// A place of the world in this frame.
    pub fn inward(&self, place: DVec3) -> DVec3 {
        self.orientation.inverse() * (place - self.place)
    }

    /// The pose with this orientation at another place of this frame.
    pub fn about(&self, place: DVec3) -> Self {
        Self { place: self.outward(place), ..*self }
    }

    /// A place of this frame in the world.
    pub fn outward(&self, place: DVec3) -> DVec3 {
        self.place + self.orientation * place
    }
}
