//! Tension of lines and weak links, and values at a length along a line.
//!
//! Tension `T` of a lumped segment is that at its middle. Between there and the end is the load of half a segment, so that the
//! end carries
//! `T + (l/2) (w e_z - f)` [N], with `e` the unit vector along the segment to the end, `w` the weight in water and `f` the drag
//! along `e`, both per metre [N/m], and `l` the length [m].
//!
//! The greatest tension along a line is recorded by unstretched length. A line is divided into bins of [`TENSION_BIN_M`] from end A; the
//! last one may be shorter. The value of a bin is the greatest tension of any segment that lay in it, at least in part, in any accepted
//! solver step, converged or not. It is therefore at least the greatest tension of every place in the bin, also where segments moved along
//! the line. Lengths change rarely: tensions are collected by segment, and enter the bins when the lengths of their line change.

use std::ops::Range;

use endline_sdk::LineEnd;
use glam::DVec3;

use super::events::{EventKind, Log};
use super::loads::line_drag;
use super::summary::{LineSummary, LinkSummary};
use super::whale::WhaleMeter;
use crate::model::Model;
use crate::simd::greater;
use crate::state::State;

/// Peaks of every line and weak link.
#[derive(Clone, Debug)]
pub(super) struct LineMeter {
    lines: Vec<Peak>,
    /// By line: greatest tension of the first segment, of all between, and of the last one [N].
    places_n: Vec<[f64; 3]>,
    bins: BinMeter,
    links: Vec<Peak>,
}

/// A peak, its time, and whether the parting has been reported.
#[derive(Clone, Copy, Debug, Default)]
struct Peak {
    tension_n: f64,
    at_s: f64,
    /// Greatest tension in solver steps that did not converge [N].
    unconverged_n: f64,
    reported: bool,
}

/// Greatest tensions of the segments over the solver steps of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Peaks<'a> {
    /// Over converged solver steps; zero without any [N].
    pub converged_n: &'a [f64],
    /// Over solver steps that did not converge; zero or empty without any [N].
    pub unconverged_n: &'a [f64],
}

impl Peaks<'_> {
    /// Greatest tension of a range of segments, in converged and in unconverged solver steps [N].
    fn of(&self, segments: Range<usize>) -> [f64; 2] {
        [self.converged_n, self.unconverged_n].map(|peaks| {
            let own = peaks.get(segments.clone()).unwrap_or_default();
            own.iter().copied().fold(0.0, greater)
        })
    }
}

/// Greatest tensions over places of a line, in converged and in unconverged solver steps [N].
fn over(places: [[f64; 2]; 3]) -> [f64; 2] {
    [0, 1].map(|kind| places.iter().map(|place| place[kind]).fold(0.0, f64::max))
}

impl Peak {
    fn take(&mut self, [tension_n, unconverged_n]: [f64; 2], time_s: f64) {
        if tension_n > self.tension_n {
            (self.tension_n, self.at_s) = (tension_n, time_s);
        }
        self.unconverged_n = self.unconverged_n.max(unconverged_n);
    }

    /// Greatest tension of all solver steps [N].
    fn greatest_n(&self) -> f64 {
        self.tension_n.max(self.unconverged_n)
    }
}

impl LineMeter {
    pub(super) fn new(model: &Model) -> Self {
        Self {
            lines: vec![Peak::default(); model.spec.lines.len()],
            places_n: vec![[0.0; 3]; model.spec.lines.len()],
            bins: BinMeter::new(model),
            links: vec![Peak::default(); model.spec.links.len()],
        }
    }

