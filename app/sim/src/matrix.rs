//! Small matrices.

use glam::{DMat3, DVec3};

/// The matrix `v wᵀ`.
pub(crate) fn outer(one: DVec3, other: DVec3) -> DMat3 {
    DMat3::from_cols(one * other.x, one * other.y, one * other.z)
}

/// The projection `1 - n nᵀ` on the plane across a unit normal.
pub(crate) fn plane_across(normal: DVec3) -> DMat3 {
    DMat3::IDENTITY - outer(normal, normal)
}

/// The matrix of `arm ×`.
pub(crate) fn cross_matrix(arm: DVec3) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(0.0, arm.z, -arm.y),
        DVec3::new(-arm.z, 0.0, arm.x),
        DVec3::new(arm.y, -arm.x, 0.0),
    )
}

/// The product `[arm ×] m`: the cross product with each column.
///
/// This product and the next omit the terms that are zero; they differ from those with [`cross_matrix`] at most in the sign of a zero,
/// which a sum that starts at zero does not keep.
#[inline]
pub(crate) fn cross_times(arm: DVec3, m: &DMat3) -> DMat3 {
    DMat3::from_cols(arm.cross(m.x_axis), arm.cross(m.y_axis), arm.cross(m.z_axis))
}

/// The product `m [arm ×]`.
#[inline]
pub(crate) fn times_cross(m: &DMat3, arm: DVec3) -> DMat3 {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = *m;
    DMat3::from_cols(y * arm.z - z * arm.y, z * arm.x - x * arm.z, x * arm.y - y * arm.x)
}

/// The matrix `A D Aᵀ` of a rotation `A` and a diagonal `D`.
#[inline]
pub(crate) fn turned(axes: &DMat3, diagonal: DVec3) -> DMat3 {
    axes.mul_diagonal_scale(diagonal) * axes.transpose()
}
