//! Pairs of segments of rope, and of knots and segments, that may come near each other in a step: those whose boxes meet, among the
//! neighbours of a list that holds for several steps (`rope_neighbours.rs`).
//!
//! A piece whose segments all advance along one direction cannot return to itself: if each advances by at least `c l`,
//! two of its points are at least `c` times the rope between them apart. This is tested at both ends of a step; any moment between is
//! a mean of the two, and so as straight. Two consecutive pieces need directions that agree too.

use crate::broad_phase::knots::Ball;
use crate::broad_phase::pieces::{GROUPS, IN_A_GROUP, Piece, Pieces};
use crate::broad_phase::rope_neighbours::{
    Are, MayTouch, NearGroups, NearKnot, NearPieces, Neighbours,
};
use crate::bucket_sort::BucketSort;
use crate::whale::Bounds;
use glam::DVec3;

/// The search, with its list of neighbours.
#[derive(Clone, Debug, Default)]
pub(crate) struct Broad {
    neighbours: Neighbours,
    sort: BucketSort<[usize; 2]>,
}

/// A step's moves as the search sees them.
pub(crate) struct Moves<'a, F: Fn(usize) -> DVec3> {
    /// Places where it begins.
    pub from: &'a [DVec3],
    /// Place of each node at its end.
    pub to: F,
}

/// Pairs that may come near each other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Found {
    /// Pairs of segments, the first below the second, in rising order.
    pub segments: Vec<[usize; 2]>,
    /// Pairs of a knot, by its number, and a segment, in rising order.
    pub knots: Vec<[usize; 2]>,
    /// Whether there is more than is listed: rope lies in a heap.
    pub crowded: bool,
}

/// Largest number of pairs of segments: a hundred times that of the shipped scenarios.
const MOST_PAIRS: usize = 500_000;

/// Rope in which to search.
#[derive(Clone, Copy)]
pub(crate) struct Rope<'a> {
    /// Its pieces, measured for the step.
    pub pieces: &'a Pieces,
    /// Its knots, in rising order of segment.
    pub knots: &'a [Ball],
    /// Which pairs may touch at all; called for pieces that are not consecutive.
    pub may_touch: MayTouch<'a>,
}

impl Broad {
    /// Discards the list, because the pairs that may touch at all have changed.
    pub fn forget(&mut self) {
        self.neighbours.forget();
    }

    /// Collects the pairs whose boxes come within `reach` in the step, which is at most the reach of the list.
    pub fn collect(
        &mut self,
        rope: Rope<'_>,
        moves: &Moves<'_, impl Fn(usize) -> DVec3>,
        reach: Reach,
        farthest: Reach,
        found: &mut Found,
    ) {
        found.segments.clear();
        found.knots.clear();
        let Rope { pieces: all, knots, may_touch } = rope;
        self.neighbours.update(all, knots, farthest, may_touch);
        let mut boxes = [SegmentBoxes::NONE; 2];
        found.crowded = self.neighbours.crowded;
        for near in &self.neighbours.pieces {
            if found.segments.len() > MOST_PAIRS {
                found.crowded = true;
                break;
            }
            let pieces = near.pieces.map(|piece| &all.pieces[piece]);
            let [one, other] = pieces;
            let is_straight = match near.are {
                Are::One => one.is_straight,
                Are::InARow => one.runs_on(other),
                Are::Apart => false,
            };
            if is_straight || !one.bounds.grown(reach.farthest_m()).meets(&other.bounds) {
                continue;
            }
            let (list, boxes) = (&self.neighbours, &mut boxes);
            boxes.iter_mut().for_each(SegmentBoxes::clear);
            let mut step = Step { list, near, pieces, moves, reach, boxes };
            step.pairs(&mut found.segments);
            step.knots(knots, &mut found.knots);
        }
        self.sort.sort(&mut found.segments, |[one, _]| *one, |[_, other]| *other);
        found.knots.sort_unstable();
    }
}

/// The boxes around the paths of the segments of a piece, as far as they have been computed.
struct SegmentBoxes {
    boxes: [[Bounds; IN_A_GROUP]; GROUPS],
    known: [bool; GROUPS],
}

impl SegmentBoxes {
    const NONE: Self =
        Self { boxes: [[Bounds::EMPTY; IN_A_GROUP]; GROUPS], known: [false; GROUPS] };

