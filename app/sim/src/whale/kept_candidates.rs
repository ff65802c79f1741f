//! Candidates of a search with a larger margin, kept for the searches after it.
//!
//! Let a list hold all pairs of a segment and a triangle whose boxes over a former step are within `m + s`. If since then each point of
//! the segment has moved by a vector in the box `u`, and each corner of the triangle by one in the box `d`, both at the start and at the
//! end of the step, their boxes have approached by at most `max(u.high - d.low, d.high - u.low)` in any direction of an axis. While that
//! is at most `s`, the pair is in the list if its boxes are now within `m`. This is tested for each group of segments and leaf of the tree
//! that the search of this step finds within `m`. Those that have moved more are searched anew; of the pairs kept for the others, a test
//! of their boxes leaves those of this step. The result does not depend on what was kept.
//!
//! A corner moves as the weighted mean of the moves of its bones, so that the corners of a leaf move by vectors within the boxes of one
//! ball per bone (`tree.rs`).

use std::ops::Range;

use glam::{DAffine3, DVec3};
use pulp::{Arch, Simd, WithSimd};

use super::surface::{Candidate, Group, Step};
use super::tree::{BoneMove, Bounds, SkinTree};
use crate::geometry::sweep::SweptSegment;

/// How far beyond the margin of a search candidates are kept: `s` [m].
pub(super) const SLACK_M: f64 = 0.06;
/// Allowance for rounding in moves [m].
const ROUNDING_M: f64 = 1e-6;
/// A list that serves fewer searches than this costs more than it saves.
const LEAST_USES: u32 = 4;
/// Searches without a kept list after one that served too few.
const PAUSE: u32 = 16;

/// The kept candidates, with their buffers.
#[derive(Clone, Debug, Default)]
pub(super) struct KeptCandidates {
    arch: Arch,
    /// The margin of the searches for which it holds [m]; `None` where nothing is kept.
    margin_m: Option<f64>,
    /// Searches that it has served, with that for which it was made.
    uses: u32,
    /// Leaves with groups of segments that were searched anew since it was made, and that this search finds within the margin.
    anew: usize,
    found: usize,
    /// Searches that are to be made without it.
    pause: u32,
    /// Each segment with its range in `places`, in rising order.
    runs: Vec<(u32, Range<usize>)>,
    /// Places of triangles in `triangles`, those of each segment in rising order of triangle.
    places: Vec<u32>,
    /// Triangles, each with its leaf.
    triangles: Vec<(u32, usize)>,
    /// Place of each triangle of the skin in `triangles`, where it is among them.
    place_of: Vec<u32>,
    leaf_of: Vec<usize>,
    /// Boxes of the triangles over this step: lower corner, and upper corner negated.
    boxes: Vec<Sides>,
    /// Segments and bones of the step for which it was made.
    segments: Vec<SweptSegment>,
    starts: Vec<DAffine3>,
    ends: Vec<DAffine3>,
    /// Moves of the bones since then, at the start and at the end of the step.
    bone_moves: Vec<[BoneMove; 2]>,
    /// Moves of the corners of each leaf and of the points of each group of segments, with the number of the step for which they hold.
    leaf_moves: Vec<(u64, Bounds)>,
    group_moves: Vec<(u64, Bounds)>,
    /// Number of the step in which each leaf was last searched anew with each group of segments, leaf by leaf.
    searched: Vec<u64>,
    merged: Vec<Candidate>,
}

impl KeptCandidates {
    /// Whether it serves a search over this step; begins to compare the two steps.
    pub fn serves(&mut self, step: &Step, segments: &[SweptSegment], margin_m: f64) -> bool {
        if self.margin_m.is_none_or(|own| own.to_bits() != margin_m.to_bits())
            || self.segments.len() != segments.len()
            || self.anew > self.found
        {
            return false;
        }
        let starts = self.starts.iter().zip(&step.starts);
        let ends = self.ends.iter().zip(&step.ends);
        let moves = starts.zip(ends).map(|((start_then, start), (end_then, end))| {
            [BoneMove::between(start_then, start), BoneMove::between(end_then, end)]
        });
        self.bone_moves.clear();
        self.bone_moves.extend(moves);
        self.found = 0;
        true
    }

    /// Ends the list; returns whether another is to be made.
    pub fn begin(&mut self) -> bool {
        if self.margin_m.take().is_some() && self.uses < LEAST_USES {
            self.pause = PAUSE;
        }
        let is_wanted = self.pause == 0;
        self.pause = self.pause.saturating_sub(1);
        is_wanted
    }

