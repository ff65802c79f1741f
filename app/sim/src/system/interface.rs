//! Direct solve of the interface system: free joints (one 3×3 block) and bodies (place and rotation, two blocks).
//!
//! Lines reduced to their ends couple interface blocks pairwise. The block matrix is factored without pivoting
//! (inertia keeps its diagonal dominant) along an order of least degree found once per model, with
//! the fill laid out beforehand: trees of gear have no fill, a loop has a few blocks.

use glam::{DMat3, DVec3};

use crate::matrix::{Columns, cross_matrix};
use crate::model::Model;
use crate::trial::plan::{Attachment, Plan};

/// Pattern, order and storage of the interface matrix.
#[derive(Clone, Debug, Default)]
pub(crate) struct InterfaceSystem {
    blocks: usize,
    /// Storage place of block (row, column), or `NONE`.
    storage: Vec<u32>,
    order: Vec<usize>,
    /// For each block in `order`: the later blocks its row couples to.
    later: Vec<Vec<usize>>,
    value: Vec<DMat3>,
    /// Force out of balance.
    pub force: Vec<DVec3>,
    /// Solution.
    pub step: Vec<DVec3>,
}

const NONE: u32 = u32::MAX;

impl InterfaceSystem {
    /// Lays out the matrix for `blocks` blocks coupled in these pairs.
    pub fn new(blocks: usize, pairs: &[(usize, usize)]) -> Self {
        let mut coupled = vec![false; blocks * blocks];
        for block in 0..blocks {
            coupled[block * blocks + block] = true;
        }
        for &(one, other) in pairs {
            coupled[one * blocks + other] = true;
            coupled[other * blocks + one] = true;
        }
        let (order, later) = order_of_least_degree(blocks, &mut coupled);
        let mut storage = vec![NONE; blocks * blocks];
        let mut count = 0;
        for (place, _) in coupled.iter().enumerate().filter(|(_, there)| **there) {
            storage[place] = count;
            count += 1;
        }
        Self {
            blocks,
            storage,
            order,
            later,
            value: vec![DMat3::ZERO; count as usize],
            force: vec![DVec3::ZERO; blocks],
            step: vec![DVec3::ZERO; blocks],
        }
    }

    /// The empty interface matrix of a model in which these bodies touch each other.
    pub fn of_model(plan: &Plan, model: &Model, coupled: &[[usize; 2]]) -> Self {
        let blocks_of = |joint: usize| match plan.attachments[joint] {
            Attachment::Fixed => [None, None],
            Attachment::Free(block) => [Some(block), None],
            Attachment::Body { block, .. } => [Some(block), Some(block + 1)],
        };
        let mut pairs: Vec<(usize, usize)> =
            plan.body_block.iter().map(|block| (*block, block + 1)).collect();
        for bodies in coupled {
            let [one, two] = bodies.map(|body| plan.body_block[body]);
            pairs.extend([(one, two), (one, two + 1), (one + 1, two), (one + 1, two + 1)]);
        }
        for line in &model.spec.lines {
            for one in blocks_of(line.from).into_iter().flatten() {
                for other in blocks_of(line.to).into_iter().flatten() {
                    pairs.push((one, other));
                }
            }
        }
        let free = plan
            .attachments
            .iter()
            .filter(|attachment| matches!(attachment, Attachment::Free(_)))
            .count();
        Self::new(free + 2 * plan.body_block.len(), &pairs)
    }

    /// Empties matrix and forces for a new pass.
    pub fn clear(&mut self) {
        self.value.fill(DMat3::ZERO);
        self.force.fill(DVec3::ZERO);
    }

    /// Copies matrix and forces of a system of the same layout.
    pub fn copy_values(&mut self, from: &Self) {
        self.value.clone_from(&from.value);
        self.force.clone_from(&from.force);
    }

    /// The block at (row, column), which the layout must hold.
    pub fn at(&mut self, row: usize, column: usize) -> &mut DMat3 {
        let storage = self.storage[row * self.blocks + column];
        debug_assert!(storage != NONE, "interface block ({row}, {column}) is not in the layout");
        &mut self.value[storage as usize]
    }

    /// The block at (row, column), if the layout holds it.
    #[cfg(test)]
    pub(super) fn get(&self, row: usize, column: usize) -> Option<DMat3> {
        let storage = self.storage[row * self.blocks + column];
        (storage != NONE).then(|| self.value[storage as usize])
    }

