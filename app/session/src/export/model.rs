//! The solid parts of a scene as 3-D models for CAD and for pictures, STL and binary glTF 2.0; lines as closed tubes.
//!
//! STL has no unit and no axes of its own: coordinates are metres, z up. glTF is in metres with y
//! up, so a place (x, y, z) is written (x, z, -y). Only glTF carries colours.

use std::sync::Arc;

use endline_gear::whale::gltf::pack::{self, Pack};
use endline_sim::model::Knot;
use endline_sim::{Frame, Model};
use glam::Vec3;
use serde_json::{Value, json};

use crate::scene::Scene;
use crate::scene::mesh::{Colour, Mesh};

/// Parts that are solid, unlike the sea and marks.
const SOLID: [&str; 5] = ["obstacles", "whale", "ropes", "weak places", "bodies"];

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
pub fn glb(scene: &Scene) -> Vec<u8> {
    let mut pack = Pack::default();
    let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
    for (name, mesh) in solid(scene) {
        nodes.push(json!({ "name": name, "mesh": meshes.len() }));
        let primitive = primitive(&mut pack, mesh);
        meshes.push(json!({ "name": name, "primitives": [primitive] }));
    }
    file(pack, nodes, meshes, None)
}

/// The bytes of a file: nodes, all of one scene, with their meshes, and how they move.
pub(super) fn file(
    pack: Pack,
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    animation: Option<Value>,
) -> Vec<u8> {
    let of_scene: Vec<usize> = (0..nodes.len()).collect();
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "Endline" },
        "scene": 0,
        "scenes": [{ "nodes": of_scene }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [material()],
        "accessors": pack.accessors,
        "bufferViews": pack.views,
    });
    if let Some(animation) = animation {
        document["animations"] = json!([animation]);
    }
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

/// Rings of a whole line's tubes, and vertices of each.
const RINGS: usize = 400;
const SIDES: usize = 6;

/// A stretch of a line that is whole at the end of the frames.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    line: usize,
    /// From where to where, as shares of the line's length.
    from: f64,
    to: f64,
}

/// The pieces that a line is in at the last of the frames.
pub(super) fn pieces(model: &Model, frames: &[Arc<Frame>], line: usize) -> Vec<Piece> {
    let Some(last) = frames.last() else { return Vec::new() };
    let lengths = Lengths::of(model, last, line);
    let mut cuts: Vec<f64> = lengths.cut_middles();
    cuts.push(1.0);
    let mut from = 0.0;
    let mut found = Vec::new();
    for to in cuts {
        found.push(Piece { line, from, to });
        from = to;
    }
    found
}

impl Piece {
    /// Vertices of a line that does not part.
    pub(super) const MOST_VERTICES: usize = RINGS * SIDES;

    /// The mesh in the first frame, and the places of its vertices in each later one.
    pub(super) fn meshes(
        &self,
        model: &Model,
        frames: &[Arc<Frame>],
        radius: f32,
        colour: Colour,
    ) -> (Mesh, Vec<Vec<Vec3>>) {
        let mut across = Vec3::ZERO;
        let mut tubes = frames.iter().map(|frame| {
            let centres = self.centres(model, frame);
            rings(&centres, radius, &mut across)
        });
        let first = tubes.next().unwrap_or_default();
        let mesh = mesh_of(&first, colour);
        (mesh, tubes.map(|tube| tube.into_iter().map(|(place, _)| place).collect()).collect())
    }

    fn centres(&self, model: &Model, frame: &Frame) -> Vec<Vec3> {
        let lengths = Lengths::of(model, frame, self.line);
        let count = (((self.to - self.from) * RINGS as f64) as usize).max(2);
        let share =
            |ring: usize| self.from + (self.to - self.from) * ring as f64 / (count - 1) as f64;
        // Where the line is cut, its pieces end at the nodes of their own sides.
        let middle = 0.5 * (self.from + self.to);
        (0..count).map(|ring| lengths.place(share(ring), share(ring) < middle)).collect()
    }

    /// Position at a share of a line's length in a frame; none where the frame lacks it.
    pub(super) fn place_at(model: &Model, frame: &Frame, line: usize, share: f64) -> Option<Vec3> {
        let lengths = Lengths::of(model, frame, line);
        (!lengths.nodes.is_empty()).then(|| lengths.place(share, false))
    }

