//! Small matrices, and right-hand sides of a factored system: one column or three at once.

use std::ops::{AddAssign, Sub, SubAssign};

use glam::{DMat3, DVec3};

/// The matrix `v wᵀ`.
pub(crate) fn outer(one: DVec3, other: DVec3) -> DMat3 {
    DMat3::from_cols(one * other.x, one * other.y, one * other.z)
}

/// The matrix of `arm ×`.
pub(crate) fn cross_matrix(arm: DVec3) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(0.0, arm.z, -arm.y),
        DVec3::new(-arm.z, 0.0, arm.x),
        DVec3::new(arm.y, -arm.x, 0.0),
    )
}

/// Right-hand sides that a factored system can be solved for again: one column or three.
pub(crate) trait Columns: Copy + AddAssign + SubAssign + Sub<Output = Self> {
    const ZERO: Self;
    fn by(self, matrix: DMat3) -> Self;
}

impl Columns for DVec3 {
    const ZERO: Self = Self::ZERO;
    fn by(self, matrix: DMat3) -> Self {
        matrix * self
    }
}

impl Columns for DMat3 {
    const ZERO: Self = Self::ZERO;
    fn by(self, matrix: DMat3) -> Self {
        matrix * self
    }
}
