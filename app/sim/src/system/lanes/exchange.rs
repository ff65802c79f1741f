//! Exchange between lanes and the rest of the solver: lengths, places, the seabed, contact and the ends of lines go in; places,
//! tensions and ends of lines come out.

use crate::bits::same_bits;
use crate::forces::rope::Lengths;
use crate::model::Model;
use crate::state::RopeState;
use crate::system::lanes::Lanes;
use crate::system::lanes::layout::{Group, Piece};
use crate::system::lanes::rows::{ContactRow, GroundRow, NodeRow, SegmentRow};
use crate::trial::Trial;
use crate::trial::scheme::Scheme;
use glam::{DMat3, DVec3};
use pulp::{Simd, WithSimd};

impl Lanes {
    /// Copies lengths, laws and cuts of segments, if they have changed.
    pub fn take_lengths(&mut self, model: &Model, lengths: &Lengths, cut: &[bool]) {
        if same_bits(&self.lengths, &lengths.segment) && self.cut == cut {
            return;
        }
        self.lengths.clone_from(&lengths.segment);
        cut.clone_into(&mut self.cut);
        for group in &self.groups {
            for (lane, piece) in group.pieces.iter().enumerate() {
                let segments = &mut self.segments[group.segment_row..][..group.longest];
                let nodes = &mut self.nodes[group.node_row..][..group.longest + 3];
                let piece = &self.pieces[*piece];
                let mut rows = PieceRows { lane, nodes, segments };
                rows.take_lengths(piece, lengths, cut);
                if group.bends {
                    rows.take_hinges(model, piece, &lengths.segment, cut);
                }
            }
        }
    }

    /// Copies the rope at the start of a step: the predictor of its places, and the velocity of the water there.
    pub fn gather(&mut self, state: &RopeState, scheme: &Scheme, guess: &[DVec3], flow: &[DVec3]) {
        self.arch.dispatch(Gather {
            pieces: &self.pieces,
            groups: &self.groups,
            nodes: &mut self.nodes,
            segments: &mut self.segments,
            state,
            scheme,
            guess,
            flow,
        });
        self.refresh_ghosts();
    }

    /// Copies the places of all nodes.
    pub fn take_places(&mut self, place: &[DVec3]) {
        for group in &self.groups {
            for (lane, piece) in group.pieces.iter().enumerate() {
                let Piece { first_node, segments, .. } = self.pieces[*piece];
                for k in 0..=group.longest {
                    let row = &mut self.nodes[group.node_row + 1 + k];
                    row.place.set(lane, place[first_node + k.min(segments)]);
                }
            }
        }
        self.refresh_ghosts();
    }

    /// Copies forces and blocks of the seabed on nodes. Of the blocks the symmetric part is used: Newton converges to the same
    /// balance, a little slower where rope slides.
    pub fn take_ground(&mut self, force: &[DVec3], block: &[DMat3]) {
        self.ground.resize(self.nodes.len(), GroundRow::default());
        for piece in &self.pieces {
            let rows = &mut self.ground[self.groups[piece.group].node_row + 1..][..=piece.segments];
            let nodes = piece.first_node..piece.first_node + rows.len();
            let values = force[nodes.clone()].iter().zip(&block[nodes]);
            for (row, (force, block)) in rows.iter_mut().zip(values) {
                row.set(piece.lane, (*force, *block));
            }
            if piece.follows {
                // Where two pieces meet, the first carries it.
                rows[0].set(piece.lane, (DVec3::ZERO, DMat3::ZERO));
            }
        }
    }

    /// Removes the seabed.
    pub fn leave_ground(&mut self) {
        self.ground.clear();
    }

    /// Copies the places of all line ends from the trial, where joints and bodies are.
    pub fn take_ends(&mut self, model: &Model, trial: &Trial) {
        for line in 0..self.line_pieces.len() {
            let (pieces, nodes) = (self.line_pieces[line].clone(), &model.line_nodes[line]);
            self.put_place(pieces.start, 0, trial.place[nodes.start]);
            self.put_place(
                pieces.end - 1,
                self.pieces[pieces.end - 1].segments,
                trial.place[nodes.end - 1],
            );
        }
        self.refresh_ghosts();
    }

