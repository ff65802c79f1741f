//! Free rope eight pieces at a time: the quick way through a solver step, in the lanes of the processor.
//!
//! A rig's lines are cut into pieces (`layout.rs`) that are worked on side by side (`sweep.rs`), each reduced to its ends;
//! the ends of a line's pieces are a short chain of their own (`block_tridiagonal.rs`), and the line's ends join the interface system as ever.
//! The law is the one of `forces.rs`; eight lanes do what one would do eight times, to the bit.

mod layout;
pub(super) mod real;
mod rows;
pub(super) mod space;
mod sweep;

use glam::{DMat3, DVec3};
use pulp::Arch;

use super::block_tridiagonal::{BlockTridiagonal, Ends};
use super::forces::{PerMetre, Shared};
use super::lengths::Lengths;
use super::scheme::Scheme;
use super::trial::Trial;
use crate::model::Model;
use crate::state::RopeState;
use layout::{Group, Piece};
use rows::{
    EndRows, GroundRow, LANES, MoveRows, NodeRow, Row, Row3, Row6, Row9, SegmentRow, Solved,
};
use sweep::{Backward, Forward, GroupRows};

/// Rows of all groups, and the chains of their ends.
#[derive(Clone, Debug)]
pub(crate) struct Lanes {
    arch: Arch,
    pieces: Vec<Piece>,
    /// Pieces of each line, as a range.
    line_pieces: Vec<core::ops::Range<usize>>,
    groups: Vec<Group>,
    nodes: Vec<NodeRow>,
    segments: Vec<SegmentRow>,
    solved: Vec<Solved>,
    /// What the seabed does to nodes, in the layout of `nodes`; empty where no rope is near it.
    ground: Vec<GroundRow>,
    ropes: Vec<PerMetre<Row>>,
    ends: Vec<EndRows>,
    moves: Vec<MoveRows>,
    /// Lengths and cuts the rows were made for.
    lengths: Vec<f64>,
    cut: Vec<bool>,
    /// Ends of pieces in a row: a line's pieces are the segments of a chain.
    chain: BlockTridiagonal,
}

/// What a pass did to the rope.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RopeMoved {
    /// Longest move of a node [m].
    pub longest_m: f64,
    /// Greatest difference between the pull solved for and the tension there, to second order [N].
    pub gap_n: f64,
    /// Greatest tension [N].
    pub greatest_n: f64,
    /// Whether all moves are finite.
    pub finite: bool,
}

impl Lanes {
    /// Rows for a model.
    pub fn new(model: &Model) -> Self {
        let mut pieces = layout::pieces(model);
        let groups = layout::groups(&mut pieces);
        let line_pieces = (0..model.spec.lines.len())
            .map(|line| {
                let first = pieces.partition_point(|piece| piece.line < line);
                first..first + pieces[first..].iter().take_while(|piece| piece.line == line).count()
            })
            .collect();
        let rows = |of: fn(&Group) -> usize| groups.iter().map(of).sum::<usize>();
        let ropes = groups.iter().map(|group| rope_rows(model, &pieces, group)).collect();
        Self {
            arch: Arch::new(),
            line_pieces,
            nodes: vec![NodeRow::default(); rows(|group| group.longest + 3)],
            segments: vec![SegmentRow::default(); rows(|group| group.longest)],
            solved: vec![Solved::default(); rows(|group| group.longest)],
            ground: Vec::new(),
            ropes,
            ends: vec![EndRows::default(); groups.len()],
            moves: vec![MoveRows::default(); groups.len()],
            lengths: Vec::new(),
            cut: Vec::new(),
            chain: BlockTridiagonal::new(pieces.len() + model.spec.lines.len(), pieces.len()),
            pieces,
            groups,
        }
    }

    /// Works with other lanes than the processor's widest.
    #[cfg(test)]
    pub fn set_arch(&mut self, arch: Arch) {
        self.arch = arch;
    }

