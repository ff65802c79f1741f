//! Friction of rope that is made of straight segments.
//!
//! With `D` the angle by which rope turns at each node, `g` the place on its segments where skin presses, as a share of their length, and
//! `μ` the coefficient of friction, the tension on either side of a node has `ln(T₂/T₁) = μ D (1 + D²/12 - g (1-g) D²)` to third order, where
//! smooth rope has `μ D` (the capstan law): skin presses across a segment, hence a little ahead of one node and a little back at the
//! other, and it presses more where the tension is greater. Pressed at the middle of its segments, rope has `ln(T₂/T₁) = μ sin D` at any angle,
//! to first order in `μ`. The coefficient is therefore taken
//!
//! ```text
//! 1 + (g (1-g) - 1/12) B        B = 6 (D / sin D - 1) = D² + ...
//! ```
//!
//! times. Measured: `cargo bench -p endline-sim --bench capstan`, docs/lab-notebook.md.

use glam::DVec3;

use crate::model::Model;

/// Greatest `1 - cos D` of a turn that is corrected for, a right angle; rope that turns more follows nothing that it touches.
const MOST_TURN: f64 = 1.0;

/// Factor on the coefficient of friction of a segment that is pressed at a share of its length, with its [`bend`].
pub(crate) fn friction_factor(bend: f64, fraction: f64) -> f64 {
    1.0 + (fraction * (1.0 - fraction) - 1.0 / 12.0) * bend
}

/// Mean of `B` at the two ends of a segment.
pub(crate) fn bend(model: &Model, places: &[DVec3], segment: usize, node: usize) -> f64 {
    let nodes = &model.line_nodes[model.segment_line[segment]];
    let along = |from: usize| (places[from + 1] - places[from]).normalize_or_zero();
    let here = along(node);
    let at = |from: usize| bend_of(1.0 - here.dot(along(from)));
    let before = if node > nodes.start { at(node - 1) } else { 0.0 };
    let after = if node + 2 < nodes.end { at(node + 1) } else { 0.0 };
    0.5 * (before + after)
}

/// `B` of a turn by `D`, from `x = 1 - cos D`: `D / sin D = Σ aₙ xⁿ` with `aₙ₊₁/aₙ = (n + 1)/(2n + 3)`.
fn bend_of(x: f64) -> f64 {
    let x = x.min(MOST_TURN);
    x * (2.0 + x * (0.8 + x * (12.0 / 35.0 + x * (48.0 / 315.0 + x * (48.0 / 693.0)))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bend_is_that_of_the_sine() {
        for degrees in [1.0_f64, 20.0, 45.0, 79.0] {
            let turn = degrees.to_radians();
            let exact = 6.0 * (turn / libm::sin(turn) - 1.0);
            let series = bend_of(1.0 - libm::cos(turn));
            assert!((series / exact - 1.0).abs() < 0.03, "{degrees}: {series}, {exact}");
        }
    }
}
