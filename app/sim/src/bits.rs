//! Bit-exact helpers: comparison of lists, random numbers from a seed, and copies without allocation.
//!
//! Random numbers: SplitMix64, Steele, Lea and Flood 2014 (doi:10.1145/2660193.2660195).

use glam::DVec3;

/// Whether two lists are equal to the bit.
///
/// Compares all numbers without a branch, so that the compiler vectorises the loop: most lists compared are equal, and `==`
/// branches after each number.
pub(crate) fn same_bits(one: &[f64], other: &[f64]) -> bool {
    let differences = one.iter().zip(other).map(|(a, b)| a.to_bits() ^ b.to_bits());
    one.len() == other.len() && differences.fold(0, |all, one| all | one) == 0
}

/// Whether two lists of vectors are equal to the bit.
pub(crate) fn same_vectors(one: &[DVec3], other: &[DVec3]) -> bool {
    let bits = |a: f64, b: f64| a.to_bits() ^ b.to_bits();
    let differences =
        one.iter().zip(other).map(|(a, b)| bits(a.x, b.x) | bits(a.y, b.y) | bits(a.z, b.z));
    one.len() == other.len() && differences.fold(0, |all, one| all | one) == 0
}

/// Whether all vectors are positive zeros.
pub(crate) fn are_zero(vectors: &[DVec3]) -> bool {
    let bits =
        vectors.iter().map(|vector| vector.x.to_bits() | vector.y.to_bits() | vector.z.to_bits());
    bits.fold(0, |all, one| all | one) == 0
}

/// Random number in [0, 1) from a seed and an index (SplitMix64).
pub(crate) fn unit(seed: u64, index: u64) -> f64 {
    let mut mixed = seed.wrapping_add((index + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Implements `Clone` field by field; `clone_from` reuses the memory of each field, which the derived one does not.
///
/// The compiler reports a missing field.
macro_rules! clone_in_place {
    ($type:ident { $($field:ident),* $(,)? }) => {
        impl Clone for $type {
            fn clone(&self) -> Self {
                Self { $($field: self.$field.clone()),* }
            }
            fn clone_from(&mut self, source: &Self) {
                $(self.$field.clone_from(&source.$field);)*
            }
        }
    };
}

pub(crate) use clone_in_place;
