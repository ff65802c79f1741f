//! Which segments of rope may come near a solid in a step: boxes of lines, then of sixteen segments.

use std::ops::Range;

use glam::DVec3;

use super::{Pose, Solid};
use crate::model::Model;

/// Segments in one box.
const IN_A_BOX: usize = 16;

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    low: DVec3,
    high: DVec3,
}

impl Bounds {
    const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    fn hold(&mut self, place: DVec3) {
        self.low = self.low.min(place);
        self.high = self.high.max(place);
    }

    /// Whether a solid that goes from one pose to another may come within `search_distance`.
    fn meets(&self, solid: &Solid, [from, to]: &[Pose; 2], search_distance: f64) -> bool {
        if solid.radius_m.is_finite() {
            let low = from.place.min(to.place) - DVec3::splat(solid.radius_m + search_distance);
            let high = from.place.max(to.place) + DVec3::splat(solid.radius_m + search_distance);
            return self.low.cmple(high).all() && low.cmple(self.high).all();
        }
        let normal = from.orientation * DVec3::Z;
        let (middle, half) = (0.5 * (self.low + self.high), 0.5 * (self.high - self.low));
        normal.dot(middle - from.place) - normal.abs().dot(half) <= search_distance
    }
}

/// Boxes of the lines and of pieces of them, over a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Boxes {
    lines: Vec<(Range<usize>, Bounds)>,
    pieces: Vec<Piece>,
}

/// Segments in a row of one line.
#[derive(Clone, Debug)]
struct Piece {
    segments: Range<usize>,
    nodes: Range<usize>,
    bounds: Bounds,
}

/// A segment whose box comes near a solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearSegment {
    pub segment: usize,
    /// First node of the segment.
    pub node: usize,
    pub line: usize,
}

impl Boxes {
    /// Storage for a model.
    pub fn new(model: &Model) -> Self {
        let mut boxes = Self::default();
        for (nodes, segments) in model.line_nodes.iter().zip(&model.line_segments) {
            let first = boxes.pieces.len();
            for start in segments.clone().step_by(IN_A_BOX) {
                let end = (start + IN_A_BOX).min(segments.end);
                let node = nodes.start + start - segments.start;
                boxes.pieces.push(Piece {
                    segments: start..end,
                    nodes: node..node + end - start + 1,
                    bounds: Bounds::EMPTY,
                });
            }
            boxes.lines.push((first..boxes.pieces.len(), Bounds::EMPTY));
        }
        boxes
    }

    /// Measures the boxes of rope that goes from one place to another.
    pub fn measure(&mut self, from: &[DVec3], to: impl Fn(usize) -> DVec3) {
        for (pieces, whole) in &mut self.lines {
            *whole = Bounds::EMPTY;
            for piece in &mut self.pieces[pieces.clone()] {
                let mut bounds = Bounds::EMPTY;
                for node in piece.nodes.clone() {
                    bounds.hold(from[node]);
                    bounds.hold(to(node));
                }
                piece.bounds = bounds;
                whole.hold(bounds.low);
                whole.hold(bounds.high);
            }
        }
    }

    /// Segments whose box comes within `search_distance` of a solid.
    pub fn near<'a>(
        &'a self,
        solid: &'a Solid,
        poses: &'a [Pose; 2],
        search_distance: f64,
    ) -> impl Iterator<Item = NearSegment> + 'a {
        let lines = self
            .lines
            .iter()
            .enumerate()
            .filter(move |(_, (_, bounds))| bounds.meets(solid, poses, search_distance));
        lines.flat_map(move |(line, (pieces, _))| {
            let pieces = self.pieces[pieces.clone()]
                .iter()
                .filter(move |piece| piece.bounds.meets(solid, poses, search_distance));
            pieces.flat_map(move |piece| {
                piece
                    .segments
                    .clone()
                    .zip(piece.nodes.clone())
                    .map(move |(segment, node)| NearSegment { segment, node, line })
            })
        })
    }
}
