//! Ropes that touch, in the linear system: a correction of low rank to the block-tridiagonal systems of the lines.
//!
//! A touch of two ropes acts on the relative move `W δ` of its two points (four nodes) by a block `B`, not symmetric because of
//! friction. It couples nodes far apart, which the block-tridiagonal systems cannot hold. With `A` the system of lines and interface blocks without touches, `r`
//! its right-hand side, `W` and `B` of all touches:
//! `(A + Wᵀ B W) δ = r`, so `δ = A⁻¹ r - A⁻¹ Wᵀ λ`, `(1 + B S) λ = B W A⁻¹ r`, `S = W A⁻¹ Wᵀ`
//! (Sherman, Morrison and Woodbury; Golub and Van Loan 2013, Matrix Computations, section 2.1.4).
//! It is exact, whatever the stiffness. It takes a sweep over the lines with touches, three columns at once, for each touch,
//! and a dense solve of three rows a touch.

use std::ops::Range;

use glam::{DMat3, DVec3};

use super::Solver;
use super::block_tridiagonal::BlockTridiagonal;
use super::columns::Columns;
use super::interface::{Attachment, InterfaceSystem};
use crate::model::Model;

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
struct Again<T> {
    right: Vec<T>,
    step: Vec<T>,
    interface_right: Vec<T>,
    interface_step: Vec<T>,
}

/// All touches of the linear system, with scratch.
#[derive(Clone, Debug, Default)]
pub(crate) struct Woodbury {
    pub touches: Vec<ContactBlock>,
    /// Whether each line has a touch.
    lines: Vec<bool>,
    three: Again<DMat3>,
    one: Again<DVec3>,
    /// `1 + B S`, row after row.
    matrix: Vec<f64>,
    lambda: Vec<f64>,
}

impl ContactBlock {
    /// Weights of its four nodes.
    fn weights(&self) -> [(usize, f64); 4] {
        let ([a, b], [s, t]) = (self.nodes, self.fractions);
        [(a, 1.0 - s), (a + 1, s), (b, t - 1.0), (b + 1, -t)]
    }

    /// `W` of a quantity given at nodes.
    fn relative<T: Columns>(&self, at: &[T]) -> T {
        let mut sum = T::ZERO;
        for (node, weight) in self.weights() {
            sum += at[node].by(DMat3::from_diagonal(DVec3::splat(weight)));
        }
        sum
    }
}

impl<T: Columns> Again<T> {
    fn begin(&mut self, nodes: usize, interface: usize) {
        self.right.resize(nodes, T::ZERO);
        self.step.resize(nodes, T::ZERO);
        self.interface_right.clear();
        self.interface_right.resize(interface, T::ZERO);
        self.interface_step.resize(interface, T::ZERO);
    }

