//! Geometry that knows no model of gear: distances, swept paths, exact crossing tests, and shapes.

pub(crate) mod along;
pub(crate) mod core;
pub mod crossing;
pub mod distance;
pub(crate) mod ellipse;
pub(crate) mod placed;
pub(crate) mod segment_pair;
pub mod shape;
pub mod sweep;

use glam::{DQuat, DVec3};

/// Place and orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pub place: DVec3,
    pub orientation: DQuat,
}

impl Pose {
    /// A place of the world in this frame.
    pub fn inward(&self, place: DVec3) -> DVec3 {
        self.orientation.inverse() * (place - self.place)
    }

    /// The pose with this orientation at another place of this frame.
    pub fn about(&self, place: DVec3) -> Self {
        Self { place: self.outward(place), ..*self }
    }

    /// A place of this frame in the world.
    pub fn outward(&self, place: DVec3) -> DVec3 {
        self.place + self.orientation * place
    }
}

/// Lengths and unit vectors for loops that are compiled for vector instructions.
///
/// glam takes a square root by libm, which does so by an assembler instruction in the encoding of SSE. Between AVX instructions that
/// costs some hundred cycles on Intel processors, because each change of the encoding waits for the upper halves of the registers
/// (Intel 64 and IA-32 Architectures Optimization Reference Manual, "Mixing AVX code with SSE code").
/// The compiler encodes `f64::sqrt` as the code around it. The functions have the bits of glam's methods of the same names.
pub(crate) mod norm {
    use glam::DVec3;

    /// Length of a vector.
    #[inline(always)]
    pub(crate) fn length(of: DVec3) -> f64 {
        of.length_squared().sqrt()
    }

    /// Distance of two places.
    #[inline(always)]
    pub(crate) fn distance(from: DVec3, to: DVec3) -> f64 {
        length(from - to)
    }

    /// Unit vector in the direction of a vector; `None` if it is zero or so short that its inverse length is not finite.
    #[inline(always)]
    pub(crate) fn try_normalize(of: DVec3) -> Option<DVec3> {
        let inverse = 1.0 / length(of);
        (inverse.is_finite() && inverse > 0.0).then(|| of * inverse)
    }

    /// Unit vector in the direction of a vector, or `instead` if there is none.
    #[inline(always)]
    pub(crate) fn normalize_or(of: DVec3, instead: DVec3) -> DVec3 {
        try_normalize(of).unwrap_or(instead)
    }
}

#[cfg(test)]
mod tests {
    use super::norm::*;
    use super::*;

    #[test]
    fn bits_are_those_of_glam() {
        let number = |index: u64| crate::bits::unit(7, index) - 0.5;
        let drawn = (0..1000_u64).map(|index| {
            let scale = libm::pow(10.0, 24.0 * number(4 * index + 3));
            DVec3::new(number(4 * index), number(4 * index + 1), number(4 * index + 2)) * scale
        });
        let edges = [DVec3::ZERO, DVec3::splat(1e-320), DVec3::splat(1e300), DVec3::NAN];
        for vector in drawn.chain(edges) {
            let (place, other) = (DVec3::new(0.1, -0.2, 0.3), DVec3::X);
            let bits = |vector: DVec3| vector.to_array().map(f64::to_bits);
            assert_eq!(length(vector).to_bits(), vector.length().to_bits(), "{vector}");
            assert_eq!(
                distance(vector, place).to_bits(),
                vector.distance(place).to_bits(),
                "{vector}"
            );
            assert_eq!(
                try_normalize(vector).map(bits),
                vector.try_normalize().map(bits),
                "{vector}"
            );
            assert_eq!(
                bits(normalize_or(vector, other)),
                bits(vector.normalize_or(other)),
                "{vector}"
            );
        }
    }
}
