//! Segments of rope that was moved aside get their lengths back.
//!
//! Newton's method on what each segment is too long, with the least move of nodes in each step: with `C` those lengths and `J` their derivatives
//! by the places of nodes, `x ← x - Jᵀ (J Jᵀ)⁻¹ C`. `J Jᵀ` has three diagonals.
//! Reference: Goldenthal et al. 2007, Efficient simulation of inextensible cloth (doi:10.1145/1276377.1276438).

use glam::DVec3;

/// Newton steps that give segments their lengths again: each squares what is left.
const PROJECTIONS: usize = 6;
/// Added to the diagonal of `J Jᵀ` [1].
const SINGULAR: f64 = 1e-9;

/// Gives the segments of a chain the lengths wanted, as near as so many steps come; nodes that may not move stay.
pub(super) fn restore(wanted_m: &[f64], may_move: &[bool], places: &mut [DVec3]) {
    for _ in 0..PROJECTIONS {
        project(wanted_m, may_move, places);
    }
}

/// One step.
fn project(wanted_m: &[f64], may_move: &[bool], places: &mut [DVec3]) {
    let count = wanted_m.len();
    let free = |node: usize| f64::from(u8::from(may_move[node]));
    let along: Vec<DVec3> =
        (0..count).map(|index| (places[index + 1] - places[index]).normalize_or_zero()).collect();
    let excess = |index: usize| places[index].distance(places[index + 1]) - wanted_m[index];
    // Forward elimination; a straight chain between two ends that stay is singular but for the small share.
    let (mut above, mut right) = (vec![0.0; count], vec![0.0; count]);
    for index in 0..count {
        let beside = |index: usize| -along[index].dot(along[index - 1]) * free(index);
        let mut diagonal = free(index) + free(index + 1) + SINGULAR;
        right[index] = excess(index);
        if index > 0 {
            let below = beside(index);
            diagonal -= below * above[index - 1];
            right[index] -= below * right[index - 1];
        }
        right[index] /= diagonal;
        above[index] = if index + 1 < count { beside(index + 1) / diagonal } else { 0.0 };
    }
    for index in (0..count.saturating_sub(1)).rev() {
        right[index] -= above[index] * right[index + 1];
    }
    for (index, multiplier) in right.iter().enumerate() {
        places[index] += free(index) * *multiplier * along[index];
        places[index + 1] -= free(index + 1) * *multiplier * along[index];
    }
}