    fn put_place(&mut self, piece: usize, k: usize, place: DVec3) {
        let Piece { group, lane, .. } = self.pieces[piece];
        let row = self.groups[group].node_row + 1 + k;
        self.nodes[row].place.set(lane, place);
    }

    /// Puts before and behind each piece the node that the line has there, or at a line's end that end again.
    fn refresh_ghosts(&mut self) {
        for index in 0..self.pieces.len() {
            let piece = self.pieces[index];
            let before = if piece.follows {
                (index - 1, self.pieces[index - 1].segments - 1)
            } else {
                (index, 0)
            };
            let behind = if piece.continues { (index + 1, 1) } else { (index, piece.segments) };
            let place_of = |(piece, k): (usize, usize)| {
                self.node(piece, k).place.vector(self.pieces[piece].lane)
            };
            let (before, behind) = (place_of(before), place_of(behind));
            let first = self.groups[piece.group].node_row;
            self.nodes[first].place.set(piece.lane, before);
            self.nodes[first + piece.segments + 2].place.set(piece.lane, behind);
        }
    }
}

/// The copy of rope at the start of a step, compiled for the instructions that the processor has; its bits do not depend on them.
struct Gather<'a> {
    pieces: &'a [Piece],
    groups: &'a [Group],
    nodes: &'a mut [NodeRow],
    segments: &'a mut [SegmentRow],
    state: &'a RopeState,
    scheme: &'a Scheme,
    guess: &'a [DVec3],
    flow: &'a [DVec3],
}

impl WithSimd for Gather<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { pieces, groups, nodes, segments, state, .. } = self;
        for group in groups {
            for (lane, piece) in group.pieces.iter().enumerate() {
                let piece = &pieces[*piece];
                let rows = &mut nodes[group.node_row + 1..][..=group.longest];
                let (own, beyond) = rows.split_at_mut(piece.segments + 1);
                let range = piece.first_node..piece.first_node + own.len();
                let ends = state.position[range.clone()]
                    .iter()
                    .zip(&state.earlier_position[range.clone()]);
                let speeds = state.velocity[range.clone()]
                    .iter()
                    .zip(&state.earlier_velocity[range.clone()]);
                let inputs = self.guess[range.clone()].iter().zip(&self.flow[range]);
                for (row, ((places, speeds), (guess, flow))) in
                    own.iter_mut().zip(ends.zip(speeds).zip(inputs))
                {
                    row.place.set(lane, *guess);
                    row.place_history.set(lane, self.scheme.history(*places.0, *places.1));
                    row.velocity_history.set(lane, self.scheme.history(*speeds.0, *speeds.1));
                    row.flow.set(lane, *flow);
                }
                // Rows beyond its end hold copies of its last node.
                let last = own[piece.segments];
                for row in beyond {
                    row.place.set(lane, last.place.vector(lane));
                    row.place_history.set(lane, last.place_history.vector(lane));
                    row.velocity_history.set(lane, last.velocity_history.vector(lane));
                    row.flow.set(lane, last.flow.vector(lane));
                }
            }
            for (lane, piece) in group.pieces[..group.used].iter().enumerate() {
                let piece = &pieces[*piece];
                let rows = &mut segments[group.segment_row..][..piece.segments];
                for (row, tension) in rows.iter_mut().zip(&state.tension[piece.first_segment..]) {
                    row.tension.0[lane] = *tension;
                }
            }
        }
    }
}

/// Rows of a piece, and its lane in them.
struct PieceRows<'a> {
    lane: usize,
    nodes: &'a mut [NodeRow],
    segments: &'a mut [SegmentRow],
}

