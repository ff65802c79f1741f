//! A line as tubes whose vertices stay the same from frame to frame, whatever its nodes do.

use std::sync::Arc;

use endline_sim::model::Knot;
use endline_sim::{Frame, Model};
use glam::Vec3;

use crate::scene::mesh::{Colour, Mesh};

/// Rings of a whole line's tubes, and vertices of each.
const RINGS: usize = 400;
const SIDES: usize = 6;

/// A stretch of a line that is whole at the end of the frames.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    line: usize,
    /// From where to where, as shares of the line's length.
    from: f64,
    to: f64,
}

/// The pieces that a line is in at the last of the frames.
pub(super) fn pieces(model: &Model, frames: &[Arc<Frame>], line: usize) -> Vec<Piece> {
    let Some(last) = frames.last() else { return Vec::new() };
    let lengths = Lengths::of(model, last, line);
    let mut cuts: Vec<f64> = lengths.cut_middles();
    cuts.push(1.0);
    let mut from = 0.0;
    let mut found = Vec::new();
    for to in cuts {
        found.push(Piece { line, from, to });
        from = to;
    }
    found
}

impl Piece {
    /// Vertices of a line that does not part.
    pub(super) const MOST_VERTICES: usize = RINGS * SIDES;

    /// The mesh in the first frame, and the places of its vertices in each later one.
    pub(super) fn meshes(
        &self,
        model: &Model,
        frames: &[Arc<Frame>],
        radius: f32,
        colour: Colour,
    ) -> (Mesh, Vec<Vec<Vec3>>) {
        let mut across = Vec3::ZERO;
        let mut tubes = frames.iter().map(|frame| {
            let centres = self.centres(model, frame);
            rings(&centres, radius, &mut across)
        });
        let first = tubes.next().unwrap_or_default();
        let mesh = mesh_of(&first, colour);
        (mesh, tubes.map(|tube| tube.into_iter().map(|(place, _)| place).collect()).collect())
    }

    fn centres(&self, model: &Model, frame: &Frame) -> Vec<Vec3> {
        let lengths = Lengths::of(model, frame, self.line);
        let count = (((self.to - self.from) * RINGS as f64) as usize).max(2);
        let share =
            |ring: usize| self.from + (self.to - self.from) * ring as f64 / (count - 1) as f64;
        // Where the line is cut, its pieces end at the nodes of their own sides.
        let middle = 0.5 * (self.from + self.to);
        (0..count).map(|ring| lengths.place(share(ring), share(ring) < middle)).collect()
    }

    /// Place of a share of a line's length in a frame; none where the frame lacks it.
    pub(super) fn place_at(model: &Model, frame: &Frame, line: usize, share: f64) -> Option<Vec3> {
        let lengths = Lengths::of(model, frame, line);
        (!lengths.nodes.is_empty()).then(|| lengths.place(share, false))
    }

    /// Where on its line a knot sits, as a share of the length.
    pub(super) fn share_of_knot(model: &Model, frame: &Frame, knot: &Knot) -> f64 {
        let line = model.segment_line[knot.segment];
        let lengths = Lengths::of(model, frame, line);
        let segment = knot.segment - model.line_segments[line].start;
        let start = lengths.start(segment);
        let length = lengths.start(segment + 1) - start;
        (start + knot.fraction(length) * length) / lengths.whole_m()
    }
}

/// A line in a frame by its unstretched length.
struct Lengths<'a> {
    nodes: &'a [endline_sim::DVec3],
    cut: &'a [bool],
    /// Length from the line's start to the end of each segment [m].
    ends: Vec<f64>,
}

impl<'a> Lengths<'a> {
    fn of(model: &Model, frame: &'a Frame, line: usize) -> Self {
        let (nodes, segments) = (model.line_nodes[line].clone(), model.line_segments[line].clone());
        let whole = frame.nodes.len() >= nodes.end
            && frame.cut.len() >= segments.end
            && frame.segment_length_m.len() >= segments.end;
        if !whole {
            return Self { nodes: &[], cut: &[], ends: Vec::new() };
        }
        let mut at = 0.0;
        let ends = frame.segment_length_m[segments.clone()].iter().map(|length| {
            at += length;
            at
        });
        Self { ends: ends.collect(), nodes: &frame.nodes[nodes], cut: &frame.cut[segments] }
    }

    fn whole_m(&self) -> f64 {
        self.ends.last().copied().unwrap_or_default().max(1e-9)
    }

    /// Length from the line's start to that of a segment, or to the line's end [m].
    fn start(&self, segment: usize) -> f64 {
        let before = segment.checked_sub(1).and_then(|before| self.ends.get(before));
        before.copied().unwrap_or_default()
    }

    /// Middles of the segments that are cut, as shares of the length.
    fn cut_middles(&self) -> Vec<f64> {
        let cut = (0..self.cut.len()).filter(|segment| self.cut[*segment]);
        cut.map(|segment| 0.5 * (self.start(segment) + self.ends[segment]) / self.whole_m())
            .collect()
    }

    /// The place of a share of the length. In a segment that is cut it is the node that the piece still has: the further one
    /// `at_start` of a piece.
    fn place(&self, share: f64, at_start: bool) -> Vec3 {
        let wanted = share.clamp(0.0, 1.0) * self.whole_m();
        let segment = self.ends.partition_point(|end| *end < wanted);
        let segment = segment.min(self.ends.len().saturating_sub(1));
        let Some([from, to]) = self.nodes.get(segment..segment + 2) else {
            return self.nodes.last().map_or(Vec3::ZERO, |node| node.as_vec3());
        };
        if self.cut[segment] {
            return (if at_start { *to } else { *from }).as_vec3();
        }
        let start = self.start(segment);
        let length = (self.ends[segment] - start).max(1e-9);
        from.lerp(*to, (wanted - start) / length).as_vec3()
    }
}

/// Places and normals of the rings of a tube. `across` is where its first ring began in the frame before: so that it does not turn.
fn rings(centres: &[Vec3], radius: f32, across: &mut Vec3) -> Vec<(Vec3, Vec3)> {
    let last = centres.len() - 1;
    let along = |ring: usize| {
        let way = centres[(ring + 1).min(last)] - centres[ring.saturating_sub(1)];
        way.normalize_or(Vec3::Z)
    };
    let level = |side: Vec3, along: Vec3| {
        (side - along * side.dot(along))
            .try_normalize()
            .unwrap_or_else(|| along.any_orthonormal_vector())
    };
    *across = level(*across, along(0));
    let mut side = *across;
    let mut found = Vec::with_capacity(centres.len() * SIDES);
    for (ring, centre) in centres.iter().enumerate() {
        let along = along(ring);
        side = level(side, along);
        let up = along.cross(side);
        for corner in 0..SIDES {
            let angle = std::f32::consts::TAU * corner as f32 / SIDES as f32;
            let normal = side * angle.cos() + up * angle.sin();
            found.push((*centre + normal * radius, normal));
        }
    }
    found
}

fn mesh_of(rings: &[(Vec3, Vec3)], colour: Colour) -> Mesh {
    let mut mesh = Mesh::default();
    for (place, normal) in rings {
        mesh.vertex(*place, *normal, 0.0, colour);
    }
    for first in (SIDES..rings.len()).step_by(SIDES) {
        mesh.band((first - SIDES) as u32, first as u32, SIDES);
    }
    mesh
}
