//! Ropes that touch, in the linear system: a correction of low rank to the block-tridiagonal systems of the lines.
//!
//! A touch of two ropes acts on the relative move `W δ` of its two points (four nodes) by a block `B`, not symmetric because of
//! friction. It couples nodes far apart, which the block-tridiagonal systems cannot hold. With `A` the system of lines and interface blocks without touches, `r`
//! its right-hand side, `W` and `B` of all touches:
//! `(A + Wᵀ B W) δ = r`, so `δ = A⁻¹ r - A⁻¹ Wᵀ λ`, `(1 + B S) λ = B W A⁻¹ r`, `S = W A⁻¹ Wᵀ`
//! (Sherman, Morrison and Woodbury; Golub and Van Loan 2013, Matrix Computations, section 2.1.4).
//! It is exact, whatever the stiffness. `S` takes one walk along the lines with touches and a few products for each pair of touches
//! (`condensed.rs`), `λ` a dense solve of three rows a touch.

use std::ops::Range;

use glam::{DMat3, DVec3};
use pulp::Arch;

use crate::model::Model;
use crate::system::block_tridiagonal::BlockTridiagonal;
use crate::system::condensed::Condensed;
use crate::system::dense::solve_in_place;
use crate::system::interface::InterfaceSystem;
use crate::trial::plan::{Attachment, Attachments};

/// A touch as the linear system sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactBlock {
    /// First nodes of the two segments.
    pub nodes: [usize; 2],
    /// Fractions along them.
    pub fractions: [f64; 2],
    /// `-d force / d move`, of the first point relative to the second [N/m].
    pub block: DMat3,
}

/// Scratch of a solve again: right-hand side and solution at nodes and interface blocks.
#[derive(Clone, Debug, Default)]
struct Again {
    right: Vec<DVec3>,
    step: Vec<DVec3>,
    interface_right: Vec<DVec3>,
    interface_step: Vec<DVec3>,
}

/// All touches of the linear system, with scratch.
#[derive(Clone, Debug)]
pub(crate) struct Woodbury {
    arch: Arch,
    pub touches: Vec<ContactBlock>,
    /// Slots of the four nodes of each touch.
    slots: Vec<[usize; 4]>,
    condensed: Condensed,
    again: Again,
    /// `1 + B S`, row after row.
    matrix: Vec<f64>,
    lambda: Vec<f64>,
}

impl ContactBlock {
    /// Weights of its four nodes.
    pub fn weights(&self) -> [(usize, f64); 4] {
        let ([a, b], [s, t]) = (self.nodes, self.fractions);
        [(a, 1.0 - s), (a + 1, s), (b, t - 1.0), (b + 1, -t)]
    }

    /// `W` of the moves of nodes.
    fn relative(&self, at: &[DVec3]) -> DVec3 {
        self.weights().into_iter().map(|(node, weight)| at[node] * weight).sum()
    }
}

impl Again {
    fn begin(&mut self, nodes: usize, interface: usize) {
        self.right.clear();
        self.right.resize(nodes, DVec3::ZERO);
        self.step.resize(nodes, DVec3::ZERO);
        self.interface_right.clear();
        self.interface_right.resize(interface, DVec3::ZERO);
        self.interface_step.resize(interface, DVec3::ZERO);
    }

    /// Solves the factored system for the right-hand side.
    fn solve(
        &mut self,
        model: &Model,
        tridiagonal: &BlockTridiagonal,
        interface: &InterfaceSystem,
        attachments: &Attachments,
    ) {
        let lines = || model.spec.lines.iter().enumerate();
        for (index, line) in lines() {
            let ((attachment_a, arm_a), (attachment_b, arm_b)) =
                (attachments[line.from], attachments[line.to]);
            let (nodes, segments) = (&model.line_nodes[index], &model.line_segments[index]);
            let ends = tridiagonal.reduce_again(
                nodes,
                segments,
                attachment_a != Attachment::Fixed,
                &mut self.right,
            );
            interface.push_again(attachment_a, arm_a, ends[0], &mut self.interface_right);
            interface.push_again(attachment_b, arm_b, ends[1], &mut self.interface_right);
        }
        interface.solve_again(&mut self.interface_right, &mut self.interface_step);
        for (index, line) in lines() {
            let ends = [attachments[line.from], attachments[line.to]].map(|(attachment, arm)| {
                interface.step_again(attachment, arm, &self.interface_step)
            });
            let (nodes, segments) = (&model.line_nodes[index], &model.line_segments[index]);
            let a_moves = attachments[line.from].0 != Attachment::Fixed;
            tridiagonal.substitute_again(
                nodes,
                segments,
                a_moves,
                ends,
                &self.right,
                &mut self.step,
            );
        }
    }
}