    /// Whether the lanes know all that this rope can do.
    pub fn suit(&self, model: &Model) -> bool {
        model.sea.field().is_none()
    }

    /// Takes over lengths, laws and what is cut, where they are not those there are.
    pub fn take_lengths(&mut self, model: &Model, lengths: &Lengths, cut: &[bool]) {
        if self.lengths == lengths.segment && self.cut == cut {
            return;
        }
        self.lengths.clone_from(&lengths.segment);
        cut.clone_into(&mut self.cut);
        for group in &self.groups {
            for (lane, piece) in group.pieces.iter().enumerate() {
                let segments = &mut self.segments[group.segment_row..][..group.longest];
                let nodes = &mut self.nodes[group.node_row..][..group.longest + 3];
                let piece = &self.pieces[*piece];
                take_lengths(piece, lane, (&mut *nodes, &mut *segments), lengths, cut);
                if group.bends {
                    take_hinges(model, piece, lane, (nodes, segments), (&lengths.segment, cut));
                }
            }
        }
    }

    /// Takes over the rope as a step begins: `guess` of its places, and the water's velocity there.
    pub fn gather(&mut self, state: &RopeState, scheme: &Scheme, guess: &[DVec3], flow: &[DVec3]) {
        for group in &self.groups {
            let first_nodes = group.pieces.map(|piece| self.pieces[piece].first_node);
            let last_nodes = group
                .pieces
                .map(|piece| self.pieces[piece].first_node + self.pieces[piece].segments);
            for (k, row) in
                self.nodes[group.node_row + 1..][..=group.longest].iter_mut().enumerate()
            {
                for lane in 0..LANES {
                    let node = (first_nodes[lane] + k).min(last_nodes[lane]);
                    row.place.set(lane, guess[node]);
                    row.place_history.set(
                        lane,
                        scheme.history(state.position[node], state.earlier_position[node]),
                    );
                    row.velocity_history.set(
                        lane,
                        scheme.history(state.velocity[node], state.earlier_velocity[node]),
                    );
                    row.flow.set(lane, flow[node]);
                }
            }
            for lane in 0..group.used {
                let piece = &self.pieces[group.pieces[lane]];
                let segments = &mut self.segments[group.segment_row..][..piece.segments];
                for (row, tension) in segments.iter_mut().zip(&state.tension[piece.first_segment..])
                {
                    row.tension.0[lane] = *tension;
                }
            }
        }
        self.refresh_ghosts();
    }

    /// Takes what the seabed does to nodes: forces and blocks, of which the symmetric part is kept (Newton then comes to the
    /// same balance, a little slower where rope slides).
    pub fn take_ground(&mut self, force: &[DVec3], block: &[DMat3]) {
        self.ground.resize(self.nodes.len(), GroundRow::default());
        for piece in &self.pieces {
            let rows = &mut self.ground[self.groups[piece.group].node_row + 1..][..=piece.segments];
            for (k, row) in rows.iter_mut().enumerate() {
                let node = piece.first_node + k;
                // Where two pieces meet, the first carries it.
                let carried = k > 0 || !piece.follows;
                row.set(
                    piece.lane,
                    if carried { (force[node], block[node]) } else { (DVec3::ZERO, DMat3::ZERO) },
                );
            }
        }
    }

    /// Forgets the seabed.
    pub fn leave_ground(&mut self) {
        self.ground.clear();
    }

    /// Places of all nodes.
    pub fn give_places(&self, place: &mut [DVec3]) {
        for piece in &self.pieces {
            let rows = &self.nodes[self.groups[piece.group].node_row + 1..][..=piece.segments];
            for (place, row) in place[piece.first_node..].iter_mut().zip(rows) {
                *place = row.place.vector(piece.lane);
            }
        }
    }

