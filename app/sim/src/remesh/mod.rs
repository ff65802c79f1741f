//! Adaptive resolution: segments are short near the whale and long far from it, at a constant number of segments.
//!
//! Every segment has a target length `l_w`, which depends on its distance from skin and from the thin edges of fins: the near
//! length within [`NEAR_M`] of skin, the edge length within [`EDGE_M`] of a thin edge, and beyond these a growth by [`GRADE`]
//! per metre of distance up to the far length. A grade of at most 1 makes neighbours of target length differ by a factor of at
//! most 2.
//!
//! With `r = l/l_w` the ratio of length to target length, the segment of greatest `r > 1` that may be split is split at its
//! middle, and the pair of neighbours in the same line of least merged `r` is merged. A swap requires that the split gains more
//! than the merge loses, so that no swap is reversed while the whale is at rest. The number of nodes, and with it the layout of
//! the model, is constant (`split_merge.rs`).
//!
//! Conserved to rounding: unstretched length, mass, and momentum of the rope's own mass. A split changes no elastic tension
//! (damping given as a ratio depends on the length); a merge changes no tension by more than 0.2 N or 0.5 %. Neighbours differ
//! by a factor of two at most. End segments (which carry links and knots), cut segments and segments in contact are not
//! changed, and segments near skin are not merged.
//!
//! Remeshing runs at the start of a step at intervals of [`EVERY_S`] of simulated time, and depends on the state only.
//! Lengths in metres. Target lengths and their sources: docs/physics.md, Resolution.

mod split_merge;
#[cfg(test)]
mod tests;

use std::ops::Range;

use glam::DVec3;

use crate::broad_phase::pieces::Pieces;
use crate::contact::rope_on_rope::near::{MARGIN_M, RopeOnRope};
use crate::forces::axial::Axial;
use crate::model::{Model, Resolution, Rope};
use crate::simd::real::Real;
use crate::simd::rows::LANES;
use crate::state::{RopeState, State};
use crate::whale::approach::{Approach, Size};
use crate::whale::{Bounds, pose};

/// Interval between two remeshings [s].
const EVERY_S: f64 = 0.05;

/// Greatest number of splits of a line per remeshing.
const MOST_SPLITS: usize = 64;

/// Buffers; no result of a step depends on their content.
#[derive(Clone, Debug)]
pub(crate) struct RemeshWorkspace {
    approach: Approach,
    bones: Vec<glam::DAffine3>,
    /// Target length of each segment [m].
    wanted: Vec<f64>,
    /// Whether each segment touches skin or is near other rope.
    gripped: Vec<bool>,
    pieces: Pieces,
    ropes: RopeOnRope,
}

impl RemeshWorkspace {
    /// Buffers for a model with adaptive resolution and a whale; `None` for others.
    pub fn new(model: &Model) -> Option<Self> {
        model.spec.settings.resolution?;
        let tree = model.skin_tree.clone()?;
        Some(Self {
            bones: Vec::with_capacity(tree.skin().bones.len()),
            approach: Approach::new(tree),
            wanted: vec![0.0; model.segment_count],
            gripped: vec![false; model.segment_count],
            pieces: Pieces::new(model),
            ropes: RopeOnRope::new(model),
        })
    }
}

/// Result of a remeshing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Remeshed {
    /// Number of segments split.
    pub splits: u64,
    /// Greatest ratio of length to target length near the whale; `None` without rope near it.
    pub near_ratio: Option<f64>,
}

/// Adapts the segment lengths if a remeshing is due.
pub(crate) fn remesh(
    model: &Model,
    state: &mut State,
    work: &mut Option<RemeshWorkspace>,
) -> Remeshed {
    let (Some(work), Some(resolution)) = (work, &model.spec.settings.resolution) else {
        return Remeshed::default();
    };
    if !is_time(model, state) {
        return Remeshed::default();
    }
    pose_whale(model, state, work);
    measure(model, state, resolution, work, Measure::NearOrTooLong);
    if !may_any_be_split(model, state, resolution, work) {
        return Remeshed { splits: 0, near_ratio: near_ratio(state, &work.wanted, resolution) };
    }
    measure(model, state, resolution, work, Measure::Rest);
    grip(model, state, work);
    let mut splits = 0;
    for (line, gear) in model.gears.of_line.iter().enumerate() {
        let own = remesh_line(model, state, line, work, resolution);
        if own > 0 {
            state.step_control.still_steps[*gear] = 0;
        }
        splits += own;
    }
    debug_assert!(
        state.rope.segment_length.iter().all(|length| *length > 0.0),
        "lengths are positive"
    );
    debug_assert!(state.rope.friction.sites.is_sorted(), "sites are sorted");
    Remeshed { splits, near_ratio: near_ratio(state, &work.wanted, resolution) }
}

