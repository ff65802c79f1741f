//! A spheroid, as a core.

use glam::DVec3;
use parry3d::shape::SupportMap;

use crate::geometry::core::convex::Convex;
use crate::geometry::ellipse::nearest_on_ellipse;

/// An ellipsoid that is round about z.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spheroid {
    /// Half axes across and along z [m].
    pub across: f64,
    pub along: f64,
}

/// Share of the smaller half axis by which a spheroid's core is smaller than itself.
const SHRUNK_SHARE: f64 = 0.25;

impl Spheroid {
    /// The core of a spheroid by its half axes, and how far its surface lies off the core: both half axes are less by a quarter of the smaller.
    ///
    /// The surface about that core touches the spheroid at its poles and on its equator, and lies outside it between: by 2 % of the smaller
    /// half axis where the other is twice as long, by 4 % where it is three times as long.
    pub fn shrunk(across_m: f64, along_m: f64) -> (Self, f64) {
        let reach = SHRUNK_SHARE * across_m.min(along_m);
        (Self { across: across_m - reach, along: along_m - reach }, reach)
    }
}

impl SupportMap for Spheroid {
    fn local_support_point(&self, direction: DVec3) -> DVec3 {
        let half = DVec3::new(self.across, self.across, self.along);
        half * (half * direction).normalize_or(DVec3::Z)
    }
}

impl Convex for Spheroid {
    fn nearest(&self, place: DVec3) -> DVec3 {
        let off = libm::hypot(place.x, place.y);
        let share = libm::hypot(off / self.across, place.z / self.along);
        if share <= 1.0 {
            return place;
        }
        let [across, height] = nearest_on_ellipse([self.across, self.along], [off, place.z]);
        let outward = DVec3::new(place.x, place.y, 0.0).normalize_or_zero();
        outward * across + DVec3::Z * height
    }
}
