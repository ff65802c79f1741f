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
        let centres: Vec<DVec3> = skin
            .triangles
            .iter()
            .map(|corners| corners.iter().map(|&corner| skin.vertices[corner as usize]).sum())
            .collect();
        let order = (0_u32..).take(skin.triangles.len()).collect();
        let mut tree = Self { skin, nodes: Vec::new(), spheres: Vec::new(), order };
        if !tree.order.is_empty() {
            let bones = tree.skin.bones.len();
            let mut vertices = Vertices {
                seen: vec![0; tree.skin.vertices.len()],
                next: 0,
                moved: vec![Vec::new(); bones],
            };
            tree.grow(0..tree.order.len(), &centres, &mut vertices);
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
            sphere.add_to(&mut bounds, starts);
            sphere.add_to(&mut bounds, ends);
        }
        bounds.grown(ROUNDING)
    }

    /// A box around all of a node's vertices in one pose.
    pub(super) fn bound_at(&self, node: usize, bones: &[DAffine3]) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for sphere in &self.spheres[self.nodes[node].spheres.clone()] {
            sphere.add_to(&mut bounds, bones);
        }
        bounds.grown(ROUNDING)
    }

    /// Adds the node over a range of triangles, and those below it; its index.
    fn grow(
        &mut self,
        triangles: std::ops::Range<usize>,
        centres: &[DVec3],
        vertices: &mut Vertices,
    ) -> usize {
        let index = self.nodes.len();
        let from = self.spheres.len();
        self.add_spheres(&triangles, vertices);
        self.nodes.push(Node {
            spheres: from..self.spheres.len(),
            triangles: triangles.clone(),
            children: None,
        });
        if triangles.len() > CLUSTER {
            let middle = self.split(&triangles, centres);
            let first = self.grow(triangles.start..middle, centres, vertices);
            let second = self.grow(middle..triangles.end, centres, vertices);
            self.nodes[index].children = Some([first, second]);
        }
        index
    }

    /// Cuts a range across its longest side near the middle, at whole clusters.
    fn split(&mut self, triangles: &std::ops::Range<usize>, centres: &[DVec3]) -> usize {
        let order = &mut self.order[triangles.clone()];
        let sides = order
            .iter()
            .fold(Bounds::EMPTY, |bounds, &triangle| bounds.with(centres[triangle as usize]));
        let extent = sides.high - sides.low;
        let axis =
            (0..3).fold(0, |best, axis| if extent[axis] > extent[best] { axis } else { best });
        let half = triangles.len().div_ceil(2 * CLUSTER) * CLUSTER;
        let place = |triangle: u32| centres[triangle as usize][axis];
        order.select_nth_unstable_by(half, |left, right| {
            place(*left).total_cmp(&place(*right)).then(left.cmp(right))
        });
        triangles.start + half
    }

    /// Adds the spheres of a range of triangles: one around the vertices of each bone that moves any.
    fn add_spheres(&mut self, triangles: &std::ops::Range<usize>, vertices: &mut Vertices) {
        let skin = &self.skin;
        vertices.next += 1;
        for corner in self.order[triangles.clone()]
            .iter()
            .flat_map(|&triangle| skin.triangles[triangle as usize])
        {
            let vertex = corner as usize;
            if std::mem::replace(&mut vertices.seen[vertex], vertices.next) == vertices.next {
                continue;
            }
            for &(bone, weight) in &skin.weights[vertex] {
                if weight > 0.0 {
                    vertices.moved[usize::from(bone)].push(skin.vertices[vertex]);
                }
            }
        }
        for (bone, places) in
            vertices.moved.iter_mut().enumerate().filter(|(_, places)| !places.is_empty())
        {
            self.spheres.push(Sphere::around(bone, places));
            places.clear();
        }
    }
}

/// Scratch of growing a tree.
struct Vertices {
    /// The last node each vertex was seen in, counted from 1.
    seen: Vec<usize>,
    next: usize,
    /// Places of the vertices of the present node that each bone moves.
    moved: Vec<Vec<DVec3>>,
}

impl Sphere {
    /// Grows bounds to hold it where its bone carries it.
    fn add_to(&self, bounds: &mut Bounds, bones: &[DAffine3]) {
        let centre = bones[self.bone].transform_point3(self.centre);
        bounds.low = bounds.low.min(centre - self.radius);
        bounds.high = bounds.high.max(centre + self.radius);
    }

    /// A small sphere around points: from the middle of their box, then drawn towards the farthest (Bădoiu and Clarkson 2003).
    fn around(bone: usize, points: &[DVec3]) -> Self {
        let sides = Bounds::around(points);
        let mut centre = (sides.low + sides.high) / 2.0;
        let mut far = farthest(points, centre);
        let mut best = (centre, centre.distance(far));
        for round in 1..20 {
            centre += (far - centre) / f64::from(round + 1);
            far = farthest(points, centre);
            let radius = centre.distance(far);
            if radius < best.1 {
                best = (centre, radius);
            }
        }
        Self { bone, centre: best.0, radius: best.1 }
    }
}

/// The point farthest from a place, the first where several are.
fn farthest(points: &[DVec3], from: DVec3) -> DVec3 {
    let mut far = (0.0, from);
    for point in points {
        let square = point.distance_squared(from);
        if square > far.0 {
            far = (square, *point);
        }
    }
    far.1
}
