//! Contact of rope in the lanes: push, friction and their blocks, put to the nodes and couplings of the pieces that touch.

use glam::{DMat3, DVec3};

use crate::system::lanes::Lanes;
use crate::system::lanes::rows::ContactRow;

impl Lanes {
    /// First node of a segment.
    pub fn first_node_of(&self, segment: usize) -> usize {
        let piece = &self.pieces[self.piece_of[segment]];
        piece.first_node + segment - piece.first_segment
    }

    /// Removes all contact.
    pub fn clear_contact(&mut self) {
        self.contact.resize(self.nodes.len(), ContactRow::default());
        for row in self.contact_rows.drain(..) {
            self.contact[row] = ContactRow::default();
        }
        self.touches.fill(false);
    }

    /// Adds a force and its block `-dF/dx` at a fraction of a segment.
    pub fn add_contact(&mut self, segment: usize, fraction: f64, force: DVec3, block: &DMat3) {
        let piece = &self.pieces[self.piece_of[segment]];
        let row = self.groups[piece.group].node_row + 1 + segment - piece.first_segment;
        let (lane, first, second) = (piece.lane, 1.0 - fraction, fraction);
        for (row, share) in [(row, first), (row + 1, second)] {
            self.contact[row].force.add(lane, force * share);
            self.contact[row].block.add(lane, &(*block * (share * share)));
        }
        self.contact[row].coupling.add(lane, &(*block * (first * second)));
        // A row may be noted twice, which does no harm: points of neighbouring segments come one after the other, so that most rows
        // are found among the last three.
        for row in [row, row + 1] {
            let last = self.contact_rows.len().saturating_sub(3);
            if !self.contact_rows[last..].contains(&row) {
                self.contact_rows.push(row);
            }
        }
        self.touches[piece.group] = true;
    }
}
