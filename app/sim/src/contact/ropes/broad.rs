//! Which segments of rope may come near each other in a step, and which knots may come near segments: boxes of pieces of lines, then
//! of segments and knots.
//!
//! A piece whose segments all run on along one direction cannot come back to itself: where each goes at least `c l` along it,
//! two of its points lie at least `c` times the rope between them apart. Both ends of a step are looked at; what is between is
//! a mean of the two, and so as straight. Two pieces in a row need directions that agree too.

use glam::DVec3;

use super::knots::{Ball, on_segments};
use crate::contact::pieces::{Piece, Pieces};
use crate::whale::Bounds;

/// Scratch of the search.
#[derive(Clone, Debug, Default)]
pub(crate) struct Broad {
    order: Vec<usize>,
    boxes: [Vec<(usize, Bounds)>; 2],
}

/// A step's moves as the search sees them.
pub(crate) struct Moves<'a, F: Fn(usize) -> DVec3> {
    /// Places where it begins.
    pub from: &'a [DVec3],
    /// Place of each node at its end.
    pub to: F,
}

/// How far apart things are looked for [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// Segments.
    pub ropes_m: f64,
    /// Knots from segments; not less.
    pub knots_m: f64,
}

/// What may come near each other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Found {
    /// Pairs of segments, the first below the second, in rising order.
    pub segments: Vec<[usize; 2]>,
    /// Pairs of a knot, by its number, and a segment, in rising order.
    pub knots: Vec<[usize; 2]>,
}

impl Broad {
    /// Collects what comes within reach in the step by its boxes. Knots stand in rising order of segment.
    pub fn collect(
        &mut self,
        all: &Pieces,
        knots: &[Ball],
        moves: &Moves<'_, impl Fn(usize) -> DVec3>,
        reach: Reach,
        found: &mut Found,
    ) {
        found.segments.clear();
        found.knots.clear();
        let (pieces, whole) = (&all.pieces, all.whole());
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
        self.order.sort_unstable_by(|a, b| {
            pieces[*a].bounds.low[axis].total_cmp(&pieces[*b].bounds.low[axis]).then(a.cmp(b))
        });
        for place in 0..self.order.len() {
            let one = &pieces[self.order[place]];
            if !one.is_straight {
                pairs_within(one, moves, reach.ropes_m, &mut self.boxes[0], &mut found.segments);
                knots_near(knots, one, one, moves, reach.knots_m, &mut found.knots);
            }
            let near = [reach.ropes_m, reach.knots_m].map(|reach_m| one.bounds.grown(reach_m));
            for other in &self.order[place + 1..] {
                let other = &pieces[*other];
                if other.bounds.low[axis] > near[1].high[axis] {
                    break;
                }
                if !near[1].meets(&other.bounds) || one.runs_on(other) {
                    continue;
                }
                if near[0].meets(&other.bounds) {
                    let (boxes, found) = (&mut self.boxes, &mut found.segments);
                    pairs_between(one, other, moves, reach.ropes_m, boxes, found);
                }
                knots_near(knots, one, other, moves, reach.knots_m, &mut found.knots);
                knots_near(knots, other, one, moves, reach.knots_m, &mut found.knots);
            }
        }
        found.segments.sort_unstable();
        found.knots.sort_unstable();
    }
}

/// The box around a node's way.
#[inline(always)]
fn way_of(node: usize, moves: &Moves<'_, impl Fn(usize) -> DVec3>) -> Bounds {
    let [from, to] = [moves.from[node], (moves.to)(node)];
    Bounds { low: from.min(to), high: from.max(to) }
}

/// Boxes of a piece's segments that reach into another box.
fn boxes_of(
    piece: &Piece,
    moves: &Moves<'_, impl Fn(usize) -> DVec3>,
    margin: f64,
    into: &Bounds,
    boxes: &mut Vec<(usize, Bounds)>,
) {
    boxes.clear();
    let into = into.grown(margin);
    for (segments, node) in piece.groups(|bounds| bounds.grown(margin).meets(&into)) {
        let mut here = way_of(node, moves);
        for (segment, node) in segments.zip(node + 1..) {
            let next = way_of(node, moves);
            let bounds = here.join(next).grown(margin);
            if bounds.meets(&into) {
                boxes.push((segment, bounds));
            }
            here = next;
        }
    }
}

fn pairs_within(
    piece: &Piece,
    moves: &Moves<'_, impl Fn(usize) -> DVec3>,
    search_distance: f64,
    boxes: &mut Vec<(usize, Bounds)>,
    found: &mut Vec<[usize; 2]>,
) {
    boxes_of(piece, moves, 0.5 * search_distance, &piece.bounds, boxes);
    for (place, (segment, bounds)) in boxes.iter().enumerate() {
        let later = boxes[place + 1..].iter().filter(|(_, other)| bounds.meets(other));
        found.extend(later.map(|(other, _)| [*segment, *other]));
    }
}

fn pairs_between(
    one: &Piece,
    other: &Piece,
    moves: &Moves<'_, impl Fn(usize) -> DVec3>,
    search_distance: f64,
    boxes: &mut [Vec<(usize, Bounds)>; 2],
    found: &mut Vec<[usize; 2]>,
) {
    let [first, second] = boxes;
    boxes_of(one, moves, 0.5 * search_distance, &other.bounds, first);
    boxes_of(other, moves, 0.5 * search_distance, &one.bounds, second);
    for (segment, bounds) in first.iter() {
        let near = second.iter().filter(|(_, other)| bounds.meets(other));
        found.extend(near.map(|(other, _)| [*segment.min(other), *segment.max(other)]));
    }
}

/// Knots of a piece near segments of another, or of its own.
fn knots_near(
    knots: &[Ball],
    of: &Piece,
    piece: &Piece,
    moves: &Moves<'_, impl Fn(usize) -> DVec3>,
    reach_m: f64,
    found: &mut Vec<[usize; 2]>,
) {
    for index in on_segments(knots, &of.segments) {
        let ball = &knots[index];
        let way = [ball.middle(|node| moves.from[node]), ball.middle(&moves.to)];
        let bounds = Bounds::around(&way).grown(reach_m);
        if !bounds.meets(&piece.bounds) {
            continue;
        }
        for (segments, node) in piece.groups(|group| bounds.meets(group)) {
            let mut here = way_of(node, moves);
            for (segment, node) in segments.zip(node + 1..) {
                let next = way_of(node, moves);
                if segment != ball.segment && bounds.meets(&here.join(next)) {
                    found.push([index, segment]);
                }
                here = next;
            }
        }
    }
}
