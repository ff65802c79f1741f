//! The list of neighbours among rope: groups of segments, and knots and groups, whose held boxes come within reach of each other
//! (`contact/pieces/held.rs`).
//!
//! It is laid out by pieces sorted along the axis on which rope extends farthest. What never touches, as rope next to the joint that it is
//! made fast to, is left out of it for good: that depends on lengths of rope alone. Within a piece and of two in a row it is not asked: most of
//! these run straight, and nothing of them is looked at.

use std::ops::Range;

use crate::broad_phase::knots::{Ball, on_segments};
use crate::broad_phase::pieces::{GROUPS, IN_A_GROUP, Piece, Pieces};
use crate::broad_phase::ropes::Reach;
use crate::whale::Bounds;

/// Pieces that are usually near a piece, itself included.
const USUAL_PIECES: usize = 6;

/// Margin for rounding of the middle of a knot in the box of its segment [m].
const ROUNDING_M: f64 = 1e-9;

/// Two groups of rope.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearGroups {
    /// Their numbers in the two pieces.
    pub groups: [usize; 2],
    /// Whether two of their segments may touch, by the place of each in its group.
    pub may: [[bool; IN_A_GROUP]; IN_A_GROUP],
}

/// Largest number of pairs of groups, about 100 MB: a hundred times that of the shipped scenarios.
const MOST_GROUPS: usize = 1_000_000;

/// A knot and a group of rope.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearKnot {
    pub knot: usize,
    /// Which of the two pieces the group belongs to, and its number in that.
    pub side: usize,
    pub group: usize,
    /// Whether the knot and each segment may touch.
    pub may: [bool; IN_A_GROUP],
}

/// How two pieces lie on rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Are {
    /// Both are one piece.
    One,
    /// One follows the other.
    InARow,
    /// Neither.
    Apart,
}

/// Two pieces, or one twice, and the groups in them that may be near each other.
#[derive(Clone, Debug)]
pub(crate) struct NearPieces {
    pub pieces: [usize; 2],
    pub are: Are,
    pub groups: Range<usize>,
    pub knots: Range<usize>,
}

/// What may touch at all: two segments, the first below the second, or the knot of this number, or another on the second of them,
/// and two segments.
pub(crate) type MayTouch<'a> = &'a dyn Fn([usize; 2], Option<usize>) -> bool;

/// The list, for one layout of held boxes and one reach.
#[derive(Clone, Debug, Default)]
pub(crate) struct Neighbours {
    /// Number of the layout of held boxes, and the reach, for which the list holds.
    of: Option<(u64, Reach)>,
    order: Vec<usize>,
    pub pieces: Vec<NearPieces>,
    pub groups: Vec<NearGroups>,
    pub knots: Vec<NearKnot>,
    /// Whether more is near than is listed.
    pub crowded: bool,
}

impl Neighbours {
    /// Discards the list, because the pairs that may touch have changed.
    pub fn forget(&mut self) {
        self.of = None;
    }

    /// Builds the list, if it does not hold for these held boxes and this reach.
    pub fn update(&mut self, all: &Pieces, knots: &[Ball], reach: Reach, may_touch: MayTouch<'_>) {
        if self.of == Some((all.holding, reach)) {
            return;
        }
        self.of = Some((all.holding, reach));
        self.clear(all.pieces.len(), knots.len());
        let pieces = &all.pieces;
        let axis = self.sort(pieces);
        for place in 0..self.order.len() {
            if self.groups.len() > MOST_GROUPS {
                self.crowded = true;
                return;
            }
            let one = self.order[place];
            self.add(pieces, [one, one], knots, reach, may_touch);
            let near = pieces[one].held_whole.grown(reach.farthest_m());
            for next in place + 1..self.order.len() {
                let other = self.order[next];
                let bounds = &pieces[other].held_whole;
                if bounds.low[axis] > near.high[axis] {
                    break;
                }
                if near.meets(bounds) {
                    self.add(pieces, [one, other], knots, reach, may_touch);
                }
            }
        }
    }

