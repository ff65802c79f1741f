//! Lines condensed to the nodes at which ropes touch, for many right-hand sides that act there alone.
//!
//! Elimination leaves a line `r_{n+1} += F_n r_n`, `F = -L D⁻¹`, on the way to its end B, and
//! `δ_n = D_n⁻¹ r_n + G_n δ_{n+1} + H_n δ_a`, `G = -D⁻¹ U`, `H = -D⁻¹ C`, on the way back, with `C` what couples a row to end A.
//! From a node `p` that is touched to the next one `q` nothing else acts, so that both ways have one product each:
//! `r_q += Φ r_p`, `r_a += β r_p`, `δ_p = R r_p + Ψ δ_q + A δ_a`, with `Φ = F_{q-1} … F_p`, `Ψ = G_p … G_{q-1}`,
//! `R = Σ (G_p … G_{n-1}) D_n⁻¹ (F_{n-1} … F_p)`. The products take one walk along the line; a right-hand side then takes a few
//! products for each touched node, instead of a walk of its own.

use std::ops::Range;

use glam::DMat3;

use crate::model::Model;
use crate::system::block_tridiagonal::BlockTridiagonal;
use crate::system::interface::InterfaceSystem;
use crate::trial::plan::{Attachment, Attachments};

/// From a touched node to the next one, or to end B.
#[derive(Clone, Copy, Debug)]
struct Span {
    /// `Φ`.
    onward: DMat3,
    /// `β`.
    to_a: DMat3,
    /// `R`.
    own: DMat3,
    /// `Ψ`.
    next: DMat3,
    /// `A`.
    from_a: DMat3,
}

/// A line with touches.
#[derive(Clone, Debug)]
struct Line {
    index: usize,
    /// Its slots: end A, touched inner nodes in order, end B.
    slots: Range<usize>,
}

/// All lines with touches.
#[derive(Clone, Debug, Default)]
pub(crate) struct Condensed {
    lines: Vec<Line>,
    /// Node of each slot.
    nodes: Vec<usize>,
    /// Of the slots of inner nodes; those of ends are not used.
    spans: Vec<Span>,
    right: Vec<DMat3>,
    step: Vec<DMat3>,
    interface_right: Vec<DMat3>,
    interface_step: Vec<DMat3>,
}

impl Condensed {
    /// Condenses the lines of these nodes, from a system that has been eliminated.
    pub fn condense(
        &mut self,
        model: &Model,
        tridiagonal: &BlockTridiagonal,
        attachments: &Attachments,
        touched: impl Iterator<Item = usize> + Clone,
    ) {
        self.lines.clear();
        self.nodes.clear();
        self.spans.clear();
        for (index, (line, nodes)) in model.spec.lines.iter().zip(&model.line_nodes).enumerate() {
            let here = touched.clone().filter(|node| nodes.contains(node));
            if self.take_slots(index, nodes, here) {
                let a_moves = attachments[line.from].0 != Attachment::Fixed;
                self.measure_spans(&model.line_segments[index], nodes, tridiagonal, a_moves);
            }
        }
        self.right.resize(self.nodes.len(), DMat3::ZERO);
        self.step.resize(self.nodes.len(), DMat3::ZERO);
    }

    /// Slots of a line, if any of its nodes is touched.
    fn take_slots(
        &mut self,
        index: usize,
        nodes: &Range<usize>,
        touched: impl Iterator<Item = usize>,
    ) -> bool {
        let first = self.nodes.len();
        self.nodes.extend(touched);
        if self.nodes.len() == first {
            return false;
        }
        self.nodes.extend([nodes.start, nodes.end - 1]);
        self.nodes[first..].sort_unstable();
        let mut kept = first;
        for slot in first..self.nodes.len() {
            if slot == first || self.nodes[slot] != self.nodes[kept - 1] {
                self.nodes[kept] = self.nodes[slot];
                kept += 1;
            }
        }
        self.nodes.truncate(kept);
        self.lines.push(Line { index, slots: first..kept });
        true
    }

