//! Axis-aligned boxes, and a tree over a skin: clusters of triangles with bounds for any posture.
//!
//! A vertex is a weighted mean of its positions under its bones. All vertices of a node are therefore in the convex hull of one
//! sphere per bone: the bounding sphere at rest of the vertices that the bone moves, transformed by the bone. This bound needs
//! no skinning, is valid for every posture, and costs one transform per bone.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::Skin;
use super::pose::skin_vertex;

/// An axis-aligned box; the empty box has `low` above `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower corner [m].
    pub low: DVec3,
    /// Upper corner [m].
    pub high: DVec3,
}

impl Default for Bounds {
    /// The empty box.
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Bounds {
    /// The empty box.
    pub const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// Bounding box of points.
    pub fn around(points: &[DVec3]) -> Self {
        points.iter().fold(Self::EMPTY, |bounds, &point| bounds.with(point))
    }

    /// Extended to contain a point.
    pub fn with(self, point: DVec3) -> Self {
        Self { low: self.low.min(point), high: self.high.max(point) }
    }

    /// Extended to contain another box.
    pub fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Extended by a margin on every side [m].
    pub fn grown(self, margin: f64) -> Self {
        Self { low: self.low - margin, high: self.high + margin }
    }

    /// Whether two boxes intersect.
    #[inline]
    pub fn meets(&self, other: &Self) -> bool {
        (self.low.x <= other.high.x)
            & (other.low.x <= self.high.x)
            & (self.low.y <= other.high.y)
            & (other.low.y <= self.high.y)
            & (self.low.z <= other.high.z)
            & (other.low.z <= self.high.z)
    }

    /// Whether it contains another.
    #[inline]
    pub fn holds(&self, other: &Self) -> bool {
        (self.low.x <= other.low.x)
            & (self.low.y <= other.low.y)
            & (self.low.z <= other.low.z)
            & (other.high.x <= self.high.x)
            & (other.high.y <= self.high.y)
            & (other.high.z <= self.high.z)
    }

    /// Distance between two boxes; zero if they intersect [m].
    pub fn gap(&self, other: &Self) -> f64 {
        (self.low - other.high).max(other.low - self.high).max(DVec3::ZERO).length()
    }

    /// Length of the longest side [m].
    pub fn longest(&self) -> f64 {
        (self.high - self.low).max_element()
    }
}

/// Greatest number of triangles in a leaf.
const CLUSTER: usize = 32;

/// Extension of each box against rounding errors [m].
const ROUNDING: f64 = 1e-9;

/// Clusters of triangles in a binary tree, with bounds for any posture.
#[derive(Clone, Debug)]
pub struct SkinTree {
    skin: Arc<Skin>,
    nodes: Vec<Node>,
    spheres: Vec<Sphere>,
    order: Vec<u32>,
    /// Greatest distance of a vertex from the whale's origin in any posture [m].
    pub(crate) reach_m: f64,
}

/// A node: its bounding spheres, its triangles, and its children unless it is a leaf.
#[derive(Clone, Debug)]
pub(super) struct Node {
    spheres: std::ops::Range<usize>,
    /// Range of its triangles in the tree's order.
    pub triangles: std::ops::Range<usize>,
    /// Indices of its children; `None` for a leaf.
    pub children: Option<[usize; 2]>,
}

/// Bounding sphere at rest of the vertices of a node that one bone moves.
#[derive(Clone, Copy, Debug)]
struct Sphere {
    bone: usize,
    centre: DVec3,
    radius: f64,
}

/// Move of a bone between two poses.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoneMove {
    /// Difference of its transforms.
    difference: DAffine3,
    /// Greatest length by which the difference of the rotations stretches a vector.
    stretch: f64,
}

impl BoneMove {
    /// The move from one transform to another. Bones turn and are not stretched: the difference of two rotations by an angle `a` apart has
    /// the singular values `2 sin(a/2)` twice and zero.
    pub fn between(from: &DAffine3, to: &DAffine3) -> Self {
        let turned = to.matrix3 - from.matrix3;
        let square: f64 = turned.to_cols_array().iter().map(|entry| entry * entry).sum();
        let difference =
            DAffine3 { matrix3: turned, translation: to.translation - from.translation };
        Self { difference, stretch: (0.5 * square).sqrt() }
    }
}

