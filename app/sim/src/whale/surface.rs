//! The moving surface of the skin over one step: every vertex moves straight from its position at the start to that at the end.
//!
//! Vertices and boxes are computed on demand and stored until the next step, so that a whale far from rope costs almost
//! nothing.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::kept_candidates::{KeptCandidates, SLACK_M};
use super::pose::skin_vertex;
use super::tree::{Bounds, SkinTree};
use crate::bucket_sort::BucketSort;
use crate::geometry::sweep::{SweptSegment, SweptTriangle};

/// A segment and a triangle that may approach each other within a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Candidate {
    /// Index of the segment in the slice of the search.
    pub segment: u32,
    /// Index of the triangle in the skin.
    pub triangle: u32,
}

/// The moving surface of a whale, with its buffers; no result depends on the steps before.
#[derive(Clone, Debug)]
pub struct Surface {
    tree: Arc<SkinTree>,
    /// Number of levels of the tree.
    depth: usize,
    step: Step,
    rope: Groups,
    pairs: Vec<Pair>,
    nodes: Vec<usize>,
    /// Triangles near a group of segments.
    close: Vec<(u32, Bounds)>,
    sort: BucketSort<Candidate>,
    pub(super) kept: KeptCandidates,
}

/// Values of the current step; an entry is valid if its stamp is the step's number.
#[derive(Clone, Debug, Default)]
pub(super) struct Step {
    pub number: u64,
    pub starts: Vec<DAffine3>,
    pub ends: Vec<DAffine3>,
    pub nodes: Vec<(u64, Bounds)>,
    clusters: Vec<u64>,
    triangles: Vec<Bounds>,
    vertices: Vec<(u64, [DVec3; 2])>,
}

/// Boxes around 1, 8 and 64 neighbouring segments.
#[derive(Clone, Debug, Default)]
struct Groups {
    levels: [Vec<Bounds>; 3],
}

/// Segments in a group of the next finer level.
const GROUP: usize = 8;

/// A node of the tree and a group of segments.
#[derive(Clone, Copy, Debug)]
struct Pair {
    node: usize,
    level: usize,
    group: usize,
}

/// Neighbouring segments with their boxes and their common box.
pub(super) struct Group<'a> {
    whole: Bounds,
    pub first: usize,
    pub boxes: &'a [Bounds],
}

impl Group<'_> {
    /// Its place among all groups.
    pub fn index(&self) -> usize {
        Group::of(self.first)
    }

    /// The place of the group of a segment.
    pub fn of(segment: usize) -> usize {
        segment / GROUP
    }

    /// Number of groups of this many segments.
    pub fn count(segments: usize) -> usize {
        segments.div_ceil(GROUP)
    }

    /// Segments with their boxes.
    fn segments(&self) -> impl Iterator<Item = (u32, &Bounds)> {
        let number = |place: usize| u32::try_from(self.first + place).unwrap_or(u32::MAX);
        self.boxes.iter().enumerate().map(move |(place, bounds)| (number(place), bounds))
    }
}

impl Surface {
    /// Surface of a skin. Allocates all buffers except the lists of candidates.
    pub fn new(tree: Arc<SkinTree>) -> Self {
        let step = Step {
            number: 0,
            starts: tree.skin().bones.iter().map(|_| DAffine3::IDENTITY).collect(),
            ends: tree.skin().bones.iter().map(|_| DAffine3::IDENTITY).collect(),
            nodes: vec![(0, Bounds::EMPTY); tree.nodes().len()],
            clusters: vec![0; tree.nodes().len()],
            triangles: vec![Bounds::EMPTY; tree.order().len()],
            vertices: vec![(0, [DVec3::ZERO; 2]); tree.skin().vertices.len()],
        };
        let mut surface = Self {
            depth: tree.depth(),
            tree,
            step,
            rope: Groups::default(),
            pairs: Vec::new(),
            nodes: Vec::new(),
            close: Vec::new(),
            sort: BucketSort::default(),
            kept: KeptCandidates::default(),
        };
        surface.step.number = 1;
        surface
    }

    /// Starts a step in which the bones move from one set of transforms of [`pose`](super::pose::pose) to the next.
    ///
    /// Bones without a transform have the identity.
    pub fn begin(&mut self, starts: &[DAffine3], ends: &[DAffine3]) {
        self.step.number += 1;
        for (stored, next) in [(&mut self.step.starts, starts), (&mut self.step.ends, ends)] {
            stored.fill(DAffine3::IDENTITY);
            stored.iter_mut().zip(next).for_each(|(stored, next)| *stored = *next);
        }
    }

