//! Right-hand sides of a factored system: one column or three at once.

use std::ops::{AddAssign, Sub, SubAssign};

use glam::{DMat3, DVec3};

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