    /// Whether the list holds all candidates of a leaf and a group of segments; else notes that they are searched anew.
    pub fn covers(
        &mut self,
        step: &Step,
        (tree, node): (&SkinTree, usize),
        (group, segments): (&Group<'_>, &[SweptSegment]),
    ) -> bool {
        let skin = &mut self.leaf_moves[node];
        if skin.0 != step.number {
            *skin = (step.number, tree.moves(node, &self.bone_moves));
        }
        let rope = &mut self.group_moves[group.index()];
        if rope.0 != step.number {
            let all = group.first..group.first + group.boxes.len();
            let then = self.segments[all.clone()].iter();
            let moves = then.zip(&segments[all]).fold(Bounds::EMPTY, |moves, (then, now)| {
                let at_start = [now.a0 - then.a0, now.b0 - then.b0];
                let at_end = [now.a1 - then.a1, now.b1 - then.b1];
                at_start.into_iter().chain(at_end).fold(moves, Bounds::with)
            });
            *rope = (step.number, moves);
        }
        let (skin, rope) = (&skin.1, &rope.1);
        let approach = (rope.high - skin.low).max(skin.high - rope.low);
        let covers = approach.max_element() <= SLACK_M - ROUNDING_M;
        self.found += 1;
        if !covers {
            self.anew += 1;
            self.searched[node * self.group_moves.len() + group.index()] = step.number;
        }
        covers
    }

    /// Keeps the candidates of a search over this step with the margin and the slack.
    pub fn keep(
        &mut self,
        step: &Step,
        tree: &SkinTree,
        (segments, margin_m): (&[SweptSegment], f64),
        candidates: &[Candidate],
    ) {
        const NONE: u32 = u32::MAX;
        (self.margin_m, self.uses, self.anew, self.found) = (Some(margin_m), 0, 0, 0);
        if self.leaf_of.is_empty() {
            self.leaf_of = tree.leaf_of_triangles();
            self.place_of.resize(self.leaf_of.len(), NONE);
            self.leaf_moves.resize(tree.nodes().len(), (0, Bounds::EMPTY));
        }
        self.group_moves.resize(Group::count(segments.len()), (0, Bounds::EMPTY));
        self.searched.resize(tree.nodes().len() * self.group_moves.len(), 0);
        for (triangle, _) in self.triangles.drain(..) {
            self.place_of[triangle as usize] = NONE;
        }
        self.runs.clear();
        self.places.clear();
        for Candidate { segment, triangle } in candidates {
            let place = &mut self.place_of[*triangle as usize];
            if *place == NONE {
                *place = u32::try_from(self.triangles.len()).unwrap_or(NONE);
                self.triangles.push((*triangle, self.leaf_of[*triangle as usize]));
            }
            self.places.push(*place);
            let end = self.places.len();
            match self.runs.last_mut() {
                Some((last, places)) if last == segment => places.end = end,
                _ => self.runs.push((*segment, end - 1..end)),
            }
        }
        self.segments.clear();
        self.segments.extend_from_slice(segments);
        self.starts.clone_from(&step.starts);
        self.ends.clone_from(&step.ends);
    }

    /// Adds the kept pairs whose boxes meet in this step, with those of the segments grown by the margin, to those searched anew; both are
    /// sorted, and so is the result.
    pub fn give(
        &mut self,
        step: &mut Step,
        tree: &SkinTree,
        segments: &[Bounds],
        out: &mut Vec<Candidate>,
    ) {
        self.uses += 1;
        self.boxes.clear();
        let boxes = self.triangles.iter().map(|(triangle, _)| step.triangle(tree, *triangle));
        self.boxes.extend(boxes.map(|bounds| sides(bounds.low, -bounds.high)));
        self.merged.clear();
        self.arch.dispatch(Give { kept: self, number: step.number, segments, anew: out });
        debug_assert!(self.merged.is_sorted(), "candidates in rising order");
        std::mem::swap(&mut self.merged, out);
    }
}

/// Six sides of a box, as two vectors of four.
type Sides = [f64; 8];

fn sides(one: DVec3, other: DVec3) -> Sides {
    [one.x, one.y, one.z, 0.0, other.x, other.y, other.z, 0.0]
}

/// Whether no number is above that of the other list; all are finite.
///
/// Compares without a branch, so that the compiler uses vectors: a difference is below zero exactly if its sign bit is set.
#[inline(always)]
fn is_within(one: &Sides, most: &Sides) -> bool {
    let signs = (0..8).fold(0, |signs, side| signs | (most[side] - one[side]).to_bits());
    signs >> 63 == 0
}

/// Tests the boxes of all kept pairs, with the instructions of the processor.
struct Give<'a> {
    kept: &'a mut KeptCandidates,
    number: u64,
    segments: &'a [Bounds],
    anew: &'a [Candidate],
}

