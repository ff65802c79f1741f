//! Knots among ropes: a knot, splice or link is a ball that touches other rope, and other knots, by its own radius.
//!
//! With radii `R` of the knot and `r` of the rope, the contact distance is `h = R + r`, from the knot's middle to the centre line; of two
//! knots it is the sum of their radii. The push acts along the line between the two. A knot drawn between two taut ropes has to spread
//! them: with stiffness `k` of each across, and its centre line at rest `y` from the knot's way, the greatest force is
//!
//! ```text
//! F = 2 k x (h/ρ - 1)        ρ³ = h y²        x² = ρ² - y²
//! ```
//!
//! without friction (`app/sim/tests/all/knots_on_ropes.rs`). A knot between them holds up to that force; the bare rope runs freely.

use std::ops::Range;

use glam::DVec3;

use crate::model::{Knot, Model};

/// A knot where it lies on its segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ball {
    pub segment: usize,
    /// First node of the segment.
    pub node: usize,
    /// Where its middle lies, 0 at the segment's first node, 1 at its second.
    pub fraction: f64,
    pub radius_m: f64,
}

impl Ball {
    /// All knots of a model, in its order.
    pub fn all(model: &Model) -> Vec<Self> {
        let ball = |knot: &Knot| {
            let line = model.segment_line[knot.segment];
            let within = knot.segment - model.line_segments[line].start;
            let node = model.line_nodes[line].start + within;
            let Knot { segment, radius_m, .. } = *knot;
            Self { segment, node, fraction: 0.0, radius_m }
        };
        model.knots.iter().map(ball).collect()
    }

    /// The place of its middle by that of nodes.
    pub fn middle(&self, at: impl Fn(usize) -> DVec3) -> DVec3 {
        at(self.node).lerp(at(self.node + 1), self.fraction)
    }
}

/// Numbers of the knots on a run of segments, of all in rising order of segment.
pub(crate) fn on_segments(knots: &[Ball], segments: &Range<usize>) -> Range<usize> {
    let place = |at: usize| knots.partition_point(|ball| ball.segment < at);
    place(segments.start)..place(segments.end)
}
