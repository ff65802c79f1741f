//! How touches of one patch share the push.
//!
//! Of the push that each had alone, a touch has the share
//!
//! ```text
//! w_i = δ_i² / Σ_j κ_ij δ_j²        κ_ij = max(0, n_i·n_j) max(0, 1 - |p_i - p_j|/ℓ_i)
//! ```
//!
//! with depths `δ`, places `p`, normals `n` and the width `ℓ = 2 √(2 h δ)` of the patch that a round body of radius `h` covers. Facets of one
//! flat face push together as one does, within some hundredths, wherever a body stands on them; two walls of a gap each push in full.

use glam::DVec3;

/// A touch as others of the same patch see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Press {
    pub place: DVec3,
    pub normal: DVec3,
    pub depth: f64,
}

/// Share of the push that a touch has beside all touches of the two things, itself included.
pub(crate) fn share(touch: Press, all: impl Iterator<Item = Press>, reach: f64) -> f64 {
    let width = 2.0 * libm::sqrt(2.0 * reach * touch.depth.max(0.0));
    let beside = all.map(|other| {
        let alike = touch.normal.dot(other.normal).max(0.0);
        let apart = touch.place.distance(other.place);
        alike * (1.0 - apart / width).max(0.0) * other.depth * other.depth
    });
    touch.depth * touch.depth / beside.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball pressed into a plane that is cut in two at a distance from its middle: the push of both halves against that of the plane.
    #[test]
    fn two_facets_of_a_plane_push_as_one() {
        let (reach, depth) = (0.15, 0.01);
        let edge = libm::sqrt(2.0 * reach * depth);
        for at in [0.0, 0.2, 0.5, 0.8, 1.0] {
            let press = |x: f64| Press {
                place: DVec3::X * x,
                normal: DVec3::Z,
                depth: depth * (1.0 - (x / edge) * (x / edge)),
            };
            let both = [press(0.0), press(at * edge)];
            let push = |press: &Press| {
                libm::pow(press.depth, 1.5) * share(*press, both.iter().copied(), reach)
            };
            let together: f64 = both.iter().filter(|press| press.depth > 0.0).map(push).sum();
            assert!((together / libm::pow(depth, 1.5) - 1.0).abs() < 0.05, "{at}: {together}");
        }
    }
}