    /// Adds a block that acts between the points of two attachments; `row_arm` and `column_arm` lead from a
    /// body's origin to its point in the world frame.
    pub fn add(
        &mut self,
        row: Attachment,
        row_arm: DVec3,
        column: Attachment,
        column_arm: DVec3,
        value: DMat3,
    ) {
        for (row_block, row_turn) in parts(row, row_arm) {
            let rows = row_turn.map_or(value, |turn| turn.transpose() * value);
            for (column_block, column_turn) in parts(column, column_arm) {
                *self.at(row_block, column_block) += column_turn.map_or(rows, |turn| rows * turn);
            }
        }
    }

    /// Adds a force at the point of an attachment.
    pub fn push(&mut self, attachment: Attachment, arm: DVec3, force: DVec3) {
        for (block, turn) in parts(attachment, arm) {
            self.force[block] += turn.map_or(force, |turn| turn.transpose() * force);
        }
    }

    /// Move of the point of an attachment.
    pub fn step_of(&self, attachment: Attachment, arm: DVec3) -> DVec3 {
        let moved = |(block, turn): (usize, Option<DMat3>)| {
            turn.map_or(self.step[block], |turn| turn * self.step[block])
        };
        parts(attachment, arm).map(moved).sum()
    }

    /// Slope of `½ xᵀAx - f·x` at a share of a step, for bodies (two blocks each) as assembled.
    pub fn slope(&self, step: &[DVec3], body_block: &[usize], share: f64) -> f64 {
        let mut slope = 0.0;
        for block in body_block {
            for row in [*block, block + 1] {
                let columns = [*block, block + 1];
                let bent: DVec3 = columns
                    .map(|column| {
                        self.value[self.storage[row * self.blocks + column] as usize] * step[column]
                    })
                    .into_iter()
                    .sum();
                slope += share * step[row].dot(bent) - self.force[row].dot(step[row]);
            }
        }
        slope
    }

    /// Factors and solves in place.
    pub fn solve(&mut self) {
        for place in 0..self.order.len() {
            self.eliminate(place);
        }
        for place in (0..self.order.len()).rev() {
            let block = self.order[place];
            let mut right = self.force[block];
            for &other in &self.later[place] {
                right -= self.value[self.storage[block * self.blocks + other] as usize]
                    * self.step[other];
            }
            // The diagonal was replaced by its inverse in `eliminate`.
            self.step[block] =
                self.value[self.storage[block * self.blocks + block] as usize] * right;
        }
    }

    /// Adds a force, or several, at the point of an attachment to another right-hand side.
    pub fn push_again<T: Columns>(
        &self,
        attachment: Attachment,
        arm: DVec3,
        force: T,
        right: &mut [T],
    ) {
        for (block, turn) in parts(attachment, arm) {
            right[block] += turn.map_or(force, |turn| force.by(turn.transpose()));
        }
    }

    /// Solves for another right-hand side, after [`solve`](Self::solve).
    pub fn solve_again<T: Columns>(&self, right: &mut [T], step: &mut [T]) {
        let at = |row: usize, column: usize| {
            self.value[self.storage[row * self.blocks + column] as usize]
        };
        for (place, &block) in self.order.iter().enumerate() {
            let moved = right[block].by(at(block, block));
            for &row in &self.later[place] {
                right[row] -= moved.by(at(row, block));
            }
        }
        for (place, &block) in self.order.iter().enumerate().rev() {
            let mut left = right[block];
            for &other in &self.later[place] {
                left -= step[other].by(at(block, other));
            }
            step[block] = left.by(at(block, block));
        }
    }

    /// Move of the point of an attachment in such a solution.
    pub fn step_again<T: Columns>(&self, attachment: Attachment, arm: DVec3, step: &[T]) -> T {
        let mut sum = T::ZERO;
        for (block, turn) in parts(attachment, arm) {
            sum += turn.map_or(step[block], |turn| step[block].by(turn));
        }
        sum
    }

    fn eliminate(&mut self, place: usize) {
        let block = self.order[place];
        let diagonal = self.storage[block * self.blocks + block] as usize;
        let inverse = self.value[diagonal].inverse();
        self.value[diagonal] = inverse;
        for row_place in 0..self.later[place].len() {
            let row = self.later[place][row_place];
            let across = self.value[self.storage[row * self.blocks + block] as usize] * inverse;
            for column_place in 0..self.later[place].len() {
                let column = self.later[place][column_place];
                let taken =
                    across * self.value[self.storage[block * self.blocks + column] as usize];
                self.value[self.storage[row * self.blocks + column] as usize] -= taken;
            }
            let taken = across * self.force[block];
            self.force[row] -= taken;
        }
    }
}

