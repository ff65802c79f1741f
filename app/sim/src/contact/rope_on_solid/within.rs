//! Rope that lies within a body as the run begins: an endline stowed in its trap, a line laid through a frame.
//!
//! It does not touch that body until it has come out of it. No push could lead it out: where a line is made fast on both sides the push
//! would only grow. Lengths of rope are told by their place along the line, which stays as segments are split and merged.

use crate::contact::rope_on_solid::{RopeOnSolid, least_distance};
use crate::geometry::Pose;
use crate::solids::Solid;
use crate::state::{RopeWithin, State};

impl RopeOnSolid {
    /// Whether rope lies in a body, by the depth of its surface.
    pub fn any_in_body(&mut self, state: &State) -> bool {
        self.measure_lengths(&state.rope.segment_length);
        self.solids.iter().enumerate().any(|(solid, thing)| {
            thing.carrier.body().is_some()
                && self.lines.iter().enumerate().any(|(line, (nodes, _))| {
                    (nodes.start..nodes.end - 1).any(|node| {
                        let range = self.range_of(solid, line, node);
                        depth_of(state, thing, node, range) > -self.radius_m[line]
                    })
                })
        })
    }

    /// Finds what lies within a body where the run begins, and takes it from the state in every later step.
    pub(crate) fn take_within(&mut self, state: &State) {
        self.within.clear();
        if state.time_s > 0.0 {
            self.within.extend_from_slice(&state.rope.within);
            return;
        }
        for (solid, thing) in self.solids.iter().enumerate() {
            if thing.carrier.body().is_none() {
                continue;
            }
            for (line, (nodes, segments)) in self.lines.iter().enumerate() {
                for (node, segment) in (nodes.start..).zip(segments.clone()) {
                    let range = self.range_of(solid, line, node);
                    if !state.rope.cut[segment] && depth_of(state, thing, node, range) > 0.0 {
                        let from_m = self.along_m[node];
                        let to_m = from_m + self.lengths[segment];
                        add(&mut self.within, RopeWithin { solid, line, from_m, to_m });
                    }
                }
            }
        }
    }

    /// Whether any of a length of rope lies within a solid since the start.
    pub(crate) fn lies_within(&self, solid: usize, line: usize, [from_m, to_m]: [f64; 2]) -> bool {
        let here = |within: &RopeWithin| {
            within.solid == solid
                && within.line == line
                && within.from_m <= to_m
                && within.to_m >= from_m
        };
        self.within.iter().any(here)
    }

    /// Writes into a state at the end of a step what still lies within a body there.
    pub fn keep_within(&self, state: &mut State) {
        let mut kept = std::mem::take(&mut state.rope.within);
        kept.clear();
        for within in &self.within {
            let (nodes, segments) = &self.lines[within.line];
            let thing = &self.solids[within.solid];
            for (node, segment) in (nodes.start..).zip(segments.clone()) {
                let from_m = self.along_m[node].max(within.from_m);
                let to_m = (self.along_m[node] + self.lengths[segment]).min(within.to_m);
                let (range, radius_m) =
                    (self.range_of(within.solid, within.line, node), self.radius_m[within.line]);
                if from_m < to_m && depth_of(state, thing, node, range) > -radius_m {
                    add(&mut kept, RopeWithin { from_m, to_m, ..*within });
                }
            }
        }
        state.rope.within = kept;
    }
}

/// How far the centre line of a segment, between two fractions of it, reaches below a solid's surface [m].
fn depth_of(state: &State, solid: &Solid, node: usize, (low, high): (f64, f64)) -> f64 {
    if low >= high {
        return f64::NEG_INFINITY;
    }
    let pose = solid.carrier.pose(|body| Pose::of(&state.bodies[body]));
    let [from, to] = [node, node + 1].map(|node| state.rope.position[node]);
    let near = solid.radius_m + 0.5 * from.distance(to);
    if from.midpoint(to).distance_squared(pose.place) > near * near {
        return f64::NEG_INFINITY;
    }
    -least_distance(solid, &pose, from.lerp(to, low), from.lerp(to, high))
}

/// Adds a length of rope to a list in which it may go on from the last.
fn add(list: &mut Vec<RopeWithin>, next: RopeWithin) {
    match list.last_mut() {
        Some(last)
            if (last.solid, last.line) == (next.solid, next.line) && last.to_m >= next.from_m =>
        {
            last.to_m = next.to_m;
        }
        _ => list.push(next),
    }
}
