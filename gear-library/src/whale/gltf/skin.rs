//! Reads vertices and triangles of a glTF file at rest, joins split vertices, and checks the skin.
//!
//! Programs split vertices at borders of materials, normals or textures. Vertices with equal place and weights are joined to
//! close the skin; touching lips on different bones remain separate. A closed skin is not changed.
//! A valid skin is closed, faces outward and has the size and place of the whale.

use std::collections::{BTreeMap, BTreeSet};

use endline_sdk::Region;
use endline_sim::whale::{Bounds, Mark, Skin};
use glam::DVec3;
use gltf::mesh::Mode;
use gltf::{Primitive, Semantic};

use crate::diagnostic::{hint, nearest};
use crate::limits::MESH_CORNERS;

use super::file::{File, rows};
use super::joints::Joints;
use super::{Fault, from_gltf, mark_of};

/// Greatest deviation of a sum of weights from 1; smaller ones are corrected.
const SUM_OFF: f64 = 0.01;
/// Smallest weight.
const NOTHING: f64 = 1e-6;

/// Vertices and triangles with their attributes.
#[derive(Default)]
pub(super) struct Mesh {
    /// Places in the whale's frame [m].
    pub vertices: Vec<DVec3>,
    /// Bones of each vertex, with weights that sum to 1.
    pub weights: Vec<[(u16, f64); 4]>,
    /// Mark of each vertex.
    pub marks: Vec<Mark>,
    /// Corners of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Region of each triangle.
    pub regions: Vec<Region>,
}

/// Reads all primitives of all meshes.
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

