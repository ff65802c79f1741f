//! The core of an obstacle, as bodies meet it.
//!
//! As for bodies (`core.rs`): a ball is a point, a capsule a rod; of a box, a cylinder and a plane `h` is taken off each side, so that the edges are
//! rounded by `h`.

use glam::DVec3;
use parry3d::shape::{Cuboid, SupportMap};

use super::core::{BodyCore, Core, ROUNDED_M, ROUNDED_SHARE};
use crate::model::Obstacle;
use crate::solids::SolidShape;

/// Places round each rim of a cylinder at which a face that lies on it bears.
const RIM_PLACES: u32 = 8;

/// A cylinder along z with flat ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cylinder {
    /// Radius [m].
    pub radius: f64,
    /// Half of its length [m].
    pub half: f64,
}

impl Cylinder {
    /// Its place that is nearest to another place of its frame.
    pub fn nearest(&self, place: DVec3) -> DVec3 {
        let across = DVec3::new(place.x, place.y, 0.0).clamp_length_max(self.radius);
        across + DVec3::Z * place.z.clamp(-self.half, self.half)
    }

    /// Places round both rims, in its frame.
    pub fn rims(self) -> impl Iterator<Item = DVec3> {
        (0..2 * RIM_PLACES).map(move |k| {
            let angle = core::f64::consts::TAU * f64::from(k / 2) / f64::from(RIM_PLACES);
            let height = if k % 2 == 0 { -self.half } else { self.half };
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            DVec3::new(self.radius * cos, self.radius * sin, height)
        })
    }
}

impl SupportMap for Cylinder {
    fn local_support_point(&self, direction: DVec3) -> DVec3 {
        let across = DVec3::new(direction.x, direction.y, 0.0).normalize_or_zero() * self.radius;
        across + DVec3::Z * self.half.copysign(direction.z)
    }
}

impl BodyCore {
    /// The core of an obstacle, in its frame.
    pub fn of_obstacle(obstacle: &Obstacle) -> Self {
        let rounded = |least_half: f64| ROUNDED_M.min(ROUNDED_SHARE * least_half);
        let (core, reach, middle) = match obstacle.shape {
            SolidShape::Plane => (Core::HalfSpace, ROUNDED_M, DVec3::NEG_Z * ROUNDED_M),
            SolidShape::Sphere(radius_m) => (Core::Point, radius_m, DVec3::ZERO),
            SolidShape::Capsule { radius_m, half_length_m } => {
                (Core::Rod((half_length_m - radius_m).max(0.0)), radius_m, DVec3::ZERO)
            }
            SolidShape::Cylinder { radius_m, half_length_m } => {
                let reach = rounded(radius_m.min(half_length_m));
                let cylinder = Cylinder { radius: radius_m - reach, half: half_length_m - reach };
                (Core::Cylinder(cylinder), reach, DVec3::ZERO)
            }
            SolidShape::Box(half) => {
                let reach = rounded(half.min_element());
                (Core::Box(Cuboid::new(half - DVec3::splat(reach))), reach, DVec3::ZERO)
            }
        };
        Self { core, reach, middle, radius: obstacle.shape.radius() }
    }
}