    /// Empties the list, with a capacity that rarely grows.
    fn clear(&mut self, pieces: usize, knots: usize) {
        self.crowded = false;
        self.pieces.clear();
        self.groups.clear();
        self.knots.clear();
        self.pieces.reserve(USUAL_PIECES * pieces);
        self.groups.reserve(USUAL_PIECES * GROUPS * GROUPS * pieces);
        self.knots.reserve(USUAL_PIECES * GROUPS * knots);
    }

    /// Sorts pieces by where their held boxes begin along the longest axis of all; which that is.
    fn sort(&mut self, pieces: &[Piece]) -> usize {
        let whole = pieces.iter().fold(Bounds::EMPTY, |whole, piece| whole.join(piece.held_whole));
        let extent = whole.high - whole.low;
        let axis = if extent.x >= extent.y.max(extent.z) {
            0
        } else {
            1 + usize::from(extent.z > extent.y)
        };
        if self.order.len() != pieces.len() {
            self.order.clear();
            self.order.extend(0..pieces.len());
        }
        let low = |piece: usize| pieces[piece].held_whole.low[axis];
        self.order.sort_unstable_by(|a, b| low(*a).total_cmp(&low(*b)).then(a.cmp(b)));
        axis
    }

    /// Adds two pieces, or one with itself, where anything of them may be near.
    fn add(
        &mut self,
        all: &[Piece],
        pieces: [usize; 2],
        knots: &[Ball],
        reach: Reach,
        may_touch: MayTouch<'_>,
    ) {
        let (first_groups, first_knots) = (self.groups.len(), self.knots.len());
        let both = pieces.map(|piece| &all[piece]);
        let are = if pieces[0] == pieces[1] {
            Are::One
        } else if both[0].follows(both[1]) {
            Are::InARow
        } else {
            Are::Apart
        };
        let is_one = are == Are::One;
        let may_touch: MayTouch<'_> = if are == Are::Apart { may_touch } else { &|_, _| true };
        self.add_groups(both, is_one, reach, may_touch);
        for side in 0..if is_one { 1 } else { 2 } {
            self.add_knots(both, side, knots, reach, may_touch);
        }
        let near = NearPieces {
            pieces,
            are,
            groups: first_groups..self.groups.len(),
            knots: first_knots..self.knots.len(),
        };
        if !near.groups.is_empty() || !near.knots.is_empty() {
            self.pieces.push(near);
        }
    }

    fn add_groups(
        &mut self,
        [one, other]: [&Piece; 2],
        is_one: bool,
        reach: Reach,
        may_touch: MayTouch<'_>,
    ) {
        for first in 0..GROUPS {
            let bounds = reach.of_segment(&one.held[first]);
            for second in if is_one { first } else { 0 }..GROUPS {
                if !bounds.meets(&reach.of_segment(&other.held[second])) {
                    continue;
                }
                let mut may = [[false; IN_A_GROUP]; IN_A_GROUP];
                for (a, row) in one.group(first).0.zip(&mut may) {
                    for (b, may) in other.group(second).0.zip(row) {
                        let is_new = !is_one || a < b;
                        *may = is_new && may_touch([a.min(b), a.max(b)], None);
                    }
                }
                if may.as_flattened().contains(&true) {
                    self.groups.push(NearGroups { groups: [first, second], may });
                }
            }
        }
    }

    /// Adds knots of the other piece near a side's groups.
    fn add_knots(
        &mut self,
        pieces: [&Piece; 2],
        side: usize,
        knots: &[Ball],
        reach: Reach,
        may_touch: MayTouch<'_>,
    ) {
        let (piece, of) = (pieces[side], pieces[1 - side]);
        for knot in on_segments(knots, &of.segments) {
            let own = knots[knot].segment;
            let held = &of.held[(own - of.segments.start) / IN_A_GROUP];
            let bounds = held.grown(reach.knots_m + ROUNDING_M);
            for group in (0..GROUPS).filter(|group| bounds.meets(&piece.held[*group])) {
                let mut may = [false; IN_A_GROUP];
                for (segment, may) in piece.group(group).0.zip(&mut may) {
                    *may = segment != own && may_touch([own, segment], Some(knot));
                }
                if may.contains(&true) {
                    self.knots.push(NearKnot { knot, side, group, may });
                }
            }
        }
    }
}
