//! Inputs and outputs of the sweeps, node by node, in rows of eight lanes.
//!
//! A lane holds a *piece* of rope: consecutive nodes of one line. Row `k` holds node `k` of every piece, and segment
//! `k` behind it. Pieces of unlike length share a group: rows beyond a piece's end hold copies of its last node.

use glam::{DMat3, DVec3};

use crate::simd::rows::{LANES, Row, Row3, Row6, Row9};

/// Inputs of a sweep at a node.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NodeRow {
    pub place: Row3,
    pub place_history: Row3,
    pub velocity_history: Row3,
    pub flow: Row3,
    pub length: Row,
    /// Bending stiffness of the hinge here, zero at a line's ends, and the inverse lengths of the segments before and behind.
    pub hinge: Row,
    pub inverse_before: Row,
    pub inverse_behind: Row,
}

/// Force and block of the seabed at a node.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct GroundRow {
    pub force: Row3,
    pub block: Row6,
}

/// Force and block of contact at a node, and the block of its coupling with the next.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactRow {
    pub force: Row3,
    pub block: Row9,
    pub coupling: Row9,
}

/// Inputs of a sweep at a segment, and the tension it predicts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SegmentRow {
    pub length: Row,
    pub inverse_length: Row,
    pub ea: Row,
    pub ea2: Row,
    pub damping: Row,
    /// Part of the block due to the hinges at both ends [N/m].
    pub bending: Row,
    pub tension: Row,
}

/// Results of the forward sweep for the backward sweep: `step_k = g - W step_A + X step_(k+1)`, and segment `k`'s pull.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Solved {
    pub x: Row9,
    pub w: Row9,
    pub g: Row3,
    pub direction: Row3,
    pub tension: Row,
    pub stiffness: Row,
    pub inverse_chord: Row,
}

/// Matrix and force of pieces reduced to their ends A and B.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct EndRows {
    pub aa: Row9,
    pub ab: Row9,
    pub ba: Row9,
    pub bb: Row9,
    pub force_a: Row3,
    pub force_b: Row3,
}

/// How far a backward sweep moved its pieces.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MoveRows {
    /// Square of the longest move.
    pub longest: Row,
    /// Greatest difference between the pull solved for and the tension there, where a segment stays taut or slack.
    pub gap: Row,
    pub turned: Row,
    /// Greatest tension of a segment that was assumed taut and is slack in the solution, or the reverse.
    pub flipped: Row,
    /// Greatest tension.
    pub greatest: Row,
    /// Zero, or not a number where a move was not finite.
    pub finite: Row,
}

impl Default for SegmentRow {
    fn default() -> Self {
        let none = Row::default();
        Self {
            length: Row([1.0; LANES]),
            inverse_length: Row([1.0; LANES]),
            ea: none,
            ea2: none,
            damping: none,
            bending: none,
            tension: none,
        }
    }
}

impl GroundRow {
    /// Writes a force and the symmetric part of its block into one lane.
    #[inline]
    pub(crate) fn set(&mut self, lane: usize, (force, block): (DVec3, DMat3)) {
        self.force.set(lane, force);
        let [x, y, z] = [block.x_axis, block.y_axis, block.z_axis];
        let half = [x.x, 0.5 * (x.y + y.x), 0.5 * (x.z + z.x), y.y, 0.5 * (y.z + z.y), z.z];
        for (row, value) in self.block.0.iter_mut().zip(half) {
            row.0[lane] = value;
        }
    }
}
