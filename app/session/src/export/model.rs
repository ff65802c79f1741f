//! The solid parts of a scene as 3-D models for CAD and for pictures: STL and binary glTF 2.0.
//!
//! STL has no unit and no axes of its own: coordinates are metres, z up. glTF is in metres with y
//! up, so a place (x, y, z) is written (x, z, -y). Only glTF carries colours.

use endline_gear::whale::gltf::pack::{self, Pack};
use glam::Vec3;
use serde_json::{Value, json};

use crate::scene::Scene;
use crate::scene::mesh::Mesh;

/// Parts that are solid things, unlike the sea and marks.
const SOLID: [&str; 4] = ["obstacles", "whale", "ropes", "bodies"];

fn solid(scene: &Scene) -> impl Iterator<Item = (&'static str, &Mesh)> {
    scene.parts.iter().filter(|part| SOLID.contains(&part.name)).map(|part| (part.name, &part.mesh))
}

/// Where each vertex is: the skin of rope lies a radius off its centre line.
fn places(mesh: &Mesh) -> impl Iterator<Item = Vec3> + '_ {
    mesh.place
        .iter()
        .zip(&mesh.normal)
        .zip(&mesh.radius_m)
        .map(|((place, normal), radius_m)| *place + *normal * *radius_m)
}

/// Binary STL.
#[must_use]
pub fn stl(scene: &Scene) -> Vec<u8> {
    let mut triangles: Vec<[Vec3; 3]> = Vec::new();
    for (_, mesh) in solid(scene) {
        let places: Vec<Vec3> = places(mesh).collect();
        triangles.extend(
            mesh.triangles.iter().map(|corners| corners.map(|corner| places[corner as usize])),
        );
    }
    let mut bytes = b"Endline; metres, z up".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(u32::try_from(triangles.len()).unwrap_or(u32::MAX).to_le_bytes());
    for [a, b, c] in triangles {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for place in [normal, a, b, c] {
            place.to_array().iter().for_each(|number| bytes.extend(number.to_le_bytes()));
        }
        bytes.extend([0, 0]);
    }
    bytes
}

/// Binary glTF 2.0: one node and mesh a part.
#[must_use]
pub fn glb(scene: &Scene) -> Vec<u8> {
    let mut pack = Pack::default();
    let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
    for (name, mesh) in solid(scene) {
        nodes.push(json!({ "name": name, "mesh": meshes.len() }));
        let primitive = primitive(&mut pack, mesh);
        meshes.push(json!({ "name": name, "primitives": [primitive] }));
    }
    let of_scene: Vec<usize> = (0..nodes.len()).collect();
    let document = json!({
        "asset": { "version": "2.0", "generator": "Endline" },
        "scene": 0,
        "scenes": [{ "nodes": of_scene }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [material()],
        "accessors": pack.accessors,
        "bufferViews": pack.views,
    });
    pack::binary(document, pack.bytes)
}

/// A mesh in the first material, with its colours.
pub(super) fn primitive(pack: &mut Pack, mesh: &Mesh) -> Value {
    let places: Vec<[f32; 3]> = places(mesh).map(turned).collect();
    let unit = |normal: &Vec3| turned(normal.normalize_or(Vec3::Z));
    let normals: Vec<[f32; 3]> = mesh.normal.iter().map(unit).collect();
    let attributes = json!({
        "POSITION": pack.places(&places),
        "NORMAL": pack.vertices(&normals),
        "COLOR_0": pack.vertices(&mesh.colour),
    });
    let indices = pack.indices(mesh.triangles.as_flattened());
    json!({ "attributes": attributes, "indices": indices, "material": 0 })
}

/// The material of all parts: dull, in the colours of the vertices.
pub(super) fn material() -> Value {
    json!({
        "name": "gear",
        "doubleSided": true,
        "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": 0.7 },
    })
}

/// A place or direction with y up.
pub(super) fn turned(place: Vec3) -> [f32; 3] {
    [place.x, place.z, -place.y]
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::scene::bounds::Bounds;
    use crate::scene::{Look, Part};

    /// A tetrahedron with legs of 1, 2 and 3 m: 1 m³.
    fn scene() -> Scene {
        let mut mesh = Mesh::default();
        for place in [Vec3::ZERO, Vec3::X, Vec3::Y * 2.0, Vec3::Z * 3.0] {
            mesh.vertex(place, Vec3::Z, 0.0, [0.5, 0.5, 0.5, 1.0]);
        }
        mesh.triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let part = |name, mesh| Part { name, look: Look::Solid, least_px: 0.0, mesh };
        let parts = vec![part("bodies", mesh.clone()), part("seabed", mesh)];
        Scene {
            parts,
            bounds: Bounds { low: DVec3::ZERO, high: DVec3::ONE },
            scale_n: 1.0,
            time_s: 0.0,
            depth_m: 1.0,
        }
    }

    #[test]
    fn an_stl_encloses_the_volume_of_the_things_and_leaves_the_sea_out() {
        let bytes = stl(&scene());
        assert_eq!(bytes.len(), 84 + 4 * 50);
        let number = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        let corner = |triangle: usize, corner: usize| {
            let at = 84 + 50 * triangle + 12 * (corner + 1);
            Vec3::new(number(at), number(at + 4), number(at + 8))
        };
        // Divergence theorem: outward triangles sum to the volume.
        let volume: f32 = (0..4)
            .map(|triangle| {
                corner(triangle, 0).dot(corner(triangle, 1).cross(corner(triangle, 2))) / 6.0
            })
            .sum();
        assert!((volume - 1.0).abs() < 1e-6, "{volume}");
    }

    #[test]
    fn a_gltf_reader_finds_every_triangle_with_y_up() {
        let bytes = glb(&scene());
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!(
            [word(0), word(4), word(8)],
            [0x4654_6C67, 2, u32::try_from(bytes.len()).unwrap()]
        );
        let length = word(12) as usize;
        let document: Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        assert_eq!(document["meshes"].as_array().unwrap().len(), 1);
        let accessor = |index: &Value| {
            &document["accessors"][usize::try_from(index.as_u64().unwrap()).unwrap()]
        };
        let primitive = &document["meshes"][0]["primitives"][0];
        assert_eq!(accessor(&primitive["indices"])["count"], 12);
        let place = accessor(&primitive["attributes"]["POSITION"]);
        assert_eq!(
            (place["count"].as_u64(), place["max"][1].as_f64(), place["min"][2].as_f64()),
            (Some(4), Some(3.0), Some(-2.0))
        );
        assert_eq!(
            u64::from(word(20 + length)),
            document["buffers"][0]["byteLength"].as_u64().unwrap().next_multiple_of(4)
        );
    }
}