impl BlockTridiagonal {
    /// Eliminates the inner nodes from another right-hand side, after [`eliminate`](Self::eliminate); returns the remainder at both ends.
    fn reduce_again(
        &self,
        nodes: &Range<usize>,
        segments: &Range<usize>,
        a_moves: bool,
        right: &mut [DVec3],
    ) -> [DVec3; 2] {
        let (a, b) = (nodes.start, nodes.end - 1);
        let mut end_a = right[a];
        for (node, segment) in (a + 1..b).zip(segments.start + 1..segments.end) {
            let moved = self.inverse[node] * right[node];
            right[node + 1] -= self.low[segment] * moved;
            if a_moves {
                end_a -= self.back[node] * moved;
            }
        }
        [end_a, right[b]]
    }

    fn substitute_again(
        &self,
        nodes: &Range<usize>,
        segments: &Range<usize>,
        a_moves: bool,
        [step_a, step_b]: [DVec3; 2],
        right: &[DVec3],
        step: &mut [DVec3],
    ) {
        let (a, b) = (nodes.start, nodes.end - 1);
        (step[a], step[b]) = (step_a, step_b);
        for (node, segment) in (a + 1..b).zip(segments.start + 1..segments.end).rev() {
            let mut left = right[node] - self.up[segment] * step[node + 1];
            if a_moves {
                left -= self.fill[node] * step_a;
            }
            step[node] = self.inverse[node] * left;
        }
    }
}

impl Woodbury {
    /// No touches.
    pub fn new() -> Self {
        Self {
            arch: Arch::new(),
            touches: Vec::new(),
            slots: Vec::new(),
            condensed: Condensed::default(),
            again: Again::default(),
            matrix: Vec::new(),
            lambda: Vec::new(),
        }
    }

    /// Corrects the solution of lines and interface system for all couplings.
    pub fn correct(
        &mut self,
        model: &Model,
        tridiagonal: &mut BlockTridiagonal,
        interface: &mut InterfaceSystem,
        attachments: &Attachments,
    ) {
        if self.touches.is_empty() {
            return;
        }
        self.measure(model, tridiagonal, interface, attachments);
        self.solve_dense(&tridiagonal.step);
        self.solve_correction(model, tridiagonal, interface, attachments);
        for (step, less) in tridiagonal.step.iter_mut().zip(&self.again.step) {
            *step -= *less;
        }
        for (step, less) in interface.step.iter_mut().zip(&self.again.interface_step) {
            *step -= *less;
        }
    }

    /// Writes `1 + B S`, three columns a touch.
    fn measure(
        &mut self,
        model: &Model,
        tridiagonal: &BlockTridiagonal,
        interface: &InterfaceSystem,
        attachments: &Attachments,
    ) {
        let rows = 3 * self.touches.len();
        self.matrix.clear();
        self.matrix.resize(rows * rows, 0.0);
        let nodes = |touch: &ContactBlock| touch.weights().map(|(node, _)| node);
        let touched = self.touches.iter().flat_map(nodes);
        self.condensed.condense(model, tridiagonal, attachments, touched);
        self.slots.clear();
        let slot = |node| self.condensed.slot(node).unwrap_or_default();
        self.slots.extend(self.touches.iter().map(|touch| nodes(touch).map(slot)));
        for column in 0..self.touches.len() {
            let right = self.condensed.empty_right(interface.step.len());
            for (slot, (_, weight)) in self.slots[column].iter().zip(self.touches[column].weights())
            {
                right[*slot] += DMat3::from_diagonal(DVec3::splat(weight));
            }
            let step = self.condensed.solve(model, interface, attachments);
            for (row, (touch, slots)) in self.touches.iter().zip(&self.slots).enumerate() {
                let weighted = |(slot, (_, weight)): (&usize, (_, f64))| step[*slot] * weight;
                let relative: DMat3 = slots.iter().zip(touch.weights()).map(weighted).sum();
                let block = touch.block * relative;
                for (k, values) in block.to_cols_array_2d().iter().enumerate() {
                    for (j, value) in values.iter().enumerate() {
                        self.matrix[(3 * row + j) * rows + 3 * column + k] = *value;
                    }
                }
            }
        }
        for row in 0..rows {
            self.matrix[row * rows + row] += 1.0;
        }
    }