    /// The spans of the line whose slots were taken last.
    fn measure_spans(
        &mut self,
        segments: &Range<usize>,
        nodes: &Range<usize>,
        tridiagonal: &BlockTridiagonal,
        a_moves: bool,
    ) {
        let first = self.spans.len();
        for slot in first..self.nodes.len() {
            let is_inner = slot > first && slot + 1 < self.nodes.len();
            let span = if is_inner { self.nodes[slot]..self.nodes[slot + 1] } else { 0..0 };
            let segment_of = |node: usize| segments.start + (node - nodes.start);
            self.spans.push(Span::of(tridiagonal, span, segment_of, a_moves));
        }
    }

    /// Place of a node among the slots.
    pub fn slot(&self, node: usize) -> Option<usize> {
        self.lines.iter().find_map(|line| {
            let found = self.nodes[line.slots.clone()].binary_search(&node).ok()?;
            Some(line.slots.start + found)
        })
    }

    /// The right-hand side, emptied: a block for each slot.
    pub fn empty_right(&mut self, interface: usize) -> &mut [DMat3] {
        self.right.fill(DMat3::ZERO);
        self.interface_right.clear();
        self.interface_right.resize(interface, DMat3::ZERO);
        self.interface_step.resize(interface, DMat3::ZERO);
        &mut self.right
    }

    /// Solves for that right-hand side; the moves of the slots.
    pub fn solve(
        &mut self,
        model: &Model,
        interface: &InterfaceSystem,
        attachments: &Attachments,
    ) -> &[DMat3] {
        for line in &self.lines {
            let slots = line.slots.clone();
            let (first, last) = (slots.start, slots.end - 1);
            for slot in first + 1..last {
                let (span, right) = (&self.spans[slot], self.right[slot]);
                self.right[slot + 1] += span.onward * right;
                self.right[first] += span.to_a * right;
            }
            let ends = &model.spec.lines[line.index];
            for (end, slot) in [(ends.from, first), (ends.to, last)] {
                let (attachment, arm) = attachments[end];
                let right = self.right[slot];
                interface.push_again(attachment, arm, right, &mut self.interface_right);
            }
        }
        interface.solve_again(&mut self.interface_right, &mut self.interface_step);
        for line in &self.lines {
            let slots = line.slots.clone();
            let (first, last) = (slots.start, slots.end - 1);
            let ends = &model.spec.lines[line.index];
            for (end, slot) in [(ends.from, first), (ends.to, last)] {
                let (attachment, arm) = attachments[end];
                self.step[slot] = interface.step_again(attachment, arm, &self.interface_step);
            }
            for slot in (first + 1..last).rev() {
                let span = &self.spans[slot];
                self.step[slot] = span.own * self.right[slot]
                    + span.next * self.step[slot + 1]
                    + span.from_a * self.step[first];
            }
        }
        &self.step
    }
}

impl Span {
    /// Of these inner nodes.
    fn of(
        tridiagonal: &BlockTridiagonal,
        nodes: Range<usize>,
        segment_of: impl Fn(usize) -> usize,
        a_moves: bool,
    ) -> Self {
        let mut span = Self {
            onward: DMat3::IDENTITY,
            to_a: DMat3::ZERO,
            own: DMat3::ZERO,
            next: DMat3::IDENTITY,
            from_a: DMat3::ZERO,
        };
        for node in nodes {
            let (segment, inverse) = (segment_of(node), tridiagonal.inverse[node]);
            let (here, back) = (inverse * span.onward, span.next * inverse);
            span.own += span.next * here;
            if a_moves {
                span.to_a -= tridiagonal.back[node] * here;
                span.from_a -= back * tridiagonal.fill[node];
            }
            span.onward = -(tridiagonal.low[segment] * here);
            span.next = -(back * tridiagonal.up[segment]);
        }
        span
    }
}
