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

use crate::bits::same_bits;
use crate::model::Model;
use crate::state::State;
use crate::whale::Bounds;
use glam::DVec3;
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
        let mut all = Self { wanted, holds, ..Self::default() };
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
        self.measured = None;
        if !self.wanted {
            return;
        }
        self.take_lengths(lengths);
        let mut is_held = true;
        for (pieces, whole) in &mut self.lines {
            *whole = Bounds::EMPTY;
            for piece in &mut self.pieces[pieces.clone()] {
                piece.measure(from, &to, lengths);
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
        if self.holds && !same_bits(&self.lengths, lengths) {
            self.lengths.clear();
            self.lengths.extend_from_slice(lengths);
            self.lengths_number += 1;
        }
    }

    /// Measures rope over a step of length `dt` in which it keeps its velocities, unless that step was measured already.
    #[expect(clippy::float_cmp, reason = "the same time, to the bit, is that of the same state")]
    pub fn measure_drift(&mut self, state: &State, dt: f64) {
        let is_same = |[time_s, length_s]: [f64; 2]| {
            time_s == state.time_s && (length_s - dt).abs() <= SAME_STEP * dt
        };
        if self.measured.is_some_and(is_same) {
            return;
        }
        let rope = &state.rope;
        let drift = |node: usize| rope.position[node] + rope.velocity[node] * dt;
        self.measure(&rope.position, drift, &rope.segment_length);
        self.measured = Some([state.time_s, dt]);
    }

    /// Forgets which step was measured: rope is another.
    pub fn forget(&mut self) {
        self.measured = None;
    }
}

impl Piece {
    fn measure(&mut self, places: &[DVec3], to: &impl Fn(usize) -> DVec3, lengths: &[f64]) {
        let (first, last) = (self.nodes.start, self.nodes.end - 1);
        let both = |node: usize| Both::of(places[node], to(node));
        let mut here = both(first);
        let directions = both(last).less(&here).normalized();
        let (mut is_straight, mut node) = (true, first);
        self.bounds = Bounds::EMPTY;
        let lengths = lengths[self.segments.clone()].chunks(IN_A_GROUP);
        for (group, lengths) in self.groups.iter_mut().zip(lengths) {
            let (mut low, mut high) = (here, here);
            for length in lengths {
                node += 1;
                let next = both(node);
                let [from, end] = next.less(&here).dot(&directions);
                let least = STRAIGHT * length;
                is_straight &= (from >= least) & (end >= least);
                here = next;
                low = low.joined(&here, |a, b| if b < a { b } else { a });
                high = high.joined(&here, |a, b| if b > a { b } else { a });
            }
            let ([low_from, low_end], [high_from, high_end]) = (low.two(), high.two());
            *group = Bounds { low: low_from.min(low_end), high: high_from.max(high_end) };
            self.bounds = self.bounds.join(*group);
        }
        (self.directions, self.is_straight) = (directions.two(), is_straight);
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

/// A vector where a step begins and one where it ends, component by component, so that the processor works on both at once.
#[derive(Clone, Copy)]
struct Both([[f64; 2]; 3]);

impl Both {
    #[inline(always)]
    fn of(from: DVec3, end: DVec3) -> Self {
        Self([[from.x, end.x], [from.y, end.y], [from.z, end.z]])
    }

    #[inline(always)]
    fn two(&self) -> [DVec3; 2] {
        let Self([x, y, z]) = self;
        [0, 1].map(|k| DVec3::new(x[k], y[k], z[k]))
    }

    #[inline(always)]
    fn joined(&self, other: &Self, join: impl Fn(f64, f64) -> f64) -> Self {
        Self([0, 1, 2].map(|axis| [0, 1].map(|k| join(self.0[axis][k], other.0[axis][k]))))
    }

    #[inline(always)]
    fn less(&self, other: &Self) -> Self {
        self.joined(other, |a, b| a - b)
    }

    #[inline(always)]
    fn dot(&self, other: &Self) -> [f64; 2] {
        let Self([x, y, z]) = self.joined(other, |a, b| a * b);
        [0, 1].map(|k| x[k] + y[k] + z[k])
    }

    fn normalized(&self) -> Self {
        let [from, end] = self.two().map(DVec3::normalize_or_zero);
        Self::of(from, end)
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
    pub(crate) fn hold(&mut self, from: &[DVec3], to: impl Fn(usize) -> DVec3) {
        let moves = from.iter().enumerate().map(|(node, place)| place.distance_squared(to(node)));
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
