//! The normal force of skin and blubber on a body that is pressed into them.
//!
//! A ball of radius `R` pressed by `δ` into an incompressible half space of modulus `E` (Hertz 1881; Johnson 1985, Contact Mechanics,
//! section 4.2), stiffened exponentially as the core approaches, like the normal force on rope (`law/barrier.rs`):
//!
//! ```text
//! N = (16/9) E √R δ^(3/2) e^(b δ/D)        dN/dδ = N (3/(2δ) + b/D)        D = 3/4 R
//! ```
//!
//! `E` is the modulus of skin under rope, `R` the body's contact distance: the radius of a ball or a buoy, the rounding of a
//! trap's edges. Triangles of one patch of skin share the force (`law/patch_shares.rs`).

/// `b`, by which skin stiffens, as under rope: a trap of 60 kg that is struck at 20 m/s is thrown off before its core is reached.
const STIFFENING: f64 = 10.0;
/// `D` as a share of the contact distance.
const ROOM_SHARE: f64 = 0.75;
/// `16/9`, of which `4/3` is Hertz's and `4/3 = 1/(1 - ν²)` that of an incompressible solid.
const HERTZ: f64 = 16.0 / 9.0;

/// Normal force [N] and its derivative by depth [N/m] at a depth in skin of a modulus [Pa].
pub(crate) fn push(depth: f64, reach: f64, modulus: f64) -> [f64; 2] {
    if depth <= 0.0 {
        return [0.0; 2];
    }
    let rate = STIFFENING / (ROOM_SHARE * reach);
    let push = HERTZ * modulus * libm::sqrt(reach * depth) * depth * libm::exp(rate * depth);
    [push, push * (1.5 / depth + rate)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_hertz_at_first_and_its_growth_is_the_derivative() {
        let (reach, modulus) = (0.15, 4e5);
        let [shallow, _] = push(1e-4, reach, modulus);
        let hertz = 4.0 / 3.0 * modulus / 0.75 * libm::sqrt(reach) * libm::pow(1e-4, 1.5);
        assert!((shallow / hertz - 1.0).abs() < 1e-2, "{shallow} {hertz}");
        for depth in [1e-4, 0.01, 0.08] {
            let by = |change: f64| push(depth + change, reach, modulus)[0];
            let growth = (by(1e-8) - by(-1e-8)) / 2e-8;
            assert!((growth / push(depth, reach, modulus)[1] - 1.0).abs() < 1e-5, "{depth}");
        }
        assert!(push(0.0, reach, modulus).iter().all(|value| value.to_bits() == 0));
    }
}
