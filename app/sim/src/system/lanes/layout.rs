//! How a rig's lines are cut into pieces and the pieces laid into groups of eight lanes.
//!
//! Pieces of about an eighth of the rig's nodes fill one group; short lines are a piece each. Pieces are grouped by
//! length, so that few rows are idle.

use crate::model::{Joint, JointKind, Model};
use crate::simd::rows::{LANES, Row};

/// Least segments of a piece that is cut from a longer line.
const LEAST_SEGMENTS: usize = 12;

/// Consecutive segments of one line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub line: usize,
    pub first_node: usize,
    pub first_segment: usize,
    pub segments: usize,
    /// Whether the line continues before and behind it.
    pub follows: bool,
    pub continues: bool,
    /// Whether its end A is on a fixture.
    pub anchored: bool,
    /// Whether its rope resists bending.
    pub bends: bool,
    /// Where it lies.
    pub group: usize,
    pub lane: usize,
}

/// Eight pieces side by side.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// First of its node rows (a ghost), and of its segment rows.
    pub node_row: usize,
    pub segment_row: usize,
    /// Segments of its longest and shortest piece.
    pub longest: usize,
    pub shortest: usize,
    /// For each segment from `shortest` on: 1 in lanes whose piece has it.
    pub live: Vec<Row>,
    /// Piece of each lane; lanes to spare repeat the first.
    pub pieces: [usize; LANES],
    /// Lanes in use.
    pub used: usize,
    /// Whether end A of every piece is on a fixture.
    pub anchored: bool,
    /// Whether any of its rope resists bending.
    pub bends: bool,
}

fn is_fixture(joint: &Joint) -> bool {
    matches!(joint.kind, JointKind::Fixed | JointKind::Driven { .. } | JointKind::Whale(_))
}

/// All pieces, in the order of the lines and along each.
pub(crate) fn pieces(model: &Model) -> Vec<Piece> {
    let target = model.segment_count.div_ceil(LANES).max(LEAST_SEGMENTS);
    let mut pieces = Vec::new();
    for line in 0..model.spec.lines.len() {
        let (nodes, segments) = (&model.line_nodes[line], &model.line_segments[line]);
        let count = ((segments.len() as f64 / target as f64).round() as usize).max(1);
        for part in 0..count {
            let (from, to) = (part * segments.len() / count, (part + 1) * segments.len() / count);
            pieces.push(Piece {
                line,
                first_node: nodes.start + from,
                first_segment: segments.start + from,
                segments: to - from,
                follows: part > 0,
                continues: part + 1 < count,
                bends: model.spec.ropes[model.spec.lines[line].rope].bending_stiffness_n_m2 > 0.0,
                anchored: part == 0 && is_fixture(&model.spec.joints[model.spec.lines[line].from]),
                group: 0,
                lane: 0,
            });
        }
    }
    pieces
}

/// Lays pieces into groups, longest first.
pub(crate) fn groups(pieces: &mut [Piece]) -> Vec<Group> {
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by_key(|piece| core::cmp::Reverse(pieces[*piece].segments));
    let (mut node_row, mut segment_row) = (0, 0);
    let mut groups = Vec::new();
    for chunk in order.chunks(LANES) {
        let mut lanes = [chunk[0]; LANES];
        lanes[..chunk.len()].copy_from_slice(chunk);
        for (lane, piece) in chunk.iter().enumerate() {
            (pieces[*piece].group, pieces[*piece].lane) = (groups.len(), lane);
        }
        let lengths = lanes.map(|piece| pieces[piece].segments);
        let longest = lengths[0];
        let shortest = lengths.into_iter().fold(longest, usize::min);
        let live = (shortest..longest)
            .map(|k| Row(lengths.map(|length| if k < length { 1.0 } else { 0.0 })))
            .collect();
        let anchored = lanes.iter().all(|piece| pieces[*piece].anchored);
        let bends = lanes.iter().any(|piece| pieces[*piece].bends);
        groups.push(Group {
            node_row,
            segment_row,
            longest,
            shortest,
            live,
            pieces: lanes,
            used: chunk.len(),
            anchored,
            bends,
        });
        node_row += longest + 3;
        segment_row += longest;
    }
    groups
}
