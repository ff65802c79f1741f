//! What gear types share: reading attributes, putting parts into a rig, and the two halves of fixed gear.
//!
//! | module | |
//! |---|---|
//! | [`values`] | attribute values by key, with errors that name the attribute |
//! | [`parts`] | a rig in the making |
//! | [`ground`] | what lies on the seabed: groundline, gangions, traps, anchors |
//! | [`endline`] | what stands above it: two ropes, surface system, buoy, high-flyer |
//!
//! Frame: origin on the mean sea surface above the foot of the near endline, x along the gear with the rest of it on the
//! negative side, z up. All places are first guesses, from which statics finds the shape.

pub mod endline;
pub mod ground;
pub mod parts;
pub mod values;

pub use endline::Endline;
pub use ground::{Foot, Ground};
pub use parts::Lay;
pub use values::Values;

use endline_sdk::{HookError, Site};

/// What is added to the ids of the endline, buoy and anchor at the far end.
pub const FAR: &str = "far-";

/// The site's depth, looked at [m].
///
/// # Errors
/// Where there is no water under the gear.
pub fn depth_of(site: &Site) -> Result<f64, HookError> {
    if site.depth_m > 0.0 && site.depth_m.is_finite() {
        return Ok(site.depth_m);
    }
    Err(HookError::new(format!(
        "the site's depth is {} m; fixed gear needs water under it",
        site.depth_m
    )))
}

/// Unit direction of the current, along x where there is none.
#[must_use]
pub fn downstream([east, north]: [f64; 2]) -> [f64; 2] {
    let speed = (east * east + north * north).sqrt();
    if speed > 0.0 { [east / speed, north / speed] } else { [1.0, 0.0] }
}