    /// Adds a step with the greatest tension of each segment during it.
    pub(super) fn fold(&mut self, model: &Model, state: &State, peaks: &Peaks<'_>, log: &mut Log) {
        debug_assert_eq!(peaks.converged_n.len(), model.segment_count, "one peak per segment");
        self.bins.fold(model, state, peaks);
        for (line, peak) in self.lines.iter_mut().enumerate() {
            let Range { start, end } = model.line_segments[line];
            let last = end.saturating_sub(1).max(start);
            let by_place =
                [start..end.min(start + 1), start + 1..last, last..end].map(|own| peaks.of(own));
            for (greatest_n, [converged_n, unconverged_n]) in
                self.places_n[line].iter_mut().zip(by_place)
            {
                *greatest_n = greatest_n.max(converged_n).max(unconverged_n);
            }
            peak.take(over(by_place), state.time_s);
            if state.line_parted[line].is_some() && !peak.reported {
                peak.reported = true;
                log.record(
                    state.time_s,
                    EventKind::LineParted,
                    &model.spec.lines[line].id,
                    peak.greatest_n(),
                );
            }
        }
        for (index, (link, peak)) in model.spec.links.iter().zip(&mut self.links).enumerate() {
            let borne = end_segment(model, link.line, link.end)
                .map_or([0.0; 2], |(segment, ..)| peaks.of(segment..segment + 1));
            peak.take(borne, state.time_s);
            if state.link_parted_s[index].is_some() && !peak.reported {
                peak.reported = true;
                log.record(state.time_s, EventKind::LinkParted, &link.id, peak.greatest_n());
            }
        }
    }

    pub(super) fn lines(
        &self,
        model: &Model,
        state: &State,
        whale: Option<&WhaleMeter>,
    ) -> Vec<LineSummary> {
        let summary = |(index, peak): (usize, &Peak)| {
            let [whale_normal_n, whale_friction_n] =
                whale.map_or([0.0; 2], |whale| whale.on_line(index));
            let [twist, peak_twist] = whale.map_or([0.0; 2], |whale| whale.twist(model, index));
            LineSummary {
                drag_n: line_drag(model, state, index),
                whale_normal_n,
                whale_friction_n,
                twist,
                peak_twist,
                id: model.spec.lines[index].id.clone(),
                peak_tension_n: peak.tension_n,
                peak_at_s: peak.at_s,
                unconverged_peak_n: peak.unconverged_n,
                place_peaks_n: self.places_n[index],
                bin_peaks_n: self.bins.of_line(model, index),
                end_a_tension_n: end_tension(model, state, index, LineEnd::A),
                end_b_tension_n: end_tension(model, state, index, LineEnd::B),
                parted_at_s: state.line_parted[index].map(|(time, _)| time),
            }
        };
        self.lines.iter().enumerate().map(summary).collect()
    }

    pub(super) fn links(&self, model: &Model, state: &State) -> Vec<LinkSummary> {
        let summary = |(index, peak): (usize, &Peak)| LinkSummary {
            id: model.spec.links[index].id.clone(),
            rating_n: model.spec.links[index].rating_n,
            peak_tension_n: peak.tension_n,
            unconverged_peak_n: peak.unconverged_n,
            parted_at_s: state.link_parted_s[index],
        };
        self.links.iter().enumerate().map(summary).collect()
    }
}

/// Length of a bin [m]: a few segments near the whale, and less than the distance between two inserts by an order of magnitude.
pub const TENSION_BIN_M: f64 = 0.5;

/// Greatest tensions of all lines by bin.
#[derive(Clone, Debug)]
pub(super) struct BinMeter {
    /// Of each line, from end A [N].
    bins_n: Vec<Vec<f64>>,
    /// Greatest tension of each segment while it had its length of `lengths_m` [N].
    segments_n: Vec<f64>,
    /// Unstretched length of each segment at the last step [m].
    lengths_m: Vec<f64>,
}

impl BinMeter {
    pub(super) fn new(model: &Model) -> Self {
        let count = |segments_m: &[f64]| {
            (segments_m.iter().sum::<f64>() / TENSION_BIN_M).ceil().max(1.0) as usize
        };
        let lines = model.spec.lines.iter();
        Self {
            bins_n: lines.map(|line| vec![0.0; count(&line.segments_m)]).collect(),
            segments_n: vec![0.0; model.segment_count],
            lengths_m: vec![0.0; model.segment_count],
        }
    }

