//! Small matrices.

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