/// Blocks of an attachment with the 3×3 map from the block's move to the move of the point; no map if the point moves as the
/// block does.
pub(super) fn parts(
    attachment: Attachment,
    arm: DVec3,
) -> impl Iterator<Item = (usize, Option<DMat3>)> {
    let list = match attachment {
        Attachment::Fixed => [None, None],
        Attachment::Free(block) => [Some((block, None)), None],
        Attachment::Body { block, .. } => {
            [Some((block, None)), Some((block + 1, Some(-cross_matrix(arm))))]
        }
    };
    list.into_iter().flatten()
}

/// Greedy order of least degree; `coupled` is completed with the fill.
fn order_of_least_degree(blocks: usize, coupled: &mut [bool]) -> (Vec<usize>, Vec<Vec<usize>>) {
    let mut left: Vec<usize> = (0..blocks).collect();
    let (mut order, mut later) = (Vec::new(), Vec::new());
    while !left.is_empty() {
        let degree =
            |block: &usize| left.iter().filter(|other| coupled[block * blocks + **other]).count();
        let Some(&next) = left.iter().min_by_key(|block| (degree(block), **block)) else { break };
        left.retain(|block| *block != next);
        let neighbours: Vec<usize> =
            left.iter().copied().filter(|other| coupled[next * blocks + other]).collect();
        for &one in &neighbours {
            for &other in &neighbours {
                coupled[one * blocks + other] = true;
            }
        }
        order.push(next);
        later.push(neighbours);
    }
    (order, later)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every block that lines add to a body and a free joint is `Pᵀ V Q`, with the maps from move of block to move of point.
    #[test]
    fn blocks_and_forces_go_through_the_maps_of_their_points() {
        let value = DMat3::from_cols(
            DVec3::new(2.0, 0.3, -0.7),
            DVec3::new(0.4, 3.0, 0.1),
            DVec3::new(-0.2, 0.5, 1.7),
        );
        let (arm, force) = (DVec3::new(0.3, -1.2, 0.8), DVec3::new(5.0, -4.0, 3.0));
        let body = Attachment::Body { block: 1, body: 0, offset: arm };
        let mut interface = InterfaceSystem::new(3, &[(0, 1), (0, 2), (1, 2)]);
        interface.add(body, arm, Attachment::Free(0), DVec3::ZERO, value);
        interface.add(body, arm, body, arm, value);
        interface.push(body, arm, force);
        let turn = -cross_matrix(arm);
        let turned = turn.transpose() * value;
        for (row, column, expected) in [
            (1, 0, value),
            (2, 0, turned),
            (1, 1, value),
            (1, 2, value * turn),
            (2, 1, turned),
            (2, 2, turned * turn),
        ] {
            assert_eq!(*interface.at(row, column), expected, "block ({row}, {column})");
        }
        assert_eq!(interface.force, [DVec3::ZERO, force, arm.cross(force)]);
        interface.step = vec![DVec3::ZERO, DVec3::X, DVec3::new(0.1, 0.2, -0.3)];
        let moved = interface.step_of(body, arm);
        assert_eq!(moved, interface.step_again(body, arm, &interface.step));
        assert!(moved.distance(DVec3::X + interface.step[2].cross(arm)) < 1e-15);
    }

    /// Solves a loop of interface blocks and checks the product with the matrix as it was.
    #[test]
    fn a_loop_of_hubs_is_solved_exactly() {
        let blocks = 5;
        let pairs: Vec<(usize, usize)> =
            (0..blocks).map(|block| (block, (block + 1) % blocks)).collect();
        let mut interface = InterfaceSystem::new(blocks, &pairs);
        let mut dense = vec![DMat3::ZERO; blocks * blocks];
        for (index, &(one, other)) in pairs.iter().enumerate() {
            let size = 1.0 + index as f64;
            let block = DMat3::from_cols(
                DVec3::new(0.3, size, 0.1),
                DVec3::new(-0.2, 0.5, size),
                DVec3::new(0.7, 0.1, 0.4),
            );
            for (row, column, value) in [
                (one, other, block),
                (other, one, block.transpose()),
                (one, one, DMat3::from_diagonal(DVec3::splat(9.0 + size))),
            ] {
                *interface.at(row, column) += value;
                dense[row * blocks + column] += value;
            }
        }
        let right: Vec<DVec3> =
            (0..blocks).map(|block| DVec3::new(1.0, block as f64, -2.0)).collect();
        interface.force.copy_from_slice(&right);
        interface.solve();
        for row in 0..blocks {
            let product: DVec3 = (0..blocks)
                .map(|column| dense[row * blocks + column] * interface.step[column])
                .sum();
            assert!((product - right[row]).length() < 1e-12);
        }
    }
}