    /// Adds a step with the greatest tension of each segment during it, throughout which segments had the lengths of the state.
    pub(super) fn fold(&mut self, model: &Model, state: &State, peaks: &Peaks<'_>) {
        let now_m = &state.rope.segment_length;
        for (own, bins_n) in model.line_segments.iter().zip(&mut self.bins_n) {
            if are_equal(&self.lengths_m[own.clone()], &now_m[own.clone()]) {
                continue;
            }
            raise_bins(bins_n, &self.lengths_m[own.clone()], &self.segments_n[own.clone()]);
            self.lengths_m[own.clone()].copy_from_slice(&now_m[own.clone()]);
            self.segments_n[own.clone()].fill(0.0);
        }
        for peaks_n in [peaks.converged_n, peaks.unconverged_n] {
            for (greatest_n, peak_n) in self.segments_n.iter_mut().zip(peaks_n) {
                *greatest_n = greater(*greatest_n, *peak_n);
            }
        }
    }

    /// Greatest tension of each bin of a line so far [N].
    pub(super) fn of_line(&self, model: &Model, line: usize) -> Vec<f64> {
        let own = model.line_segments[line].clone();
        let mut bins_n = self.bins_n[line].clone();
        raise_bins(&mut bins_n, &self.lengths_m[own.clone()], &self.segments_n[own]);
        bins_n
    }
}

/// Index of the bin of a place, by its length from end A [m].
pub(super) fn bin_at(at_m: f64, bins: usize) -> usize {
    debug_assert!(at_m >= 0.0 && bins > 0, "a place on a line");
    ((at_m / TENSION_BIN_M) as usize).min(bins - 1)
}

/// Raises each bin to the tensions [N] of the segments in it, by their lengths from end A [m].
fn raise_bins(bins_n: &mut [f64], lengths_m: &[f64], tensions_n: &[f64]) {
    let mut to_m = 0.0;
    for (length_m, tension_n) in lengths_m.iter().zip(tensions_n) {
        let first = bin_at(to_m, bins_n.len());
        to_m += length_m;
        let last = bin_at(to_m, bins_n.len());
        for bin_n in &mut bins_n[first..=last] {
            *bin_n = greater(*bin_n, *tension_n);
        }
    }
}

/// Whether two lists of one length have the same bits, without an early exit, so that the compiler vectorises it.
fn are_equal(one: &[f64], other: &[f64]) -> bool {
    let pairs = one.iter().zip(other);
    pairs.fold(0, |differ, (one, other)| differ | (one.to_bits() ^ other.to_bits())) == 0
}

/// Tension of a line at an end; zero if it is slack, cut or empty [N].
pub fn end_tension(model: &Model, state: &State, line: usize, end: LineEnd) -> f64 {
    let middle = end_segment_tension(model, state, line, end);
    let Some((segment, tip, inner)) = end_segment(model, line, end) else { return 0.0 };
    if middle <= 0.0 {
        return 0.0;
    }
    let Some(outward) = (state.rope.position[tip] - state.rope.position[inner]).try_normalize()
    else {
        return middle;
    };
    let length = state.rope.segment_length[segment];
    (middle - 0.5 * length * load_along(model, state, line, tip, outward)).max(0.0)
}

/// Weight, buoyancy and drag of a line's rope at a node, along a direction [N/m].
fn load_along(model: &Model, state: &State, line: usize, node: usize, along: DVec3) -> f64 {
    let (rope, water) = (&model.spec.ropes[model.spec.lines[line].rope], &model.spec.water);
    let place = state.rope.position[node];
    let flow = model.sea.at(place, state.time_s);
    let density =
        if water.rope_dries && place.z > flow.surface_m { 0.0 } else { water.density_kg_m3 };
    let speed = (flow.velocity_m_s - state.rope.velocity[node]).dot(along);
    let drag = 0.5
        * density
        * rope.drag_tangential
        * std::f64::consts::PI
        * rope.diameter_m
        * rope.drag_speed_along_m_s(speed)
        * speed;
    drag - (rope.mass_kg_m - density * rope.displaced_m3_m) * water.gravity_m_s2 * along.z
}

