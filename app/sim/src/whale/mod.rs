//! The whale: a skinned mesh on bones, moved by a motion plugin.

pub mod acts;
pub(crate) mod approach;
pub mod axes;
pub mod drive;
pub mod hitch;
pub mod jaws;
mod kept_candidates;
pub mod kinetic;
pub mod pilot;
pub mod pose;
pub mod skin;
pub mod surface;
pub mod tree;

pub use jaws::JawStrength;
pub use kinetic::{Exertion, Kinetic};
pub use pose::{JointRanges, pose, skin_all, skin_vertex};
pub use skin::{Angle, Bone, Channel, Mark, Measures, Skin};
pub use surface::{Candidate, Surface};
pub use tree::{Bounds, SkinTree};