/// Whether a segment is longer than its target and may be split if it touches nothing, which is the condition of any swap.
fn may_any_be_split(
    model: &Model,
    state: &State,
    resolution: &Resolution,
    work: &mut RemeshWorkspace,
) -> bool {
    let mut segments = state.rope.segment_length.iter().zip(&work.wanted);
    if !segments.any(|(length, wanted)| length > wanted) {
        return false;
    }
    work.gripped.fill(false);
    (0..model.line_segments.len()).any(|line| {
        let line = Line::of(model, state, line, &work.wanted, &work.gripped, resolution);
        line.inner().any(|segment| line.excess(segment) > 1.0 && line.may_split(segment))
    })
}

/// Greatest ratio of length to target length of uncut rope near the whale.
fn near_ratio(state: &State, wanted: &[f64], resolution: &Resolution) -> Option<f64> {
    let segments = state.rope.segment_length.iter().zip(wanted).zip(&state.rope.cut);
    let near = segments.filter(|((_, wanted), cut)| !**cut && !is_far(resolution, **wanted));
    near.map(|((length, wanted), _)| length / wanted).reduce(f64::max)
}

/// Whether a remeshing is due before this step.
fn is_time(model: &Model, state: &State) -> bool {
    let steps = (EVERY_S / model.spec.settings.step_s).round().max(1.0) as u64;
    state.step.is_multiple_of(steps)
}

/// Splits and merges in one line until no swap gains; returns the number of splits.
fn remesh_line(
    model: &Model,
    state: &mut State,
    line: usize,
    work: &mut RemeshWorkspace,
    resolution: &Resolution,
) -> u64 {
    for splits in 0..MOST_SPLITS {
        let view = Line::of(model, state, line, &work.wanted, &work.gripped, resolution);
        let Some((split, merge)) = best(&view) else { return splits as u64 };
        split_merge::split_and_merge(model, state, line, split, merge, work);
    }
    MOST_SPLITS as u64
}

/// Least ratio of the split segment's `r` to the merged segment's `r`.
const GAIN: f64 = 1.25;

/// Greatest ratio between the lengths of neighbours, with a margin for rounding.
const GREATEST_RATIO: f64 = 2.0 + 1e-9;

/// Greatest relative change of tension by a merge.
const JUMP_SHARE: f64 = 0.005;

/// Change of tension that a merge may always cause [N].
const JUMP_N: f64 = 0.2;

/// Greatest distance of a removed node from the chord, as a share of the chord.
const SAG_SHARE: f64 = 0.03;

/// Greatest change of tension by a merge at this tension [N].
fn jump_n(tension_n: f64) -> f64 {
    JUMP_N.max(JUMP_SHARE * tension_n)
}

/// A line, for the criteria of splitting and merging.
struct Line<'a> {
    rope: &'a Rope,
    state: &'a RopeState,
    segments: Range<usize>,
    /// Index of the first node minus index of the first segment.
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

    /// Ratio `r` of length to target length.
    fn excess(&self, segment: usize) -> f64 {
        self.length(segment) / self.wanted[segment]
    }

    /// Inner segments, which may be split or merged.
    fn inner(&self) -> Range<usize> {
        self.segments.start + 1..self.segments.end.saturating_sub(1).max(self.segments.start + 1)
    }

    /// Whether a segment must not be changed.
    fn stays(&self, segment: usize) -> bool {
        self.state.cut[segment] || self.gripped[segment]
    }

    /// Whether a segment may be split: its halves differ from their neighbours by a factor of two at most.
    fn may_split(&self, segment: usize) -> bool {
        let half = 0.5 * self.length(segment);
        let longest = self.length(segment - 1).max(self.length(segment + 1));
        !self.stays(segment) && longest <= GREATEST_RATIO * half
    }

    /// Ratio `r` of this segment and the next if merged.
    fn merged_excess(&self, segment: usize) -> f64 {
        let whole = self.length(segment) + self.length(segment + 1);
        whole / self.wanted[segment].min(self.wanted[segment + 1])
    }

    /// Whether this segment and the next may be merged.
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

    /// Whether this segment and the next are so straight that a single chord has their tension.
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

/// Tension of rope between two nodes, zero if slack [N].
fn tension(rope: &Rope, chord: DVec3, velocity: DVec3, length: f64) -> f64 {
    let (stretched, along) = (chord.length(), velocity.dot(chord.normalize_or_zero()));
    Axial::of(rope, length).tension(stretched / length - 1.0, along / length).max(0.0)
}

/// Returns the best swap: the segment to split, and the first of the two segments to merge.
fn best(line: &Line<'_>) -> Option<(usize, usize)> {
    let inner = line.inner();
    debug_assert!(
        inner.clone().all(|segment| line.wanted[segment] > 0.0),
        "target lengths are positive"
    );
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
        // The split segment and its neighbours must not be merged in the same swap.
        let apart = segment > split + 1 || segment + 2 < split;
        if apart && line.merged_excess(segment) < least && line.may_merge(segment) {
            (merge, least) = (Some(segment), line.merged_excess(segment));
        }
    }
    Some((split, merge?))
}

/// Distance from skin within which rope has the near length: more than a whale swims between two remeshings [m].
const NEAR_M: f64 = 0.3;