/// Bound of the distance of a vertex from the whale's origin in any posture: the sum of the distances from bone to bone, which turn about
/// their origins, and to the vertex [m].
fn reach_m(skin: &Skin) -> f64 {
    let mut along_m: Vec<f64> = Vec::with_capacity(skin.bones.len());
    for bone in &skin.bones {
        let parent = bone.parent.filter(|parent| *parent < along_m.len());
        let (before_m, origin) = parent
            .map_or((0.0, DVec3::ZERO), |parent| (along_m[parent], skin.bones[parent].origin));
        along_m.push(before_m + origin.distance(bone.origin));
    }
    let moved = skin.vertices.iter().zip(&skin.weights).flat_map(|(vertex, weights)| {
        weights.iter().filter(|(_, weight)| *weight > 0.0).map(move |(bone, _)| (vertex, bone))
    });
    let reach = moved.filter_map(|(vertex, bone)| {
        let bone = usize::from(*bone);
        Some(along_m.get(bone)? + skin.bones[bone].origin.distance(*vertex))
    });
    reach.fold(0.0, f64::max)
}

impl SkinTree {
    /// Builds the tree, deterministically.
    pub fn new(skin: Arc<Skin>) -> Self {
        let sum = |weights: &[(u16, f64); 4]| weights.iter().map(|(_, weight)| weight).sum::<f64>();
        debug_assert!(
            skin.weights.iter().all(|weights| (sum(weights) - 1.0).abs() < 1e-4),
            "weights of a vertex sum to 1"
        );
        let centres: Vec<DVec3> = skin
            .triangles
            .iter()
            .map(|corners| corners.iter().map(|&corner| skin.vertices[corner as usize]).sum())
            .collect();
        let order = (0_u32..).take(skin.triangles.len()).collect();
        let reach_m = reach_m(&skin);
        let mut tree = Self { skin, nodes: Vec::new(), spheres: Vec::new(), order, reach_m };
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

    /// Skin of the tree.
    pub fn skin(&self) -> &Arc<Skin> {
        &self.skin
    }

    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Number of levels from the root to the deepest leaf.
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

    /// Node of the leaf of each triangle.
    pub(super) fn leaf_of_triangles(&self) -> Vec<usize> {
        let mut leaf_of = vec![0; self.order.len()];
        let leaves = self.nodes.iter().enumerate().filter(|(_, node)| node.children.is_none());
        for (index, leaf) in leaves {
            for triangle in &self.order[leaf.triangles.clone()] {
                leaf_of[*triangle as usize] = index;
            }
        }
        leaf_of
    }

    /// Triangles in the order of leaves.
    pub(super) fn order(&self) -> &[u32] {
        &self.order
    }

    /// Box around all vertices of a node while each moves straight from its position under `starts` to that under `ends`.
    pub(super) fn bound(&self, node: usize, starts: &[DAffine3], ends: &[DAffine3]) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for sphere in &self.spheres[self.nodes[node].spheres.clone()] {
            sphere.add_to(&mut bounds, starts);
            sphere.add_to(&mut bounds, ends);
        }
        bounds.grown(ROUNDING)
    }

    /// Box around the moves of all vertices of a node, by the moves of the bones in each of two poses.
    pub(super) fn moves(&self, node: usize, bones: &[[BoneMove; 2]]) -> Bounds {
        let mut moves = Bounds::EMPTY;
        for sphere in &self.spheres[self.nodes[node].spheres.clone()] {
            for bone in &bones[sphere.bone] {
                let centre = bone.difference.transform_point3(sphere.centre);
                let radius = sphere.radius * bone.stretch;
                moves.low = moves.low.min(centre - radius);
                moves.high = moves.high.max(centre + radius);
            }
        }
        moves.grown(ROUNDING)
    }

