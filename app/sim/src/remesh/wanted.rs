//! The length every segment should have.
//!
//! Within [`NEAR_M`] of skin it is the near length, within [`EDGE_M`] of a thin edge the edge length; beyond, it grows by
//! [`GRADE`] for each metre of distance, up to the far length.
//! With a grade of at most one, neighbours that have the wanted length differ by a factor of two at most.

use super::RemeshWorkspace;
use crate::model::{Model, Resolution};
use crate::state::State;
use crate::whale::{Bounds, pose};

/// Distance from skin within which rope has the near length [m]: more than a whale in burst swims between two looks.
pub(super) const NEAR_M: f64 = 0.3;
/// Distance from a thin edge within which rope has the edge length [m].
pub(super) const EDGE_M: f64 = 0.2;
/// Growth of the wanted length with distance [m/m].
const GRADE: f64 = 0.3;

/// Length wanted at a distance from skin [m].
fn size(resolution: &Resolution, gap_m: f64, thin: bool) -> f64 {
    let at =
        |least: f64, within: f64| (least + GRADE * (gap_m - within).max(0.0)).min(resolution.far_m);
    let near = at(resolution.near_m, NEAR_M);
    if thin { near.min(at(resolution.edge_m, EDGE_M)) } else { near }
}

/// Distance from skin that a wanted length implies [m].
pub(super) fn is_far(resolution: &Resolution, wanted_m: f64) -> bool {
    wanted_m > resolution.near_m
}

/// Marks the segments that touch skin, and those near rope that they may touch: they stay as they are.
pub(super) fn grip(model: &Model, state: &State, work: &mut RemeshWorkspace) {
    work.gripped.fill(false);
    for site in &state.rope.friction.sites {
        work.gripped[crate::contact::rope_on_skin::stored_faces::segment_of(*site)] = true;
    }
    // A merge moves rope, and rope near it would be crossed.
    let rope = &state.rope;
    work.pieces.measure(&rope.position, |node| rope.position[node], &rope.segment_length);
    work.ropes.gather(model, state, &work.pieces, 0.0);
    for pair in &work.ropes.pairs {
        pair.segments.iter().for_each(|segment| work.gripped[*segment] = true);
    }
}

/// Measures the wanted length of every segment.
pub(super) fn measure(
    model: &Model,
    state: &State,
    resolution: &Resolution,
    work: &mut RemeshWorkspace,
) {
    work.wanted.fill(resolution.far_m);
    let (Some(whale), Some(now)) = (&model.spec.whale, &state.whale) else { return };
    pose(&whale.skin, now.position, now.orientation, &now.posture, &mut work.bones);
    work.approach.begin();
    for (nodes, segments) in model.line_nodes.iter().zip(&model.line_segments) {
        for (node, segment) in (nodes.start..).zip(segments.clone()) {
            let place = Bounds::around(&[state.rope.position[node], state.rope.position[node + 1]]);
            work.wanted[segment] =
                work.approach.least(&work.bones, &place, resolution.far_m, |gap_m, thin| {
                    size(resolution, gap_m, thin)
                });
        }
    }
}