impl WithSimd for Give<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { kept, number, segments, anew } = self;
        let KeptCandidates { runs, places: places_of, triangles, boxes, .. } = kept;
        let KeptCandidates { merged, searched, group_moves, .. } = kept;
        let mut anew = anew.iter().copied().peekable();
        for (segment, places) in runs {
            let (segment, rope) = (*segment, &segments[*segment as usize]);
            let most = sides(rope.high, -rope.low);
            for place in &places_of[places.clone()] {
                if !is_within(&boxes[*place as usize], &most) {
                    continue;
                }
                let (triangle, leaf) = triangles[*place as usize];
                let at = leaf * group_moves.len() + Group::of(segment as usize);
                if searched[at] == number {
                    continue;
                }
                let pair = Candidate { segment, triangle };
                while let Some(other) = anew.next_if(|other| *other < pair) {
                    merged.push(other);
                }
                merged.push(pair);
            }
        }
        merged.extend(anew);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DQuat;

    use super::*;
    use crate::whale::surface::tests::{Dice, random_bones, tube};
    use crate::whale::{Surface, skin_all};

    /// Moves all bones with the whale, and each a little on its own.
    fn moved(bones: &[DAffine3], common: &DAffine3, dice: &mut Dice, by: f64) -> Vec<DAffine3> {
        let turned = |bone: &DAffine3| {
            let turn = DQuat::from_scaled_axis(dice.point() * by);
            let own = DAffine3::from_rotation_translation(turn, dice.point() * by);
            *common * *bone * own
        };
        bones.iter().map(turned).collect()
    }

    /// Rope that winds along the tube.
    fn rope_on(places: &[DVec3]) -> Vec<SweptSegment> {
        let node = |ring: usize| places[12 * ring + ring % 12];
        let segment = |ring: usize| {
            let (a0, b0) = (node(ring), node(ring + 1));
            SweptSegment { a0, b0, a1: a0, b1: b0 }
        };
        (0..59).map(segment).collect()
    }

    /// Rope and skin move together and a little apart: the candidates are those of a search that keeps nothing.
    #[test]
    fn kept_candidates_are_those_of_a_search() {
        let skin = Arc::new(tube());
        let tree = Arc::new(SkinTree::new(skin.clone()));
        let mut dice = Dice(29);
        let (mut all, mut served, mut partly) = (0, 0, 0);
        for round in 0..20 {
            let (mut keeping, mut plain) = (Surface::new(tree.clone()), Surface::new(tree.clone()));
            let (mut bones, mut places) = (random_bones(&skin, &mut dice), Vec::new());
            skin_all(&skin, &bones, &mut places);
            let mut rope = rope_on(&places);
            let by = 2e-3 * f64::from(round % 5);
            let turn = DQuat::from_scaled_axis(dice.point() * 1e-3);
            let common = DAffine3::from_rotation_translation(turn, dice.point() * 0.05);
            for _ in 0..30 {
                let next = moved(&bones, &common, &mut dice, by);
                for surface in [&mut keeping, &mut plain] {
                    surface.begin(&bones, &next);
                }
                let (mut found, mut expected) = (Vec::new(), Vec::new());
                keeping.gather_keeping(&rope, 0.05, &mut found);
                plain.gather(&rope, 0.05, &mut expected);
                assert_eq!(found, expected, "round {round}");
                all += found.len();
                let kept = &keeping.kept;
                let serves = kept.margin_m.is_some() && kept.uses > 1;
                served += usize::from(serves);
                partly += usize::from(serves && kept.anew > 0);
                bones = next;
                for segment in &mut rope {
                    for place in
                        [&mut segment.a0, &mut segment.b0, &mut segment.a1, &mut segment.b1]
                    {
                        *place = common.transform_point3(*place) + dice.point() * by;
                    }
                }
            }
        }
        assert!(all > 10_000, "{all} candidates");
        assert!(served > 200 && partly > 20, "{served} searches served, {partly} in part");
    }
}
