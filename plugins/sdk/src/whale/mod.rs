//! The whale as a plugin sees it: posture (joint angles) and surface regions.

mod posture;
mod skin;

pub use posture::{FLUKE_STATION, Posture, SPINE_JOINTS, SPINE_STATIONS};
pub use skin::{BodyPart, Limb, Region, Side};
