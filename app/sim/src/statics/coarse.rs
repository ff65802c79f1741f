//! Coarse to fine: the gear with fewer segments finds its shape first.
//!
//! A pass costs what the gear has nodes, and how many passes a shape takes depends on how far the first guess is from it,
//! not on the segments. So neighbouring segments of each line are joined, the coarse gear settles, and its shape is
//! carried over: nodes between two that were kept lie on the straight line between them, tension and grip likewise.
//! What is left to the finer gear is to round those corners.
//! Reference: Brandt and Livne 2011, Multigrid Techniques, section 1.5 (nested iteration; doi:10.1137/1.9781611970753).

use crate::model::{Line, Model};
use crate::state::State;

/// Segments that are joined to one.
const TIMES: usize = 4;
/// Fewest segments of a line that has more.
const LEAST: usize = 4;
/// Segments of the longest line below which it is not joined further.
const COARSEST: usize = 40;

/// Gear with fewer segments.
pub(super) struct Coarse {
    pub model: Model,
    /// Node of the finer gear at each of its nodes.
    kept: Vec<usize>,
}

impl Coarse {
    /// Of gear whose longest line has segments enough.
    pub fn of(model: &Model) -> Option<Self> {
        let longest = model.spec.lines.iter().map(|line| line.segments_m.len()).max()?;
        if longest < COARSEST {
            return None;
        }
        let (mut lines, mut kept) = (Vec::new(), Vec::new());
        for (line, nodes) in model.spec.lines.iter().zip(&model.line_nodes) {
            let ends = ends_of(line.segments_m.len());
            lines.push(joined(line, &ends));
            kept.extend(ends.iter().map(|end| nodes.start + end));
        }
        Some(Self { model: model.with_lines(lines), kept })
    }

    /// A state of the coarse gear carried over to the finer one.
    pub fn carry(&self, tolerance: &Model, state: &State) -> State {
        let mut carried = State::start(tolerance);
        for (nodes, segments) in self.model.line_nodes.iter().zip(&self.model.line_segments) {
            for (node, segment) in (nodes.start..).zip(segments.clone()) {
                self.carry_segment(state, node, segment, &mut carried);
            }
        }
        carried.bodies.clone_from(&state.bodies);
        carried
    }

    fn carry_segment(&self, state: &State, node: usize, segment: usize, carried: &mut State) {
        let (first, last) = (self.kept[node], self.kept[node + 1]);
        let first_segment = first - self.model.segment_line[segment];
        let (rope, from) = (&mut carried.rope, &state.rope);
        let mut along = 0.0;
        for place in first..=last {
            let share = along / from.segment_length[segment];
            rope.position[place] = from.position[node].lerp(from.position[node + 1], share);
            rope.seabed_grip[place] =
                from.seabed_grip[node].lerp(from.seabed_grip[node + 1], share);
            if place < last {
                rope.tension[first_segment + place - first] = from.tension[segment];
                along += rope.segment_length[first_segment + place - first];
            }
        }
    }
}

/// Nodes of a line of so many segments that are kept, both ends among them.
fn ends_of(segments: usize) -> Vec<usize> {
    let count = segments.div_ceil(TIMES).max(segments.min(LEAST));
    (0..=count).map(|end| end * segments / count).collect()
}

/// The line with its segments between those ends joined.
fn joined(line: &Line, ends: &[usize]) -> Line {
    Line {
        segments_m: ends
            .windows(2)
            .map(|pair| line.segments_m[pair[0]..pair[1]].iter().sum())
            .collect(),
        start_m: if line.start_m.is_empty() {
            Vec::new()
        } else {
            ends.iter().map(|end| line.start_m[*end]).collect()
        },
        ..line.clone()
    }
}