/// Checks the number of corners before memory is allocated: a mesh may occur at many nodes.
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
            let help = "use a coarser mesh, and use each mesh at one node";
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
    /// Vertices by their accessors, which primitives may share.
    read: BTreeMap<[usize; 3], Vec<u32>>,
    /// Names of joints with vertices that are not bones of the whale.
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

    /// The region of a material's name; the number of a copy, as in `lips.001`, is ignored.
    fn region(&mut self, material: Option<&str>) -> Option<Region> {
        let regions = || Region::ALL.into_iter().map(Region::name);
        let Some(name) = material else {
            let all = regions().collect::<Vec<_>>().join(", ");
            self.fault(Fault::new(
                "has triangles without a material, and therefore without a region",
                format!("add materials named after regions: {all}"),
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
                format!("has a material `{name}`, which is not a region"),
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
                "export triangles only",
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
                "has vertices with and without bones in one primitive",
                "export it again",
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

    /// Mark of each vertex: that of the nearest colour; plain skin without a colour.
    fn marks(&self, primitive: &Primitive<'_>, count: usize) -> Result<Vec<Mark>, Fault> {
        let mut seen: Vec<Mark> = match primitive.get(&Semantic::Colors(0)) {
            None => Vec::new(),
            Some(colours) if colours.dimensions().multiplicity() == 4 => {
                rows::<4>(self.file, &colours)?.iter().map(|colour| mark_of(&colour[..3])).collect()
            }
            Some(colours) => {
                rows::<3>(self.file, &colours)?.iter().map(|colour| mark_of(colour)).collect()
            }
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

    /// Adds a vertex; returns its number.
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

    /// Rest place of a vertex in the whale's frame, and its weights by bone.
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
                    "export it again",
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
        return Err(Fault::new("has a triangle with a missing vertex", "export it again"));
    }
    Ok(indices)
}

/// A place for a message: three coordinates in the whale's frame.
pub(super) fn shown(place: DVec3) -> String {
    format!("({:.2} m, {:.2} m, {:.2} m)", place.x, place.y, place.z)
}

/// Key of equal vertices: bits of place and weights.
type Key = ([u64; 3], [(u16, u64); 4]);

/// The skin with split vertices joined, without triangles of zero area.
pub(super) fn weld(skin: &Skin) -> Skin {
    // -0 equals 0.
    let bits = |number: f64| (number + 0.0).to_bits();
    let mut known: BTreeMap<Key, u32> = BTreeMap::new();
    let mut welded = Skin { bones: skin.bones.clone(), ..Skin::default() };
    let mut numbers = Vec::with_capacity(skin.vertices.len());
    for ((place, weights), mark) in skin.vertices.iter().zip(&skin.weights).zip(&skin.marks) {
        let key = (place.to_array().map(bits), weights.map(|(bone, weight)| (bone, bits(weight))));
        numbers.push(*known.entry(key).or_insert_with(|| {
            welded.vertices.push(*place);
            welded.weights.push(*weights);
            welded.marks.push(*mark);
            u32::try_from(welded.vertices.len() - 1).unwrap_or(u32::MAX)
        }));
    }
    for (triangle, region) in skin.triangles.iter().zip(&skin.regions) {
        let [a, b, c] = triangle.map(|corner| numbers[corner as usize]);
        if a != b && b != c && c != a {
            welded.triangles.push([a, b, c]);
            welded.regions.push(*region);
        }
    }
    welded
}

/// Tolerance of length and place of a skin, as a share of length.
const ROOM: f64 = 0.1;

/// Checks the whole skin.
pub(super) fn whole(skin: &Skin, like: &Skin) -> Result<(), Vec<Fault>> {
    let faults: Vec<Fault> =
        [scale(skin, like), closed(skin), outside_out(skin)].into_iter().flatten().collect();
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

/// Checks length and place of the skin.
fn scale(skin: &Skin, like: &Skin) -> Option<Fault> {
    let [own, wanted] = [skin, like].map(|skin| Bounds::around(&skin.vertices));
    let [long, want] = [own, wanted].map(|bounds| bounds.high.x - bounds.low.x);
    let ratio = long / want;
    if !(ratio - 1.0).abs().is_finite() || (ratio - 1.0).abs() > ROOM {
        let help = "a file is in metres with the whale at its own `length`; in Blender, apply the scale (Ctrl+A) of mesh and armature";
        return Some(Fault::new(
            format!("is {long:.3} m long from snout to fluke tips, expected {want:.2} m"),
            help,
        ));
    }
    let off = (own.low + own.high - wanted.low - wanted.high) / 2.0;
    if off.length() > ROOM * want {
        return Some(Fault::new(
            format!("is {:.2} m away from the whale's place, or rotated", off.length()),
            LIES,
        ));
    }
    let (part, off) = farthest(skin, like)?;
    (off > ROOM * want)
        .then(|| Fault::new(format!("is rotated: {part} is {off:.2} m away from its place"), LIES))
}

/// Help on the place of a whale in a file.
const LIES: &str = "the snout points along +x and the back up; the origin is at mid-body at the height of the snout's tip; in Blender, orient the whale this way, then apply the rotation (Ctrl+A) of mesh and armature";

/// The region or bone with the greatest distance from its place, and the distance [m].
fn farthest(skin: &Skin, like: &Skin) -> Option<(String, f64)> {
    let region = |region: Region| {
        let off = centre(skin, region)?.distance(centre(like, region)?);
        Some((format!("the region `{}`", region.name()), off))
    };
    let bones = skin.bones.iter().zip(&like.bones);
    let bones = bones
        .map(|(own, like)| (format!("the bone `{}`", own.name), own.origin.distance(like.origin)));
    let all = Region::ALL.into_iter().filter_map(region).chain(bones);
    all.max_by(|one, other| one.1.total_cmp(&other.1))
}

/// Centre of a region's skin [m]; `None` without skin.
fn centre(skin: &Skin, region: Region) -> Option<DVec3> {
    let own = skin.triangles.iter().zip(&skin.regions).filter(|(_, own)| **own == region);
    let (moment, area) = own.fold((DVec3::ZERO, 0.0), |(moment, area), (triangle, _)| {
        let [a, b, c] = triangle.map(|corner| skin.vertices[corner as usize]);
        let own = (b - a).cross(c - a).length();
        (moment + own * (a + b + c) / 3.0, area + own)
    });
    (area > 0.0).then(|| moment / area)
}

/// Checks that each edge has two triangles in opposite directions.
pub(super) fn closed(skin: &Skin) -> Option<Fault> {
    let mut edges: BTreeMap<(u32, u32), (u32, usize)> = BTreeMap::new();
    for (triangle, &[a, b, c]) in skin.triangles.iter().enumerate() {
        for edge in [(a, b), (b, c), (c, a)] {
            edges.entry(edge).or_insert((0, triangle)).0 += 1;
        }
    }
    let bad = |&(&(from, to), &(count, _)): &(&(u32, u32), &(u32, usize))| {
        count > 1 || !edges.contains_key(&(to, from))
    };
    let open: Vec<_> = edges.iter().filter(bad).collect();
    let &(&(from, _), &(_, triangle)) = open.first()?;
    let message = format!(
        "is not closed: {} edges do not have two triangles, one at {} in the region `{}`",
        open.len(),
        shown(skin.vertices[from as usize]),
        skin.regions[triangle].name(),
    );
    Some(Fault::new(
        message,
        "in Blender, Mesh > Merge > By Distance, then Clean Up > Fill Holes; Select > All by Trait > Non Manifold shows where",
    ))
}

/// Checks that the enclosed volume is positive.
fn outside_out(skin: &Skin) -> Option<Fault> {
    let corner = |index: u32| skin.vertices[index as usize];
    let volume: f64 = skin
        .triangles
        .iter()
        .map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0)
        .sum();
    let help = "in Blender, Mesh > Normals > Recalculate Outside";
    (volume <= 0.0).then(|| Fault::new("has no skin, or its skin faces inward", help))
}