    fn clear(&mut self) {
        self.known = [false; GROUPS];
    }

    /// Boxes of the segments of a group.
    fn of(
        &mut self,
        piece: &Piece,
        group: usize,
        moves: &Moves<'_, impl Fn(usize) -> DVec3>,
    ) -> &[Bounds; IN_A_GROUP] {
        let boxes = &mut self.boxes[group];
        if !self.known[group] {
            self.known[group] = true;
            let (segments, node) = piece.group(group);
            let mut here = way_of(node, moves);
            for (bounds, node) in boxes[..segments.len()].iter_mut().zip(node + 1..) {
                let next = way_of(node, moves);
                *bounds = here.join(next);
                here = next;
            }
        }
        boxes
    }
}

/// The box around a node's way.
#[inline(always)]
fn way_of(node: usize, moves: &Moves<'_, impl Fn(usize) -> DVec3>) -> Bounds {
    let [from, to] = [moves.from[node], (moves.to)(node)];
    Bounds { low: from.min(to), high: from.max(to) }
}

/// Two pieces of which something may be near, in a step.
struct Step<'a, F: Fn(usize) -> DVec3> {
    list: &'a Neighbours,
    near: &'a NearPieces,
    pieces: [&'a Piece; 2],
    moves: &'a Moves<'a, F>,
    reach: Reach,
    boxes: &'a mut [SegmentBoxes; 2],
}

impl<F: Fn(usize) -> DVec3> Step<'_, F> {
    /// Boxes of the segments of a group of one of the two pieces.
    fn boxes_of(&mut self, side: usize, group: usize) -> [Bounds; IN_A_GROUP] {
        let side = if self.near.are == Are::One { 0 } else { side };
        *self.boxes[side].of(self.pieces[side], group, self.moves)
    }

    /// Adds the pairs of segments that come within reach.
    fn pairs(&mut self, found: &mut Vec<[usize; 2]>) {
        let (list, reach, [one, other]) = (self.list, self.reach, self.pieces);
        for NearGroups { groups: [first, second], may } in &list.groups[self.near.groups.clone()] {
            let [a, b] = [&one.groups[*first], &other.groups[*second]];
            if !reach.of_segment(a).meets(&reach.of_segment(b)) {
                continue;
            }
            let boxes = self.boxes_of(0, *first).map(|bounds| reach.of_segment(&bounds));
            let others = self.boxes_of(1, *second).map(|bounds| reach.of_segment(&bounds));
            for ((a, bounds), row) in one.group(*first).0.zip(&boxes).zip(may) {
                for ((b, other), may) in other.group(*second).0.zip(&others).zip(row) {
                    if *may && bounds.meets(other) {
                        found.push([a.min(b), a.max(b)]);
                    }
                }
            }
        }
    }

    /// Adds the pairs of a knot and a segment that come within reach.
    fn knots(&mut self, knots: &[Ball], found: &mut Vec<[usize; 2]>) {
        let list = self.list;
        for NearKnot { knot, side, group, may } in &list.knots[self.near.knots.clone()] {
            let ball = &knots[*knot];
            let way = [ball.middle(|node| self.moves.from[node]), ball.middle(&self.moves.to)];
            let bounds = Bounds::around(&way).grown(self.reach.knots_m);
            let piece = self.pieces[*side];
            if !bounds.meets(&piece.groups[*group]) {
                continue;
            }
            let boxes = self.boxes_of(*side, *group);
            for ((segment, other), may) in piece.group(*group).0.zip(&boxes).zip(may) {
                if *may && bounds.meets(other) {
                    found.push([*knot, segment]);
                }
            }
        }
    }
}

/// Distances within which pairs are searched for [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    /// Segments.
    pub ropes_m: f64,
    /// Knots from segments; not less.
    pub knots_m: f64,
}

impl Reach {
    /// A box around a segment or more, grown so that two of them meet within reach.
    #[inline(always)]
    pub fn of_segment(&self, bounds: &Bounds) -> Bounds {
        bounds.grown(0.5 * self.ropes_m)
    }

    /// The greater of the two, with a margin for rounding [m].
    pub fn farthest_m(&self) -> f64 {
        self.ropes_m.max(self.knots_m) + 2e-9
    }
}