    /// Whether the surface may be within `margin` of the bounds during the step.
    ///
    /// `false` is certain; `true` means that the box of a triangle's motion is that near.
    pub fn is_near(&mut self, bounds: &Bounds, margin: f64) -> bool {
        let Self { tree, step, nodes, .. } = self;
        let bounds = bounds.grown(margin);
        nodes.clear();
        nodes.extend((!tree.nodes().is_empty()).then_some(0));
        while let Some(node) = nodes.pop() {
            if !step.node(tree, node).meets(&bounds) {
                continue;
            }
            match tree.nodes()[node].children {
                Some(children) => nodes.extend(children),
                None if step.cluster(tree, node).iter().any(|triangle| triangle.meets(&bounds)) => {
                    return true;
                }
                None => {}
            }
        }
        false
    }

    /// Box around the whole surface over the step.
    pub(crate) fn whole(&mut self) -> Bounds {
        if self.tree.nodes().is_empty() { Bounds::EMPTY } else { self.step.node(&self.tree, 0) }
    }

    /// Finds all pairs of a segment and a triangle whose boxes over the step are within `margin`, and writes them to `out`,
    /// sorted. Every pair whose distance may be below `margin` is included.
    pub fn gather(&mut self, segments: &[SweptSegment], margin: f64, out: &mut Vec<Candidate>) {
        out.clear();
        let mut close = std::mem::take(&mut self.close);
        self.search(segments, margin, |step, tree, node, group| {
            step.add_pairs((tree, node), group, &mut close, out);
            true
        });
        self.close = close;
        self.sort.sort_by_both(
            out,
            (|pair| pair.segment as usize, segments.len()),
            (|pair| pair.triangle as usize, self.tree.order().len()),
        );
    }

    /// As [`gather`](Self::gather), for rope that moves little relative to skin between two searches with the same margin.
    pub fn gather_keeping(
        &mut self,
        segments: &[SweptSegment],
        margin: f64,
        out: &mut Vec<Candidate>,
    ) {
        let mut kept = std::mem::take(&mut self.kept);
        if kept.serves(&self.step, segments, margin) {
            let mut close = std::mem::take(&mut self.close);
            out.clear();
            self.search(segments, margin, |step, tree, node, group| {
                if !kept.covers(step, (tree, node), (group, segments)) {
                    step.add_pairs((tree, node), group, &mut close, out);
                }
                true
            });
            self.close = close;
            let triangle = |pair: &Candidate| pair.triangle as usize;
            self.sort.sort(out, |pair| pair.segment as usize, triangle);
            kept.give(&mut self.step, &self.tree, &self.rope.levels[0], out);
        } else if kept.begin() {
            self.gather(segments, margin + SLACK_M, out);
            kept.keep(&self.step, &self.tree, (segments, margin), out);
            self.rope.fill(segments, margin);
            out.clear();
            kept.give(&mut self.step, &self.tree, &self.rope.levels[0], out);
        } else {
            self.gather(segments, margin, out);
        }
        self.kept = kept;
    }

    /// Whether any pair of a segment and a triangle has boxes over the step within `margin`.
    pub fn is_any_near(&mut self, segments: &[SweptSegment], margin: f64) -> bool {
        let mut none = true;
        self.search(segments, margin, |step, tree, node, group| {
            let triangles = step.cluster(tree, node);
            let any = |rope_box: &Bounds| triangles.iter().any(|triangle| triangle.meets(rope_box));
            none = !any(&group.whole) || !group.segments().any(|(_, rope_box)| any(rope_box));
            none
        });
        !none
    }