/// Tension of the segment at an end, zero if slack [N].
fn end_segment_tension(model: &Model, state: &State, line: usize, end: LineEnd) -> f64 {
    end_segment(model, line, end).map_or(0.0, |(segment, ..)| {
        if state.rope.cut[segment] { 0.0 } else { state.rope.tension[segment].max(0.0) }
    })
}

/// Segment at an end, its node at the joint and its other node.
fn end_segment(model: &Model, line: usize, end: LineEnd) -> Option<(usize, usize, usize)> {
    let (segments, nodes) = (&model.line_segments[line], &model.line_nodes[line]);
    match end {
        _ if segments.is_empty() => None,
        LineEnd::A => Some((segments.start, nodes.start, nodes.start + 1)),
        LineEnd::B => Some((segments.end - 1, nodes.end - 1, nodes.end - 2)),
    }
}

/// Position of the midpoint by unstretched length [m].
pub(super) fn middle(model: &Model, state: &State, line: usize) -> Option<DVec3> {
    let whole: f64 = state.rope.segment_length[model.line_segments.get(line)?.clone()].iter().sum();
    place(model, state, line, 0.5 * whole)
}

/// Position at a length from end A, linear between nodes and constant beyond the ends [m].
pub(super) fn place(model: &Model, state: &State, line: usize, length_m: f64) -> Option<DVec3> {
    let lengths = &state.rope.segment_length[model.line_segments.get(line)?.clone()];
    let nodes = &state.rope.position[model.line_nodes[line].clone()];
    let mut left = length_m.max(0.0);
    for (ends, length) in nodes.windows(2).zip(lengths) {
        if left <= *length {
            return Some(ends[0].lerp(ends[1], left / length));
        }
        left -= length;
    }
    nodes.last().copied()
}

/// Greatest height above the seabed of a line's nodes, excluding those within a length from an end [m].
///
/// Without other nodes it is the height of the midpoint; without a line, zero; without a seabed, the height above the water
/// depth.
pub(super) fn height(model: &Model, state: &State, line: usize, away_m: f64) -> f64 {
    let Some(own) = model.line_segments.get(line) else { return 0.0 };
    let lengths = &state.rope.segment_length[own.clone()];
    let whole: f64 = lengths.iter().sum();
    let above = |place: DVec3| {
        place.z
            - model
                .spec
                .seabed
                .as_ref()
                .map_or(-model.spec.water.depth_m, |bed| bed.height_at(place))
    };
    let starts =
        lengths.iter().scan(0.0, |from, length| Some(std::mem::replace(from, *from + length)));
    let nodes =
        state.rope.position[model.line_nodes[line].clone()].iter().zip(starts.chain([whole]));
    let kept = nodes
        .filter(|(_, from)| *from >= away_m && whole - from >= away_m)
        .map(|(place, _)| above(*place));
    kept.reduce(f64::max).or_else(|| middle(model, state, line).map(above)).unwrap_or(0.0)
}

/// Tension at a length from end A, linear between the middles of segments and constant beyond them; zero if slack, cut or
/// without a line [N].
pub(super) fn tension(model: &Model, state: &State, line: usize, length_m: f64) -> f64 {
    let Some(own) = model.line_segments.get(line) else { return 0.0 };
    let pull = |segment: usize| {
        if state.rope.cut[segment] { 0.0 } else { state.rope.tension[segment].max(0.0) }
    };
    let (mut from, mut before) = (0.0, None);
    for (segment, length) in own.clone().zip(&state.rope.segment_length[own.clone()]) {
        let middle = from + 0.5 * length;
        if length_m <= middle {
            let Some((last_middle, last)) = before else { return pull(segment) };
            return last
                + (pull(segment) - last) * (length_m - last_middle) / (middle - last_middle);
        }
        before = Some((middle, pull(segment)));
        from += length;
    }
    before.map_or(0.0, |(_, last)| last)
}
