//! The bones of a glTF file: identified by name, with their rest places and the transforms of their vertices.

use endline_sim::whale::{Bone, Skin};
use glam::{DAffine3, DMat4, DVec3};
use gltf::{Node, Skin as FileSkin};

use crate::diagnostic::hint;

use super::file::{File, rows};
use super::{Fault, from_gltf};

/// The joints of a file's skin.
pub(super) struct Joints {
    /// Name of each joint.
    pub names: Vec<String>,
    /// The bone of each joint; `None` if the whale has no such bone.
    pub bones: Vec<Option<u16>>,
    /// Rest transform of each joint's vertices, from the mesh to the scene.
    pub binds: Vec<DAffine3>,
    /// Rest place of each joint in the whale's frame [m].
    origins: Vec<DVec3>,
}

impl Joints {
    /// Reads the skin of the file with all bones of `like`.
    pub fn read(file: &File, like: &Skin) -> Result<Self, Vec<Fault>> {
        let skin = only_skin(file).map_err(|fault| vec![fault])?;
        let names: Vec<String> =
            skin.joints().map(|joint| joint.name().unwrap_or_default().to_owned()).collect();
        missing(&names, like)?;
        let bone = |name: &String| {
            like.bones
                .iter()
                .position(|bone| bone.name == *name)
                .and_then(|bone| u16::try_from(bone).ok())
        };
        let (parents, locals) =
            (parents(file), file.document.nodes().map(|node| local(&node)).collect::<Vec<_>>());
        let worlds: Vec<DAffine3> =
            skin.joints().map(|joint| world(&locals, &parents, joint.index())).collect();
        let inverse = inverse_binds(file, &skin, names.len()).map_err(|fault| vec![fault])?;
        Ok(Self {
            bones: names.iter().map(bone).collect(),
            binds: worlds.iter().zip(inverse).map(|(world, inverse)| *world * inverse).collect(),
            origins: worlds.iter().map(|world| from_gltf(world.translation)).collect(),
            names,
        })
    }

    /// The bones of `like` at the places of this file.
    pub fn bones(&self, like: &Skin) -> Vec<Bone> {
        let mut bones = like.bones.clone();
        for (bone, origin) in self.bones.iter().zip(&self.origins) {
            if let Some(bone) = bone.and_then(|bone| bones.get_mut(usize::from(bone))) {
                bone.origin = *origin;
            }
        }
        bones
    }
}

/// The skin of every mesh in the file.
fn only_skin(file: &File) -> Result<FileSkin<'_>, Fault> {
    let parent_it =
        "in Blender, parent the mesh to the armature with its vertex groups, and export both";
    let mut found: Option<FileSkin<'_>> = None;
    for node in file.document.nodes().filter(|node| node.mesh().is_some()) {
        let Some(skin) = node.skin() else {
            let message =
                format!("has a mesh without a skin, `{}`", node.name().unwrap_or("without a name"));
            return Err(Fault::new(message, format!("{parent_it}; delete other objects")));
        };
        if found.as_ref().is_some_and(|known| known.index() != skin.index()) {
            return Err(Fault::new("has meshes on different skins", "join the armatures into one"));
        }
        found = Some(skin);
    }
    found.ok_or_else(|| Fault::new("has no mesh on a skin", parent_it))
}

/// The missing bones.
fn missing(names: &[String], like: &Skin) -> Result<(), Vec<Fault>> {
    let faults: Vec<Fault> = like
        .bones
        .iter()
        .filter(|bone| !names.contains(&bone.name))
        .map(|bone| {
            let strangers =
                names.iter().filter(|name| like.bones.iter().all(|known| known.name != **name));
            Fault::new(
                format!("has no bone `{}`", bone.name),
                hint(&bone.name, strangers.map(String::as_str)),
            )
        })
        .collect();
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

/// The parent of each node.
pub(super) fn parents(file: &File) -> Vec<Option<usize>> {
    let mut parents = vec![None; file.document.nodes().len()];
    for node in file.document.nodes() {
        for child in node.children() {
            parents[child.index()] = Some(node.index());
        }
    }
    parents
}

/// Rest transform of each node to the scene: from its inverse bind matrix, else from the nodes.
pub(super) fn rests(file: &File) -> Result<Vec<DAffine3>, Fault> {
    let (parents, locals) =
        (parents(file), file.document.nodes().map(|node| local(&node)).collect::<Vec<_>>());
    let mut rests: Vec<DAffine3> =
        (0..locals.len()).map(|node| world(&locals, &parents, node)).collect();
    for skin in file.document.skins().filter(|skin| skin.inverse_bind_matrices().is_some()) {
        let inverse = inverse_binds(file, &skin, skin.joints().count())?;
        skin.joints()
            .zip(inverse)
            .for_each(|(joint, inverse)| rests[joint.index()] = inverse.inverse());
    }
    Ok(rests)
}

/// A node's transform to the scene; a cycle of parents ends after the number of nodes.
fn world(locals: &[DAffine3], parents: &[Option<usize>], node: usize) -> DAffine3 {
    let (mut world, mut at) = (DAffine3::IDENTITY, Some(node));
    for _ in 0..parents.len() {
        let Some(here) = at else { break };
        world = locals[here] * world;
        at = parents[here];
    }
    world
}

/// The local transform of a node.
pub(super) fn local(node: &Node<'_>) -> DAffine3 {
    affine(&node.transform().matrix().map(|column| column.map(f64::from)))
}

fn affine(columns: &[[f64; 4]; 4]) -> DAffine3 {
    DAffine3::from_mat4(DMat4::from_cols_array_2d(columns))
}

fn inverse_binds(file: &File, skin: &FileSkin<'_>, count: usize) -> Result<Vec<DAffine3>, Fault> {
    let Some(accessor) = skin.inverse_bind_matrices() else {
        return Ok(vec![DAffine3::IDENTITY; count]);
    };
    let matrices = rows::<16>(file, &accessor)?;
    if matrices.len() < count {
        let message = format!("has {} inverse bind matrices for {count} bones", matrices.len());
        return Err(Fault::new(message, "export it again"));
    }
    Ok(matrices
        .iter()
        .map(|matrix| {
            affine(&std::array::from_fn(|column| {
                std::array::from_fn(|row| matrix[4 * column + row])
            }))
        })
        .collect())
}