    /// Calls `visit` for every intersecting pair of a leaf and a group of neighbouring segments, until it returns `false`.
    fn search(
        &mut self,
        segments: &[SweptSegment],
        margin: f64,
        mut visit: impl FnMut(&mut Step, &SkinTree, usize, &Group<'_>) -> bool,
    ) {
        let Self { tree, depth, step, rope, pairs, .. } = self;
        pairs.clear();
        if tree.nodes().is_empty() {
            return;
        }
        rope.fill(segments, margin);
        // Upper bound of pending pairs: all groups of rope, and the remaining pairs of each level of the descent.
        pairs.reserve(rope.levels[2].len() + *depth + 2 * GROUP);
        pairs.extend((0..rope.levels[2].len()).map(|group| Pair { node: 0, level: 2, group }));
        while let Some(pair) = pairs.pop() {
            let rope_box = rope.levels[pair.level][pair.group];
            let skin_box = step.node(tree, pair.node);
            if !skin_box.meets(&rope_box) {
                continue;
            }
            match tree.nodes()[pair.node].children {
                Some(children) if pair.level == 1 || skin_box.longest() > rope_box.longest() => {
                    pairs.extend(children.map(|node| Pair { node, ..pair }));
                }
                _ if pair.level > 1 => {
                    pairs.extend(rope.finer(pair.level, pair.group).map(|group| Pair {
                        level: pair.level - 1,
                        group,
                        ..pair
                    }));
                }
                _ if visit(step, tree, pair.node, &rope.group(pair.group)) => {}
                _ => return,
            }
        }
    }

    /// Corners of a triangle at the start and at the end of the step.
    pub fn triangle_sweep(&mut self, triangle: u32) -> SweptTriangle {
        let corners = self.tree.skin().triangles[triangle as usize]
            .map(|vertex| self.step.vertex(self.tree.as_ref(), vertex as usize));
        [corners.map(|ends| ends[0]), corners.map(|ends| ends[1])]
    }

    /// Corners of a triangle at a fraction of the step, 0 at its start.
    pub fn triangle_at(&mut self, triangle: u32, fraction: f64) -> [DVec3; 3] {
        let [start, end] = self.triangle_sweep(triangle);
        [0, 1, 2].map(|corner| start[corner].lerp(end[corner], fraction))
    }
}

impl Step {
    fn node(&mut self, tree: &SkinTree, node: usize) -> Bounds {
        if self.nodes[node].0 != self.number {
            self.nodes[node] = (self.number, tree.bound(node, &self.starts, &self.ends));
        }
        self.nodes[node].1
    }

    /// Boxes of a leaf's triangles over the step.
    fn cluster(&mut self, tree: &SkinTree, node: usize) -> &[Bounds] {
        let range = tree.nodes()[node].triangles.clone();
        if self.clusters[node] != self.number {
            self.clusters[node] = self.number;
            for place in range.clone() {
                self.triangles[place] = self.triangle(tree, tree.order()[place]);
            }
        }
        &self.triangles[range]
    }

    /// Box of a triangle over the step.
    pub fn triangle(&mut self, tree: &SkinTree, triangle: u32) -> Bounds {
        let corners = tree.skin().triangles[triangle as usize];
        corners.iter().fold(Bounds::EMPTY, |bounds, &vertex| {
            bounds.join(Bounds::around(&self.vertex(tree, vertex as usize)))
        })
    }

    fn vertex(&mut self, tree: &SkinTree, vertex: usize) -> [DVec3; 2] {
        if self.vertices[vertex].0 != self.number {
            let skin = tree.skin();
            let ends =
                [skin_vertex(skin, &self.starts, vertex), skin_vertex(skin, &self.ends, vertex)];
            self.vertices[vertex] = (self.number, ends);
        }
        self.vertices[vertex].1
    }

    /// Appends the pairs of a leaf and a group of segments whose boxes intersect.
    fn add_pairs(
        &mut self,
        (tree, node): (&SkinTree, usize),
        group: &Group<'_>,
        close: &mut Vec<(u32, Bounds)>,
        out: &mut Vec<Candidate>,
    ) {
        self.find_close(tree, node, &group.whole, close);
        for (segment, rope_box) in group.segments() {
            let meeting = close.iter().filter(|(_, bounds)| bounds.meets(rope_box));
            out.extend(meeting.map(|(triangle, _)| Candidate { segment, triangle: *triangle }));
        }
    }

    /// Finds the triangles of a leaf whose boxes intersect that of a group of segments.
    fn find_close(
        &mut self,
        tree: &SkinTree,
        node: usize,
        rope_box: &Bounds,
        close: &mut Vec<(u32, Bounds)>,
    ) {
        let triangles = &tree.order()[tree.nodes()[node].triangles.clone()];
        let boxes = self.cluster(tree, node);
        let meeting = triangles.iter().zip(boxes).filter(|(_, bounds)| bounds.meets(rope_box));
        close.clear();
        close.extend(meeting.map(|(triangle, bounds)| (*triangle, *bounds)));
    }
}

impl Groups {
    /// Computes boxes around the segments' motion, extended by the margin.
    fn fill(&mut self, segments: &[SweptSegment], margin: f64) {
        let [ones, eights, all] = &mut self.levels;
        ones.clear();
        ones.extend(segments.iter().map(|segment| {
            Bounds::around(&[segment.a0, segment.b0, segment.a1, segment.b1]).grown(margin)
        }));
        coarsen(ones, eights);
        coarsen(eights, all);
    }

