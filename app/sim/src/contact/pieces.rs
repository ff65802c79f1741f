//! Rope in pieces of sixteen segments, in groups of four: a box around the move of each over a step, and whether a piece runs straight.
//!
//! They are measured once for all that looks for rope near something: skin (`contact/near/mod.rs`), obstacles and bodies
//! (`solids/broad.rs`), other rope (`contact/ropes/broad.rs`).

use std::ops::Range;

use glam::DVec3;

use crate::model::Model;
use crate::state::State;
use crate::whale::Bounds;

/// Segments in one piece.
const IN_A_PIECE: usize = 16;
/// Segments in one group of a piece.
const IN_A_GROUP: usize = 4;
/// Groups of a piece.
const GROUPS: usize = IN_A_PIECE / IN_A_GROUP;
/// Cosine of 40°: how far a straight piece's segments, and two pieces in a row, may turn from each other. Together they then
/// stay within 60° of one direction.
const STRAIGHT: f64 = 0.766;

/// Share of a step by which the length of another may differ that is the same but for rounding.
const SAME_STEP: f64 = 1e-9;

/// Segments in a row of one line.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub line: usize,
    pub segments: Range<usize>,
    pub nodes: Range<usize>,
    pub bounds: Bounds,
    /// Boxes around its groups, empty beyond its end.
    groups: [Bounds; GROUPS],
    /// Whether each of its segments goes on along one direction.
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
    /// Whether anybody asks for them.
    wanted: bool,
    /// Time and length of the step that they were measured over last, where rope went on as it moved [s].
    measured: Option<[f64; 2]>,
}

impl Pieces {
    /// Storage for a model.
    pub fn new(model: &Model) -> Self {
        let settings = &model.spec.settings;
        let on_bodies = settings.rope_on_bodies && !model.spec.bodies.is_empty();
        let on_solids = on_bodies || !model.spec.obstacles.is_empty();
        let wanted = on_solids || settings.rope_on_rope.is_some() || model.spec.whale.is_some();
        let mut all = Self { wanted, ..Self::default() };
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
                    directions: [DVec3::ZERO; 2],
                    is_straight: false,
                });
            }
            all.lines.push((first..all.pieces.len(), Bounds::EMPTY));
        }
        all
    }

    /// Measures rope that goes from one place to another in a step, its segments of these unstretched lengths, where anybody asks for it.
    pub fn measure(&mut self, from: &[DVec3], to: impl Fn(usize) -> DVec3, lengths: &[f64]) {
        self.measured = None;
        if !self.wanted {
            return;
        }
        for (pieces, whole) in &mut self.lines {
            *whole = Bounds::EMPTY;
            for piece in &mut self.pieces[pieces.clone()] {
                piece.measure(from, &to, lengths);
                *whole = whole.join(piece.bounds);
            }
        }
    }

    /// Measures rope over a step of length `dt` in which it goes on as it moves, or leaves what was measured of that step before.
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

    /// The box around all rope.
    pub fn whole(&self) -> Bounds {
        self.lines.iter().fold(Bounds::EMPTY, |whole, (_, line)| whole.join(*line))
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

    /// Groups whose box passes a test: their segments, and the first node of these.
    #[inline(always)]
    pub fn groups(
        &self,
        passes: impl Fn(&Bounds) -> bool,
    ) -> impl Iterator<Item = (Range<usize>, usize)> {
        let (segments, node) = (self.segments.clone(), self.nodes.start);
        let near = self.groups.iter().enumerate().filter(move |(_, bounds)| passes(bounds));
        near.map(move |(group, _)| {
            let start = segments.start + group * IN_A_GROUP;
            let end = (start + IN_A_GROUP).min(segments.end);
            (start..end, node + group * IN_A_GROUP)
        })
    }

    /// Whether the two are one straight run of one line.
    pub fn runs_on(&self, other: &Self) -> bool {
        let in_a_row =
            self.segments.end == other.segments.start || other.segments.end == self.segments.start;
        let agree = || (0..2).all(|k| self.directions[k].dot(other.directions[k]) >= STRAIGHT);
        self.line == other.line && in_a_row && self.is_straight && other.is_straight && agree()
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
