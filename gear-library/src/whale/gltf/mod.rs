//! A whale's skin as a glTF 2.0 file, out and in: the bridge to Blender and other programs that draw and edit meshes.
//!
//! ```text
//! glTF  x y z  =  whale  x  z  -y        metres; glTF has y up, the whale's frame has z to the back
//! ```
//! Vertices are written in glTF's axes; the first bone turns by a quarter, so that each bone keeps the whale's own axes.
//! Rest places of bones and vertices are read from the nodes and the inverse bind matrices, whatever their local axes
//! (Blender turns its bones along themselves). How bones turn is not in the mesh: bones are known by name.

mod accessor;
mod animation;
mod check;
mod corners;
mod extras;
mod file;
mod joints;
mod marks;
pub mod pack;
mod weld;
mod write;

use endline_sim::whale::Skin;
use glam::DVec3;

pub use animation::{Animation, read_animation};
pub use extras::About;
pub use write::{Form, write};

/// What is wrong with a glTF file, and how to fix it.
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

/// Reads a skin from the bytes of a `.glb` or `.gltf` file: its mesh and where its bones sit. Bones, their order, their parents
/// and how they turn are those of `like`, the skin made from the whale's own measures.
///
/// # Errors
/// Every fault found at the first stage that fails: the file, its bones, its vertices, the whole skin.
pub fn read(bytes: &[u8], like: &Skin) -> Result<Skin, Vec<Fault>> {
    let file = file::File::open(bytes).map_err(|fault| vec![fault])?;
    let joints = joints::Joints::read(&file, like)?;
    let mesh = corners::read(&file, &joints, like)?;
    let mut skin = Skin {
        vertices: mesh.vertices,
        triangles: mesh.triangles,
        regions: mesh.regions,
        weights: mesh.weights,
        marks: mesh.marks,
        bones: joints.bones(like),
    };
    if check::closed(&skin).is_some() {
        skin = weld::weld(&skin);
    }
    check::whole(&skin, like)?;
    Ok(skin)
}

/// A place of the whale's frame in glTF's axes.
fn to_gltf(place: DVec3) -> DVec3 {
    DVec3::new(place.x, place.z, -place.y)
}

/// A place in glTF's axes in the whale's frame.
fn from_gltf(place: DVec3) -> DVec3 {
    DVec3::new(place.x, -place.z, place.y)
}