    /// A group of neighbouring segments of the level above single segments.
    fn group(&self, group: usize) -> Group<'_> {
        let [ones, eights, _] = &self.levels;
        let first = group * GROUP;
        let boxes = &ones[first..(first + GROUP).min(ones.len())];
        Group { whole: eights[group], first, boxes }
    }

    /// Groups of the next finer level within a group.
    fn finer(&self, level: usize, group: usize) -> std::ops::Range<usize> {
        group * GROUP..((group + 1) * GROUP).min(self.levels[level - 1].len())
    }
}

/// Boxes around groups of neighbouring boxes.
fn coarsen(fine: &[Bounds], coarse: &mut Vec<Bounds>) {
    coarse.clear();
    coarse.extend(
        fine.chunks(GROUP)
            .map(|group| group.iter().fold(Bounds::EMPTY, |bounds, other| bounds.join(*other))),
    );
}

#[cfg(test)]
pub(super) mod tests {
    use endline_sdk::{Posture, Region};
    use glam::DQuat;

    use super::*;
    use crate::geometry::distance::segment_triangle;
    use crate::geometry::sweep::triangle_at;
    use crate::whale::{Angle, Bone, Channel, Skin, pose, skin_all};

    /// Deterministic pseudo-random numbers in -1..1 for tests.
    pub(crate) struct Dice(pub u64);

    impl Dice {
        fn next(&mut self) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }

        pub fn point(&mut self) -> DVec3 {
            DVec3::new(self.next(), self.next(), self.next())
        }
    }

    /// A tube 8 m long on eight bones, each vertex moved by up to four of them with uneven weights.
    pub(crate) fn tube() -> Skin {
        let (rings, sides) = (60_u32, 12_u32);
        let mut dice = Dice(3);
        let mut skin = Skin::default();
        for ring in 0..rings {
            for side in 0..sides {
                let turn = f64::from(side) * std::f64::consts::TAU / f64::from(sides);
                let along = f64::from(ring) * 8.0 / f64::from(rings);
                skin.vertices.push(DVec3::new(-along, libm::cos(turn), libm::sin(turn)));
                let first = (along as u16).min(7);
                let shares: [f64; 4] = std::array::from_fn(|_| dice.next() + 1.0);
                let sum: f64 = shares.iter().sum();
                skin.weights.push(std::array::from_fn(|place| {
                    ((first + place as u16).min(7), shares[place] / sum)
                }));
                if ring > 0 {
                    let (here, next) = (ring * sides + side, ring * sides + (side + 1) % sides);
                    skin.triangles
                        .extend([[here, next, next - sides], [here, next - sides, here - sides]]);
                    skin.regions.extend([Region::Body; 2]);
                }
            }
        }
        skin.bones = (0..8).map(joint).collect();
        skin
    }

    fn joint(index: usize) -> Bone {
        let turns = vec![
            (Channel { angle: Angle::SpinePitch(index), share: 1.0 }, DVec3::NEG_Y),
            (Channel { angle: Angle::SpineYaw(index), share: 1.0 }, DVec3::Z),
        ];
        Bone {
            name: format!("bone_{index}"),
            parent: index.checked_sub(1),
            origin: DVec3::NEG_X * index as f64,
            turns,
        }
    }

    pub(crate) fn random_bones(skin: &Skin, dice: &mut Dice) -> Vec<DAffine3> {
        let mut posture = Posture::default();
        for angle in posture.spine_pitch.iter_mut().chain(&mut posture.spine_yaw) {
            *angle = 0.5 * dice.next();
        }
        let mut bones = Vec::new();
        let orientation = DQuat::from_scaled_axis(dice.point() * 2.0);
        pose(skin, dice.point() * 3.0, orientation, &posture, &mut bones);
        bones
    }

    fn random_rope(dice: &mut Dice) -> Vec<SweptSegment> {
        let mut at = dice.point() * 6.0;
        let mut next = at;
        let mut nodes = Vec::new();
        for _ in 0..101 {
            nodes.push([at, next]);
            at += dice.point() * 0.3;
            next = at + dice.point() * 0.2;
        }
        nodes
            .windows(2)
            .map(|pair| SweptSegment {
                a0: pair[0][0],
                b0: pair[1][0],
                a1: pair[0][1],
                b1: pair[1][1],
            })
            .collect()
    }

    /// In random postures the candidates are those of an exhaustive search, and no pair within the margin is missing.
    #[test]
    fn candidates_are_those_of_a_full_search() {
        let skin = Arc::new(tube());
        let mut surface = Surface::new(Arc::new(SkinTree::new(skin.clone())));
        let (mut dice, mut found, mut all) = (Dice(5), Vec::new(), 0);
        for round in 0..60 {
            let (starts, ends) = (random_bones(&skin, &mut dice), random_bones(&skin, &mut dice));
            let rope = random_rope(&mut dice);
            let margin = 0.05 * f64::from(round % 4);
            surface.begin(&starts, &ends);
            surface.gather(&rope, margin, &mut found);
            let expected = full_search(&skin, &starts, &ends, &rope, margin);
            assert_eq!(found, expected);
            all += found.len();
            let whole = Bounds::around(
                &rope.iter().flat_map(|s| [s.a0, s.b0, s.a1, s.b1]).collect::<Vec<_>>(),
            );
            assert!(found.is_empty() || surface.is_near(&whole, margin));
        }
        assert!(all > 10_000, "{all} candidates are too few to prove anything");
    }

    fn full_search(
        skin: &Skin,
        starts: &[DAffine3],
        ends: &[DAffine3],
        rope: &[SweptSegment],
        margin: f64,
    ) -> Vec<Candidate> {
        let (mut from, mut to) = (Vec::new(), Vec::new());
        skin_all(skin, starts, &mut from);
        skin_all(skin, ends, &mut to);
        let mut out = Vec::new();
        for (segment, swept) in (0..).zip(rope) {
            let rope_box = Bounds::around(&[swept.a0, swept.b0, swept.a1, swept.b1]).grown(margin);
            for (triangle, corners) in (0..).zip(&skin.triangles) {
                let [start, end] =
                    [&from, &to].map(|places| corners.map(|corner| places[corner as usize]));
                let listed = Bounds::around(&start).join(Bounds::around(&end)).meets(&rope_box);
                if listed {
                    out.push(Candidate { segment, triangle });
                }
                let middle =
                    segment_triangle(swept.at(0.5), triangle_at(&[start, end], 0.5)).distance;
                assert!(listed || middle > margin, "a pair at {middle} m is not in the boxes");
            }
        }
        out
    }

    /// Every vertex is in the boxes of all its ancestors, at the start, at the end and between.
    #[test]
    fn bounds_hold_every_vertex() {
        let skin = Arc::new(tube());
        let tree = SkinTree::new(skin.clone());
        let mut dice = Dice(17);
        for _ in 0..50 {
            let (starts, ends) = (random_bones(&skin, &mut dice), random_bones(&skin, &mut dice));
            for (index, node) in tree.nodes().iter().enumerate() {
                let bounds = tree.bound(index, &starts, &ends);
                for &triangle in &tree.order()[node.triangles.clone()] {
                    for vertex in skin.triangles[triangle as usize] {
                        let [start, end] = [&starts, &ends]
                            .map(|bones| skin_vertex(&skin, bones, vertex as usize));
                        for place in [start, start.lerp(end, 0.3), end] {
                            assert!(
                                place.cmpge(bounds.low).all() && place.cmple(bounds.high).all()
                            );
                        }
                    }
                }
            }
        }
    }

    /// The motion of a triangle agrees with skinning.
    #[test]
    fn the_motion_of_triangles_agrees_with_skinning() {
        let skin = Arc::new(tube());
        let mut surface = Surface::new(Arc::new(SkinTree::new(skin.clone())));
        let mut dice = Dice(23);
        for _ in 0..5 {
            let (starts, ends) = (random_bones(&skin, &mut dice), random_bones(&skin, &mut dice));
            surface.begin(&starts, &ends);
            for (triangle, corners) in (0..).zip(&skin.triangles) {
                let start = corners.map(|corner| skin_vertex(&skin, &starts, corner as usize));
                let end = corners.map(|corner| skin_vertex(&skin, &ends, corner as usize));
                assert_eq!(surface.triangle_sweep(triangle), [start, end]);
                assert!(
                    surface.triangle_at(triangle, 0.25)[1].distance(start[1].lerp(end[1], 0.25))
                        < 1e-12
                );
            }
        }
    }

    #[test]
    fn a_whale_without_skin_has_no_candidates() {
        let mut surface = Surface::new(Arc::new(SkinTree::new(Arc::new(Skin::default()))));
        let mut out = vec![Candidate { segment: 0, triangle: 0 }];
        surface.begin(&[], &[]);
        surface.gather(&[SweptSegment::default()], 1.0, &mut out);
        assert!(out.is_empty() && !surface.is_near(&Bounds::around(&[DVec3::ZERO]), 1.0));
    }
}
