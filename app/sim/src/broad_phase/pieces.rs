//! Rope in pieces of sixteen segments, in groups of four: a box around the path of each over a step, and whether a piece is straight.
//!
//! They are measured once for all searches: skin (`contact/rope_on_skin/near`), obstacles and bodies (`broad_phase/solids.rs`), other rope
//! (`broad_phase/ropes.rs`).
//!
//! *Held boxes* are the boxes of groups grown by a slack; they hold for several steps. A search among held boxes gives a list of
//! neighbours (Verlet 1967, Physical Review 159, 98). As long as each group is in its held box, every two boxes that meet belong to held
//! boxes that meet: `A ⊆ A'` and `B ⊆ B'`, so `A ∩ B ⊆ A' ∩ B'`, also for boxes grown by a margin, since rounding preserves the order of
//! numbers. The list therefore omits nothing, and the boxes of the step remove what is too much: the result does not depend on the age
//! of the list.

use crate::bits::{are_zero, same_bits, same_vectors};
use crate::model::Model;
use crate::simd::real::{Lane, Real};
use crate::simd::rows::{LANES, Part, Row, Row3};
use crate::simd::space::Vec3;
use crate::state::State;
use crate::whale::Bounds;
use glam::DVec3;
use pulp::{Arch, Simd, WithSimd};
use std::ops::Range;

/// Segments in one piece.
const IN_A_PIECE: usize = 16;
/// Segments in one group of a piece.
pub(crate) const IN_A_GROUP: usize = 4;
/// Groups of a piece.
pub(crate) const GROUPS: usize = IN_A_PIECE / IN_A_GROUP;
/// Cosine of 40°: how far a straight piece's segments, and two pieces in a row, may turn from each other. Together they then
/// stay within 60° of one direction.
const STRAIGHT: f64 = 0.766;

/// Relative difference of two step lengths that is rounding.
const SAME_STEP: f64 = 1e-9;

/// Segments in a row of one line.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub line: usize,
    pub segments: Range<usize>,
    pub nodes: Range<usize>,
    pub bounds: Bounds,
    /// Boxes around its groups, empty beyond its end.
    pub groups: [Bounds; GROUPS],
    /// Wider boxes that those lie in for some steps, and a box around all of these.
    pub held: [Bounds; GROUPS],
    pub held_whole: Bounds,
    /// Whether all of its segments advance along one direction.
    pub is_straight: bool,
    /// Direction from its first node to its last, at the start and at the end of the step.
    directions: [DVec3; 2],
}

/// All pieces of a rig.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pieces {
    pub pieces: Vec<Piece>,
    /// Pieces of each line, with a box around all of it.
    pub lines: Vec<(Range<usize>, Bounds)>,
    /// Whether any search uses them.
    wanted: bool,
    /// Whether any search uses held boxes, and the number of times these have been laid out.
    holds: bool,
    pub holding: u64,
    /// Unstretched lengths of the segments, and how often these have changed [m].
    lengths: Vec<f64>,
    pub lengths_number: u64,
    arch: Arch,
    rows: Rows,
    /// Where nodes are at the end of the step that was measured.
    ends: Vec<DVec3>,
    /// Whether rope stood still in that step.
    stood_still: bool,
    /// Time and length of the step that they were measured over last, where rope went on as it moved [s].
    measured: Option<[f64; 2]>,
}

impl Pieces {
    /// Storage for a model.
    pub fn new(model: &Model) -> Self {
        let settings = &model.spec.settings;
        let on_bodies = settings.rope_on_bodies && !model.spec.bodies.is_empty();
        let on_solids = on_bodies || !model.spec.obstacles.is_empty();
        let holds = on_solids || settings.rope_on_rope.is_some();
        let wanted = holds || model.spec.whale.is_some();
        let ends = Vec::with_capacity(model.node_count);
        let mut all = Self { wanted, holds, ends, ..Self::default() };
        for (line, (nodes, segments)) in
            model.line_nodes.iter().zip(&model.line_segments).enumerate()
        {
            let first = all.pieces.len();
            for start in segments.clone().step_by(IN_A_PIECE) {
                let end = (start + IN_A_PIECE).min(segments.end);
                let node = nodes.start + start - segments.start;
                all.pieces.push(Piece {
                    line,
                    segments: start..end,
                    nodes: node..node + end - start + 1,
                    bounds: Bounds::EMPTY,
                    groups: [Bounds::EMPTY; GROUPS],
                    held: [Bounds::EMPTY; GROUPS],
                    held_whole: Bounds::EMPTY,
                    directions: [DVec3::ZERO; 2],
                    is_straight: false,
                });
            }
            all.lines.push((first..all.pieces.len(), Bounds::EMPTY));
        }
        all
    }

    /// Measures rope that goes from one place to another in a step, its segments of these unstretched lengths, if any search uses them.
    pub fn measure(&mut self, from: &[DVec3], to: impl Fn(usize) -> DVec3, lengths: &[f64]) {
        if self.wanted {
            let mut ends = std::mem::take(&mut self.ends);
            ends.clear();
            ends.extend((0..from.len()).map(to));
            self.measure_between(from, &ends, lengths);
            self.ends = ends;
        }
        (self.measured, self.stood_still) = (None, false);
    }

