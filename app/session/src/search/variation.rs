//! Variations of elites, as a map of elites is filled: an elite with one of its choices exchanged and the rest a little off.
//!
//! Local searches keep acts and other choices; variations carry what is near to other acts.
//! Reference: Mouret and Clune 2015, Illuminating search spaces by mapping elites (arXiv 1504.04909).

use crate::encounters::draw;

use super::elites::Elite;

/// What is continuous is off by up to this share of its law.
const OFF: f64 = 0.08;

/// Variation `number` of an elite, of which `free` are the continuous dimensions.
pub(super) fn variation(elite: &Elite, free: &[usize], seed: u64, number: u32) -> Vec<f64> {
    let mut point = elite.point.clone();
    let chances = draw::sobol_point(seed ^ 0x5851_f42d_4c95_7f2d, number, point.len() + 1);
    for dimension in free {
        let off = OFF * (2.0 * chances[*dimension] - 1.0);
        point[*dimension] = (point[*dimension] + off).clamp(0.0, 1.0);
    }
    let choices: Vec<usize> =
        (0..point.len()).filter(|dimension| !free.contains(dimension)).collect();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a place in a short list"
    )]
    let place = (chances[elite.point.len()] * choices.len() as f64) as usize;
    if let Some(choice) = choices.get(place) {
        point[*choice] = chances[*choice];
    }
    point
}
