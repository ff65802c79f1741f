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

/// A touch, for the comparison with others of its patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Press {
    pub place: DVec3,
    pub normal: DVec3,
    pub depth: f64,
}

/// A touch that shares its push with others.
pub(crate) trait Shared {
    fn press(&self) -> Press;
    /// Number of the thing that presses: touches of one thing share.
    fn thing(&self) -> usize;
    /// Number by which it is known from pass to pass.
    fn number(&self) -> (usize, u64);
    fn share(&mut self) -> &mut f64;
}

/// Passes of a solver step in which shares follow the depths; then they stay.
const SHARING_PASSES: usize = 3;

/// Sets the share of each touch; `touched` are the touches of the iteration before, `reach` the contact distance of a thing.
pub(crate) fn share_out<T: Shared>(
    touches: &mut [T],
    touched: &mut [T],
    pass: usize,
    reach: impl Fn(usize) -> f64,
) {
    for place in 0..touches.len() {
        let (number, thing) = (touches[place].number(), touches[place].thing());
        let before = touched.iter_mut().find(|before| before.number() == number);
        let share = match before.filter(|_| pass >= SHARING_PASSES) {
            Some(before) => *before.share(),
            None => {
                let mine = touches.iter().filter(|other| other.thing() == thing);
                share(touches[place].press(), mine.map(Shared::press), reach(thing))
            }
        };
        *touches[place].share() = share;
    }
}

/// Share of the push that a touch has beside all touches of the two things, itself included.
fn share(touch: Press, all: impl Iterator<Item = Press>, reach: f64) -> f64 {
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
