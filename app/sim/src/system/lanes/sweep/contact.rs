//! Forward sweep of rope that touches skin, obstacles or bodies: as `forward.rs`, with blocks of contact, which friction makes unsymmetric.
//!
//! A contact point adds a block to the diagonal of two nodes and, to the coupling of both, the same block `C`: the coupling of segment `k` is
//! `-(B - C)` both ways. With `G` the coupling of end A's row to node `k` beside `F`, the coupling of the node's row to end A,
//! `step_k = g - W step_A + X step_(k+1)`, `X = D⁻¹(B - C)`, `W = D⁻¹F`, and onward `F' = (B - C) W`, `G' = G X`,
//! `A' = A - G W`. Not pivoted: inertia and push keep every `D` well away from singular.

use pulp::{Simd, WithSimd};

use crate::simd::real::{Lane, Real};
use crate::simd::rows::Part;
use crate::simd::space::{Mat3, Sym3, Vec3};
use crate::system::lanes::kept::{KeptRow, KeptRows};
use crate::system::lanes::rows::{ContactRow, EndRows, Solved};
use crate::system::lanes::sweep::GroupRows;
use crate::system::lanes::sweep::forward::{Inputs, keep_pull};

/// Forward sweep with contact rows in the layout of the nodes.
pub(crate) struct ForwardContact<'a> {
    pub rows: GroupRows<'a>,
    pub contact: &'a [ContactRow],
    pub kept: KeptRows<'a>,
    pub ends: &'a mut EndRows,
}

impl WithSimd for ForwardContact<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let Self { rows, contact, kept, ends } = &mut self;
        for part in 0..Part::<S>::COUNT {
            let part = Part { simd, part };
            if rows.anchored && kept.is_empty() {
                forward::<S, false>(part, rows, contact, kept, ends);
            } else {
                forward::<S, true>(part, rows, contact, kept, ends);
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
    kept: &mut KeptRows<'_>,
    ends: &mut EndRows,
) {
    let (inputs, solved, (shortest, live)) = Inputs::of(part, group);
    let mut carry = begin(&inputs, contact, &mut solved[0]);
    let (first, rest) = solved.split_at_mut(shortest);
    for (k, solved) in first.iter_mut().enumerate().skip(1) {
        carry = onward::<S, FILL>(&inputs, contact, kept.get(k), (k, carry), solved);
    }
    for (k, (live, solved)) in (shortest..).zip(live.iter().zip(rest)) {
        let live = part.get(live);
        let next = onward::<S, FILL>(&inputs, contact, kept.get(k), (k, carry), solved);
        carry = choose(live, &next, &carry);
    }
    put_ends(part, ends, &carry);
}

/// Stores what a span leaves, at its end B.
#[inline(always)]
fn put_ends<S: Simd>(part: Part<S>, ends: &mut EndRows, carry: &Carry<Lane<S>>) {
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

/// Eliminates node `k`, or ends a span there in lanes in which it is kept; the carry for node `k + 1`.
#[inline(always)]
fn onward<S: Simd, const FILL: bool>(
    inputs: &Inputs<'_, S>,
    contact: &[ContactRow],
    kept: Option<&mut KeptRow>,
    (k, carry): (usize, Carry<Lane<S>>),
    solved: &mut Solved,
) -> Carry<Lane<S>> {
    let part = inputs.part;
    let pull = inputs.pull(k);
    keep_pull(part, &pull, solved);
    let own = pull.block.matrix();
    let coupling = own.sub(part.get9(&contact[k + 1].coupling));
    let carry = Carry { block: carry.block.add(own), force: carry.force.add(pull.force), ..carry };
    let inverse = carry.block.inverse();
    let x = inverse.times(coupling);
    let g = inverse.apply(carry.force);
    part.put9(&mut solved.x, x);
    part.put3(&mut solved.g, g);
    let (force, block) = node(inputs, contact, k + 1);
    let (force, block) = (force.sub(pull.force), block.add(own));
    let onward =
        Carry { block: block.sub(coupling.times(x)), force: force.add(coupling.apply(g)), ..carry };
    if !FILL {
        return onward;
    }
    let w = inverse.times(carry.fill);
    part.put9(&mut solved.w, w);
    let onward = Carry {
        fill: coupling.times(w),
        back: carry.back.times(x),
        aa: carry.aa.sub(carry.back.times(w)),
        force_a: carry.force_a.sub(carry.back.apply(g)),
        ..onward
    };
    let Some(kept) = kept else { return onward };
    put_ends(part, &mut kept.ends, &carry);
    let zero = Sym3::diagonal(inputs.shared.rate.splat(0.0)).matrix();
    let coupled = zero.sub(coupling);
    let begun =
        Carry { block, force, fill: coupled, back: coupled, aa: zero, force_a: force.sub(force) };
    choose(part.get(&kept.mask), &begun, &onward)
}

/// `yes` in lanes in which `of` is above zero, else `no`.
#[inline(always)]
fn choose<S: Simd>(of: Lane<S>, yes: &Carry<Lane<S>>, no: &Carry<Lane<S>>) -> Carry<Lane<S>> {
    Carry {
        block: Mat3::choose(of, yes.block, no.block),
        force: Vec3::choose(of, yes.force, no.force),
        fill: Mat3::choose(of, yes.fill, no.fill),
        back: Mat3::choose(of, yes.back, no.back),
        aa: Mat3::choose(of, yes.aa, no.aa),
        force_a: Vec3::choose(of, yes.force_a, no.force_a),
    }
}
