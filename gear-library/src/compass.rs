//! Compass bearings as directions: x east, y north.

use endline_sim::DVec3;

/// Unit vector of a compass bearing [rad]: 0 is north, a quarter turn is east.
pub(crate) fn direction(bearing_rad: f64) -> DVec3 {
    let clean = |share: f64| if share.abs() < 1e-15 { 0.0 } else { share };
    DVec3::new(clean(libm::sin(bearing_rad)), clean(libm::cos(bearing_rad)), 0.0)
}
