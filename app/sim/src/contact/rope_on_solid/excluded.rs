//! Rope next to the body that it is made fast to, which does not touch any part of that body.

use crate::contact::rope_on_solid::RopeOnSolid;
use crate::model::{JointKind, Model};
use crate::solids::{Carrier, Solid};

/// Share of a segment next to its nodes that its nodes answer for.
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