    /// Forces, matrix and elimination of every piece, and of the chains of their ends.
    pub fn reduce(&mut self, shared: &Shared<f64>) {
        for (index, group) in self.groups.iter().enumerate() {
            let ground = self.ground.get(group.node_row..).unwrap_or_default();
            let rows = group_rows(
                group,
                (&mut self.nodes, &mut self.segments, &mut self.solved),
                ground,
                &self.ropes[index],
                shared,
            );
            self.arch.dispatch(Forward(rows, &mut self.ends[index]));
        }
        self.chain.clear();
        for (index, piece) in self.pieces.iter().enumerate() {
            let (ends, lane, node) = (&self.ends[piece.group], piece.lane, index + piece.line);
            self.chain.diagonal[node] += ends.aa.matrix(lane);
            self.chain.diagonal[node + 1] += ends.bb.matrix(lane);
            self.chain.force[node] += ends.force_a.vector(lane);
            self.chain.force[node + 1] += ends.force_b.vector(lane);
            let low = ends.ba.matrix(lane);
            self.chain.low[index] = low;
            self.chain.up[index] = low.transpose();
        }
    }

    /// What a line leaves on its ends.
    pub fn line_ends(&mut self, line: usize, a_moves: bool) -> Ends {
        let pieces = self.line_pieces[line].clone();
        self.chain.eliminate(&chain_nodes(line, &pieces), &pieces, a_moves)
    }

    /// Takes the moves of a line's ends.
    pub fn move_ends(&mut self, line: usize, a_moves: bool, step_a: DVec3, step_b: DVec3) {
        let pieces = self.line_pieces[line].clone();
        self.chain.substitute(&chain_nodes(line, &pieces), &pieces, a_moves, step_a, step_b);
    }

