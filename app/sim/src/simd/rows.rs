//! Numbers, vectors and matrices in rows of eight lanes, and the part of a row that the registers of the processor hold.

use glam::{DMat3, DVec3};
use pulp::Simd;

use crate::simd::real::Lane;
use crate::simd::space::{Mat3, Sym3, Vec3};

/// Lanes of a row.
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
