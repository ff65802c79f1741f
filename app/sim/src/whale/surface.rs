//! The skin's surface over one step: every vertex goes straight from its place at the start to that at the end.
//!
//! Parts are worked out when first asked for and remembered until the next step,
//! so a whale far from all rope costs next to nothing.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::bounds::Bounds;
use super::pose::skin_vertex;
use super::tree::SkinTree;
use crate::geometry::sweep::{SweptSegment, SweptTriangle};

/// A segment and a triangle that may come near one another within a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Candidate {
    /// Index of the segment in the slice gathered for.
    pub segment: u32,
    /// Index of the triangle in the skin.
    pub triangle: u32,
}

/// The moving surface of one whale, with its scratch space; it carries nothing from step to step.
#[derive(Clone, Debug)]
pub struct Surface {
    tree: Arc<SkinTree>,
    /// Levels of the tree.
    depth: usize,
    step: Step,
    rope: Groups,
    pairs: Vec<Pair>,
    nodes: Vec<usize>,
    /// Triangles near a group of segments.
    close: Vec<(u32, Bounds)>,
}

/// What is known of the present step; a part is known where its stamp is the step's number.
#[derive(Clone, Debug, Default)]
struct Step {
    number: u64,
    starts: Vec<DAffine3>,
    ends: Vec<DAffine3>,
    nodes: Vec<(u64, Bounds)>,
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

/// A node of the tree against a group of segments.
#[derive(Clone, Copy, Debug)]
struct Pair {
    node: usize,
    level: usize,
    group: usize,
}

/// Neighbouring segments, with their boxes and the box around them.
struct Group<'a> {
    whole: Bounds,
    first: usize,
    boxes: &'a [Bounds],
}

impl Group<'_> {
    /// Its segments with their boxes.
    fn segments(&self) -> impl Iterator<Item = (u32, &Bounds)> {
        let number = |place: usize| u32::try_from(self.first + place).unwrap_or(u32::MAX);
        self.boxes.iter().enumerate().map(move |(place, bounds)| (number(place), bounds))
    }
}

impl Surface {
    /// Scratch space for a skin. Allocates all but the lists of candidates.
    #[must_use]
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
        };
        surface.step.number = 1;
        surface
    }

    /// Begins a step in which the bones go from one set of transforms to the next, as [`pose`](super::pose::pose) gives them.
    ///
    /// Bones that a slice does not cover stay at rest in the world's frame.
    pub fn begin(&mut self, starts: &[DAffine3], ends: &[DAffine3]) {
        self.step.number += 1;
        for (kept, given) in [(&mut self.step.starts, starts), (&mut self.step.ends, ends)] {
            kept.fill(DAffine3::IDENTITY);
            kept.iter_mut().zip(given).for_each(|(kept, given)| *kept = *given);
        }
    }

    /// Whether any of the surface may come within `margin` of the bounds during the step.
    ///
    /// `false` is certain; `true` means that the box of some triangle's move is that near.
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

    /// The box around the whole surface over the step.
    pub(crate) fn whole(&mut self) -> Bounds {
        if self.tree.nodes().is_empty() { Bounds::EMPTY } else { self.step.node(&self.tree, 0) }
    }

    /// All pairs of a segment and a triangle whose boxes over the step come within `margin`, written
    /// over `out` in rising order: every pair that may come nearer than `margin` is among them.
    pub fn gather(&mut self, segments: &[SweptSegment], margin: f64, out: &mut Vec<Candidate>) {
        out.clear();
        let mut close = std::mem::take(&mut self.close);
        self.search(segments, margin, |step, tree, node, group| {
            step.find_close(tree, node, &group.whole, &mut close);
            for (segment, rope_box) in group.segments() {
                let meeting = close.iter().filter(|(_, bounds)| bounds.meets(rope_box));
                out.extend(meeting.map(|(triangle, _)| Candidate { segment, triangle: *triangle }));
            }
            true
        });
        self.close = close;
        out.sort_unstable();
    }

    /// Whether any pair of a segment and a triangle has boxes over the step that come within `margin`.
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

    /// Hands over every leaf of the tree and group of neighbouring segments that meet, until asked to stop.
    fn search(
        &mut self,
        segments: &[SweptSegment],
        margin: f64,
        mut go_on: impl FnMut(&mut Step, &SkinTree, usize, &Group<'_>) -> bool,
    ) {
        let Self { tree, depth, step, rope, pairs, .. } = self;
        pairs.clear();
        if tree.nodes().is_empty() {
            return;
        }
        rope.fill(segments, margin);
        // A leaf is met with at most this many waiting: all groups of rope, and what each level on the way down left behind.
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
                _ if go_on(step, tree, pair.node, &rope.group(pair.group)) => {}
                _ => return,
            }
        }
    }

    /// A triangle's corners at the start and at the end of the step.
    pub fn triangle_sweep(&mut self, triangle: u32) -> SweptTriangle {
        let corners = self.tree.skin().triangles[triangle as usize]
            .map(|vertex| self.step.vertex(self.tree.as_ref(), vertex as usize));
        [corners.map(|ends| ends[0]), corners.map(|ends| ends[1])]
    }

    /// A triangle's corners at a fraction of the step, 0 at its start.
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
                let corners = tree.skin().triangles[tree.order()[place] as usize];
                self.triangles[place] = corners.iter().fold(Bounds::EMPTY, |bounds, &vertex| {
                    bounds.join(Bounds::around(&self.vertex(tree, vertex as usize)))
                });
            }
        }
        &self.triangles[range]
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

    /// Finds the triangles of a leaf whose boxes meet that of a group of segments.
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
    /// Boxes around the segments' moves, grown by the margin.
    fn fill(&mut self, segments: &[SweptSegment], margin: f64) {
        let [ones, eights, all] = &mut self.levels;
        ones.clear();
        ones.extend(segments.iter().map(|segment| {
            Bounds::around(&[segment.a0, segment.b0, segment.a1, segment.b1]).grown(margin)
        }));
        coarsen(ones, eights);
        coarsen(eights, all);
    }

    /// A group of neighbouring segments, of the level above single ones.
    fn group(&self, group: usize) -> Group<'_> {
        let [ones, eights, _] = &self.levels;
        let first = group * GROUP;
        let boxes = &ones[first..(first + GROUP).min(ones.len())];
        Group { whole: eights[group], first, boxes }
    }

    /// The groups of the next finer level within one group.
    fn finer(&self, level: usize, group: usize) -> std::ops::Range<usize> {
        group * GROUP..((group + 1) * GROUP).min(self.levels[level - 1].len())
    }
}

fn coarsen(fine: &[Bounds], coarse: &mut Vec<Bounds>) {
    coarse.clear();
    coarse.extend(
        fine.chunks(GROUP)
            .map(|group| group.iter().fold(Bounds::EMPTY, |bounds, other| bounds.join(*other))),
    );
}

#[cfg(test)]
#[path = "surface_tests.rs"]
pub(super) mod tests;
