//! Inputs and outputs of the sweeps, node by node, in rows of eight lanes.
//!
//! A lane holds a *piece* of rope: consecutive nodes of one line. Row `k` holds node `k` of every piece, and segment
//! `k` behind it. Pieces of unlike length share a group: rows beyond a piece's end hold copies of its last node.

use glam::{DMat3, DVec3};
use pulp::Simd;

use crate::system::lanes::real::Lane;
use crate::system::lanes::space::{Mat3, Sym3, Vec3};

/// Lanes of a group.
pub(crate) const LANES: usize = 8;

/// One number a lane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(64))]
pub(crate) struct Row(pub [f64; LANES]);

/// One vector a lane.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Row3(pub [Row; 3]);

/// One symmetric matrix a lane.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Row6(pub [Row; 6]);

/// One matrix a lane, by columns.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Row9(pub [Row3; 3]);

/// A part of a row's lanes, as many as the processor's registers hold.
#[derive(Clone, Copy)]
pub(crate) struct Part<S: Simd> {
    pub simd: S,
    pub part: usize,
}

impl<S: Simd> Part<S> {
    /// Parts a row has.
    pub const COUNT: usize = LANES / S::F64_LANES;

    #[inline(always)]
    pub fn get(self, row: &Row) -> Lane<S> {
        Lane { simd: self.simd, value: S::as_simd_f64s(&row.0).0[self.part] }
    }
    #[inline(always)]
    pub fn put(self, row: &mut Row, lane: Lane<S>) {
        S::as_mut_simd_f64s(&mut row.0).0[self.part] = lane.value;
    }
    #[inline(always)]
    pub fn get3(self, row: &Row3) -> Vec3<Lane<S>> {
        Vec3 { x: self.get(&row.0[0]), y: self.get(&row.0[1]), z: self.get(&row.0[2]) }
    }
    #[inline(always)]
    pub fn put3(self, row: &mut Row3, v: Vec3<Lane<S>>) {
        self.put(&mut row.0[0], v.x);
        self.put(&mut row.0[1], v.y);
        self.put(&mut row.0[2], v.z);
    }
    #[inline(always)]
    pub fn get6(self, row: &Row6) -> Sym3<Lane<S>> {
        let [xx, xy, xz, yy, yz, zz] = &row.0;
        Sym3 {
            xx: self.get(xx),
            xy: self.get(xy),
            xz: self.get(xz),
            yy: self.get(yy),
            yz: self.get(yz),
            zz: self.get(zz),
        }
    }
    #[inline(always)]
    pub fn get9(self, row: &Row9) -> Mat3<Lane<S>> {
        Mat3 { x: self.get3(&row.0[0]), y: self.get3(&row.0[1]), z: self.get3(&row.0[2]) }
    }
    #[inline(always)]
    pub fn put9(self, row: &mut Row9, m: Mat3<Lane<S>>) {
        self.put3(&mut row.0[0], m.x);
        self.put3(&mut row.0[1], m.y);
        self.put3(&mut row.0[2], m.z);
    }
}

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

impl Row3 {
    /// Writes a vector into one lane.
    #[inline]
    pub(crate) fn set(&mut self, lane: usize, v: DVec3) {
        for (row, value) in self.0.iter_mut().zip(v.to_array()) {
            row.0[lane] = value;
        }
    }
    /// Adds a vector in one lane.
    #[inline]
    pub(crate) fn add(&mut self, lane: usize, v: DVec3) {
        for (row, value) in self.0.iter_mut().zip(v.to_array()) {
            row.0[lane] += value;
        }
    }
    /// The vector of one lane.
    #[inline]
    pub(crate) fn vector(&self, lane: usize) -> DVec3 {
        DVec3::from_array([self.0[0].0[lane], self.0[1].0[lane], self.0[2].0[lane]])
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

impl Row9 {
    /// Adds a matrix in one lane.
    #[inline]
    pub(crate) fn add(&mut self, lane: usize, m: &DMat3) {
        for (column, value) in self.0.iter_mut().zip([m.x_axis, m.y_axis, m.z_axis]) {
            column.add(lane, value);
        }
    }
    /// The matrix of one lane.
    #[inline]
    pub(crate) fn matrix(&self, lane: usize) -> DMat3 {
        DMat3::from_cols(self.0[0].vector(lane), self.0[1].vector(lane), self.0[2].vector(lane))
    }
}
