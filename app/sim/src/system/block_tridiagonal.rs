//! Direct solve of one line: elimination of its inner nodes down to its two ends.
//!
//! The matrix of a line of nodes 0..=n is block-tridiagonal (3×3 blocks). Eliminating nodes
//! 1..n-1 in turn leaves a 2×2 block system on the ends, which joins the interface system (`interface.rs`);
//! back-substitution then gives the inner nodes. Cost is linear in n, with no limit from stiffness.
//! While node k is eliminated its row couples to k+1 and, by fill, to end A.

use std::ops::Range;

use glam::{DMat3, DVec3};
use pulp::{Arch, Simd, WithSimd};

/// Matrix and right-hand side of all lines, in the model's node and segment layout.
#[derive(Clone, Debug, Default)]
pub(crate) struct BlockTridiagonal {
    arch: Arch,
    /// Diagonal block of each node.
    pub diagonal: Vec<DMat3>,
    /// Block of each segment: row of its first node, column of its second.
    pub up: Vec<DMat3>,
    /// Block of each segment: row of its second node, column of its first.
    pub low: Vec<DMat3>,
    /// Force out of balance at each node.
    pub force: Vec<DVec3>,
    /// Solution: move of each node.
    pub step: Vec<DVec3>,
    /// After [`eliminate`](Self::eliminate): force of each inner node, inverse of its diagonal, and the block that couples its row to
    /// end A.
    reduced: Vec<DVec3>,
    inverse: Vec<DMat3>,
    fill: Vec<DMat3>,
}

/// Matrix and force of a line reduced to its ends A and B.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Ends {
    pub aa: DMat3,
    pub ab: DMat3,
    pub ba: DMat3,
    pub bb: DMat3,
    pub force_a: DVec3,
    pub force_b: DVec3,
}

impl BlockTridiagonal {
    /// Storage for these numbers of nodes and segments.
    pub fn new(nodes: usize, segments: usize) -> Self {
        Self {
            arch: Arch::new(),
            diagonal: vec![DMat3::ZERO; nodes],
            up: vec![DMat3::ZERO; segments],
            low: vec![DMat3::ZERO; segments],
            force: vec![DVec3::ZERO; nodes],
            step: vec![DVec3::ZERO; nodes],
            reduced: vec![DVec3::ZERO; nodes],
            inverse: vec![DMat3::ZERO; nodes],
            fill: vec![DMat3::ZERO; nodes],
        }
    }

    /// Empties matrix and forces for a new pass.
    pub fn clear(&mut self) {
        self.diagonal.fill(DMat3::ZERO);
        self.up.fill(DMat3::ZERO);
        self.low.fill(DMat3::ZERO);
        self.force.fill(DVec3::ZERO);
    }

    /// Adds a force and its block at a fraction of a segment.
    pub fn add_at(
        &mut self,
        segment: usize,
        node: usize,
        fraction: f64,
        force: DVec3,
        block: &DMat3,
    ) {
        let (first, second) = (1.0 - fraction, fraction);
        self.force[node] += force * first;
        self.force[node + 1] += force * second;
        self.diagonal[node] += *block * (first * first);
        self.diagonal[node + 1] += *block * (second * second);
        self.up[segment] += *block * (first * second);
        self.low[segment] += *block * (first * second);
    }

    /// Eliminates the inner nodes of a line or of a span of it. `a_moves`: whether end A has freedom at all; `owns_a`: whether the result
    /// contains the block and the force of end A, which two spans share. Matrix and forces stay as they are.
    pub fn eliminate(
        &mut self,
        nodes: &Range<usize>,
        segments: &Range<usize>,
        a_moves: bool,
        owns_a: bool,
    ) -> Ends {
        let (nodes, segments) = (nodes.clone(), segments.clone());
        self.arch.dispatch(Eliminate { rope: self, nodes, segments, a_moves, owns_a })
    }

    /// Moves of the inner nodes from the moves of the ends.
    pub fn substitute(
        &mut self,
        nodes: &Range<usize>,
        segments: &Range<usize>,
        a_moves: bool,
        step_a: DVec3,
        step_b: DVec3,
    ) {
        let (a, b) = (nodes.start, nodes.end - 1);
        self.step[a] = step_a;
        self.step[b] = step_b;
        for (node, segment) in (a + 1..b).zip(segments.start + 1..segments.end).rev() {
            let mut right = self.reduced[node] - self.up[segment] * self.step[node + 1];
            if a_moves {
                right -= self.fill[node] * step_a;
            }
            self.step[node] = self.inverse[node] * right;
        }
    }
}

/// An elimination, compiled for the instructions that the processor has; its bits do not depend on them.
struct Eliminate<'a> {
    rope: &'a mut BlockTridiagonal,
    nodes: Range<usize>,
    segments: Range<usize>,
    a_moves: bool,
    owns_a: bool,
}

impl WithSimd for Eliminate<'_> {
    type Output = Ends;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Ends {
        let Self { rope, nodes, segments, a_moves, owns_a } = self;
        let (a, b) = (nodes.start, nodes.end - 1);
        let (mut fill, mut gill) = (rope.low[segments.start], rope.up[segments.start]);
        let (mut aa, mut force_a) =
            if owns_a { (rope.diagonal[a], rope.force[a]) } else { (DMat3::ZERO, DVec3::ZERO) };
        let (mut diagonal, mut force) = (rope.diagonal[a + 1], rope.force[a + 1]);
        for (node, segment) in (a + 1..b).zip(segments.start + 1..segments.end) {
            let inverse = diagonal.inverse();
            let up = rope.up[segment];
            let across = rope.low[segment] * inverse;
            (rope.inverse[node], rope.reduced[node]) = (inverse, force);
            if a_moves {
                let back = gill * inverse;
                aa -= back * fill;
                force_a -= back * force;
                gill = -(back * up);
                rope.fill[node] = fill;
                fill = -(across * fill);
            }
            diagonal = rope.diagonal[node + 1] - across * up;
            force = rope.force[node + 1] - across * force;
        }
        Ends { aa, ab: gill, ba: fill, bb: diagonal, force_a, force_b: force }
    }
}