    /// Solves the factored system for the right-hand side, on some lines alone.
    fn solve(
        &mut self,
        model: &Model,
        tridiagonal: &BlockTridiagonal,
        interface: &InterfaceSystem,
        attachments: &[(Attachment, DVec3)],
        wanted: impl Fn(usize) -> bool,
    ) {
        let lines = || model.spec.lines.iter().enumerate().filter(|(index, _)| wanted(*index));
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
    /// Eliminates the inner nodes from another right-hand side, after [`eliminate`](Self::eliminate); what is left on both ends.
    fn reduce_again<T: Columns>(
        &self,
        nodes: &Range<usize>,
        segments: &Range<usize>,
        a_moves: bool,
        right: &mut [T],
    ) -> [T; 2] {
        let (a, b) = (nodes.start, nodes.end - 1);
        let mut end_a = right[a];
        for (node, segment) in (a + 1..b).zip(segments.start + 1..segments.end) {
            let moved = right[node].by(self.inverse[node]);
            right[node + 1] -= moved.by(self.low[segment]);
            if a_moves {
                end_a -= moved.by(self.back[node]);
            }
        }
        [end_a, right[b]]
    }

    fn substitute_again<T: Columns>(
        &self,
        nodes: &Range<usize>,
        segments: &Range<usize>,
        a_moves: bool,
        [step_a, step_b]: [T; 2],
        right: &[T],
        step: &mut [T],
    ) {
        let (a, b) = (nodes.start, nodes.end - 1);
        (step[a], step[b]) = (step_a, step_b);
        for (node, segment) in (a + 1..b).zip(segments.start + 1..segments.end).rev() {
            let mut left = right[node] - step[node + 1].by(self.up[segment]);
            if a_moves {
                left -= step_a.by(self.fill[node]);
            }
            step[node] = left.by(self.inverse[node]);
        }
    }
}

impl Solver {
    /// Corrects the solved step for the touches of ropes.
    pub(super) fn correct_for_rope_contact(&mut self, model: &Model) {
        if self.woodbury.touches.is_empty() {
            return;
        }
        let mut woodbury = std::mem::take(&mut self.woodbury);
        let mut attachments = std::mem::take(&mut self.attachments);
        attachments.clear();
        attachments.extend(
            self.plan.attachments.iter().map(|attachment| (*attachment, self.arm(*attachment))),
        );
        woodbury.measure(model, &self.tridiagonal, &self.interface, &attachments);
        woodbury.solve_dense(&self.tridiagonal.step);
        woodbury.correct(model, &self.tridiagonal, &self.interface, &attachments);
        for (step, less) in self.tridiagonal.step.iter_mut().zip(&woodbury.one.step) {
            *step -= *less;
        }
        for (step, less) in self.interface.step.iter_mut().zip(&woodbury.one.interface_step) {
            *step -= *less;
        }
        (self.woodbury, self.attachments) = (woodbury, attachments);
    }
}

impl Woodbury {
    /// Writes `1 + B S`, three columns a touch.
    fn measure(
        &mut self,
        model: &Model,
        tridiagonal: &BlockTridiagonal,
        interface: &InterfaceSystem,
        attachments: &[(Attachment, DVec3)],
    ) {
        let rows = 3 * self.touches.len();
        self.matrix.clear();
        self.matrix.resize(rows * rows, 0.0);
        self.lines.clear();
        self.lines.extend(model.line_nodes.iter().map(|nodes| {
            let here = |touch: &ContactBlock| touch.nodes.iter().any(|node| nodes.contains(node));
            self.touches.iter().any(here)
        }));
        for column in 0..self.touches.len() {
            self.three.begin(model.node_count, interface.step.len());
            for (nodes, _) in model.line_nodes.iter().zip(&self.lines).filter(|(_, there)| **there)
            {
                self.three.right[nodes.clone()].fill(DMat3::ZERO);
            }
            for (node, weight) in self.touches[column].weights() {
                self.three.right[node] += DMat3::from_diagonal(DVec3::splat(weight));
            }
            self.three.solve(model, tridiagonal, interface, attachments, |line| self.lines[line]);
            for (row, touch) in self.touches.iter().enumerate() {
                let block = touch.block * touch.relative(&self.three.step);
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
        solve_in_place(&mut self.matrix, &mut self.lambda);
    }

    /// `A⁻¹ Wᵀ λ`, into `one`.
    fn correct(
        &mut self,
        model: &Model,
        tridiagonal: &BlockTridiagonal,
        interface: &InterfaceSystem,
        attachments: &[(Attachment, DVec3)],
    ) {
        self.one.begin(model.node_count, interface.step.len());
        self.one.right.fill(DVec3::ZERO);
        for (touch, force) in self.touches.iter().zip(self.lambda.chunks_exact(3)) {
            for (node, weight) in touch.weights() {
                self.one.right[node] += DVec3::from_slice(force) * weight;
            }
        }
        self.one.solve(model, tridiagonal, interface, attachments, |_| true);
    }
}

/// Solves a dense system by elimination with partial pivoting; the solution takes the right-hand side's place.
fn solve_in_place(matrix: &mut [f64], right: &mut [f64]) {
    let rows = right.len();
    for pivot in 0..rows {
        let size = |row: usize, matrix: &[f64]| matrix[row * rows + pivot].abs();
        let best = (pivot + 1..rows).fold(pivot, |best, row| {
            if size(row, matrix) > size(best, matrix) { row } else { best }
        });
        if best != pivot {
            let (above, below) = matrix.split_at_mut(best * rows);
            above[pivot * rows..(pivot + 1) * rows].swap_with_slice(&mut below[..rows]);
            right.swap(pivot, best);
        }
        let (above, below) = matrix.split_at_mut((pivot + 1) * rows);
        let lead = &above[pivot * rows..];
        for (row, values) in below.chunks_exact_mut(rows).enumerate() {
            let factor = values[pivot] / lead[pivot];
            if factor != 0.0 {
                values[pivot + 1..]
                    .iter_mut()
                    .zip(&lead[pivot + 1..])
                    .for_each(|(value, above)| *value -= factor * above);
                right[pivot + 1 + row] -= factor * right[pivot];
            }
        }
    }
    for row in (0..rows).rev() {
        let known: f64 =
            (row + 1..rows).map(|column| matrix[row * rows + column] * right[column]).sum();
        right[row] = (right[row] - known) / matrix[row * rows + row];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dense_system_that_needs_pivots_is_solved() {
        let matrix = [0.0, 2.0, -1.0, 1e-9, 1.0, 3.0, 4.0, -2.0, 0.5];
        let wanted = [1.5, -2.0, 0.25];
        let mut right: Vec<f64> = matrix
            .chunks_exact(3)
            .map(|row| row.iter().zip(&wanted).map(|(a, x)| a * x).sum())
            .collect();
        solve_in_place(&mut matrix.clone(), &mut right);
        assert!(
            right.iter().zip(&wanted).all(|(got, wanted)| (got - wanted).abs() < 1e-12),
            "{right:?}"
        );
    }
}
