//! Nodes moved outward until every segment of a laid line is clear of the skin.
//!
//! Between two nodes rope is straight and cuts a bend short by up to `l^2/8R`. At a fin's edge that is
//! more than the rope's distance from the skin. A segment that is too near moves its nodes along the
//! direction from skin to rope. A segment that cuts through an edge moves them to the outside of the
//! rope's own bend: away from the middle between their neighbours.

use endline_sim::DVec3;

use super::cut::Laid;
use super::skin::PosedSkin;

/// Most rounds.
const MOST_ROUNDS: usize = 200;
/// Share of the wanted distance that is near enough.
const ENOUGH: f64 = 0.98;
/// Move of a node whose segment cuts through an edge [m].
const OUT_OF_SKIN_M: f64 = 1e-3;
/// Bend of the way at a node below which it goes straight through [m].
const STRAIGHT_M: f64 = 1e-5;

/// Moves nodes, ends apart; with the name of the region where rope still is too near or goes through.
pub(super) fn clear(skin: &mut PosedSkin, laid: &mut Laid) -> Result<(), &'static str> {
    for _ in 0..MOST_ROUNDS {
        let nearest = skin.nearest(&laid.nodes);
        let mut moves = vec![(DVec3::ZERO, 0.0_f64); laid.nodes.len()];
        for (segment, near) in nearest.iter().enumerate() {
            let Some(near) = near.as_ref().filter(|near| near.distance_m < ENOUGH * skin.off_m)
            else {
                continue;
            };
            for (node, share) in [(segment, 1.0 - near.fraction), (segment + 1, near.fraction)] {
                let weight = share.max(0.25);
                let shift = if near.out == DVec3::ZERO {
                    outward(&laid.nodes, node)
                } else {
                    near.out * (skin.off_m - near.distance_m)
                };
                moves[node].0 += shift * weight;
                moves[node].1 += weight;
            }
            let stuck = |node: usize| moves[node].0.length() <= 0.0;
            if near.out == DVec3::ZERO && stuck(segment) && stuck(segment + 1) {
                return Err(near.region.name());
            }
        }
        let last = laid.nodes.len() - 1;
        (moves[0], moves[last]) = ((DVec3::ZERO, 0.0), (DVec3::ZERO, 0.0));
        if moves.iter().all(|(_, weight)| *weight <= 0.0) {
            return Ok(());
        }
        for (node, (shift, weight)) in laid.nodes.iter_mut().zip(&moves) {
            if *weight > 0.0 {
                *node += *shift / *weight;
            }
        }
    }
    let nearest = skin.nearest(&laid.nodes);
    let still = nearest.iter().flatten().find(|near| near.distance_m < 0.5 * skin.off_m);
    still.map_or(Ok(()), |near| Err(near.region.name()))
}

/// A small move of a node the way the rope bends there; none at an end or where it is straight.
fn outward(nodes: &[DVec3], node: usize) -> DVec3 {
    let (Some(before), Some(after)) =
        (node.checked_sub(1).and_then(|before| nodes.get(before)), nodes.get(node + 1))
    else {
        return DVec3::ZERO;
    };
    let bend = nodes[node] - before.midpoint(*after);
    if bend.length() > STRAIGHT_M { bend.normalize() * OUT_OF_SKIN_M } else { DVec3::ZERO }
}
