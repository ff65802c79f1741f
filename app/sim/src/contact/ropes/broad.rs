//! Which segments of rope may come near each other in a step: boxes of pieces of lines, then of segments.
//!
//! A piece whose segments all run on along one direction cannot come back to itself: where each goes at least `c l` along it,
//! two of its points lie at least `c` times the rope between them apart. Both ends of a step are looked at; what is between is
//! a mean of the two, and so as straight. Two pieces in a row need directions that agree too.

use std::ops::Range;

use glam::DVec3;

use crate::model::Model;
use crate::whale::Bounds;

/// Segments in one piece.
const IN_A_PIECE: usize = 16;
/// Cosine of 40°: how far a straight piece's segments, and two pieces in a row, may turn from each other. Together they then
/// stay within 60° of one direction.
const STRAIGHT: f64 = 0.766;

/// Segments in a row of one line.
#[derive(Clone, Debug)]
struct Piece {
    line: usize,
    segments: Range<usize>,
    nodes: Range<usize>,
    bounds: Bounds,
    /// Direction from its first node to its last, at the start and at the end of the step.
    directions: [DVec3; 2],
    is_straight: bool,
}

/// Boxes over a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Broad {
    pieces: Vec<Piece>,
    order: Vec<usize>,
    boxes: [Vec<(usize, Bounds)>; 2],
}

/// A step's moves as the search sees them.
pub(crate) struct Moves<'a, F: Fn(usize) -> DVec3> {
    /// Places where it begins.
    pub from: &'a [DVec3],
    /// Place of each node at its end.
    pub to: F,
    /// Unstretched length of each segment [m].
    pub lengths: &'a [f64],
}

impl Broad {
    /// Storage for a model.
    pub fn new(model: &Model) -> Self {
        let mut pieces = Vec::new();
        for (line, (nodes, segments)) in
            model.line_nodes.iter().zip(&model.line_segments).enumerate()
        {
            for start in segments.clone().step_by(IN_A_PIECE) {
                let end = (start + IN_A_PIECE).min(segments.end);
                let node = nodes.start + start - segments.start;
                pieces.push(Piece {
                    line,
                    segments: start..end,
                    nodes: node..node + end - start + 1,
                    bounds: Bounds::EMPTY,
                    directions: [DVec3::ZERO; 2],
                    is_straight: false,
                });
            }
        }
        let boxes = [Vec::with_capacity(IN_A_PIECE), Vec::with_capacity(IN_A_PIECE)];
        Self { order: (0..pieces.len()).collect(), pieces, boxes }
    }

    /// Collects pairs of segments, the first below the second, whose boxes come within `search_distance` in the step, in rising order.
    pub fn collect(
        &mut self,
        moves: &Moves<'_, impl Fn(usize) -> DVec3>,
        search_distance: f64,
        found: &mut Vec<[usize; 2]>,
    ) {
        found.clear();
        for piece in &mut self.pieces {
            piece.measure(moves, 0.5 * search_distance);
        }
        let whole = self.pieces.iter().fold(Bounds::EMPTY, |whole, piece| whole.join(piece.bounds));
        let extent = whole.high - whole.low;
        let axis = if extent.x >= extent.y.max(extent.z) {
            0
        } else {
            1 + usize::from(extent.z > extent.y)
        };
        let pieces = &self.pieces;
        self.order.sort_unstable_by(|a, b| {
            pieces[*a].bounds.low[axis].total_cmp(&pieces[*b].bounds.low[axis]).then(a.cmp(b))
        });
        for place in 0..self.order.len() {
            let one = &self.pieces[self.order[place]];
            if !one.is_straight {
                pairs_within(one, moves, search_distance, &mut self.boxes[0], found);
            }
            for other in &self.order[place + 1..] {
                let other = &self.pieces[*other];
                if other.bounds.low[axis] > one.bounds.high[axis] {
                    break;
                }
                if one.bounds.meets(&other.bounds) && !one.runs_on(other) {
                    pairs_between(one, other, moves, search_distance, &mut self.boxes, found);
                }
            }
        }
        found.sort_unstable();
    }
}

impl Piece {
    fn measure(&mut self, moves: &Moves<'_, impl Fn(usize) -> DVec3>, margin: f64) {
        let (first, last) = (self.nodes.start, self.nodes.end - 1);
        let (mut from, mut to) = (moves.from[first], (moves.to)(first));
        let directions = [
            (moves.from[last] - from).normalize_or_zero(),
            ((moves.to)(last) - to).normalize_or_zero(),
        ];
        let mut bounds = Bounds::around(&[from, to]);
        let mut is_straight = true;
        for (node, segment) in (first + 1..=last).zip(self.segments.clone()) {
            let (next_from, next_to) = (moves.from[node], (moves.to)(node));
            let least = STRAIGHT * moves.lengths[segment];
            is_straight &= (next_from - from).dot(directions[0]) >= least
                && (next_to - to).dot(directions[1]) >= least;
            (from, to) = (next_from, next_to);
            bounds = bounds.with(from).with(to);
        }
        (self.bounds, self.directions, self.is_straight) =
            (bounds.grown(margin), directions, is_straight);
    }

    /// Whether the two are one straight run of one line.
    fn runs_on(&self, other: &Self) -> bool {
        let in_a_row =
            self.segments.end == other.segments.start || other.segments.end == self.segments.start;
        let agree = || (0..2).all(|k| self.directions[k].dot(other.directions[k]) >= STRAIGHT);
        self.line == other.line && in_a_row && self.is_straight && other.is_straight && agree()
    }

    /// Boxes of its segments that reach into another's box.
    fn boxes(
        &self,
        moves: &Moves<'_, impl Fn(usize) -> DVec3>,
        margin: f64,
        into: &Bounds,
        boxes: &mut Vec<(usize, Bounds)>,
    ) {
        boxes.clear();
        for (node, segment) in (self.nodes.start..).zip(self.segments.clone()) {
            let corners =
                [moves.from[node], moves.from[node + 1], (moves.to)(node), (moves.to)(node + 1)];
            let bounds = Bounds::around(&corners).grown(margin);
            if bounds.meets(into) {
                boxes.push((segment, bounds));
            }
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
    piece.boxes(moves, 0.5 * search_distance, &piece.bounds, boxes);
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
    one.boxes(moves, 0.5 * search_distance, &other.bounds, first);
    other.boxes(moves, 0.5 * search_distance, &one.bounds, second);
    for (segment, bounds) in first.iter() {
        let near = second.iter().filter(|(_, other)| bounds.meets(other));
        found.extend(near.map(|(other, _)| [*segment.min(other), *segment.max(other)]));
    }
}
