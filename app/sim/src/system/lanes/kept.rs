//! Nodes inside pieces that stay unknowns of the linear system, because other rope presses on them.
//!
//! At such a node the forward sweep ends a span of rope and begins the next; the backward sweep takes its move as given.

use glam::DVec3;

use crate::simd::rows::{Row, Row3};
use crate::system::lanes::layout::{Group, Piece};
use crate::system::lanes::rows::EndRows;

/// Kept nodes in one row of a group.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct KeptRow {
    /// 1 in lanes whose node is kept.
    pub mask: Row,
    /// Matrix and force of the span that ends here, reduced to its ends.
    pub ends: EndRows,
    /// Move of the node, and of the first node of the span that ends here.
    pub step: Row3,
    pub before: Row3,
}

/// Kept nodes of all groups.
#[derive(Clone, Debug, Default)]
pub(crate) struct Kept {
    /// The nodes, in order; those between two pieces included.
    nodes: Vec<usize>,
    rows: Vec<KeptRow>,
    /// For each row of segments, which of `rows` belongs to its first node, plus 1; 0 if that is not kept in any lane.
    row_of: Vec<u32>,
    /// Whether a group has rows.
    in_group: Vec<bool>,
    /// Move of the first node of the last span of each piece.
    last: Vec<DVec3>,
}

/// Kept rows for a sweep over one group.
pub(crate) struct KeptRows<'a> {
    rows: &'a mut [KeptRow],
    /// As in [`Kept`]; empty if the group has no rows.
    row_of: &'a [u32],
}

impl Kept {
    /// No kept nodes, for these pieces in groups.
    pub fn new(pieces: usize, groups: &[Group]) -> Self {
        let rows = groups.iter().map(|group| group.longest).sum();
        Self {
            row_of: vec![0; rows],
            in_group: vec![false; groups.len()],
            last: vec![DVec3::ZERO; pieces],
            ..Self::default()
        }
    }

    /// Whether no node is kept.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Whether a node inside a piece of the group is kept.
    pub fn is_in(&self, group: usize) -> bool {
        self.in_group[group]
    }

    /// Keeps these nodes, in rising order, and no others.
    pub fn set(&mut self, nodes: &[usize], pieces: &[Piece], groups: &[Group]) {
        debug_assert!(nodes.is_sorted(), "kept nodes in rising order");
        if self.nodes == nodes {
            return;
        }
        self.nodes.clear();
        self.nodes.extend_from_slice(nodes);
        self.rows.clear();
        self.row_of.fill(0);
        self.in_group.fill(false);
        let mut piece = 0;
        for node in nodes {
            while piece + 1 < pieces.len() && pieces[piece + 1].first_node <= *node {
                piece += 1;
            }
            let Piece { first_node, segments, group, lane, .. } = pieces[piece];
            let k = node - first_node;
            if k == 0 || k >= segments {
                continue;
            }
            let row_of = &mut self.row_of[groups[group].segment_row + k];
            if *row_of == 0 {
                self.rows.push(KeptRow::default());
                *row_of = self.rows.len() as u32;
            }
            self.rows[*row_of as usize - 1].mask.0[lane] = 1.0;
            self.in_group[group] = true;
        }
    }

    /// The rows of a group, for a sweep.
    pub fn rows_of(&mut self, index: usize, group: &Group) -> KeptRows<'_> {
        let row_of = &self.row_of[group.segment_row..][..group.longest];
        KeptRows { rows: &mut self.rows, row_of: if self.in_group[index] { row_of } else { &[] } }
    }

    /// The row of node `k` of a piece, which is kept.
    pub fn row(&self, group: &Group, k: usize) -> &KeptRow {
        &self.rows[self.row_of[group.segment_row + k] as usize - 1]
    }

    /// Sets the moves of node `k` of a piece, which is kept, and of the first node of the span that ends there.
    pub fn move_row(
        &mut self,
        (group, lane): (&Group, usize),
        k: usize,
        [before, step]: [DVec3; 2],
    ) {
        let row = &mut self.rows[self.row_of[group.segment_row + k] as usize - 1];
        row.before.set(lane, before);
        row.step.set(lane, step);
    }

    /// Move of the first node of the last span of a piece.
    pub fn last(&self, piece: usize) -> DVec3 {
        self.last[piece]
    }

    /// Sets the move of the first node of the last span of a piece.
    pub fn set_last(&mut self, piece: usize, step: DVec3) {
        self.last[piece] = step;
    }
}

impl KeptRows<'_> {
    /// Whether the group has no kept nodes.
    pub fn is_empty(&self) -> bool {
        self.row_of.is_empty()
    }

    /// The row of node `k`, if that is kept in any lane.
    #[inline(always)]
    pub fn get(&mut self, k: usize) -> Option<&mut KeptRow> {
        let row = *self.row_of.get(k)? as usize;
        self.rows.get_mut(row.checked_sub(1)?)
    }
}
