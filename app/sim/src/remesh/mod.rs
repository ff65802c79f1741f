//! Resolution where it matters: segments short near the whale, long far from it, as many as before.
//!
//! Every segment has a length it should have, by its distance from skin and from the thin edges of fins (`wanted`).
//! Where one is longer than that, it is split at its middle, and a pair of neighbours elsewhere in the same line that
//! loses less by it is merged (`criteria.rs`), so that the number of nodes, and with it the model's layout, stays (`split_merge.rs`).
//! Kept to rounding: unstretched length, mass, momentum of the rope's own mass. A split changes no elastic tension (damping
//! named as a ratio goes with the length), a merge no tension by more than 0.2 N or 0.5 %. Neighbours differ by a factor of
//! two at most. End segments (which carry links and knots), cut ones and those that touch skin stay as they are, and nothing
//! is merged near skin.
//!
//! It happens at the start of a step, from the state alone, at every [`EVERY_S`] of simulated time.
//! Sizes wanted: docs/physics.md, Resolution.

mod criteria;
mod split_merge;
mod wanted;

use crate::broad_phase::pieces::Pieces;
use crate::contact::rope_on_rope::near::RopeOnRope;
use crate::model::{Model, Resolution};
use crate::state::State;
use crate::whale::approach::Approach;
use criteria::{Line, best};
use wanted::{grip, measure};

#[cfg(test)]
mod tests;

/// Time between two looks at the lengths [s].
const EVERY_S: f64 = 0.05;
/// Most splits of one line at a time.
const MOST_SPLITS: usize = 64;

/// Scratch; it keeps nothing that a step depends on.
#[derive(Clone, Debug)]
pub(crate) struct RemeshWorkspace {
    approach: Approach,
    bones: Vec<glam::DAffine3>,
    /// Length each segment should have [m].
    wanted: Vec<f64>,
    /// Whether each segment touches skin, or is near rope that it may touch.
    gripped: Vec<bool>,
    pieces: Pieces,
    ropes: RopeOnRope,
}

impl RemeshWorkspace {
    /// Scratch for a model whose resolution follows its whale.
    pub fn new(model: &Model) -> Option<Self> {
        model.spec.settings.resolution?;
        let tree = model.skin_tree.clone()?;
        Some(Self {
            bones: Vec::with_capacity(tree.skin().bones.len()),
            approach: Approach::new(tree),
            wanted: vec![0.0; model.segment_count],
            gripped: vec![false; model.segment_count],
            pieces: Pieces::new(model),
            ropes: RopeOnRope::new(model),
        })
    }
}

/// What a look at the lengths of segments did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Remeshed {
    /// Segments split.
    pub splits: u64,
    /// Greatest ratio of a segment's length near the whale to the one wanted; `None` where no rope is near it.
    pub near_ratio: Option<f64>,
}

/// Moves resolution to where it is wanted, where it is time to look.
pub(crate) fn remesh(
    model: &Model,
    state: &mut State,
    work: &mut Option<RemeshWorkspace>,
) -> Remeshed {
    let (Some(work), Some(resolution)) = (work, &model.spec.settings.resolution) else {
        return Remeshed::default();
    };
    if !is_time(model, state) {
        return Remeshed::default();
    }
    measure(model, state, resolution, work);
    if !is_any_too_long(state, &work.wanted) {
        return Remeshed { splits: 0, near_ratio: near_ratio(state, &work.wanted, resolution) };
    }
    grip(model, state, work);
    let lines = 0..model.spec.lines.len();
    let splits = lines.map(|line| remesh_line(model, state, line, work, resolution)).sum();
    Remeshed { splits, near_ratio: near_ratio(state, &work.wanted, resolution) }
}

/// Whether a segment is longer than wanted, without which none is split and none merged.
fn is_any_too_long(state: &State, wanted: &[f64]) -> bool {
    state.rope.segment_length.iter().zip(wanted).any(|(length, wanted)| length > wanted)
}

/// Greatest ratio of length to wanted length of uncut rope near the whale.
fn near_ratio(state: &State, wanted: &[f64], resolution: &Resolution) -> Option<f64> {
    let segments = state.rope.segment_length.iter().zip(wanted).zip(&state.rope.cut);
    let near =
        segments.filter(|((_, wanted), cut)| !**cut && !wanted::is_far(resolution, **wanted));
    near.map(|((length, wanted), _)| length / wanted).reduce(f64::max)
}

/// Whether lengths are looked at before this step.
fn is_time(model: &Model, state: &State) -> bool {
    let steps = (EVERY_S / model.spec.settings.step_s).round().max(1.0) as u64;
    state.step.is_multiple_of(steps)
}

fn remesh_line(
    model: &Model,
    state: &mut State,
    line: usize,
    work: &mut RemeshWorkspace,
    resolution: &Resolution,
) -> u64 {
    for splits in 0..MOST_SPLITS {
        let view = Line::of(model, state, line, &work.wanted, &work.gripped, resolution);
        let Some((split, merge)) = best(&view) else { return splits as u64 };
        split_merge::split_and_merge(model, state, line, split, merge, work);
    }
    MOST_SPLITS as u64
}
