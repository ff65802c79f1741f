//! Reads and writes a whale's skin as a glTF 2.0 file, for Blender and other programs.
//!
//! ```text
//! glTF  x y z  =  whale  x  z  -y        metres; glTF has y up, the whale's frame has z to the back
//! ```
//! Vertices are written in glTF's axes; the first bone is rotated by 90 degrees, so that the bones have the whale's axes.
//! Rest places are read from the nodes and the inverse bind matrices, for any local axes (Blender aligns bones with their
//! length). Bones are identified by name, because the mesh does not contain their rotation axes. The vertex colour is the
//! mark; reading takes the mark of the nearest colour.

mod animation;
mod file;
mod joints;
pub mod pack;
mod skin;
mod write;

use endline_sim::whale::{Mark, Skin};
use glam::DVec3;

pub use animation::{Animation, read_animation};
pub use write::{About, Form, write};

/// A problem of a glTF file, and its correction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What is wrong.
    pub message: String,
    /// What was expected and how to fix it.
    pub help: String,
}

impl Fault {
    fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into() }
    }
}

/// Reads a skin from a `.glb` or `.gltf` file: its mesh and the places of its bones. Other properties of the bones are those
/// of `like`, the skin of the whale's measures. `Err` has the problems of the first stage that fails: file, bones, vertices,
/// whole skin.
pub fn read(bytes: &[u8], like: &Skin) -> Result<Skin, Vec<Fault>> {
    let file = file::File::open(bytes).map_err(|fault| vec![fault])?;
    let joints = joints::Joints::read(&file, like)?;
    let mesh = skin::read(&file, &joints, like)?;
    let mut skin = Skin {
        vertices: mesh.vertices,
        triangles: mesh.triangles,
        regions: mesh.regions,
        weights: mesh.weights,
        marks: mesh.marks,
        bones: joints.bones(like),
    };
    if skin::closed(&skin).is_some() {
        skin = skin::weld(&skin);
    }
    skin::whole(&skin, like)?;
    Ok(skin)
}

/// Converts a place from the whale's frame to glTF's axes.
fn to_gltf(place: DVec3) -> DVec3 {
    DVec3::new(place.x, place.z, -place.y)
}

/// Converts a place from glTF's axes to the whale's frame.
fn from_gltf(place: DVec3) -> DVec3 {
    DVec3::new(place.x, -place.z, place.y)
}

/// Marks and their colours: red, green, blue.
const COLOURS: [(Mark, [f32; 3]); 6] = [
    (Mark::Skin, [1.0, 1.0, 1.0]),
    (Mark::Callosity, [1.0, 0.8, 0.4]),
    (Mark::Baleen, [0.4, 0.4, 0.2]),
    (Mark::Mouth, [1.0, 0.4, 0.5]),
    (Mark::White, [0.6, 0.9, 1.0]),
    (Mark::Eye, [0.1, 0.1, 0.1]),
];

/// The colour of a mark.
fn colour_of(mark: Mark) -> [f32; 3] {
    COLOURS.iter().find(|(own, _)| *own == mark).map_or([1.0; 3], |(_, colour)| *colour)
}

/// The mark whose colour is nearest.
fn mark_of(colour: &[f64]) -> Mark {
    let off = |own: &[f32; 3]| {
        own.iter()
            .zip(colour)
            .map(|(own, seen)| (f64::from(*own) - seen) * (f64::from(*own) - seen))
            .sum::<f64>()
    };
    let near = COLOURS.iter().min_by(|left, right| off(&left.1).total_cmp(&off(&right.1)));
    near.map_or_else(Mark::default, |(mark, _)| *mark)
}
