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
    let reach = solid.radius_m + search_distance;
    let around = Bounds::around(&[poses[0].place, poses[1].place]).grown(reach);
    let meets = move |bounds: &Bounds| {
        if solid.radius_m.is_finite() {
            around.meets(bounds)
        } else {
            comes_near_plane(bounds, &poses[0], search_distance)
        }
    };
    let lines = all.lines.iter().filter(move |(_, bounds)| meets(bounds));
    lines.flat_map(move |(pieces, _)| {
        let pieces = all.pieces[pieces.clone()].iter().filter(move |piece| meets(&piece.bounds));
        pieces.flat_map(move |piece| {
            piece.groups(meets).flat_map(move |(segments, node)| {
                let near = segments.zip(node..);
                near.map(move |(segment, node)| NearSegment { segment, node, line: piece.line })
            })
        })
    })
}

/// Whether a box comes within a distance of all that lies below a plane.
fn comes_near_plane(bounds: &Bounds, plane: &Pose, search_distance: f64) -> bool {
    let normal = plane.orientation * DVec3::Z;
    let (middle, half) = (0.5 * (bounds.low + bounds.high), 0.5 * (bounds.high - bounds.low));
    normal.dot(middle - plane.place) - normal.abs().dot(half) <= search_distance
}
