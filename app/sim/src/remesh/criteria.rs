//! Which segment of a line to split, and which two neighbours to merge for it.
//!
//! With `r` a segment's length over the wanted one, the allowed split of greatest `r` is paid for by the allowed merge of
//! least `r`, where the split gains more than the merge loses; so no change is ever undone while the whale stands still.

use std::ops::Range;

use glam::DVec3;

use super::wanted::is_far;
use crate::forces::axial::Axial;
use crate::model::{Model, Resolution, Rope};
use crate::state::{RopeState, State};

/// How much more a split must gain than its merge loses.
const GAIN: f64 = 1.25;
/// Greatest ratio between the lengths of neighbours, with room for rounding.
const GREATEST_RATIO: f64 = 2.0 + 1e-9;
/// Share of the tension by which a merge may change it.
const JUMP_SHARE: f64 = 0.005;
/// Change of tension a merge may make in any rope [N].
const JUMP_N: f64 = 0.2;
/// Farthest a node that is merged away may lie off the chord, as a share of the chord.
const SAG_SHARE: f64 = 0.03;

/// Greatest change of tension by a merge of segments under these tensions [N].
fn jump_n(tension_n: f64) -> f64 {
    JUMP_N.max(JUMP_SHARE * tension_n)
}

/// A line as the criteria of splitting and merging see it.
pub(super) struct Line<'a> {
    rope: &'a Rope,
    state: &'a RopeState,
    segments: Range<usize>,
    /// First node less first segment.
    shift: usize,
    wanted: &'a [f64],
    gripped: &'a [bool],
    resolution: &'a Resolution,
}

impl<'a> Line<'a> {
    pub fn of(
        model: &'a Model,
        state: &'a State,
        line: usize,
        wanted: &'a [f64],
        gripped: &'a [bool],
        resolution: &'a Resolution,
    ) -> Self {
        let segments = model.line_segments[line].clone();
        let shift = model.line_nodes[line].start - segments.start;
        Self {
            rope: &model.spec.ropes[model.spec.lines[line].rope],
            state: &state.rope,
            segments,
            shift,
            wanted,
            gripped,
            resolution,
        }
    }

    fn length(&self, segment: usize) -> f64 {
        self.state.segment_length[segment]
    }

    /// Length over the wanted one.
    fn excess(&self, segment: usize) -> f64 {
        self.length(segment) / self.wanted[segment]
    }

    /// Inner segments: those at the ends stay.
    fn inner(&self) -> Range<usize> {
        self.segments.start + 1..self.segments.end.saturating_sub(1).max(self.segments.start + 1)
    }

    fn stays(&self, segment: usize) -> bool {
        self.state.cut[segment] || self.gripped[segment]
    }

    /// Whether its halves would still be in proportion with their neighbours.
    fn may_split(&self, segment: usize) -> bool {
        let half = 0.5 * self.length(segment);
        let longest = self.length(segment - 1).max(self.length(segment + 1));
        !self.stays(segment) && longest <= GREATEST_RATIO * half
    }

    /// Excess of this segment and the next as one, where they may be merged.
    fn merged_excess(&self, segment: usize) -> f64 {
        let whole = self.length(segment) + self.length(segment + 1);
        whole / self.wanted[segment].min(self.wanted[segment + 1])
    }

    /// Whether this segment and the next may become one.
    fn may_merge(&self, segment: usize) -> bool {
        let next = segment + 1;
        let whole = self.length(segment) + self.length(next);
        let least = self.length(segment - 1).min(self.length(next + 1));
        let far = is_far(self.resolution, self.wanted[segment].min(self.wanted[next]));
        far && !self.stays(segment)
            && !self.stays(next)
            && whole <= GREATEST_RATIO * least
            && self.is_straight(segment)
    }

    /// Whether the rope of this segment and the next is so straight that one chord has its tension.
    fn is_straight(&self, segment: usize) -> bool {
        let node = segment + self.shift;
        let [a, b, c] = [node, node + 1, node + 2].map(|node| self.state.position[node]);
        let chord = c - a;
        let off = (b - a).reject_from(chord.normalize_or(DVec3::X));
        if off.length_squared() > (SAG_SHARE * SAG_SHARE) * chord.length_squared() {
            return false;
        }
        let tensions =
            [self.tension(segment, node, node + 1), self.tension(segment + 1, node + 1, node + 2)];
        let (length, velocity) = (
            self.length(segment) + self.length(segment + 1),
            self.state.velocity[node + 2] - self.state.velocity[node],
        );
        let merged = tension(self.rope, chord, velocity, length);
        tensions.iter().all(|one| (one - merged).abs() <= jump_n(one.max(merged)))
    }

    fn tension(&self, segment: usize, a: usize, b: usize) -> f64 {
        let (position, velocity) = (&self.state.position, &self.state.velocity);
        tension(
            self.rope,
            position[b] - position[a],
            velocity[b] - velocity[a],
            self.length(segment),
        )
    }
}

/// Tension of rope between two nodes, never below zero [N].
fn tension(rope: &Rope, chord: DVec3, velocity: DVec3, length: f64) -> f64 {
    let (stretched, along) = (chord.length(), velocity.dot(chord.normalize_or_zero()));
    Axial::of(rope, length).tension(stretched / length - 1.0, along / length).max(0.0)
}

/// The pair of split and merge that gains most: the segment to split, and the first of the two to merge.
pub(super) fn best(line: &Line<'_>) -> Option<(usize, usize)> {
    let inner = line.inner();
    let mut split = None;
    let mut greatest = 1.0;
    for segment in inner.clone() {
        if line.excess(segment) > greatest && line.may_split(segment) {
            (split, greatest) = (Some(segment), line.excess(segment));
        }
    }
    let split = split?;
    let mut merge = None;
    let mut least = greatest / GAIN;
    for segment in inner.start..inner.end.saturating_sub(1) {
        // The split and what it is next to are not to be merged at once.
        let apart = segment > split + 1 || segment + 2 < split;
        if apart && line.merged_excess(segment) < least && line.may_merge(segment) {
            (merge, least) = (Some(segment), line.merged_excess(segment));
        }
    }
    Some((split, merge?))
}