    /// Where on its line a knot sits, as a share of the length.
    pub(super) fn share_of_knot(model: &Model, frame: &Frame, knot: &Knot) -> f64 {
        let line = model.segment_line[knot.segment];
        let lengths = Lengths::of(model, frame, line);
        let segment = knot.segment - model.line_segments[line].start;
        let start = lengths.start(segment);
        let length = lengths.start(segment + 1) - start;
        (start + knot.fraction(length) * length) / lengths.whole_m()
    }
}

/// A line in a frame by its unstretched length.
struct Lengths<'a> {
    nodes: &'a [endline_sim::DVec3],
    cut: &'a [bool],
    /// Length from the line's start to the end of each segment [m].
    ends: Vec<f64>,
}

impl<'a> Lengths<'a> {
    fn of(model: &Model, frame: &'a Frame, line: usize) -> Self {
        let (nodes, segments) = (model.line_nodes[line].clone(), model.line_segments[line].clone());
        let whole = frame.nodes.len() >= nodes.end
            && frame.cut.len() >= segments.end
            && frame.segment_length_m.len() >= segments.end;
        if !whole {
            return Self { nodes: &[], cut: &[], ends: Vec::new() };
        }
        let mut at = 0.0;
        let ends = frame.segment_length_m[segments.clone()].iter().map(|length| {
            at += length;
            at
        });
        Self { ends: ends.collect(), nodes: &frame.nodes[nodes], cut: &frame.cut[segments] }
    }

    fn whole_m(&self) -> f64 {
        self.ends.last().copied().unwrap_or_default().max(1e-9)
    }

    /// Length from the line's start to that of a segment, or to the line's end [m].
    fn start(&self, segment: usize) -> f64 {
        let before = segment.checked_sub(1).and_then(|before| self.ends.get(before));
        before.copied().unwrap_or_default()
    }

    /// Middles of the segments that are cut, as shares of the length.
    fn cut_middles(&self) -> Vec<f64> {
        let cut = (0..self.cut.len()).filter(|segment| self.cut[*segment]);
        cut.map(|segment| 0.5 * (self.start(segment) + self.ends[segment]) / self.whole_m())
            .collect()
    }

    /// The position at a share of the length. In a segment that is cut it is the node that the piece still has: the further one
    /// `at_start` of a piece.
    fn place(&self, share: f64, at_start: bool) -> Vec3 {
        let wanted = share.clamp(0.0, 1.0) * self.whole_m();
        let segment = self.ends.partition_point(|end| *end < wanted);
        let segment = segment.min(self.ends.len().saturating_sub(1));
        let Some([from, to]) = self.nodes.get(segment..segment + 2) else {
            return self.nodes.last().map_or(Vec3::ZERO, |node| node.as_vec3());
        };
        if self.cut[segment] {
            return (if at_start { *to } else { *from }).as_vec3();
        }
        let start = self.start(segment);
        let length = (self.ends[segment] - start).max(1e-9);
        from.lerp(*to, (wanted - start) / length).as_vec3()
    }
}

/// Places and normals of the rings of a tube. `across` is where its first ring began in the frame before: so that it does not turn.
fn rings(centres: &[Vec3], radius: f32, across: &mut Vec3) -> Vec<(Vec3, Vec3)> {
    let last = centres.len() - 1;
    let along = |ring: usize| {
        let way = centres[(ring + 1).min(last)] - centres[ring.saturating_sub(1)];
        way.normalize_or(Vec3::Z)
    };
    let level = |side: Vec3, along: Vec3| {
        (side - along * side.dot(along))
            .try_normalize()
            .unwrap_or_else(|| along.any_orthonormal_vector())
    };
    *across = level(*across, along(0));
    let mut side = *across;
    let mut found = Vec::with_capacity(centres.len() * SIDES);
    for (ring, centre) in centres.iter().enumerate() {
        let along = along(ring);
        side = level(side, along);
        let up = along.cross(side);
        for corner in 0..SIDES {
            let angle = std::f32::consts::TAU * corner as f32 / SIDES as f32;
            let normal = side * angle.cos() + up * angle.sin();
            found.push((*centre + normal * radius, normal));
        }
    }
    found
}

fn mesh_of(rings: &[(Vec3, Vec3)], colour: Colour) -> Mesh {
    let mut mesh = Mesh::default();
    for (place, normal) in rings {
        mesh.vertex(*place, *normal, 0.0, colour);
    }
    for first in (SIDES..rings.len()).step_by(SIDES) {
        mesh.band((first - SIDES) as u32, first as u32, SIDES);
    }
    mesh
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::scene::{Bounds, Look, Part};

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
            drift_m: DVec3::ZERO,
            film: false,
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
