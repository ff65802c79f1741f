//! Unstretched lengths of segments, what of them hangs on each node, and the axial law that goes with each.

use crate::forces::axial::Axial;
use crate::model::Model;
use crate::same_bits::same_bits;

/// Lengths of a step, taken from the state it begins from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lengths {
    /// Unstretched length of each segment [m].
    pub segment: Vec<f64>,
    /// Length of the shortest segment [m].
    pub shortest: f64,
    /// Unstretched length that hangs on each node: half of its neighbours in the same line [m].
    pub node: Vec<f64>,
    /// Axial law of each segment.
    pub axial: Vec<Axial>,
}

impl Lengths {
    /// Takes over the lengths of a state, where they are not those there are.
    pub fn take(&mut self, model: &Model, segment_length: &[f64]) {
        if self.shortest > 0.0 && same_bits(&self.segment, segment_length) {
            return;
        }
        self.segment.clear();
        self.segment.extend_from_slice(segment_length);
        self.shortest = segment_length.iter().copied().fold(f64::INFINITY, f64::min);
        self.axial.clear();
        self.axial.extend(
            segment_length
                .iter()
                .enumerate()
                .map(|(segment, length)| Axial::of(model.rope_of_segment(segment), *length)),
        );
        self.node.clear();
        self.node.resize(model.node_count, 0.0);
        for (nodes, segments) in model.line_nodes.iter().zip(&model.line_segments) {
            for (node, length) in (nodes.start..).zip(&segment_length[segments.clone()]) {
                self.node[node] += 0.5 * length;
                self.node[node + 1] += 0.5 * length;
            }
        }
    }
}