    /// `λ` from the step without touches.
    fn solve_dense(&mut self, step: &[DVec3]) {
        self.lambda.clear();
        for touch in &self.touches {
            self.lambda.extend_from_slice(&(touch.block * touch.relative(step)).to_array());
        }
        solve_in_place(self.arch, &mut self.matrix, &mut self.lambda);
    }

    /// `A⁻¹ Wᵀ λ`, into `again`.
    fn solve_correction(
        &mut self,
        model: &Model,
        tridiagonal: &BlockTridiagonal,
        interface: &InterfaceSystem,
        attachments: &Attachments,
    ) {
        self.again.begin(model.node_count, interface.step.len());
        for (touch, force) in self.touches.iter().zip(self.lambda.chunks_exact(3)) {
            for (node, weight) in touch.weights() {
                self.again.right[node] += DVec3::from_slice(force) * weight;
            }
        }
        self.again.solve(model, tridiagonal, interface, attachments);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::Solver;
    use crate::solver::tests::{model, moving};
    use crate::state::State;
    use crate::trial::StepContext;
    use crate::trial::scheme::Scheme;

    /// Touches within a line and between lines, at ends and inside, with blocks that are not symmetric.
    fn touches(model: &Model) -> Vec<ContactBlock> {
        let [low, high, tail] = [0, 1, 2].map(|line| model.line_nodes[line].start);
        [
            [low, high + 20],
            [low + 12, low + 40],
            [low + 13, high],
            [high + 35, tail],
            [low + 58, tail + 7],
        ]
        .into_iter()
        .zip([1e3, 1e4, 1e5, 1e6, 1e7])
        .map(|(nodes, size)| {
            let block = DMat3::from_cols_array(&[3.0, 0.2, -0.4, 0.9, 2.0, 0.1, -0.3, 0.5, 1.0]);
            ContactBlock { nodes, fractions: [0.3, 0.8], block: block * size }
        })
        .collect()
    }

    /// The step of one assembled pass: its moves of nodes.
    fn solved(model: &Model, state: &State, prepare: impl FnOnce(&mut Solver)) -> Vec<DVec3> {
        let (mut solver, scheme) = (Solver::new(model), Scheme::bdf2(0.01, 0.01));
        solver.begin(model, state, &scheme);
        solver.assemble(&StepContext { model, state, scheme: &scheme });
        prepare(&mut solver);
        solver.solve(model);
        solver.system.rope.step
    }

    /// The forces of the couplings in the solution are applied as external forces; without couplings these give the same solution.
    #[test]
    fn touches_as_forces_give_the_same_moves() {
        let model = model(60.0, 0.7);
        let (state, touches) = (moving(&model), touches(&model));
        let free = solved(&model, &state, |_| ());
        let touched =
            solved(&model, &state, |solver| solver.system.ropes.touches.clone_from(&touches));
        let forced = solved(&model, &state, |solver| {
            for touch in &touches {
                let force = touch.block * touch.relative(&touched);
                for (node, weight) in touch.weights() {
                    solver.system.rope.force[node] -= force * weight;
                }
            }
        });
        let apart = |one: &[DVec3], other: &[DVec3]| {
            one.iter().zip(other).map(|(one, other)| one.distance(*other)).fold(0.0, f64::max)
        };
        assert!(apart(&free, &touched) > 1e-4, "{}", apart(&free, &touched));
        let share = apart(&touched, &forced) / apart(&free, &touched);
        assert!(share < 1e-6, "{share}");
    }
}
