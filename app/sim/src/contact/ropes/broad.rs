//! Which segments of rope may come near each other in a step: boxes of pieces of lines, then of segments.
//!
//! A piece whose segments all run on along one direction cannot come back to itself: where each goes at least `c l` along it,
//! two of its points lie at least `c` times the rope between them apart. Both ends of a step are looked at; what is between is
//! a mean of the two, and so as straight. Two pieces in a row need directions that agree too.

use glam::DVec3;

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

impl Broad {
    /// Collects pairs of segments, the first below the second, whose boxes come within `search_distance` in the step, in rising order.
    pub fn collect(
        &mut self,
        all: &Pieces,
        moves: &Moves<'_, impl Fn(usize) -> DVec3>,
        search_distance: f64,
        found: &mut Vec<[usize; 2]>,
    ) {
        found.clear();
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
                pairs_within(one, moves, search_distance, &mut self.boxes[0], found);
            }
            let reach = one.bounds.grown(search_distance);
            for other in &self.order[place + 1..] {
                let other = &pieces[*other];
                if other.bounds.low[axis] > reach.high[axis] {
                    break;
                }
                if reach.meets(&other.bounds) && !one.runs_on(other) {
                    pairs_between(one, other, moves, search_distance, &mut self.boxes, found);
                }
            }
        }
        found.sort_unstable();
    }
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
    for (node, segment) in (piece.nodes.start..).zip(piece.segments.clone()) {
        let corners =
            [moves.from[node], moves.from[node + 1], (moves.to)(node), (moves.to)(node + 1)];
        let bounds = Bounds::around(&corners).grown(margin);
        if bounds.meets(&into) {
            boxes.push((segment, bounds));
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
