//! Which segments of rope may come near a solid in a step: boxes of lines, then of pieces of them.

use glam::DVec3;

use super::{Pose, Solid};
use crate::contact::pieces::Pieces;
use crate::whale::Bounds;

/// A segment whose box comes near a solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearSegment {
    pub segment: usize,
    /// First node of the segment.
    pub node: usize,
    pub line: usize,
}

/// Segments whose box comes within `search_distance` of a solid that goes from one pose to another.
pub(crate) fn near<'a>(
    all: &'a Pieces,
    solid: &'a Solid,
    poses: &'a [Pose; 2],
    search_distance: f64,
) -> impl Iterator<Item = NearSegment> + 'a {
    let meets = move |bounds: &Bounds| meets(bounds, solid, poses, search_distance);
    let lines = all.lines.iter().filter(move |(_, bounds)| meets(bounds));
    lines.flat_map(move |(pieces, _)| {
        let pieces = all.pieces[pieces.clone()].iter().filter(move |piece| meets(&piece.bounds));
        pieces.flat_map(move |piece| {
            let segments = piece.segments.clone().zip(piece.nodes.clone());
            segments.map(move |(segment, node)| NearSegment { segment, node, line: piece.line })
        })
    })
}

/// Whether a solid that goes from one pose to another may come within `search_distance` of a box.
fn meets(bounds: &Bounds, solid: &Solid, [from, to]: &[Pose; 2], search_distance: f64) -> bool {
    if solid.radius_m.is_finite() {
        let reach = solid.radius_m + search_distance;
        return Bounds::around(&[from.place, to.place]).grown(reach).meets(bounds);
    }
    let normal = from.orientation * DVec3::Z;
    let (middle, half) = (0.5 * (bounds.low + bounds.high), 0.5 * (bounds.high - bounds.low));
    normal.dot(middle - from.place) - normal.abs().dot(half) <= search_distance
}
