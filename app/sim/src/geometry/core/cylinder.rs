//! A cylinder with flat ends, as a core.

use glam::DVec3;
use parry3d::shape::SupportMap;

use crate::geometry::core::convex::Convex;
use crate::geometry::core::rounded;

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
    /// The core of a cylinder whose rims are rounded, and the radius of the rounding [m].
    pub fn rounded(radius_m: f64, half_length_m: f64) -> (Self, f64) {
        let reach = rounded(radius_m.min(half_length_m));
        (Self { radius: radius_m - reach, half: half_length_m - reach }, reach)
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

    /// Ends of the line along its side that faces a place of its frame.
    pub fn side_towards(self, place: DVec3) -> [DVec3; 2] {
        let across = DVec3::new(place.x, place.y, 0.0).normalize_or_zero() * self.radius;
        [across - DVec3::Z * self.half, across + DVec3::Z * self.half]
    }
}

impl SupportMap for Cylinder {
    fn local_support_point(&self, direction: DVec3) -> DVec3 {
        let across = DVec3::new(direction.x, direction.y, 0.0).normalize_or_zero() * self.radius;
        across + DVec3::Z * self.half.copysign(direction.z)
    }
}

impl Convex for Cylinder {
    fn nearest(&self, place: DVec3) -> DVec3 {
        let across = DVec3::new(place.x, place.y, 0.0).clamp_length_max(self.radius);
        across + DVec3::Z * place.z.clamp(-self.half, self.half)
    }
}
