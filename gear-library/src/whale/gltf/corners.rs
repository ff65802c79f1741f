//! The vertices and triangles of a glTF file: put into rest place, with bones by the whale's numbers.

use std::collections::{BTreeMap, BTreeSet};

use endline_sdk::Region;
use endline_sim::whale::{Mark, Skin};
use glam::DVec3;
use gltf::mesh::Mode;
use gltf::{Primitive, Semantic};

use super::accessor::rows;
use super::file::File;
use super::joints::Joints;
use super::marks;
use super::{Fault, from_gltf};
use crate::limits::MESH_CORNERS;
use crate::nearest::{hint, nearest};

/// Weights that sum to 1 by less than this are scaled to do so.
const SUM_OFF: f64 = 0.01;
/// A weight below this moves nothing.
const NOTHING: f64 = 1e-6;

/// Vertices, triangles and what belongs to each.
#[derive(Default)]
pub(super) struct Mesh {
    /// Places in the whale's frame [m].
    pub vertices: Vec<DVec3>,
    /// Bones of each vertex, with weights that sum to 1.
    pub weights: Vec<[(u16, f64); 4]>,
    /// What is seen at each vertex.
    pub marks: Vec<Mark>,
    /// Corners of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Region of each triangle.
    pub regions: Vec<Region>,
}

/// Reads every primitive of every mesh.
pub(super) fn read(file: &File, joints: &Joints, like: &Skin) -> Result<Mesh, Vec<Fault>> {
    let mut reading = Reading {
        file,
        joints,
        mesh: Mesh::default(),
        read: BTreeMap::new(),
        strangers: BTreeSet::new(),
        faults: Vec::new(),
    };
    check_size(file).map_err(|fault| vec![fault])?;
    for mesh in file.document.nodes().filter_map(|node| node.mesh()) {
        for primitive in mesh.primitives() {
            reading.primitive(&primitive);
        }
    }
    for name in &reading.strangers {
        let bones = like.bones.iter().map(|bone| bone.name.as_str());
        reading.faults.push(Fault::new(
            format!("has vertices on the bone `{name}`, which the whale does not have"),
            hint(name, bones),
        ));
    }
    if reading.faults.is_empty() { Ok(reading.mesh) } else { Err(reading.faults) }
}

/// Refuses more corners than are read, counted before any is made: a mesh may stand at many nodes.
fn check_size(file: &File) -> Result<(), Fault> {
    let corners = |primitive: Primitive<'_>| {
        let counted = primitive.indices().or_else(|| primitive.get(&Semantic::Positions));
        counted.map_or(0, |accessor| accessor.count())
    };
    let meshes = file.document.nodes().filter_map(|node| node.mesh());
    let mut all = 0_usize;
    for primitive in meshes.flat_map(|mesh| mesh.primitives()) {
        all = all.saturating_add(corners(primitive));
        if all > MESH_CORNERS {
            let help = "make the mesh coarser, and put each mesh at one node";
            let message = format!("has more than {MESH_CORNERS} corners of triangles");
            return Err(Fault::new(message, help));
        }
    }
    Ok(())
}

struct Reading<'a> {
    file: &'a File,
    joints: &'a Joints,
    mesh: Mesh,
    /// Vertices of the mesh by the accessors they were read from: one set serves many primitives.
    read: BTreeMap<[usize; 3], Vec<u32>>,
    /// Names of joints that move vertices and are no bones of the whale.
    strangers: BTreeSet<String>,
    faults: Vec<Fault>,
}

