//! A split and a merge in one line, all else shifted by one place between them.
//!
//! Split of `a–c` of length `l` at its middle `b`: place, velocity, their histories and grips are means of the ends'. The mass
//! `m l/4` that leaves each end and `m l/2` that comes to the middle carry the same momentum.
//! Merge of `a–b–c` of lengths `l, l'`: the mass at `b` goes to its neighbours, `m l'/2` to `a` and `m l/2` to `c`, as a lever
//! would have it. Where `b` moves as the straight line between its neighbours does, `v = (l' v_a + l v_c)/(l + l')`, that keeps
//! the momentum and changes no velocity: rope that turns or stretches evenly goes on doing so. What `b` moves beyond that is
//! shared out: with `M` the mass of `a` before, `v_a ← v_a + (v_b - v) m l'/2 / (M + m l'/2)`.
//! What a node moved in the step before is shared in the same way, so that the multistep scheme sees the same momentum.

use glam::DVec3;

use super::RemeshWorkspace;
use crate::contact::rope_on_skin::stored_faces::shift_site;
use crate::model::Model;
use crate::state::{RopeState, State};

/// Splits segment `split` and merges `merge` with the one after it; both lie in `line`, apart from one another.
pub(super) fn split_and_merge(
    model: &Model,
    state: &mut State,
    line: usize,
    split: usize,
    merge: usize,
    work: &mut RemeshWorkspace,
) {
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

/// Takes the middle node of two segments into its neighbours; the first segment is then both, the second is to be overwritten.
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

/// What the time scheme knows of a node's motion.
#[derive(Clone, Copy)]
struct Motion {
    velocity: DVec3,
    earlier_velocity: DVec3,
    /// Way in the step before.
    moved: DVec3,
}

impl Motion {
    fn of(rope: &RopeState, node: usize) -> Self {
        let moved = rope.position[node] - rope.earlier_position[node];
        Self { velocity: rope.velocity[node], earlier_velocity: rope.earlier_velocity[node], moved }
    }

    /// Motion at a share of the way from one node to another.
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

/// Closes the gap a merge left and opens one behind `split`, which moves one place down.
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

/// Moves what lies between a split and a merge behind it; the split stays in its place.
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

/// Makes the two halves of `segment`: in its place and the next, with the node between them.
fn halve(rope: &mut RopeState, segment: usize, shift: usize, work: &mut RemeshWorkspace) {
    rope.segment_length[segment] *= 0.5;
    for_segments(rope, work, |values| values.copy(segment, segment + 1));
    let node = segment + shift + 1;
    for_nodes(rope, |values| values[node] = 0.5 * (values[node - 1] + values[node + 1]));
}

/// Numbers or marks, one a segment.
enum Values<'a> {
    Numbers(&'a mut [f64]),
    Marks(&'a mut [bool]),
}

impl Values<'_> {
    fn rotate(self, range: std::ops::Range<usize>, right: bool) {
        match self {
            Self::Numbers(values) if right => values[range].rotate_right(1),
            Self::Numbers(values) => values[range].rotate_left(1),
            Self::Marks(values) if right => values[range].rotate_right(1),
            Self::Marks(values) => values[range].rotate_left(1),
        }
    }

    fn copy(self, from: usize, to: usize) {
        match self {
            Self::Numbers(values) => values[to] = values[from],
            Self::Marks(values) => values[to] = values[from],
        }
    }
}

/// Does the same to all that is kept for each segment.
fn for_segments(rope: &mut RopeState, work: &mut RemeshWorkspace, act: impl Fn(Values<'_>)) {
    // No `..`: a new field of the state must find its place here or below before this compiles.
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
        // They lie by length along the line, which stays.
        solid_grips: _,
        within: _,
        rope_grips: _,
    } = rope;
    act(Values::Numbers(segment_length));
    act(Values::Numbers(tension));
    act(Values::Numbers(&mut work.wanted));
    act(Values::Marks(cut));
    act(Values::Marks(&mut work.gripped));
}

/// Does the same to all that is kept for each node.
fn for_nodes(rope: &mut RopeState, act: impl Fn(&mut [DVec3])) {
    act(&mut rope.position);
    act(&mut rope.velocity);
    act(&mut rope.earlier_position);
    act(&mut rope.earlier_velocity);
    act(&mut rope.seabed_grip);
}
