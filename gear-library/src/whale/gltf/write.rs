//! Writes a skin as a glTF file: one mesh with a primitive and material per region, one skin, one node per bone.
//!
//! Extra properties describe the axes and ranges of the bones and the whale, for other programs; Endline only uses the names
//! of bones.

use std::f64::consts::FRAC_1_SQRT_2;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use endline_sdk::Region;
use endline_sim::whale::{Bone, Channel, JointRanges, Skin};
use glam::DVec3;
use serde_json::{Value, json};

use super::pack::{Pack, binary};
use super::{colour_of, to_gltf};

/// The two forms of glTF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One binary file, `.glb`.
    Binary,
    /// Text with embedded data, `.gltf`.
    Text,
}

impl Form {
    /// The form by a file's name; `None` for another ending.
    pub fn of_file(name: &str) -> Option<Self> {
        match name.rsplit_once('.')?.1.to_ascii_lowercase().as_str() {
            "glb" => Some(Self::Binary),
            "gltf" => Some(Self::Text),
            _ => None,
        }
    }
}

/// The bytes of a glTF file; equal skins give equal bytes.
pub fn write(skin: &Skin, about: &About<'_>, form: Form) -> Vec<u8> {
    let mut pack = Pack::default();
    let mesh = mesh(skin, about, &mut pack);
    let bind: Vec<_> = skin.bones.iter().map(inverse_bind).collect();
    let bind = pack.matrices(&bind);
    let joints: Vec<usize> = (0..skin.bones.len()).map(|bone| bone + FIRST_BONE).collect();
    let mut document = json!({
        "asset": { "version": "2.0", "generator": concat!("Endline ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "name": about.name, "nodes": [SKIN_NODE, ROOT_NODE] }],
        "nodes": nodes(skin, about),
        "meshes": [mesh],
        "materials": regions(skin).map(material).collect::<Vec<_>>(),
        "skins": [{ "name": "whale", "inverseBindMatrices": bind, "skeleton": ROOT_NODE, "joints": joints }],
        "accessors": pack.accessors,
        "bufferViews": pack.views,
    });
    match form {
        Form::Binary => binary(document, pack.bytes),
        Form::Text => {
            let uri =
                format!("data:application/octet-stream;base64,{}", STANDARD.encode(&pack.bytes));
            document["buffers"] = json!([{ "byteLength": pack.bytes.len(), "uri": uri }]);
            format!("{document:#}\n").into_bytes()
        }
    }
}

/// Nodes: the skin, the root, then the bones in order. The first bone rotates the whale's axes into glTF's: Blender would
/// treat a rotation of the root as that of the armature, compensate it by a pose, and export the whale without the pose.
const SKIN_NODE: usize = 0;
const ROOT_NODE: usize = 1;
const FIRST_BONE: usize = 2;

fn nodes(skin: &Skin, about: &About<'_>) -> Vec<Value> {
    let children = |of: Option<usize>| -> Vec<usize> {
        let own = skin.bones.iter().enumerate().filter(|(_, bone)| bone.parent == of);
        own.map(|(index, _)| index + FIRST_BONE).collect()
    };
    let mut nodes = vec![
        json!({ "name": "skin", "mesh": 0, "skin": 0 }),
        json!({ "name": "whale", "children": children(None), "extras": whale_extras(about) }),
    ];
    for (index, bone) in skin.bones.iter().enumerate() {
        let mut node = json!({ "name": bone.name, "extras": bone_extras(bone, about.joints) });
        match bone.parent.and_then(|parent| skin.bones.get(parent)) {
            Some(parent) => {
                node["translation"] = json!((bone.origin - parent.origin).to_array());
            }
            None => {
                node["translation"] = json!(to_gltf(bone.origin).to_array());
                node["rotation"] = json!([-FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2]);
            }
        }
        let below = children(Some(index));
        if !below.is_empty() {
            node["children"] = json!(below);
        }
        nodes.push(node);
    }
    nodes
}

/// Inverse bind matrix of a bone, column by column.
fn inverse_bind(bone: &Bone) -> [f32; 16] {
    let at = bone.origin.as_vec3();
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, -at.x, -at.y, -at.z, 1.0]
}

fn mesh(skin: &Skin, about: &About<'_>, pack: &mut Pack) -> Value {
    let single = |place: DVec3| to_gltf(place).as_vec3().to_array();
    let places: Vec<_> = skin.vertices.iter().map(|&place| single(place)).collect();
    let outward: Vec<_> = normals(skin).into_iter().map(single).collect();
    let (joints, weights): (Vec<_>, Vec<_>) = skin.weights.iter().map(packed).unzip();
    let mut attributes = json!({
        "POSITION": pack.places(&places),
        "NORMAL": pack.vertices(&outward),
        "JOINTS_0": pack.joints(&joints),
        "WEIGHTS_0": pack.vertices(&weights),
    });
    if skin.marks.len() == skin.vertices.len() {
        attributes["COLOR_0"] = json!(
            pack.vertices(&skin.marks.iter().map(|&mark| colour_of(mark)).collect::<Vec<_>>())
        );
    }
    let primitive = |(material, region): (usize, Region)| {
        let own = skin.triangles.iter().zip(&skin.regions).filter(|(_, own)| **own == region);
        let corners: Vec<u32> = own.flat_map(|(triangle, _)| *triangle).collect();
        json!({ "attributes": attributes, "indices": pack.indices(&corners), "material": material, "mode": 4 })
    };
    let primitives: Vec<_> = regions(skin).enumerate().map(primitive).collect();
    json!({ "name": about.id, "primitives": primitives })
}

/// The regions that have skin, in their own order.
fn regions(skin: &Skin) -> impl Iterator<Item = Region> {
    Region::ALL.into_iter().filter(|region| skin.regions.contains(region))
}

/// A material named after its region; its colour only distinguishes regions.
fn material(region: Region) -> Value {
    let turn = f64::from(region as u32) * 0.618_034;
    let colour: [f64; 3] = std::array::from_fn(|part| {
        let shade = 0.5 + 0.35 * libm::cos(std::f64::consts::TAU * (turn + part as f64 / 3.0));
        (shade * 1000.0).round() / 1000.0
    });
    let [red, green, blue] = colour;
    json!({
        "name": region.name(),
        "pbrMetallicRoughness": { "baseColorFactor": [red, green, blue, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.6 },
    })
}

/// Unit normals at the vertices, weighted by the angles of the triangles.
fn normals(skin: &Skin) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; skin.vertices.len()];
    for triangle in &skin.triangles {
        let corners = triangle.map(|corner| skin.vertices[corner as usize]);
        let facing = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        for side in 0..3 {
            let [to_next, to_last] =
                [1, 2].map(|step| (corners[(side + step) % 3] - corners[side]).normalize_or_zero());
            sums[triangle[side] as usize] +=
                facing * libm::acos(to_next.dot(to_last).clamp(-1.0, 1.0));
        }
    }
    sums.into_iter().map(|sum| sum.try_normalize().unwrap_or(DVec3::Z)).collect()
}