impl PieceRows<'_> {
    /// Copies lengths and laws of a piece.
    fn take_lengths(&mut self, piece: &Piece, lengths: &Lengths, cut: &[bool]) {
        let Self { lane, nodes, segments } = self;
        let lane = *lane;
        let mut half_before = 0.0;
        for k in 0..piece.segments {
            let (row, segment) = (&mut segments[k], piece.first_segment + k);
            let (length, law) = (lengths.segment[segment], &lengths.axial[segment]);
            let whole = if cut[segment] { 0.0 } else { 1.0 };
            row.length.0[lane] = length;
            row.inverse_length.0[lane] = 1.0 / length;
            row.ea.0[lane] = law.ea * whole;
            row.ea2.0[lane] = law.ea2 * whole;
            row.damping.0[lane] = law.damping * whole;
            nodes[k + 1].length.0[lane] = half_before + 0.5 * length;
            half_before = 0.5 * length;
        }
        nodes[piece.segments + 1].length.0[lane] = half_before;
    }

    /// Hinges of a piece, those where it meets the next included: `c = EI/L` at a node that is neither a line's end nor at a cut.
    fn take_hinges(&mut self, model: &Model, piece: &Piece, length: &[f64], cut: &[bool]) {
        let Self { lane, nodes, segments } = self;
        let lane = *lane;
        let bending = model.spec.ropes[model.spec.lines[piece.line].rope].bending_stiffness_n_m2;
        for (k, row) in nodes[1..][..=piece.segments].iter_mut().enumerate() {
            let behind = piece.first_segment + k;
            let is_inner = (k > 0 || piece.follows) && (k < piece.segments || piece.continues);
            let bends = is_inner && !cut[behind - 1] && !cut[behind];
            let [one, other] =
                if bends { [length[behind - 1], length[behind]] } else { [1.0, 1.0] };
            row.hinge.0[lane] = if bends { 2.0 * bending / (one + other) } else { 0.0 };
            (row.inverse_before.0[lane], row.inverse_behind.0[lane]) = (1.0 / one, 1.0 / other);
        }
        for (k, row) in segments[..piece.segments].iter_mut().enumerate() {
            let hinges = nodes[k + 1].hinge.0[lane] + nodes[k + 2].hinge.0[lane];
            row.bending.0[lane] = hinges * row.inverse_length.0[lane] * row.inverse_length.0[lane];
        }
    }
}

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
            let nodes = piece.first_node..piece.first_node + rows.len();
            let places = state.position[nodes.clone()].iter_mut();
            for (row, (to, velocity)) in rows.iter().zip(places.zip(&mut state.velocity[nodes])) {
                let place = row.place.vector(piece.lane);
                *to = place;
                *velocity = (place - row.place_history.vector(piece.lane)) * scheme.rate;
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

    /// Adds a force at a fraction of a segment.
    pub fn add_force(&mut self, segment: usize, fraction: f64, force: DVec3) {
        let (row, lane) = self.contact_row(segment);
        for (row, share) in [(row, 1.0 - fraction), (row + 1, fraction)] {
            self.contact[row].force.add(lane, force * share);
        }
    }

    /// Adds a force and its block `-dF/dx` at a fraction of a segment.
    pub fn add_contact(&mut self, segment: usize, fraction: f64, force: DVec3, block: &DMat3) {
        let (row, lane) = self.contact_row(segment);
        let (first, second) = (1.0 - fraction, fraction);
        for (row, share) in [(row, first), (row + 1, second)] {
            self.contact[row].force.add(lane, force * share);
            self.contact[row].block.add(lane, &(*block * (share * share)));
        }
        self.contact[row].coupling.add(lane, &(*block * (first * second)));
    }

    /// Row of contact of a segment's first node, and its lane; this row and the next are in use from now on.
    fn contact_row(&mut self, segment: usize) -> (usize, usize) {
        debug_assert_eq!(self.contact.len(), self.nodes.len(), "contact in the layout of nodes");
        let Piece { group, lane, first_segment, .. } = self.pieces[self.piece_of[segment]];
        let first = self.groups[group].node_row + 1 + segment - first_segment;
        // A row may be noted twice, which does no harm: points of neighbouring segments come one after the other, so that most rows
        // are found among the last three.
        for row in [first, first + 1] {
            let last = self.contact_rows.len().saturating_sub(3);
            if !self.contact_rows[last..].contains(&row) {
                self.contact_rows.push(row);
            }
        }
        self.touches[group] = true;
        (first, lane)
    }
}
