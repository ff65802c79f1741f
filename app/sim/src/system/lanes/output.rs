//! Copies rope out of the lanes: places, tensions, and the ends of lines.

use glam::DVec3;

use crate::model::Model;
use crate::state::RopeState;
use crate::system::lanes::Lanes;
use crate::trial::Trial;
use crate::trial::scheme::Scheme;

impl Lanes {
    /// Places of all nodes.
    pub fn give_places(&self, place: &mut [DVec3]) {
        for piece in &self.pieces {
            let rows = &self.nodes[self.groups[piece.group].node_row + 1..][..=piece.segments];
            for (place, row) in place[piece.first_node..].iter_mut().zip(rows) {
                *place = row.place.vector(piece.lane);
            }
        }
    }

    /// Pull at an end of a line in the last solve: direction from its first node to its second, and tension predicted [N].
    pub fn end_pull(&self, line: usize, at_b: bool) -> (DVec3, f64) {
        let pieces = &self.line_pieces[line];
        let piece = &self.pieces[if at_b { pieces.end - 1 } else { pieces.start }];
        let row = self.groups[piece.group].segment_row + if at_b { piece.segments - 1 } else { 0 };
        (self.solved[row].direction.vector(piece.lane), self.segments[row].tension.0[piece.lane])
    }

    /// Hands the places of all line ends to the trial.
    pub fn give_ends(&self, model: &Model, trial: &mut Trial) {
        for (line, pieces) in self.line_pieces.iter().enumerate() {
            let nodes = &model.line_nodes[line];
            trial.place[nodes.start] =
                self.node(pieces.start, 0).place.vector(self.pieces[pieces.start].lane);
            let last = &self.pieces[pieces.end - 1];
            trial.place[nodes.end - 1] =
                self.node(pieces.end - 1, last.segments).place.vector(last.lane);
        }
    }

    /// Hands the rope to the state as a step ends.
    pub fn keep(&self, scheme: &Scheme, state: &mut RopeState) {
        core::mem::swap(&mut state.earlier_position, &mut state.position);
        core::mem::swap(&mut state.earlier_velocity, &mut state.velocity);
        for piece in &self.pieces {
            let group = &self.groups[piece.group];
            let rows = &self.nodes[group.node_row + 1..][..=piece.segments];
            for (row, node) in rows.iter().zip(piece.first_node..) {
                let place = row.place.vector(piece.lane);
                state.position[node] = place;
                state.velocity[node] = (place - row.place_history.vector(piece.lane)) * scheme.rate;
            }
        }
        self.give_tension(&mut state.tension);
    }

    /// Hands tensions over as the last solve predicted them.
    pub fn give_tension(&self, tension: &mut [f64]) {
        for piece in &self.pieces {
            let rows = &self.segments[self.groups[piece.group].segment_row..][..piece.segments];
            for (tension, row) in tension[piece.first_segment..].iter_mut().zip(rows) {
                *tension = row.tension.0[piece.lane];
            }
        }
    }
}