    /// Box around all vertices of a node in one pose.
    pub(super) fn bound_at(&self, node: usize, bones: &[DAffine3]) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for sphere in &self.spheres[self.nodes[node].spheres.clone()] {
            sphere.add_to(&mut bounds, bones);
        }
        bounds.grown(ROUNDING)
    }

    /// The least component of the skin's vertices along the unit vector `up` in one pose, or `limit_m` if none is below it [m].
    pub(super) fn lowest_m(&self, bones: &[DAffine3], up: DVec3, limit_m: f64) -> f64 {
        debug_assert!((up.length() - 1.0).abs() < 1e-9, "a unit vector: {up}");
        if self.nodes.is_empty() { limit_m } else { self.lowest_in(0, bones, up, limit_m) }
    }

    fn lowest_in(&self, node: usize, bones: &[DAffine3], up: DVec3, limit_m: f64) -> f64 {
        let Node { spheres, triangles, children } = &self.nodes[node];
        let height = |sphere: &Sphere| {
            up.dot(bones[sphere.bone].transform_point3(sphere.centre)) - sphere.radius
        };
        let bound_m =
            self.spheres[spheres.clone()].iter().map(height).fold(f64::INFINITY, f64::min);
        if bound_m - ROUNDING > limit_m {
            return limit_m;
        }
        let Some(children) = children else {
            let corners = self.order[triangles.clone()]
                .iter()
                .flat_map(|&at| self.skin.triangles[at as usize]);
            let heights =
                corners.map(|vertex| up.dot(skin_vertex(&self.skin, bones, vertex as usize)));
            return heights.fold(limit_m, f64::min);
        };
        children.iter().fold(limit_m, |limit_m, child| self.lowest_in(*child, bones, up, limit_m))
    }

    /// Radius of a sphere with the centre of each sphere of a node that contains the spheres of the same bone of all clusters below
    /// the node, by the parent of each node [m].
    pub(super) fn radii_around_clusters(&self, parent: &[Option<usize>]) -> Vec<f64> {
        let mut radii = vec![0.0_f64; self.spheres.len()];
        let clusters = (0..self.nodes.len()).filter(|node| self.nodes[*node].children.is_none());
        for cluster in clusters {
            let mut node = Some(cluster);
            while let Some(at) = node {
                for inner in &self.spheres[self.nodes[cluster].spheres.clone()] {
                    let own = self.nodes[at].spheres.clone();
                    for (outer, radius) in self.spheres[own.clone()].iter().zip(&mut radii[own]) {
                        if outer.bone == inner.bone {
                            let reach = outer.centre.distance(inner.centre) + inner.radius;
                            *radius = radius.max(reach);
                        }
                    }
                }
                node = parent[at];
            }
        }
        radii
    }

    /// Box around the boxes ([`bound_at`](Self::bound_at)) of all clusters below a node under bone transforms, by the radii of
    /// [`radii_around_clusters`](Self::radii_around_clusters).
    pub(super) fn bound_of_clusters(
        &self,
        node: usize,
        radii: &[f64],
        bones: &[DAffine3],
    ) -> Bounds {
        let spheres = self.nodes[node].spheres.clone();
        let mut bounds = Bounds::EMPTY;
        for (sphere, radius) in self.spheres[spheres.clone()].iter().zip(&radii[spheres]) {
            Sphere { radius: *radius, ..*sphere }.add_to(&mut bounds, bones);
        }
        bounds.grown(2.0 * ROUNDING)
    }

    /// Adds the node of a range of triangles and its descendants; returns its index.
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

    /// Splits a range across its longest side near the middle, at a multiple of the cluster size.
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

    /// Adds the spheres of a range of triangles, one for each bone that moves any of their vertices.
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

/// Buffers for building a tree.
struct Vertices {
    /// Last node that each vertex was added to, numbered from 1.
    seen: Vec<usize>,
    next: usize,
    /// Rest positions of the vertices of the current node that each bone moves.
    moved: Vec<Vec<DVec3>>,
}

impl Sphere {
    /// Extends bounds to contain the sphere under its bone's transform.
    fn add_to(&self, bounds: &mut Bounds, bones: &[DAffine3]) {
        let centre = bones[self.bone].transform_point3(self.centre);
        bounds.low = bounds.low.min(centre - self.radius);
        bounds.high = bounds.high.max(centre + self.radius);
    }

    /// A small bounding sphere of points: its centre starts in the middle of their box and moves towards the farthest point
    /// (Bădoiu and Clarkson 2003).
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

/// Returns the point farthest from a position, the first of several.
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

#[cfg(test)]
mod tests {
    use super::super::pose::skin_all;
    use super::super::surface::tests::{Dice, random_bones, tube};
    use super::*;

    /// The lowest vertex is that among all vertices; a limit below it is returned as it is, and no vertex is farther from the first bone
    /// than the reach.
    #[test]
    fn the_lowest_vertex_is_that_of_all() {
        let skin = Arc::new(tube());
        let tree = SkinTree::new(skin.clone());
        let (mut dice, mut places) = (Dice(31), Vec::new());
        for _ in 0..200 {
            let bones = random_bones(&skin, &mut dice);
            skin_all(&skin, &bones, &mut places);
            let up = dice.point().normalize();
            let lowest_m = places.iter().map(|place| up.dot(*place)).fold(f64::INFINITY, f64::min);
            for (limit_m, least_m) in [
                (f64::INFINITY, lowest_m),
                (lowest_m + 0.1, lowest_m),
                (lowest_m - 0.1, lowest_m - 0.1),
            ] {
                assert!((tree.lowest_m(&bones, up, limit_m) - least_m).abs() < 1e-12);
            }
            let first = bones[0].transform_point3(skin.bones[0].origin);
            let farthest_m = places.iter().map(|place| place.distance(first)).fold(0.0, f64::max);
            assert!(farthest_m <= tree.reach_m, "{farthest_m} m, {} m", tree.reach_m);
        }
    }
}