    /// Moves every node by the solved step and predicts tensions.
    pub fn advance(&mut self, shared: &Shared<f64>) -> RopeMoved {
        let mut moved = RopeMoved { finite: true, ..RopeMoved::default() };
        for (index, group) in self.groups.iter().enumerate() {
            let mut ends = [Row3::default(); 2];
            for (lane, piece) in group.pieces.iter().enumerate() {
                let node = piece + self.pieces[*piece].line;
                ends[0].set(lane, self.chain.step[node]);
                ends[1].set(lane, self.chain.step[node + 1]);
            }
            let ground = self.ground.get(group.node_row..).unwrap_or_default();
            let rows = group_rows(
                group,
                (&mut self.nodes, &mut self.segments, &mut self.solved),
                ground,
                &self.ropes[index],
                shared,
            );
            self.arch.dispatch(Backward(rows, &ends, &mut self.moves[index]));
            for lane in 0..group.used {
                let moves = &self.moves[index];
                moved.longest_m = moved.longest_m.max(moves.longest.0[lane]);
                moved.gap_n = moved.gap_n.max(moves.gap.0[lane]);
                moved.greatest_n = moved.greatest_n.max(moves.greatest.0[lane]);
                moved.finite &= moves.finite.0[lane].is_finite();
            }
        }
        moved.longest_m = moved.longest_m.sqrt();
        moved
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

    /// Takes the places of all line ends from the trial, where joints and bodies have put them.
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

    /// Node `k` of a piece.
    fn node(&self, piece: usize, k: usize) -> &NodeRow {
        &self.nodes[self.groups[self.pieces[piece].group].node_row + 1 + k]
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
            let behind = if piece.goes_on { (index + 1, 1) } else { (index, piece.segments) };
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

/// Nodes of a line's chain of pieces.
fn chain_nodes(line: usize, pieces: &core::ops::Range<usize>) -> core::ops::Range<usize> {
    pieces.start + line..pieces.end + line + 1
}

fn group_rows<'a>(
    group: &'a Group,
    (nodes, segments, solved): (&'a mut [NodeRow], &'a mut [SegmentRow], &'a mut [Solved]),
    ground: &'a [GroundRow],
    rope: &'a PerMetre<Row>,
    shared: &'a Shared<f64>,
) -> GroupRows<'a> {
    GroupRows {
        nodes: &mut nodes[group.node_row..][..group.longest + 3],
        segments: &mut segments[group.segment_row..][..group.longest],
        solved: &mut solved[group.segment_row..][..group.longest],
        ground,
        shortest: group.shortest,
        live: &group.live,
        anchored: group.anchored,
        bends: group.bends,
        rope,
        shared,
    }
}

fn rope_rows(model: &Model, pieces: &[Piece], group: &Group) -> PerMetre<Row> {
    let rope_of = |piece: usize| &model.spec.ropes[model.spec.lines[pieces[piece].line].rope];
    let ropes = group.pieces.map(|piece| PerMetre::of(rope_of(piece), &model.spec.water));
    let row = |of: fn(&PerMetre<f64>) -> f64| Row(ropes.map(|rope| of(&rope)));
    PerMetre {
        mass: row(|rope| rope.mass),
        added: row(|rope| rope.added),
        spared: row(|rope| rope.spared),
        weight: row(|rope| rope.weight),
        lift: row(|rope| rope.lift),
        across: row(|rope| rope.across),
        along: row(|rope| rope.along),
    }
}

fn take_lengths(
    piece: &Piece,
    lane: usize,
    (nodes, segments): (&mut [NodeRow], &mut [SegmentRow]),
    lengths: &Lengths,
    cut: &[bool],
) {
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
fn take_hinges(
    model: &Model,
    piece: &Piece,
    lane: usize,
    (nodes, segments): (&mut [NodeRow], &mut [SegmentRow]),
    (length, cut): (&[f64], &[bool]),
) {
    let bending = model.spec.ropes[model.spec.lines[piece.line].rope].bending_stiffness_n_m2;
    for (k, row) in nodes[1..][..=piece.segments].iter_mut().enumerate() {
        let behind = piece.first_segment + k;
        let is_inner = (k > 0 || piece.follows) && (k < piece.segments || piece.goes_on);
        let bends = is_inner && !cut[behind - 1] && !cut[behind];
        let [one, other] = if bends { [length[behind - 1], length[behind]] } else { [1.0, 1.0] };
        row.hinge.0[lane] = if bends { 2.0 * bending / (one + other) } else { 0.0 };
        (row.inverse_before.0[lane], row.inverse_behind.0[lane]) = (1.0 / one, 1.0 / other);
    }
    for (k, row) in segments[..piece.segments].iter_mut().enumerate() {
        let hinges = nodes[k + 1].hinge.0[lane] + nodes[k + 2].hinge.0[lane];
        row.bending.0[lane] = hinges * row.inverse_length.0[lane] * row.inverse_length.0[lane];
    }
}

impl Row3 {
    fn set(&mut self, lane: usize, v: DVec3) {
        for (row, value) in self.0.iter_mut().zip(v.to_array()) {
            row.0[lane] = value;
        }
    }
    fn vector(&self, lane: usize) -> DVec3 {
        DVec3::from_array([self.0[0].0[lane], self.0[1].0[lane], self.0[2].0[lane]])
    }
}

impl GroundRow {
    fn set(&mut self, lane: usize, (force, block): (DVec3, DMat3)) {
        self.force.set(lane, force);
        let [x, y, z] = [block.x_axis, block.y_axis, block.z_axis];
        let half = [x.x, 0.5 * (x.y + y.x), 0.5 * (x.z + z.x), y.y, 0.5 * (y.z + z.y), z.z];
        for (row, value) in self.block.0.iter_mut().zip(half) {
            row.0[lane] = value;
        }
    }
}

impl Row6 {
    fn matrix(&self, lane: usize) -> DMat3 {
        let [xx, xy, xz, yy, yz, zz] = [0, 1, 2, 3, 4, 5].map(|entry: usize| self.0[entry].0[lane]);
        DMat3::from_cols(DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz))
    }
}

impl Row9 {
    fn matrix(&self, lane: usize) -> DMat3 {
        DMat3::from_cols(self.0[0].vector(lane), self.0[1].vector(lane), self.0[2].vector(lane))
    }
}

const _: () = assert!(LANES == 8, "rows are laid out for eight lanes");
