//! A swap of a split and a merge in one line; the entries between them shift by one.
//!
//! Split of a segment `a–c` of length `l` [m] at its middle `b`: position, velocity, their histories and grips of `b` are the
//! means of those of `a` and `c`. With `m` the mass per length [kg/m], `m l/4` moves from each end to the middle with the same
//! momentum.
//! Merge of `a–b–c` of lengths `l, l'`: the mass at `b` is distributed by the lever rule, `m l'/2` to `a` and `m l/2` to `c`.
//! If `b` moves with the interpolated velocity `v = (l' v_a + l v_c)/(l + l')`, this conserves momentum and changes no
//! velocity, so that uniform rotation and stretching continue. The momentum of the remainder `v_b - v` is distributed: with `M`
//! the mass of `a` before the merge, `v_a ← v_a + (v_b - v) m l'/2 / (M + m l'/2)`, and likewise for `c`.
//! Displacements of the previous step are distributed in the same way, which conserves the momentum of the multistep scheme.

use glam::DVec3;

use super::RemeshWorkspace;
use crate::contact::rope_on_skin::stored_faces::shift_site;
use crate::model::Model;
use crate::state::{RopeState, State};

/// Splits segment `split` and merges `merge` with the next one; both are inner segments of `line` and not neighbours.
pub(super) fn split_and_merge(
    model: &Model,
    state: &mut State,
    line: usize,
    split: usize,
    merge: usize,
    work: &mut RemeshWorkspace,
) {
    debug_assert!(merge > split + 1 || merge + 1 < split, "split and merge must not overlap");
    debug_assert!(
        [split, merge, merge + 1].iter().all(|one| model.line_segments[line].contains(one)),
        "split and merge belong to the line"
    );
    let shift = model.line_nodes[line].start - model.line_segments[line].start;
    merge_nodes(&mut state.rope, merge, shift);
    work.wanted[merge] = work.wanted[merge].min(work.wanted[merge + 1]);
    if merge < split {
        move_left(&mut state.rope, merge, split, shift, work);
        halve(&mut state.rope, split - 1, shift, work);
    } else {
        move_right(&mut state.rope, merge, split, shift, work);
        halve(&mut state.rope, split, shift, work);
    }
}

/// Distributes the middle node of two segments to its neighbours. The first segment then covers both; the second is overwritten
/// later.
fn merge_nodes(rope: &mut RopeState, merge: usize, shift: usize) {
    let [first, second] = [merge, merge + 1].map(|segment| rope.segment_length[segment]);
    let hanging =
        |segment: usize| 0.5 * (rope.segment_length[segment] + rope.segment_length[segment + 1]);
    let (before, after) = (hanging(merge - 1), hanging(merge + 1));
    let middle = merge + shift + 1;
    let lever = first / (first + second);
    let excess =
        Motion::of(rope, middle).less(&Motion::between(rope, middle - 1, middle + 1, lever));
    for (node, share) in [
        (middle - 1, 0.5 * second / (before + 0.5 * second)),
        (middle + 1, 0.5 * first / (after + 0.5 * first)),
    ] {
        excess.give(rope, node, share);
        rope.seabed_grip[node] = rope.seabed_grip[node].lerp(rope.seabed_grip[middle], share);
    }
    rope.tension[merge] =
        (rope.tension[merge] * first + rope.tension[merge + 1] * second) / (first + second);
    rope.segment_length[merge] = first + second;
}

/// Motion of a node in the time scheme.
#[derive(Clone, Copy)]
struct Motion {
    velocity: DVec3,
    earlier_velocity: DVec3,
    /// Displacement in the previous step.
    moved: DVec3,
}

impl Motion {
    fn of(rope: &RopeState, node: usize) -> Self {
        let moved = rope.position[node] - rope.earlier_position[node];
        Self { velocity: rope.velocity[node], earlier_velocity: rope.earlier_velocity[node], moved }
    }

    /// Motion interpolated between two nodes.
    fn between(rope: &RopeState, from: usize, to: usize, share: f64) -> Self {
        let (from, to) = (Self::of(rope, from), Self::of(rope, to));
        Self {
            velocity: from.velocity.lerp(to.velocity, share),
            earlier_velocity: from.earlier_velocity.lerp(to.earlier_velocity, share),
            moved: from.moved.lerp(to.moved, share),
        }
    }