/// Distance from a thin edge within which rope has the edge length [m].
const EDGE_M: f64 = 0.2;

/// Growth of the target length with distance [m/m].
const GRADE: f64 = 0.3;

/// Target length at a distance from skin [m].
struct Target<'a>(&'a Resolution);

impl Size for Target<'_> {
    #[inline(always)]
    fn at<R: Real>(&self, gap_m: R, thin: bool) -> R {
        let Resolution { near_m, edge_m, far_m } = *self.0;
        let near = grown([near_m, NEAR_M, far_m], gap_m);
        if thin { near.min(grown([edge_m, EDGE_M, far_m], gap_m)) } else { near }
    }
}

/// A length that is `least` within a distance, and grows beyond it up to `most`.
#[inline(always)]
fn grown<R: Real>([least, within, most]: [f64; 3], gap_m: R) -> R {
    let beyond = (gap_m - gap_m.splat(within)).max(gap_m.splat(0.0));
    (gap_m.splat(least) + gap_m.splat(GRADE) * beyond).min(gap_m.splat(most))
}

/// Whether a target length is that of rope far from the whale.
fn is_far(resolution: &Resolution, wanted_m: f64) -> bool {
    wanted_m > resolution.near_m
}

/// Marks the segments that touch skin and those near other rope, which must not be changed.
fn grip(model: &Model, state: &State, work: &mut RemeshWorkspace) {
    work.gripped.fill(false);
    for site in &state.rope.friction.sites {
        work.gripped[crate::contact::rope_on_skin::stored_faces::segment_of(*site)] = true;
    }
    // A merge moves rope, which could then cross rope near it.
    let rope = &state.rope;
    work.pieces.measure(&rope.position, |node| rope.position[node], &rope.segment_length);
    work.ropes.gather(model, state, &work.pieces, (0.0, MARGIN_M));
    for pair in &work.ropes.pairs {
        pair.segments.iter().for_each(|segment| work.gripped[*segment] = true);
    }
}

/// Which target lengths are computed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Measure {
    /// Those of groups in which a segment is near the whale or longer than its target; the others are infinite.
    NearOrTooLong,
    /// Those of the other groups.
    Rest,
}

/// Computes bones of the whale, if there is one.
fn pose_whale(model: &Model, state: &State, work: &mut RemeshWorkspace) {
    let (Some(whale), Some(now)) = (&model.spec.whale, &state.whale) else { return };
    pose(&whale.skin, now.position, now.orientation, &now.posture, &mut work.bones);
    work.approach.begin();
}

/// Computes target lengths of segments, in groups of neighbours.
fn measure(
    model: &Model,
    state: &State,
    resolution: &Resolution,
    work: &mut RemeshWorkspace,
    which: Measure,
) {
    if model.spec.whale.is_none() || state.whale.is_none() {
        return work.wanted.fill(resolution.far_m);
    }
    let (rope, size) = (&state.rope, Target(resolution));
    for (nodes, segments) in model.line_nodes.iter().zip(&model.line_segments) {
        let around = Bounds::around(&rope.position[nodes.clone()]);
        if work.approach.is_far(&work.bones, &around, resolution.far_m, &size) {
            work.wanted[segments.clone()].fill(resolution.far_m);
            continue;
        }
        let mut node = nodes.start;
        let lengths = rope.segment_length[segments.clone()].chunks(LANES);
        for (wanted, lengths) in work.wanted[segments.clone()].chunks_mut(LANES).zip(lengths) {
            let own = node..node + wanted.len();
            node = own.end;
            if which == Measure::Rest && wanted.iter().all(|wanted| wanted.is_finite()) {
                continue;
            }
            let mut places = [Bounds::EMPTY; LANES];
            for (place, node) in places.iter_mut().zip(own) {
                *place = Bounds::around(&[rope.position[node], rope.position[node + 1]]);
            }
            let (places, approach) = (&places[..wanted.len()], &mut work.approach);
            if which == Measure::NearOrTooLong
                && is_far_and_short(resolution, lengths, |limits| {
                    !approach.is_any_below(&work.bones, places, limits, &size)
                })
            {
                wanted.fill(f64::INFINITY);
            } else {
                approach.least(&work.bones, places, resolution.far_m, &size, wanted);
            }
        }
    }
}

/// Whether none of the segments of a group is near the whale or longer than its target; `are_targets_at_least` returns whether no
/// target length is below its limit.
fn is_far_and_short(
    resolution: &Resolution,
    lengths: &[f64],
    are_targets_at_least: impl FnOnce(&[f64]) -> bool,
) -> bool {
    let mut limits = [resolution.near_m.next_up(); LANES];
    limits.iter_mut().zip(lengths).for_each(|(limit, length)| *limit = limit.max(*length));
    let limits = &limits[..lengths.len()];
    // No target length exceeds that of far rope.
    limits.iter().all(|limit| *limit <= resolution.far_m) && are_targets_at_least(limits)
}
