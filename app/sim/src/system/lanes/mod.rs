//! Rope held as lanes: eight pieces of rope side by side in the lanes of the processor.
//!
//! Lines are cut into pieces (`layout.rs`) that are evaluated side by side (`sweep`), each reduced to its ends.
//! Rope is copied in and out by `exchange.rs`. The ends of the pieces of a line form a short chain (`block_tridiagonal.rs`), and the ends
//! of the line join the interface system. Where other rope presses, nodes are kept as unknowns (`kept.rs`). The force laws are those of
//! `forces/laws.rs`; eight lanes give the bits of eight single evaluations.

mod exchange;
mod kept;
mod layout;
mod rows;
mod sweep;

use glam::DVec3;
use pulp::Arch;

use crate::forces::laws::{PerMetre, Shared};
use crate::model::Model;
use crate::simd::rows::{LANES, Row, Row3};
use crate::system::block_tridiagonal::{BlockTridiagonal, Ends};
use kept::Kept;
use layout::{Group, Piece};
use rows::{ContactRow, EndRows, GroundRow, MoveRows, NodeRow, SegmentRow, Solved};
use sweep::{Backward, Forward, ForwardContact, GroupRows};

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
    /// Force and block of the seabed on nodes, in the layout of `nodes`; empty if no rope is near it.
    ground: Vec<GroundRow>,
    /// Force and block of skin, obstacles and bodies on nodes, in the layout of `nodes`; the rows in use, and which groups have any.
    contact: Vec<ContactRow>,
    contact_rows: Vec<usize>,
    touches: Vec<bool>,
    /// Nodes on which other rope presses.
    kept: Kept,
    /// Tension of each row of segments before the first solution of an iteration.
    tension: Vec<Row>,
    /// Piece of each segment.
    piece_of: Vec<usize>,
    ropes: Vec<PerMetre<Row>>,
    ends: Vec<EndRows>,
    moves: Vec<MoveRows>,
    /// Lengths and cuts the rows were made for.
    lengths: Vec<f64>,
    cut: Vec<bool>,
    /// Ends of pieces in a row: a line's pieces are the segments of a chain.
    chain: BlockTridiagonal,
}

