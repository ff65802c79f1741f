//! Forward sweep: forces, matrix and elimination, node after node.

use pulp::{Simd, WithSimd};

use crate::forces::axial::Axial;
use crate::forces::laws::{self, NodeAt, PerMetre, PullOf, SegmentAt, Shared};
use crate::simd::real::{Lane, Real};
use crate::simd::rows::{Part, Row};
use crate::simd::space::{Mat3, Sym3, Vec3};
use crate::system::lanes::rows::{EndRows, GroundRow, NodeRow, SegmentRow, Solved};
use crate::system::lanes::sweep::GroupRows;

/// Forward sweep.
pub(crate) struct Forward<'a>(pub GroupRows<'a>, pub &'a mut EndRows);

impl WithSimd for Forward<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for part in 0..Part::<S>::COUNT {
            if self.0.anchored {
                forward::<S, false>(Part { simd, part }, &mut self.0, self.1);
            } else {
                forward::<S, true>(Part { simd, part }, &mut self.0, self.1);
            }
        }
    }
}

/// Values carried from node to node.
#[derive(Clone, Copy)]
struct Carry<R> {
    block: Sym3<R>,
    force: Vec3<R>,
    fill: Mat3<R>,
    aa: Sym3<R>,
    force_a: Vec3<R>,
}

/// Inputs of a part of the lanes, spread over its registers.
pub(crate) struct Inputs<'a, S: Simd> {
    pub part: Part<S>,
    nodes: &'a [NodeRow],
    segments: &'a [SegmentRow],
    ground: &'a [GroundRow],
    bends: bool,
    rope: PerMetre<Lane<S>>,
    pub shared: Shared<Lane<S>>,
}

/// Inputs of a part of a group, the place for its solution, and the node from which each lane is active.
pub(crate) type Spread<'a, S> = (Inputs<'a, S>, &'a mut [Solved], (usize, &'a [Row]));

impl<'a, S: Simd> Inputs<'a, S> {
    /// Spreads a part of a group.
    #[inline(always)]
    pub fn of(part: Part<S>, group: &'a mut GroupRows<'_>) -> Spread<'a, S> {
        let inputs = Self {
            part,
            nodes: group.nodes,
            segments: group.segments,
            ground: group.ground,
            bends: group.bends,
            rope: spread_rope(part, group.rope),
            shared: spread_shared(part.simd, group.shared),
        };
        (inputs, group.solved, (group.shortest, group.live))
    }

    #[inline(always)]
    pub fn node(&self, k: usize) -> (Vec3<Lane<S>>, Sym3<Lane<S>>) {
        let part = self.part;
        let row = &self.nodes[k + 1];
        let at = NodeAt {
            place: part.get3(&row.place),
            before: part.get3(&self.nodes[k].place),
            after: part.get3(&self.nodes[k + 2].place),
            place_history: part.get3(&row.place_history),
            velocity_history: part.get3(&row.velocity_history),
            flow: part.get3(&row.flow),
            surface: Lane::new(part.simd, 0.0),
            length: part.get(&row.length),
        };
        let (force, block) = laws::node(&self.rope, &self.shared, &at);
        match self.ground.get(k + 1) {
            None => (force, block),
            Some(ground) => {
                (force.add(part.get3(&ground.force)), block.add(part.get6(&ground.block)))
            }
        }
    }

    #[inline(always)]
    pub fn pull(&self, k: usize) -> PullOf<Lane<S>> {
        let (part, from, to) = (self.part, &self.nodes[k + 1], &self.nodes[k + 2]);
        let row = &self.segments[k];
        let at = SegmentAt {
            between: part.get3(&to.place).sub(part.get3(&from.place)),
            history: part.get3(&to.place_history).sub(part.get3(&from.place_history)),
            length: part.get(&row.length),
            inverse_length: part.get(&row.inverse_length),
            law: Axial {
                ea: part.get(&row.ea),
                ea2: part.get(&row.ea2),
                damping: part.get(&row.damping),
            },
            predicted: part.get(&row.tension),
        };
        let pull = laws::pull(&at, self.shared.rate);
        if !self.bends {
            return pull;
        }
        let shear = self.moment(k + 1).sub(self.moment(k)).scale(at.inverse_length);
        PullOf {
            force: pull.force.sub(shear),
            block: pull.block.add(Sym3::diagonal(part.get(&row.bending))),
            ..pull
        }
    }

    /// Bending moment at node `k`, as a vector along the turn (`bending.rs`).
    #[inline(always)]
    fn moment(&self, k: usize) -> Vec3<Lane<S>> {
        let part = self.part;
        let [before, at, behind] = [0, 1, 2].map(|row| part.get3(&self.nodes[k + row].place));
        let row = &self.nodes[k + 1];
        let turn = behind
            .sub(at)
            .scale(part.get(&row.inverse_behind))
            .less(at.sub(before), part.get(&row.inverse_before));
        turn.scale(part.get(&row.hinge))
    }
}