    fn measure_between(&mut self, from: &[DVec3], to: &[DVec3], lengths: &[f64]) {
        self.take_lengths(lengths);
        for pieces in self.pieces.chunks_mut(AT_ONCE) {
            for (piece, lane) in pieces.iter_mut().zip((0..).step_by(GROUPS)) {
                piece.give(&mut self.rows, lane, [from, to], lengths);
            }
            self.arch.dispatch(Measure(&mut self.rows));
            for (piece, lane) in pieces.iter_mut().zip((0..).step_by(GROUPS)) {
                piece.take(&self.rows, lane);
            }
        }
        let mut is_held = true;
        for (pieces, whole) in &mut self.lines {
            *whole = Bounds::EMPTY;
            for piece in &self.pieces[pieces.clone()] {
                *whole = whole.join(piece.bounds);
                is_held &= !self.holds || piece.is_held();
            }
        }
        if !is_held {
            self.hold(from, to);
        }
    }

    /// Copies the lengths of segments, if they have changed.
    fn take_lengths(&mut self, lengths: &[f64]) {
        if !same_bits(&self.lengths, lengths) {
            self.lengths.clear();
            self.lengths.extend_from_slice(lengths);
            self.lengths_number += 1;
        }
    }

    /// Measures rope over a step of length `dt` in which it keeps its velocities, unless that step was measured already, or
    /// rope stands still where it stood still then.
    #[expect(clippy::float_cmp, reason = "the same time, to the bit, is that of the same state")]
    pub fn measure_drift(&mut self, state: &State, dt: f64) {
        let is_same = |[time_s, length_s]: [f64; 2]| {
            time_s == state.time_s && (length_s - dt).abs() <= SAME_STEP * dt
        };
        if self.measured.is_some_and(is_same) {
            return;
        }
        self.measured = Some([state.time_s, dt]);
        if !self.wanted {
            return;
        }
        let rope = &state.rope;
        let stands_still = are_zero(&rope.velocity);
        if stands_still
            && self.stood_still
            && same_vectors(&self.ends, &rope.position)
            && same_bits(&self.lengths, &rope.segment_length)
        {
            return;
        }
        self.stood_still = stands_still;
        let mut ends = std::mem::take(&mut self.ends);
        let nodes = rope.position.iter().zip(&rope.velocity);
        ends.clear();
        ends.extend(nodes.map(|(place, velocity)| *place + *velocity * dt));
        self.measure_between(&rope.position, &ends, &rope.segment_length);
        self.ends = ends;
    }

    /// Forgets which step was measured: rope is another.
    pub fn forget(&mut self) {
        self.measured = None;
    }
}

/// Pieces that are measured at once.
const AT_ONCE: usize = LANES / GROUPS;

/// Groups of some pieces, one in each lane of the processor, and what is measured of them.
#[derive(Clone, Debug, Default)]
struct Rows {
    /// Nodes of each group where the step begins and where it ends; a group that is shorter repeats its last node.
    nodes: [[Row3; 2]; IN_A_GROUP + 1],
    /// Length along the piece's direction that each segment has at least in a straight piece.
    least: [Row; IN_A_GROUP],
    /// Direction of the piece, where the step begins and where it ends.
    directions: [Row3; 2],
    /// Box of each group.
    low: Row3,
    high: Row3,
    /// Least of the lengths along the direction beyond `least`.
    spare: Row,
}

impl Rows {
    /// Writes nodes and lengths of a piece, its first group into this lane.
    fn set(
        &mut self,
        lane: usize,
        [from, to]: [&[DVec3; IN_A_PIECE + 1]; 2],
        lengths: &[f64; IN_A_PIECE],
    ) {
        for group in 0..GROUPS {
            let first = group * IN_A_GROUP;
            for (k, row) in self.nodes.iter_mut().enumerate() {
                row[0].set(lane + group, from[first + k]);
                row[1].set(lane + group, to[first + k]);
            }
            for (k, row) in self.least.iter_mut().enumerate() {
                row.0[lane + group] = STRAIGHT * lengths[first + k];
            }
        }
    }
}

/// Measures all groups in the rows.
struct Measure<'a>(&'a mut Rows);

impl WithSimd for Measure<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(rows) = self;
        for part in 0..Part::<S>::COUNT {
            let part = Part { simd, part };
            let [from, end] = &rows.directions;
            let directions = [part.get3(from), part.get3(end)];
            let [mut from, mut end] = [part.get3(&rows.nodes[0][0]), part.get3(&rows.nodes[0][1])];
            let (mut low, mut high) = (least(from, end), greatest(from, end));
            let mut spare = Lane::new(simd, f64::INFINITY);
            for (nodes, length) in rows.nodes[1..].iter().zip(&rows.least) {
                let next = [part.get3(&nodes[0]), part.get3(&nodes[1])];
                let length = part.get(length);
                spare = spare.min(along(next[0].sub(from), directions[0]) - length);
                spare = spare.min(along(next[1].sub(end), directions[1]) - length);
                [from, end] = next;
                low = least(low, least(from, end));
                high = greatest(high, greatest(from, end));
            }
            part.put3(&mut rows.low, low);
            part.put3(&mut rows.high, high);
            part.put(&mut rows.spare, spare);
        }
    }
}