/// Result of a solution for rope.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RopeMoved {
    /// Longest move of a node [m].
    pub longest_m: f64,
    /// Greatest difference between the solved tension and the law, to second order [N].
    pub gap_n: f64,
    /// Greatest difference across the rope, as a segment turns [N].
    pub turned_n: f64,
    /// Greatest tension of a segment that was assumed taut and is slack in the solution, or the reverse [N].
    pub flipped_n: f64,
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
            contact: Vec::new(),
            contact_rows: Vec::new(),
            touches: vec![false; groups.len()],
            kept: Kept::new(pieces.len(), &groups),
            tension: Vec::new(),
            piece_of: pieces
                .iter()
                .enumerate()
                .flat_map(|(index, piece)| std::iter::repeat_n(index, piece.segments))
                .collect(),
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

    /// Forces, matrix and elimination of every piece, and of the chains of their ends if no node is kept.
    pub fn reduce(&mut self, shared: &Shared<f64>) {
        for (index, group) in self.groups.iter().enumerate() {
            let ground = self.ground.get(group.node_row..).unwrap_or_default();
            let rows = group_rows(
                group,
                Rows {
                    nodes: &mut self.nodes,
                    segments: &mut self.segments,
                    solved: &mut self.solved,
                },
                ground,
                &self.ropes[index],
                shared,
            );
            let ends = &mut self.ends[index];
            if self.touches[index] || self.kept.is_in(index) {
                let contact = &self.contact[group.node_row..];
                let kept = self.kept.rows_of(index, group);
                self.arch.dispatch(ForwardContact { rows, contact, kept, ends });
            } else {
                self.arch.dispatch(Forward(rows, ends));
            }
        }
        if !self.kept.is_empty() {
            return;
        }
        self.chain.clear();
        for (index, piece) in self.pieces.iter().enumerate() {
            let (ends, lane, node) = (&self.ends[piece.group], piece.lane, index + piece.line);
            self.chain.diagonal[node] += ends.aa.matrix(lane);
            self.chain.diagonal[node + 1] += ends.bb.matrix(lane);
            self.chain.force[node] += ends.force_a.vector(lane);
            self.chain.force[node + 1] += ends.force_b.vector(lane);
            self.chain.low[index] = ends.ba.matrix(lane);
            self.chain.up[index] = ends.ab.matrix(lane);
        }
    }

    /// Matrix and force of a line reduced to its ends.
    pub fn line_ends(&mut self, line: usize, a_moves: bool) -> Ends {
        let pieces = self.line_pieces[line].clone();
        self.chain.eliminate(&chain_nodes(line, &pieces), &pieces, a_moves, true)
    }

    /// Sets the moves of the ends of a line.
    pub fn move_ends(&mut self, line: usize, a_moves: bool, step_a: DVec3, step_b: DVec3) {
        let pieces = self.line_pieces[line].clone();
        self.chain.substitute(&chain_nodes(line, &pieces), &pieces, a_moves, step_a, step_b);
    }

    /// Stores the tensions before an iteration.
    pub fn store_tension(&mut self) {
        self.tension.clear();
        self.tension.extend(self.segments.iter().map(|row| row.tension));
    }

    /// Restores the tensions from before the iteration, but in segments that are taut now and were slack then, or the reverse.
    pub fn restore_tension(&mut self) {
        for (row, before) in self.segments.iter_mut().zip(&self.tension) {
            for (now, before) in row.tension.0.iter_mut().zip(before.0) {
                if (*now > 0.0) == (before > 0.0) {
                    *now = before;
                }
            }
        }
    }

    /// Keeps these nodes as unknowns, in rising order and inside lines, and no others.
    pub fn keep_nodes(&mut self, nodes: &[usize]) {
        self.kept.set(nodes, &self.pieces, &self.groups);
    }

    /// Nodes where two pieces meet, in rising order.
    pub fn cuts(&self) -> impl Iterator<Item = usize> + Clone {
        self.pieces.iter().filter(|piece| piece.follows).map(|piece| piece.first_node)
    }

    /// Matrix and force of a span, which ends at a kept node or at the end of a piece; `last_segment` is the last of the span.
    pub fn span_ends(&self, last_segment: usize) -> Ends {
        let piece = &self.pieces[self.piece_of[last_segment]];
        let (group, k) = (&self.groups[piece.group], last_segment + 1 - piece.first_segment);
        let ends = if k == piece.segments {
            &self.ends[piece.group]
        } else {
            &self.kept.row(group, k).ends
        };
        Ends {
            aa: ends.aa.matrix(piece.lane),
            ab: ends.ab.matrix(piece.lane),
            ba: ends.ba.matrix(piece.lane),
            bb: ends.bb.matrix(piece.lane),
            force_a: ends.force_a.vector(piece.lane),
            force_b: ends.force_b.vector(piece.lane),
        }
    }

    /// Sets the moves of the ends of a span of these segments.
    pub fn move_span(&mut self, segments: &core::ops::Range<usize>, [step_a, step_b]: [DVec3; 2]) {
        let index = self.piece_of[segments.end - 1];
        let piece = &self.pieces[index];
        let (node, k) = (index + piece.line, segments.end - piece.first_segment);
        debug_assert!(segments.start >= piece.first_segment, "a span is part of one piece");
        if segments.start == piece.first_segment {
            self.chain.step[node] = step_a;
        }
        if k == piece.segments {
            self.chain.step[node + 1] = step_b;
            self.kept.set_last(index, step_a);
        } else {
            let group = &self.groups[piece.group];
            self.kept.move_row((group, piece.lane), k, [step_a, step_b]);
        }
    }

    /// Moves every node by a share of the solved step and predicts tensions.
    pub fn advance(&mut self, shared: &Shared<f64>, share: f64) -> RopeMoved {
        let mut moved = RopeMoved { finite: true, ..RopeMoved::default() };
        for (index, group) in self.groups.iter().enumerate() {
            let mut ends = [Row3::default(); 2];
            for (lane, piece) in group.pieces.iter().enumerate() {
                let node = piece + self.pieces[*piece].line;
                let is_whole = self.kept.is_empty();
                let step_a = if is_whole { self.chain.step[node] } else { self.kept.last(*piece) };
                ends[0].set(lane, step_a);
                ends[1].set(lane, self.chain.step[node + 1]);
            }
            let ground = self.ground.get(group.node_row..).unwrap_or_default();
            let rows = group_rows(
                group,
                Rows {
                    nodes: &mut self.nodes,
                    segments: &mut self.segments,
                    solved: &mut self.solved,
                },
                ground,
                &self.ropes[index],
                shared,
            );
            let moves = &mut self.moves[index];
            let kept = self.kept.rows_of(index, group);
            self.arch.dispatch(Backward { group: rows, kept, ends: &ends, share, moves });
            for lane in 0..group.used {
                let moves = &self.moves[index];
                moved.longest_m = moved.longest_m.max(moves.longest.0[lane]);
                moved.gap_n = moved.gap_n.max(moves.gap.0[lane]);
                moved.turned_n = moved.turned_n.max(moves.turned.0[lane]);
                moved.flipped_n = moved.flipped_n.max(moves.flipped.0[lane]);
                moved.greatest_n = moved.greatest_n.max(moves.greatest.0[lane]);
                moved.finite &= moves.finite.0[lane].is_finite();
            }
        }
        moved.longest_m = moved.longest_m.sqrt();
        moved
    }

    /// Node `k` of a piece.
    fn node(&self, piece: usize, k: usize) -> &NodeRow {
        &self.nodes[self.groups[self.pieces[piece].group].node_row + 1 + k]
    }
}

/// Nodes of a line's chain of pieces.
fn chain_nodes(line: usize, pieces: &core::ops::Range<usize>) -> core::ops::Range<usize> {
    pieces.start + line..pieces.end + line + 1
}

/// Rows of all groups.
struct Rows<'a> {
    nodes: &'a mut [NodeRow],
    segments: &'a mut [SegmentRow],
    solved: &'a mut [Solved],
}

/// The rows of one group, for a sweep.
fn group_rows<'a>(
    group: &'a Group,
    Rows { nodes, segments, solved }: Rows<'a>,
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
        along_root: row(|rope| rope.along_root),
    }
}

const _: () = assert!(LANES == 8, "rows are laid out for eight lanes");
