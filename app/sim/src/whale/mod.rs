//! The whale: a skinned mesh on bones, moved by a motion plugin.

pub mod acts;
pub(crate) mod approach;
pub mod axes;
pub mod bounds;
pub mod drive;
pub mod hitch;
pub mod jaws;
pub mod joints;
pub mod kinetic;
pub mod measures;
pub mod pilot;
pub mod pose;
pub mod skin;
pub mod surface;
pub mod tree;

pub use bounds::Bounds;
pub use jaws::JawStrength;
pub use joints::JointRanges;
pub use kinetic::{Exertion, Kinetic};
pub use measures::Measures;
pub use pose::{pose, skin_all, skin_vertex};
pub use skin::{Angle, Bone, Channel, Mark, Skin};
pub use surface::{Candidate, Surface};
pub use tree::SkinTree;
