//! A line read at an unstretched length from its end A, between nodes and between segments.

use glam::DVec3;

use crate::model::Model;
use crate::state::State;

/// Place of the middle by unstretched length [m].
pub(super) fn middle(model: &Model, state: &State, line: usize) -> Option<DVec3> {
    let whole: f64 = state.rope.segment_length[model.line_segments.get(line)?.clone()].iter().sum();
    place(model, state, line, 0.5 * whole)
}

/// Place at a length, linear between nodes; that of an end beyond it [m].
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

/// Greatest height above the seabed of a line's nodes, those left out that lie less than a length from an end; the middle's
/// where that leaves none, zero without a line. Without a seabed it is the height above where the water ends [m].
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

/// Tension at a length, linear between the middles of segments; that of the last segment beyond its
/// middle, zero where slack, cut or without a line [N].
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