/// The length of a vector along a direction, each product rounded.
#[inline(always)]
fn along<R: Real>(v: Vec3<R>, direction: Vec3<R>) -> R {
    v.x * direction.x + v.y * direction.y + v.z * direction.z
}

#[inline(always)]
fn least<R: Real>(one: Vec3<R>, other: Vec3<R>) -> Vec3<R> {
    Vec3 { x: one.x.min(other.x), y: one.y.min(other.y), z: one.z.min(other.z) }
}

#[inline(always)]
fn greatest<R: Real>(one: Vec3<R>, other: Vec3<R>) -> Vec3<R> {
    Vec3 { x: one.x.max(other.x), y: one.y.max(other.y), z: one.z.max(other.z) }
}

impl Piece {
    /// Copies it to the rows, its first group into this lane.
    fn give(&mut self, rows: &mut Rows, lane: usize, [from, to]: [&[DVec3]; 2], lengths: &[f64]) {
        let [from, to] = [from, to].map(|places| &places[self.nodes.clone()]);
        let (last, own) = (self.nodes.len() - 1, &lengths[self.segments.clone()]);
        self.directions = [from, to].map(|places| (places[last] - places[0]).normalize_or_zero());
        let lane = lane.min(LANES - GROUPS);
        for group in lane..lane + GROUPS {
            rows.directions[0].set(group, self.directions[0]);
            rows.directions[1].set(group, self.directions[1]);
        }
        if let (Some(from), Some(to), Some(own)) =
            (from.first_chunk(), to.first_chunk(), own.first_chunk())
        {
            rows.set(lane, [from, to], own);
        } else {
            let all = |places: &[DVec3]| std::array::from_fn(|node| places[node.min(last)]);
            let lengths = std::array::from_fn(|k| own.get(k).copied().unwrap_or(0.0));
            rows.set(lane, [&all(from), &all(to)], &lengths);
        }
    }

    /// Takes what was measured of it.
    fn take(&mut self, rows: &Rows, lane: usize) {
        let used = self.segments.len().div_ceil(IN_A_GROUP);
        (self.bounds, self.is_straight) = (Bounds::EMPTY, true);
        for (group, lane) in self.groups[..used].iter_mut().zip(lane..) {
            *group = Bounds { low: rows.low.vector(lane), high: rows.high.vector(lane) };
            self.bounds = self.bounds.join(*group);
            self.is_straight &= rows.spare.0[lane] >= 0.0;
        }
    }

    /// Segments of a group, and the first node of these.
    #[inline(always)]
    pub fn group(&self, group: usize) -> (Range<usize>, usize) {
        let start = self.segments.start + group * IN_A_GROUP;
        let end = (start + IN_A_GROUP).min(self.segments.end);
        (start..end, self.nodes.start + group * IN_A_GROUP)
    }

    /// Whether one of the two begins where the other ends, on one line.
    pub fn follows(&self, other: &Self) -> bool {
        let in_a_row =
            self.segments.end == other.segments.start || other.segments.end == self.segments.start;
        self.line == other.line && in_a_row
    }

    /// Whether two in a row are one straight run.
    #[inline(always)]
    pub fn runs_on(&self, next: &Self) -> bool {
        let agree = || (0..2).all(|k| self.directions[k].dot(next.directions[k]) >= STRAIGHT);
        self.is_straight && next.is_straight && agree()
    }
}

/// Steps of the present speed for which held boxes are laid out.
const STEPS: f64 = 10.0;
/// Least slack [m].
const LEAST_SLACK_M: f64 = 0.04;
/// Slack beyond which too much would be near: boxes then hold for one step alone [m].
const MOST_SLACK_M: f64 = 0.4;

impl Pieces {
    /// Lays out the held boxes around the boxes of a step.
    #[cold]
    pub(crate) fn hold(&mut self, from: &[DVec3], to: &[DVec3]) {
        let moves = from.iter().zip(to).map(|(place, to)| place.distance_squared(*to));
        let slack_m = STEPS * moves.fold(0.0, f64::max).sqrt();
        let slack_m = if slack_m <= MOST_SLACK_M { slack_m.max(LEAST_SLACK_M) } else { 0.0 };
        for piece in &mut self.pieces {
            piece.held = piece.groups.map(|group| group.grown(slack_m));
            piece.held_whole = piece.held.iter().fold(Bounds::EMPTY, |all, one| all.join(*one));
        }
        self.holding += 1;
    }
}

impl Piece {
    /// Whether each of its groups lies in its held box.
    #[inline(always)]
    pub(crate) fn is_held(&self) -> bool {
        let pairs = self.held.iter().zip(&self.groups);
        pairs.fold(true, |all, (held, group)| all & held.holds(group))
    }
}
