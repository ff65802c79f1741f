//! Friction of rope that is made of straight segments.
//!
//! With `D` the angle by which rope turns at each node, `g` the place on its segments where skin presses, as a share of their length, and
//! `μ` the coefficient of friction, the tension on either side of a node has `ln(T₂/T₁) = μ D (1 + D²/12 - g (1-g) D²)` to third order, where
//! smooth rope has `μ D` (the capstan law): skin presses across a segment, hence a little ahead of one node and a little back at the
//! other, and it presses more where the tension is greater. The coefficient is therefore taken `1 + (g (1-g) - 1/12) D²` times.
//! Measured: `cargo bench -p endline-sim --bench capstan`, docs/lab-notebook.md.

use glam::DVec3;

use crate::model::Model;

/// Greatest square of a turn that is corrected for; rope that turns more follows nothing that it touches [rad²].
const MOST_TURN: f64 = 1.0;

/// What the coefficient of friction is multiplied by where a segment is pressed at a share of its length.
pub(crate) fn friction_factor(
    model: &Model,
    places: &[DVec3],
    (segment, node): (usize, usize),
    fraction: f64,
) -> f64 {
    let turn = squared_turn(model, places, segment, node).min(MOST_TURN);
    1.0 + (fraction * (1.0 - fraction) - 1.0 / 12.0) * turn
}

/// Mean square of the angles by which rope turns at the two ends of a segment [rad²].
fn squared_turn(model: &Model, places: &[DVec3], segment: usize, node: usize) -> f64 {
    let nodes = &model.line_nodes[model.segment_line[segment]];
    let along = |from: usize| (places[from + 1] - places[from]).normalize_or_zero();
    let here = along(node);
    let turn = |from: usize| 2.0 * (1.0 - here.dot(along(from)));
    let before = if node > nodes.start { turn(node - 1) } else { 0.0 };
    let after = if node + 2 < nodes.end { turn(node + 1) } else { 0.0 };
    0.5 * (before + after)
}
