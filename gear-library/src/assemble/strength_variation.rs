//! Strength drawn at random: one draw for each line and weak link, from the run's seed and the part's id.
//!
//! `factor = 1 + c z`, with `c` the coefficient of variation and `z` standard normal by Box and Muller from two uniform
//! numbers that BLAKE3 makes of seed, id and attempt. A draw hangs on nothing else: a part added or taken away does
//! not change the others'. A factor below [`LEAST`] is drawn again.
//! Reference: Box and Muller 1958 (doi:10.1214/aoms/1177706645).

use std::f64::consts::PI;

/// Least share of its named strength that a part is drawn with.
const LEAST: f64 = 0.2;

/// The factor on the strength of a part, with mean 1 and this coefficient of variation (at most 0.5).
pub(super) fn factor(seed: u64, id: &str, variation: f64) -> f64 {
    if variation <= 0.0 {
        return 1.0;
    }
    (0..)
        .map(|attempt: u64| 1.0 + variation * normal(seed, id, attempt))
        .find(|factor| *factor >= LEAST)
        .unwrap_or(1.0)
}

/// A standard normal number.
fn normal(seed: u64, id: &str, attempt: u64) -> f64 {
    let mut hasher = blake3::Hasher::new_derive_key("endline strength scatter 1");
    hasher.update(&seed.to_le_bytes()).update(&attempt.to_le_bytes()).update(id.as_bytes());
    let bytes = hasher.finalize();
    let whole = |from: usize| {
        bytes.as_bytes()[from..from + 8].iter().fold(0_u64, |sum, byte| sum << 8 | u64::from(*byte))
    };
    // 53 bits, shifted by half so that zero is never drawn.
    let uniform = |from: usize| ((whole(from) >> 11) as f64 + 0.5) / (1_u64 << 53) as f64;
    (-2.0 * libm::log(uniform(0))).sqrt() * libm::cos(2.0 * PI * uniform(8))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_variation_over_seeds_and_over_ids_are_those_named() {
        let by_seed: Vec<f64> = (0..4000).map(|seed| factor(seed, "endline-top", 0.12)).collect();
        let by_id: Vec<f64> =
            (0..4000).map(|number| factor(7, &format!("groundline-{number}"), 0.12)).collect();
        for drawn in [by_seed, by_id] {
            let mean = drawn.iter().sum::<f64>() / 4000.0;
            let variance =
                drawn.iter().map(|factor| (factor - mean) * (factor - mean)).sum::<f64>() / 3999.0;
            // Standard errors: 0.12/√4000 = 0.0019 of the mean, 0.12/√8000 = 0.0013 of the deviation.
            assert!((mean - 1.0).abs() < 0.006, "{mean}");
            assert!((variance.sqrt() - 0.12).abs() < 0.005, "{}", variance.sqrt());
        }
    }

    #[test]
    fn a_draw_is_the_same_each_time_and_hangs_on_seed_and_id() {
        assert_eq!(factor(3, "a", 0.1).to_bits(), factor(3, "a", 0.1).to_bits());
        assert!((factor(3, "a", 0.1) - factor(4, "a", 0.1)).abs() > 1e-9);
        assert!((factor(3, "a", 0.1) - factor(3, "b", 0.1)).abs() > 1e-9);
        assert_eq!(factor(3, "a", 0.0).to_bits(), 1.0_f64.to_bits());
    }
}