/// Joints and weights of a vertex for glTF: greatest first, each joint once, unused ones 0, a sum of 1.
fn packed(weights: &[(u16, f64); 4]) -> ([u16; 4], [f32; 4]) {
    let mut own: Vec<(u16, f32)> = Vec::with_capacity(4);
    for &(bone, weight) in weights {
        let weight = weight as f32;
        match own.iter_mut().find(|(known, _)| *known == bone) {
            _ if weight <= 0.0 => {}
            Some((_, sum)) => *sum += weight,
            None => own.push((bone, weight)),
        }
    }
    own.sort_by(|left, right| right.1.total_cmp(&left.1));
    let rest: f32 = own.iter().skip(1).map(|(_, weight)| weight).sum();
    if let Some((_, first)) = own.first_mut() {
        *first = 1.0 - rest;
    }
    own.resize(4, (0, 0.0));
    (std::array::from_fn(|place| own[place].0), std::array::from_fn(|place| own[place].1))
}

/// Properties of the whale in a file.
#[derive(Clone, Copy, Debug)]
pub struct About<'a> {
    /// Id of the library's whale.
    pub id: &'a str,
    /// Its name.
    pub name: &'a str,
    /// Body length [m].
    pub length_m: f64,
    /// Its joint ranges.
    pub joints: &'a JointRanges,
}

/// Extra properties of a bone: the angles that rotate it, with share, axis in the bone's frame (that of the whale) and range.
pub(super) fn bone_extras(bone: &Bone, ranges: &JointRanges) -> Value {
    let turn = |(channel, axis): &(Channel, DVec3)| {
        let (angle, of) = channel.angle.name();
        let [least, most] = ranges.of(channel.angle).map(degrees);
        json!({ "angle": angle, "of": of, "share": channel.share, "axis": axis.to_array(), "least_deg": least, "most_deg": most })
    };
    json!({ "turns": bone.turns.iter().map(turn).collect::<Vec<_>>() })
}

/// Extra properties of the root: the whale, and the ranges of the whole spine.
pub(super) fn whale_extras(about: &About<'_>) -> Value {
    let [pitch, yaw, roll] = about.joints.spine_total.map(degrees);
    json!({
        "endline": 1,
        "whale": about.id,
        "length_m": about.length_m,
        "axes": "bones: x to the snout, y to port, z to the back",
        "spine_total_deg": { "pitch": pitch, "yaw": yaw, "roll": roll },
    })
}

/// Rounded degrees; null for an unlimited angle.
fn degrees(angle: f64) -> Option<f64> {
    angle.is_finite().then(|| (angle.to_degrees() * 1e9).round() / 1e9)
}
