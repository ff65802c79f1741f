//! Forward sweep of rope that touches skin, obstacles or bodies: as `forward.rs`, with blocks of contact, which friction makes unsymmetric.
//!
//! A contact point adds a block to the diagonal of two nodes and, to the coupling of both, the same block `C`: the coupling of segment `k` is
//! `-(B - C)` both ways. With `G` the coupling of end A's row to node `k` beside `F`, the coupling of the node's row to end A,
//! `step_k = g - W step_A + X step_(k+1)`, `X = D⁻¹(B - C)`, `W = D⁻¹F`, and onward `F' = (B - C) W`, `G' = G X`,
//! `A' = A - G W`. Not pivoted: inertia and push keep every `D` well away from singular.

use pulp::{Simd, WithSimd};

use crate::system::lanes::real::Lane;
use crate::system::lanes::rows::{ContactRow, EndRows, Part, Solved};
use crate::system::lanes::space::{Mat3, Vec3};
use crate::system::lanes::sweep::GroupRows;
use crate::system::lanes::sweep::forward::{Inputs, keep_pull};

/// Forward sweep with contact rows in the layout of the nodes.
pub(crate) struct ForwardContact<'a>(pub GroupRows<'a>, pub &'a [ContactRow], pub &'a mut EndRows);

impl WithSimd for ForwardContact<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for part in 0..Part::<S>::COUNT {
            if self.0.anchored {
                forward::<S, false>(Part { simd, part }, &mut self.0, self.1, self.2);
            } else {
                forward::<S, true>(Part { simd, part }, &mut self.0, self.1, self.2);
            }
        }
    }
}

/// Values carried from node to node.
#[derive(Clone, Copy)]
struct Carry<R> {
    block: Mat3<R>,
    force: Vec3<R>,
    fill: Mat3<R>,
    back: Mat3<R>,
    aa: Mat3<R>,
    force_a: Vec3<R>,
}

#[inline(always)]
fn forward<S: Simd, const FILL: bool>(
    part: Part<S>,
    group: &mut GroupRows<'_>,
    contact: &[ContactRow],
    ends: &mut EndRows,
) {
    let (inputs, solved, (shortest, live)) = Inputs::of(part, group);
    let mut carry = begin(&inputs, contact, &mut solved[0]);
    let (first, rest) = solved.split_at_mut(shortest);
    for (k, solved) in first.iter_mut().enumerate().skip(1) {
        carry = onward::<S, FILL>(&inputs, contact, k, carry, solved);
    }
    for (k, (live, solved)) in (shortest..).zip(live.iter().zip(rest)) {
        let live = part.get(live);
        let next = onward::<S, FILL>(&inputs, contact, k, carry, solved);
        carry = Carry {
            block: Mat3::choose(live, next.block, carry.block),
            force: Vec3::choose(live, next.force, carry.force),
            fill: Mat3::choose(live, next.fill, carry.fill),
            back: Mat3::choose(live, next.back, carry.back),
            aa: Mat3::choose(live, next.aa, carry.aa),
            force_a: Vec3::choose(live, next.force_a, carry.force_a),
        };
    }
    part.put9(&mut ends.aa, carry.aa);
    part.put9(&mut ends.ab, carry.back);
    part.put9(&mut ends.ba, carry.fill);
    part.put9(&mut ends.bb, carry.block);
    part.put3(&mut ends.force_a, carry.force_a);
    part.put3(&mut ends.force_b, carry.force);
}

/// A node with its contact.
#[inline(always)]
fn node<S: Simd>(
    inputs: &Inputs<'_, S>,
    contact: &[ContactRow],
    k: usize,
) -> (Vec3<Lane<S>>, Mat3<Lane<S>>) {
    let (force, block) = inputs.node(k);
    let row = &contact[k + 1];
    let part = inputs.part;
    (force.add(part.get3(&row.force)), block.matrix().add(part.get9(&row.block)))
}

/// End A and segment 0; the carry for node 1.
#[inline(always)]
fn begin<S: Simd>(
    inputs: &Inputs<'_, S>,
    contact: &[ContactRow],
    solved: &mut Solved,
) -> Carry<Lane<S>> {
    let pull = inputs.pull(0);
    keep_pull(inputs.part, &pull, solved);
    let (force_a, aa) = node(inputs, contact, 0);
    let (force, block) = node(inputs, contact, 1);
    let own = pull.block.matrix();
    let coupling = inputs.part.get9(&contact[1].coupling).sub(own);
    Carry {
        block: block.add(own),
        force: force.sub(pull.force),
        fill: coupling,
        back: coupling,
        aa: aa.add(own),
        force_a: force_a.add(pull.force),
    }
}

/// Eliminates node `k`; the carry for node `k + 1`.
#[inline(always)]
fn onward<S: Simd, const FILL: bool>(
    inputs: &Inputs<'_, S>,
    contact: &[ContactRow],
    k: usize,
    carry: Carry<Lane<S>>,
    solved: &mut Solved,
) -> Carry<Lane<S>> {
    let part = inputs.part;
    let pull = inputs.pull(k);
    keep_pull(part, &pull, solved);
    let own = pull.block.matrix();
    let coupling = own.sub(part.get9(&contact[k + 1].coupling));
    let inverse = carry.block.add(own).inverse();
    let x = inverse.times(coupling);
    let g = inverse.apply(carry.force.add(pull.force));
    part.put9(&mut solved.x, x);
    part.put3(&mut solved.g, g);
    let (force, block) = node(inputs, contact, k + 1);
    let onward = Carry {
        block: block.add(own).sub(coupling.times(x)),
        force: force.sub(pull.force).add(coupling.apply(g)),
        ..carry
    };
    if !FILL {
        return onward;
    }
    let w = inverse.times(carry.fill);
    part.put9(&mut solved.w, w);
    Carry {
        fill: coupling.times(w),
        back: carry.back.times(x),
        aa: carry.aa.sub(carry.back.times(w)),
        force_a: carry.force_a.sub(carry.back.apply(g)),
        ..onward
    }
}
