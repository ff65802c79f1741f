//! A tree over a skin, built once for a model: clusters of triangles, bounded in any posture.
//!
//! A vertex is a weighted mean of where its bones take it, so all vertices of a node lie in the hull of
//! one sphere per bone, the rest sphere of the vertices that bone moves, carried along by the bone.
//! That bound needs no skinning, holds for every posture, and costs one transform per bone.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::Skin;
use super::bounds::Bounds;

/// Triangles in a leaf.
const CLUSTER: usize = 32;
/// Growth of each box over rounding [m].
const ROUNDING: f64 = 1e-9;

/// Clusters of triangles in a binary tree, with bounds for any posture.
#[derive(Clone, Debug)]
pub struct SkinTree {
    skin: Arc<Skin>,
    nodes: Vec<Node>,
    spheres: Vec<Sphere>,
    order: Vec<u32>,
}

/// A node: its bounding spheres, its triangles, and its children where it is no leaf.
#[derive(Clone, Debug)]
pub(super) struct Node {
    spheres: std::ops::Range<usize>,
    /// Places of its triangles in the tree's order.
    pub triangles: std::ops::Range<usize>,
    /// Indices of its children.
    pub children: Option<[usize; 2]>,
}

/// Rest sphere of the vertices of a node that one bone moves.
#[derive(Clone, Copy, Debug)]
struct Sphere {
    bone: usize,
    centre: DVec3,
    radius: f64,
}

impl SkinTree {
    /// Builds the tree; the same skin gives the same tree.
    #[must_use]
    pub fn new(skin: Arc<Skin>) -> Self {
        let centres: Vec<DVec3> =
            skin.triangles.iter().map(|corners| corners.iter().map(|&corner| skin.vertices[corner as usize]).sum()).collect();
        let order = (0_u32..).take(skin.triangles.len()).collect();
        let mut tree = Self { skin, nodes: Vec::new(), spheres: Vec::new(), order };
        if !tree.order.is_empty() {
            tree.grow(0..tree.order.len(), &centres);
        }
        tree
    }

    /// The skin it was built for.
    #[must_use]
    pub fn skin(&self) -> &Arc<Skin> {
        &self.skin
    }

    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Levels from the root to the lowest leaf.
    pub(super) fn depth(&self) -> usize {
        let mut levels = vec![1; self.nodes.len()];
        // Children come after their parent.
        for (node, at) in self.nodes.iter().enumerate() {
            for child in at.children.into_iter().flatten() {
                levels[child] = levels[node] + 1;
            }
        }
        levels.into_iter().max().unwrap_or(0)
    }

    /// Triangles in the order of the leaves.
    pub(super) fn order(&self) -> &[u32] {
        &self.order
    }

    /// A box around all of a node's vertices while each goes straight from where `starts` puts it to where `ends` does.
    pub(super) fn bound(&self, node: usize, starts: &[DAffine3], ends: &[DAffine3]) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for sphere in &self.spheres[self.nodes[node].spheres.clone()] {
            for bones in [starts, ends] {
                let centre = bones[sphere.bone].transform_point3(sphere.centre);
                bounds.low = bounds.low.min(centre - sphere.radius);
                bounds.high = bounds.high.max(centre + sphere.radius);
            }
        }
        bounds.grown(ROUNDING)
    }

    /// Adds the node over a range of triangles, and those below it; its index.
    fn grow(&mut self, triangles: std::ops::Range<usize>, centres: &[DVec3]) -> usize {
        let index = self.nodes.len();
        let from = self.spheres.len();
        self.add_spheres(&triangles);
        self.nodes.push(Node { spheres: from..self.spheres.len(), triangles: triangles.clone(), children: None });
        if triangles.len() > CLUSTER {
            let middle = self.split(&triangles, centres);
            let first = self.grow(triangles.start..middle, centres);
            let second = self.grow(middle..triangles.end, centres);
            self.nodes[index].children = Some([first, second]);
        }
        index
    }

    /// Sorts a range along its longest side and cuts it near the middle, at whole clusters.
    fn split(&mut self, triangles: &std::ops::Range<usize>, centres: &[DVec3]) -> usize {
        let order = &mut self.order[triangles.clone()];
        let sides = order.iter().fold(Bounds::EMPTY, |bounds, &triangle| bounds.with(centres[triangle as usize]));
        let extent = sides.high - sides.low;
        let axis = (0..3).fold(0, |best, axis| if extent[axis] > extent[best] { axis } else { best });
        order.sort_by(|&left, &right| centres[left as usize][axis].total_cmp(&centres[right as usize][axis]).then(left.cmp(&right)));
        triangles.start + triangles.len().div_ceil(2 * CLUSTER) * CLUSTER
    }

    fn add_spheres(&mut self, triangles: &std::ops::Range<usize>) {
        let mut vertices: Vec<u32> =
            self.order[triangles.clone()].iter().flat_map(|&triangle| self.skin.triangles[triangle as usize]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        for bone in 0..self.skin.bones.len() {
            let moved = vertices.iter().map(|&vertex| vertex as usize).filter(|&vertex| self.moves(bone, vertex));
            let places: Vec<DVec3> = moved.map(|vertex| self.skin.vertices[vertex]).collect();
            if !places.is_empty() {
                self.spheres.push(Sphere::around(bone, &places));
            }
        }
    }

    fn moves(&self, bone: usize, vertex: usize) -> bool {
        self.skin.weights[vertex].iter().any(|&(mover, weight)| usize::from(mover) == bone && weight > 0.0)
    }
}

impl Sphere {
    /// A small sphere around points: from the middle of their box, then drawn towards the farthest (Bădoiu and Clarkson 2003).
    fn around(bone: usize, points: &[DVec3]) -> Self {
        let sides = Bounds::around(points);
        let mut centre = (sides.low + sides.high) / 2.0;
        let farthest = |centre: DVec3| {
            points
                .iter()
                .copied()
                .fold(centre, |far, point| if centre.distance_squared(point) > centre.distance_squared(far) { point } else { far })
        };
        let mut best = (centre, centre.distance(farthest(centre)));
        for round in 1..20 {
            centre += (farthest(centre) - centre) / f64::from(round + 1);
            let radius = centre.distance(farthest(centre));
            if radius < best.1 {
                best = (centre, radius);
            }
        }
        Self { bone, centre: best.0, radius: best.1 }
    }
}
