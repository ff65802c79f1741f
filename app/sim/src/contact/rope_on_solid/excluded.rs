//! Rope that does not touch a solid.
//!
//! - Rope next to the body to which it is attached does not touch any part of that body.
//! - Rope that is within a body when the run begins (an endline stowed in its trap, a line laid through a frame) does not touch that
//!   body until it has come out. No normal force could lead it out: if a line is attached on both sides, the force would only grow.
//!   Such lengths of rope are stored by their position along the line, which does not change as segments are split and merged.

use crate::contact::rope_on_solid::{RopeOnSolid, least_distance};
use crate::geometry::Pose;
use crate::model::{JointKind, Model};
use crate::solids::{Carrier, Solid};
use crate::state::{RopeWithin, State};

/// Share of a segment next to its nodes in which contact is evaluated at the nodes.
const NODES_SHARE: f64 = 0.01;
/// Length of a line next to its body that does not touch that body [m].
const SPARED_M: f64 = 0.1;

/// A line's end made fast to a body, and the length of it that does not touch that body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spared {
    line: usize,
    solid: usize,
    at_start: bool,
    /// Unstretched length of it [m].
    length_m: f64,
}

impl RopeOnSolid {
    /// Fractions of a segment between which it may touch a solid.
    pub(crate) fn range_of(&self, solid: usize, line: usize, node: usize) -> (f64, f64) {
        let (start, length) = (self.along_m[node], self.length_of(node));
        let (mut low, mut high) = (NODES_SHARE, 1.0 - NODES_SHARE);
        for spared in
            self.spared.iter().filter(|spared| spared.solid == solid && spared.line == line)
        {
            let end = (self.spared_end(spared) - start) / length;
            if spared.at_start {
                low = low.max(end);
            } else {
                high = high.min(end);
            }
        }
        (low, high)
    }

    pub(crate) fn is_spared(&self, solid: usize, line: usize, along_m: f64) -> bool {
        let here = |spared: &Spared| (along_m <= self.spared_end(spared)) == spared.at_start;
        self.spared
            .iter()
            .any(|spared| spared.solid == solid && spared.line == line && here(spared))
    }

    /// Where along its line a spared length ends [m].
    fn spared_end(&self, spared: &Spared) -> f64 {
        let last = self.lines[spared.line].0.end - 1;
        if spared.at_start { spared.length_m } else { self.along_m[last] - spared.length_m }
    }
}

/// Ends of lines made fast to bodies.
pub(crate) fn spared(model: &Model, solids: &[Solid]) -> Vec<Spared> {
    let mut list = Vec::new();
    if !model.spec.settings.rope_on_bodies {
        return list;
    }
    for (index, line) in model.spec.lines.iter().enumerate() {
        for (joint, at_start) in [(line.from, true), (line.to, false)] {
            let JointKind::Body { body, offset_m } = model.spec.joints[joint].kind else {
                continue;
            };
            for (solid, part) in solids.iter().enumerate() {
                let Carrier::Body { body: whose, middle_m } = part.carrier else { continue };
                if whose == body {
                    let depth_m = -part.shape.distance(offset_m - middle_m);
                    let length_m = SPARED_M.max(2.0 * depth_m);
                    list.push(Spared { line: index, solid, at_start, length_m });
                }
            }
        }
    }
    list
}

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

    /// Finds the rope within bodies at the start of the run, and reads it from the state in every later step.
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

    /// Writes the rope that is still within a body at the end of a step to the state.
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

/// Adds a length of rope to a list, as an extension of the last if they are adjacent.
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