    fn less(self, other: &Self) -> Self {
        Self {
            velocity: self.velocity - other.velocity,
            earlier_velocity: self.earlier_velocity - other.earlier_velocity,
            moved: self.moved - other.moved,
        }
    }

    /// Adds a share of it to a node's motion.
    fn give(self, rope: &mut RopeState, node: usize, share: f64) {
        rope.velocity[node] += self.velocity * share;
        rope.earlier_velocity[node] += self.earlier_velocity * share;
        rope.earlier_position[node] -= self.moved * share;
    }
}

/// Moves the entries between a merge and a later split one place down, so that an entry after `split - 1` is free.
fn move_left(
    rope: &mut RopeState,
    merge: usize,
    split: usize,
    shift: usize,
    work: &mut RemeshWorkspace,
) {
    for_segments(rope, work, |values| values.rotate(merge + 1..split + 1, false));
    for_nodes(rope, |values| values[merge + 1 + shift..=split + shift].rotate_left(1));
    for site in &mut rope.friction.sites {
        *site = shift_site(*site, merge + 2..split, -1);
    }
}

/// Moves the entries between a split and a later merge one place up, so that an entry after `split` is free.
fn move_right(
    rope: &mut RopeState,
    merge: usize,
    split: usize,
    shift: usize,
    work: &mut RemeshWorkspace,
) {
    for_segments(rope, work, |values| values.rotate(split + 1..merge + 2, true));
    for_nodes(rope, |values| values[split + 1 + shift..=merge + 1 + shift].rotate_right(1));
    for site in &mut rope.friction.sites {
        *site = shift_site(*site, split + 1..merge, 1);
    }
}

/// Writes the two halves of `segment` into its entry and the next, and the node between them.
fn halve(rope: &mut RopeState, segment: usize, shift: usize, work: &mut RemeshWorkspace) {
    rope.segment_length[segment] *= 0.5;
    for_segments(rope, work, |values| values.copy(segment, segment + 1));
    let node = segment + shift + 1;
    for_nodes(rope, |values| values[node] = 0.5 * (values[node - 1] + values[node + 1]));
}

/// Numbers or flags, one per segment.
enum Values<'a> {
    Numbers(&'a mut [f64]),
    Flags(&'a mut [bool]),
}

impl Values<'_> {
    fn rotate(self, range: std::ops::Range<usize>, right: bool) {
        match self {
            Self::Numbers(values) if right => values[range].rotate_right(1),
            Self::Numbers(values) => values[range].rotate_left(1),
            Self::Flags(values) if right => values[range].rotate_right(1),
            Self::Flags(values) => values[range].rotate_left(1),
        }
    }

    fn copy(self, from: usize, to: usize) {
        match self {
            Self::Numbers(values) => values[to] = values[from],
            Self::Flags(values) => values[to] = values[from],
        }
    }
}

/// Applies an operation to every list with one entry per segment.
fn for_segments(rope: &mut RopeState, work: &mut RemeshWorkspace, act: impl Fn(Values<'_>)) {
    // No `..`: the compiler then reports a new field that is not handled here or below.
    let RopeState {
        segment_length,
        tension,
        cut,
        position: _,
        velocity: _,
        earlier_position: _,
        earlier_velocity: _,
        earlier_dt_s: _,
        seabed_grip: _,
        friction: _,
        // These refer to lengths along the line, which do not change.
        solid_grips: _,
        within: _,
        rope_grips: _,
    } = rope;
    act(Values::Numbers(segment_length));
    act(Values::Numbers(tension));
    act(Values::Numbers(&mut work.wanted));
    act(Values::Flags(cut));
    act(Values::Flags(&mut work.gripped));
}

/// Applies an operation to every list with one entry per node.
fn for_nodes(rope: &mut RopeState, act: impl Fn(&mut [DVec3])) {
    act(&mut rope.position);
    act(&mut rope.velocity);
    act(&mut rope.earlier_position);
    act(&mut rope.earlier_velocity);
    act(&mut rope.seabed_grip);
}