impl Reading<'_> {
    fn primitive(&mut self, primitive: &Primitive<'_>) {
        let region = self.region(primitive.material().name());
        let corners = self
            .corners(primitive)
            .and_then(|vertices| Ok((indices(self.file, primitive, vertices.len())?, vertices)));
        match (corners, region) {
            (Ok((indices, vertices)), Some(region)) => {
                self.add_triangles(&indices, &vertices, region)
            }
            (Err(fault), _) => self.fault(fault),
            (Ok(_), None) => {}
        }
    }

    /// The region a material is named after; a copy's number, as in `lips.001`, is left off.
    fn region(&mut self, material: Option<&str>) -> Option<Region> {
        let regions = || Region::ALL.into_iter().map(Region::name);
        let Some(name) = material else {
            let all = regions().collect::<Vec<_>>().join(", ");
            self.fault(Fault::new(
                "has triangles without a material, so without a region",
                format!("name a material of each by its region: {all}"),
            ));
            return None;
        };
        let plain = name
            .rsplit_once('.')
            .filter(|(_, copy)| copy.bytes().all(|byte| byte.is_ascii_digit()))
            .map_or(name, |(plain, _)| plain);
        let found = Region::ALL.into_iter().find(|region| region.name() == plain);
        if found.is_none() {
            let meant = nearest(plain, regions())
                .map_or_else(String::new, |meant| format!("did you mean `{meant}`? "));
            let all = regions().collect::<Vec<_>>().join(", ");
            self.fault(Fault::new(
                format!("has a material `{name}`, which is no region"),
                format!("{meant}regions are {all}"),
            ));
        }
        found
    }

    /// The vertices of a primitive, as numbers of the mesh.
    fn corners(&mut self, primitive: &Primitive<'_>) -> Result<Vec<u32>, Fault> {
        if primitive.mode() != Mode::Triangles {
            return Err(Fault::new(
                "has lines or points among its triangles",
                "export triangles alone",
            ));
        }
        let need = |semantic, what| {
            let help = "in Blender, paint weights for every vertex and tick Data > Armature > Skinning on export";
            primitive
                .get(&semantic)
                .ok_or_else(|| Fault::new(format!("has vertices without {what}"), help))
        };
        let places = need(Semantic::Positions, "a place")?;
        let bones = need(Semantic::Joints(0), "bones")?;
        let weights = need(Semantic::Weights(0), "weights")?;
        if let Some(more) = primitive.get(&Semantic::Weights(1)) {
            self.at_most_four(&rows::<4>(self.file, &more)?)?;
        }
        let key = [places.index(), bones.index(), weights.index()];
        if let Some(known) = self.read.get(&key) {
            return Ok(known.clone());
        }
        let (places, bones, weights) = (
            rows::<3>(self.file, &places)?,
            rows::<4>(self.file, &bones)?,
            rows::<4>(self.file, &weights)?,
        );
        if places.len() != bones.len() || places.len() != weights.len() {
            return Err(Fault::new(
                "has vertices with and without bones in one list",
                "write the file anew",
            ));
        }
        let seen = self.marks(primitive, places.len())?;
        let vertices = places.iter().zip(&bones).zip(&weights).zip(&seen);
        let vertices = vertices
            .map(|(((place, bones), weights), mark)| self.vertex(*place, *bones, *weights, *mark));
        let vertices = vertices.collect::<Result<Vec<u32>, Fault>>()?;
        self.read.insert(key, vertices.clone());
        Ok(vertices)
    }

    /// What is seen at each vertex: the mark nearest to its colour, plain skin where it has none.
    fn marks(&self, primitive: &Primitive<'_>, count: usize) -> Result<Vec<Mark>, Fault> {
        let mut seen: Vec<Mark> = match primitive.get(&Semantic::Colors(0)) {
            None => Vec::new(),
            Some(colours) if colours.dimensions().multiplicity() == 4 => {
                rows::<4>(self.file, &colours)?
                    .iter()
                    .map(|colour| marks::nearest(&colour[..3]))
                    .collect()
            }
            Some(colours) => rows::<3>(self.file, &colours)?
                .iter()
                .map(|colour| marks::nearest(colour))
                .collect(),
        };
        seen.resize(count, Mark::default());
        Ok(seen)
    }

    fn at_most_four(&self, more: &[[f64; 4]]) -> Result<(), Fault> {
        let count =
            more.iter().filter(|weights| weights.iter().any(|weight| *weight > NOTHING)).count();
        if count == 0 {
            return Ok(());
        }
        let help = "at most four bones move a vertex; in Blender, Weights > Limit Total to 4, then Normalize All";
        Err(Fault::new(format!("has {count} vertices on more than four bones"), help))
    }

    /// Adds a vertex; its number.
    fn vertex(
        &mut self,
        place: [f64; 3],
        joints: [f64; 4],
        weights: [f64; 4],
        mark: Mark,
    ) -> Result<u32, Fault> {
        let (rest, weights) = self.at_rest(DVec3::from_array(place), joints, weights)?;
        let number = u32::try_from(self.mesh.vertices.len()).unwrap_or(u32::MAX);
        self.mesh.vertices.push(rest);
        self.mesh.weights.push(weights);
        self.mesh.marks.push(mark);
        Ok(number)
    }

    /// Where the joints at rest put a vertex, in the whale's frame, and its weights by bone.
    fn at_rest(
        &mut self,
        place: DVec3,
        joints: [f64; 4],
        weights: [f64; 4],
    ) -> Result<(DVec3, [(u16, f64); 4]), Fault> {
        let sum: f64 = weights.iter().sum();
        if !(place.is_finite()
            && (sum - 1.0).abs() <= SUM_OFF
            && weights.iter().all(|weight| *weight >= 0.0))
        {
            let message = format!(
                "has a vertex at {} whose weights sum to {sum:.3}, not 1",
                shown(from_gltf(place))
            );
            return Err(Fault::new(
                message,
                "in Blender, Weights > Normalize All; every vertex needs a bone",
            ));
        }
        let (mut rest, mut own) = (DVec3::ZERO, [(0, 0.0); 4]);
        for ((slot, joint), weight) in
            own.iter_mut().zip(joints).zip(weights).filter(|(_, weight)| *weight > 0.0)
        {
            let joint = joint as usize;
            let (Some(bind), Some(bone)) =
                (self.joints.binds.get(joint), self.joints.bones.get(joint))
            else {
                return Err(Fault::new(
                    format!("has a vertex on joint {joint}, which its skin does not have"),
                    "write the file anew",
                ));
            };
            rest += weight / sum * bind.transform_point3(place);
            match bone {
                Some(bone) => *slot = (*bone, weight / sum),
                None => {
                    self.strangers.insert(self.joints.names[joint].clone());
                }
            }
        }
        Ok((from_gltf(rest), own))
    }

    fn add_triangles(&mut self, indices: &[usize], vertices: &[u32], region: Region) {
        for corners in indices.chunks_exact(3) {
            self.mesh.triangles.push([
                vertices[corners[0]],
                vertices[corners[1]],
                vertices[corners[2]],
            ]);
            self.mesh.regions.push(region);
        }
    }

    fn fault(&mut self, fault: Fault) {
        if !self.faults.contains(&fault) {
            self.faults.push(fault);
        }
    }
}

/// Corners of a primitive's triangles, each below `count`.
fn indices(file: &File, primitive: &Primitive<'_>, count: usize) -> Result<Vec<usize>, Fault> {
    let Some(accessor) = primitive.indices() else { return Ok((0..count).collect()) };
    let indices: Vec<usize> =
        rows::<1>(file, &accessor)?.into_iter().map(|[index]| index as usize).collect();
    if indices.iter().any(|index| *index >= count) {
        return Err(Fault::new(
            "has a triangle on a vertex that is not there",
            "write the file anew",
        ));
    }
    Ok(indices)
}

/// A place for a message: three coordinates in the whale's frame.
pub(super) fn shown(place: DVec3) -> String {
    format!("({:.2} m, {:.2} m, {:.2} m)", place.x, place.y, place.z)
}
