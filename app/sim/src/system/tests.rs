//! Another linear system: the whole matrix, dense, solved with pivoting. It passes the tests of the solver.

use glam::{DMat3, DVec3};

use super::LinearSystem;
use super::interface::parts;
use crate::model::Model;

/// How a system is solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Method {
    /// Lines eliminated down to their ends and touched nodes, then the sparse system of these.
    #[default]
    Elimination,
    /// One dense matrix of all nodes, free joints and bodies.
    Dense,
}

/// A matrix of 3×3 blocks with its right-hand side.
struct Dense {
    rows: usize,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

/// Blocks of unknowns that move a node, each with the map from the move of the block to that of the node.
type Node = Vec<(usize, DMat3)>;

impl Dense {
    fn new(blocks: usize) -> Self {
        let rows = 3 * blocks;
        Self { rows, matrix: vec![0.0; rows * rows], right: vec![0.0; rows] }
    }

    fn add(&mut self, row: &Node, column: &Node, value: DMat3) {
        for (one, row_map) in row {
            for (other, column_map) in column {
                let block = row_map.transpose() * value * *column_map;
                for (k, values) in block.to_cols_array_2d().iter().enumerate() {
                    for (j, value) in values.iter().enumerate() {
                        self.matrix[(3 * one + j) * self.rows + 3 * other + k] += value;
                    }
                }
            }
        }
    }

    fn push(&mut self, row: &Node, force: DVec3) {
        for (block, map) in row {
            let mapped = (map.transpose() * force).to_array();
            for (k, value) in mapped.into_iter().enumerate() {
                self.right[3 * block + k] += value;
            }
        }
    }

    /// Gauss elimination with pivoting; the solution replaces the right-hand side.
    fn eliminate(&mut self) {
        let Self { rows, matrix, right } = self;
        let rows = *rows;
        for column in 0..rows {
            let size = |row: &usize| matrix[row * rows + column].abs();
            let pivot = (column..rows).max_by(|one, other| size(one).total_cmp(&size(other)));
            let pivot = pivot.unwrap_or(column);
            (0..rows).for_each(|k| matrix.swap(column * rows + k, pivot * rows + k));
            right.swap(column, pivot);
            for row in column + 1..rows {
                let factor = matrix[row * rows + column] / matrix[column * rows + column];
                if factor != 0.0 {
                    let (above, below) = matrix.split_at_mut(row * rows);
                    let lead = &above[column * rows + column..column * rows + rows];
                    let values = below[column..rows].iter_mut().zip(lead);
                    values.for_each(|(value, lead)| *value -= factor * lead);
                    right[row] -= factor * right[column];
                }
            }
        }
        for row in (0..rows).rev() {
            let known: f64 = (row + 1..rows).map(|k| matrix[row * rows + k] * right[k]).sum();
            right[row] = (right[row] - known) / matrix[row * rows + row];
        }
    }

    fn solve(mut self) -> Vec<DVec3> {
        self.eliminate();
        self.right.chunks_exact(3).map(DVec3::from_slice).collect()
    }
}

impl LinearSystem {
    /// Solves the assembled system as one dense matrix.
    pub(super) fn solve_densely(&mut self, model: &Model) {
        let blocks = self.interface.force.len();
        let nodes = self.nodes(model, blocks);
        let inner = model.node_count;
        let mut dense = Dense::new(blocks + inner);
        for block in 0..blocks {
            let row = vec![(block, DMat3::IDENTITY)];
            dense.push(&row, self.interface.force[block]);
            for column in 0..blocks {
                if let Some(value) = self.interface.get(block, column) {
                    dense.add(&row, &vec![(column, DMat3::IDENTITY)], value);
                }
            }
        }
        for (node, at) in nodes.iter().enumerate() {
            dense.push(at, self.rope.force[node]);
            dense.add(at, at, self.rope.diagonal[node]);
            // A node that is an end of a line has no unknown of its own: its row says that nothing moves there.
            if at.iter().all(|(block, _)| *block < blocks) {
                let own = vec![(blocks + node, DMat3::IDENTITY)];
                dense.add(&own, &own, DMat3::IDENTITY);
            }
        }
        for (line_nodes, segments) in model.line_nodes.iter().zip(&model.line_segments) {
            for (node, segment) in (line_nodes.start..).zip(segments.clone()) {
                dense.add(&nodes[node], &nodes[node + 1], self.rope.up[segment]);
                dense.add(&nodes[node + 1], &nodes[node], self.rope.low[segment]);
            }
        }
        for coupling in &self.ropes.couplings {
            for (row, row_weight) in coupling.weights() {
                for (column, weight) in coupling.weights() {
                    let block = coupling.block * (row_weight * weight);
                    dense.add(&nodes[row], &nodes[column], block);
                }
            }
        }
        let solution = dense.solve();
        self.interface.step.copy_from_slice(&solution[..blocks]);
        for (step, at) in self.rope.step.iter_mut().zip(&nodes) {
            *step = at.iter().map(|(block, map)| *map * solution[*block]).sum();
        }
    }

    /// The blocks that move each node.
    fn nodes(&self, model: &Model, blocks: usize) -> Vec<Node> {
        let own = |node: usize| vec![(blocks + node, DMat3::IDENTITY)];
        let mut nodes: Vec<Node> = (0..model.node_count).map(own).collect();
        for (line, line_nodes) in model.spec.lines.iter().zip(&model.line_nodes) {
            for (joint, node) in [(line.from, line_nodes.start), (line.to, line_nodes.end - 1)] {
                let (attachment, arm) = self.attachments[joint];
                let maps = parts(attachment, arm);
                nodes[node] =
                    maps.map(|(block, turn)| (block, turn.unwrap_or(DMat3::IDENTITY))).collect();
            }
        }
        nodes
    }
}

/// Numbers from -0.5 to 0.5, the same for the same seed.
pub(super) fn random(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}
