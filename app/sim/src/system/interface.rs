//! Direct solve of the interface system: free joints (one 3×3 block) and bodies (place and rotation, two blocks).
//!
//! Lines reduced to their ends couple interface blocks pairwise. The matrix is sparse (`sparse.rs`): gear that is a tree has no
//! fill, a loop has a few blocks.

use glam::{DMat3, DVec3};

use crate::matrix::{cross_matrix, cross_times, times_cross};
use crate::model::Model;
use crate::system::sparse::{BlockSparse, Place};
use crate::trial::plan::{Attachment, Plan};

/// Matrix, force and solution of the interface.
#[derive(Clone, Debug, Default)]
pub(crate) struct InterfaceSystem {
    matrix: BlockSparse,
    /// Force out of balance.
    pub force: Vec<DVec3>,
    /// Solution.
    pub step: Vec<DVec3>,
}

impl InterfaceSystem {
    /// Lays out the matrix for `blocks` blocks coupled in these pairs; matrix and forces become zero.
    pub fn lay_out(&mut self, blocks: usize, pairs: impl Iterator<Item = (usize, usize)>) {
        self.matrix.lay_out(blocks, pairs);
        for list in [&mut self.force, &mut self.step] {
            list.clear();
            list.resize(blocks, DVec3::ZERO);
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
        let mut system = Self::default();
        system.lay_out(free + 2 * plan.body_block.len(), pairs.into_iter());
        system
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        self.matrix.unknowns()
    }

    /// Pairs of blocks that the layout couples.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        self.matrix.pairs()
    }

    /// Empties matrix and forces for a new pass.
    pub fn clear(&mut self) {
        self.matrix.clear();
        self.force.fill(DVec3::ZERO);
    }

    /// Copies matrix and forces of a system of the same layout.
    pub fn copy_values(&mut self, from: &Self) {
        self.matrix.copy_values(&from.matrix);
        self.force.clone_from(&from.force);
    }

    /// Adds matrix and forces of a smaller system, whose blocks the layout must hold.
    pub fn add_all(&mut self, from: &Self) {
        self.matrix.add_all(&from.matrix);
        self.force.iter_mut().zip(&from.force).for_each(|(sum, force)| *sum += *force);
    }

    /// The block at (row, column), which the layout must hold.
    pub fn at(&mut self, row: usize, column: usize) -> &mut DMat3 {
        self.matrix.at(row, column)
    }

    /// The block at (row, column), if the layout holds it.
    #[cfg(test)]
    pub(super) fn get(&self, row: usize, column: usize) -> Option<DMat3> {
        self.matrix.holds(row, column).then(|| self.matrix.get(row, column))
    }

    /// Where the block at (row, column) is, which the layout must hold.
    pub fn place_of(&self, row: usize, column: usize) -> Place {
        self.matrix.place_of(row, column)
    }

    /// Adds a block at its place.
    pub fn add_at(&mut self, place: Place, value: DMat3) {
        *self.matrix.at_place(place) += value;
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
        let (Some((row, turns)), Some((column, column_turns))) = (first(row), first(column)) else {
            return;
        };
        *self.at(row, column) += value;
        if column_turns {
            *self.at(row, column + 1) -= times_cross(&value, column_arm);
        }
        if turns {
            let moment = cross_times(row_arm, &value);
            *self.at(row + 1, column) += moment;
            if column_turns {
                *self.at(row + 1, column + 1) -= times_cross(&moment, column_arm);
            }
        }
    }

    /// Adds a force at the point of an attachment.
    pub fn push(&mut self, attachment: Attachment, arm: DVec3, force: DVec3) {
        if let Some((block, turns)) = first(attachment) {
            self.force[block] += force;
            if turns {
                self.force[block + 1] += arm.cross(force);
            }
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
                    .map(|column| self.matrix.get(row, column) * step[column])
                    .into_iter()
                    .sum();
                slope += share * step[row].dot(bent) - self.force[row].dot(step[row]);
            }
        }
        slope
    }

    /// Factors and solves in place.
    pub fn solve(&mut self) {
        self.matrix.solve(&mut self.force, &mut self.step);
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

/// First block of an attachment, and whether it is that of a body, whose rotation has the next block.
#[inline]
fn first(attachment: Attachment) -> Option<(usize, bool)> {
    match attachment {
        Attachment::Fixed => None,
        Attachment::Free(block) => Some((block, false)),
        Attachment::Body { block, .. } => Some((block, true)),
    }
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
        let mut interface = InterfaceSystem::default();
        interface.lay_out(3, [(0, 1), (0, 2), (1, 2)].into_iter());
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
        assert!(moved.distance(DVec3::X + interface.step[2].cross(arm)) < 1e-15);
    }

    /// Solves a loop of interface blocks and checks the product with the matrix as it was.
    #[test]
    fn a_loop_of_hubs_is_solved_exactly() {
        let blocks = 5;
        let pairs: Vec<(usize, usize)> =
            (0..blocks).map(|block| (block, (block + 1) % blocks)).collect();
        let mut interface = InterfaceSystem::default();
        interface.lay_out(blocks, pairs.iter().copied());
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
