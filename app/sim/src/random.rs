//! Numbers drawn from a seed.
//!
//! SplitMix64: Steele, Lea and Flood 2014 (doi:10.1145/2660193.2660195).

/// A number from 0 to 1 that a seed and an index draw (SplitMix64).
pub(crate) fn unit(seed: u64, index: u64) -> f64 {
    let mut mixed = seed.wrapping_add((index + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}