#[inline(always)]
fn forward<S: Simd, const FILL: bool>(
    part: Part<S>,
    group: &mut GroupRows<'_>,
    ends: &mut EndRows,
) {
    let (inputs, solved, (shortest, live)) = Inputs::of(part, group);
    let mut carry = begin(&inputs, &mut solved[0]);
    let (first, rest) = solved.split_at_mut(shortest);
    for (k, solved) in first.iter_mut().enumerate().skip(1) {
        carry = onward::<S, FILL>(&inputs, k, carry, solved);
    }
    for (k, (live, solved)) in (shortest..).zip(live.iter().zip(rest)) {
        let live = part.get(live);
        let next = onward::<S, FILL>(&inputs, k, carry, solved);
        carry = Carry {
            block: Sym3::choose(live, next.block, carry.block),
            force: Vec3::choose(live, next.force, carry.force),
            fill: Mat3::choose(live, next.fill, carry.fill),
            aa: Sym3::choose(live, next.aa, carry.aa),
            force_a: Vec3::choose(live, next.force_a, carry.force_a),
        };
    }
    part.put9(&mut ends.aa, carry.aa.matrix());
    part.put9(&mut ends.ab, carry.fill.transposed());
    part.put9(&mut ends.ba, carry.fill);
    part.put9(&mut ends.bb, carry.block.matrix());
    part.put3(&mut ends.force_a, carry.force_a);
    part.put3(&mut ends.force_b, carry.force);
}

/// End A and segment 0; the carry for node 1.
#[inline(always)]
fn begin<S: Simd>(inputs: &Inputs<'_, S>, solved: &mut Solved) -> Carry<Lane<S>> {
    let pull = inputs.pull(0);
    keep_pull(inputs.part, &pull, solved);
    let (force_a, aa) = inputs.node(0);
    let (force, block) = inputs.node(1);
    let zero = inputs.shared.rate.splat(0.0);
    Carry {
        block: block.add(pull.block),
        force: force.sub(pull.force),
        fill: Sym3::diagonal(zero).sub(pull.block).matrix(),
        aa: aa.add(pull.block),
        force_a: force_a.add(pull.force),
    }
}

/// Eliminates node `k`; the carry for node `k + 1`.
#[inline(always)]
fn onward<S: Simd, const FILL: bool>(
    inputs: &Inputs<'_, S>,
    k: usize,
    carry: Carry<Lane<S>>,
    solved: &mut Solved,
) -> Carry<Lane<S>> {
    let part = inputs.part;
    let pull = inputs.pull(k);
    keep_pull(part, &pull, solved);
    let inverse = carry.block.add(pull.block).inverse();
    let x = inverse.times_sym(pull.block);
    let g = inverse.apply(carry.force.add(pull.force));
    part.put9(&mut solved.x, x);
    part.put3(&mut solved.g, g);
    let (force, block) = inputs.node(k + 1);
    let onward = Carry {
        block: pull.block.matrix().taken_from(x, block.add(pull.block)),
        force: force.sub(pull.force).add(pull.block.apply(g)),
        ..carry
    };
    if !FILL {
        return onward;
    }
    let w = inverse.times(carry.fill);
    part.put9(&mut solved.w, w);
    Carry {
        fill: pull.block.times(w),
        aa: carry.fill.taken_from(w, carry.aa),
        force_a: carry.force_a.sub(carry.fill.apply_transposed(g)),
        ..onward
    }
}

#[inline(always)]
pub(crate) fn keep_pull<S: Simd>(part: Part<S>, pull: &PullOf<Lane<S>>, solved: &mut Solved) {
    part.put3(&mut solved.direction, pull.direction);
    part.put(&mut solved.tension, pull.tension);
    part.put(&mut solved.stiffness, pull.stiffness);
    part.put(&mut solved.inverse_chord, pull.inverse_chord);
}

#[inline(always)]
fn spread_rope<S: Simd>(part: Part<S>, rope: &PerMetre<Row>) -> PerMetre<Lane<S>> {
    PerMetre {
        mass: part.get(&rope.mass),
        added: part.get(&rope.added),
        spared: part.get(&rope.spared),
        weight: part.get(&rope.weight),
        lift: part.get(&rope.lift),
        across: part.get(&rope.across),
        along: part.get(&rope.along),
        along_root: part.get(&rope.along_root),
    }
}

#[inline(always)]
fn spread_shared<S: Simd>(simd: S, shared: &Shared<f64>) -> Shared<Lane<S>> {
    let spread = |value| Lane::new(simd, value);
    Shared {
        rate: spread(shared.rate),
        inertia: spread(shared.inertia),
        wet: spread(shared.wet),
        drying: spread(shared.drying),
        viscous: shared.viscous,
    }
}
