//! The gear that is left as parts of it go aboard: a new model, with the state carried over.

use std::ops::Range;

use endline_sdk::LineEnd;

use super::{End, Haul};
use crate::model::{JointKind, Line, Model, ModelSpec, Strength};
use crate::state::State;
use crate::step::Workspace;

/// Numbers, in the gear that the haul began with, of what is left.
#[derive(Clone, Debug, Default)]
pub(super) struct Origin {
    /// Of each line.
    pub lines: Vec<usize>,
    /// Of each segment.
    pub segments: Vec<usize>,
    /// Of each body.
    pub bodies: Vec<usize>,
    /// Unconverged steps of the models before.
    pub unconverged: u64,
}

impl Origin {
    /// Of a gear that is all there.
    pub fn of(model: &Model) -> Self {
        Self {
            lines: (0..model.spec.lines.len()).collect(),
            segments: (0..model.segment_count).collect(),
            bodies: (0..model.spec.bodies.len()).collect(),
            unconverged: 0,
        }
    }
}

/// What is kept: each line with its segments, and bodies.
struct Kept {
    lines: Vec<(usize, Range<usize>)>,
    bodies: Vec<usize>,
}

impl Haul {
    /// Lets the segment at a line's end go.
    pub(super) fn drop_segment(&mut self, end: End) {
        let mut kept = self.all();
        let segments = &mut kept.lines[end.line].1;
        *segments = match end.at {
            LineEnd::A => segments.start + 1..segments.end,
            LineEnd::B => segments.start..segments.end - 1,
        };
        self.keep(&kept);
    }

    /// Lets lines and a body go; the new number of each line, of those gone that of none.
    pub(super) fn take_aboard(&mut self, lines: &[usize], body: Option<usize>) -> Vec<usize> {
        let mut kept = self.all();
        kept.lines.retain(|(line, _)| !lines.contains(line));
        kept.bodies.retain(|other| Some(*other) != body);
        let mut renumbered = vec![usize::MAX; self.model.spec.lines.len()];
        for (new, (old, _)) in kept.lines.iter().enumerate() {
            renumbered[*old] = new;
        }
        self.keep(&kept);
        renumbered
    }

    /// Lets all of these lines and bodies go.
    pub(super) fn leave_out(&mut self, lines: &[usize], bodies: &[usize]) {
        let mut kept = self.all();
        kept.lines.retain(|(line, _)| !lines.contains(line));
        kept.bodies.retain(|body| !bodies.contains(body));
        self.keep(&kept);
    }

    fn all(&self) -> Kept {
        let lines = self.model.line_segments.iter().cloned().enumerate().collect();
        Kept { lines, bodies: (0..self.model.spec.bodies.len()).collect() }
    }

    fn keep(&mut self, kept: &Kept) {
        let model = self.model.with_spec(spec_of(&self.model, kept));
        let state = carried(&self.model, &self.state, &model, kept);
        let Origin { lines, segments, bodies, unconverged } = &self.origin;
        self.origin = Origin {
            lines: kept.lines.iter().map(|(line, _)| lines[*line]).collect(),
            segments: kept
                .lines
                .iter()
                .flat_map(|(_, of)| of.clone().map(|one| segments[one]))
                .collect(),
            bodies: kept.bodies.iter().map(|body| bodies[*body]).collect(),
            unconverged: unconverged + self.work.audit.unconverged,
        };
        self.work = Workspace::new(&model);
        (self.model, self.state) = (model, state);
    }
}

fn spec_of(model: &Model, kept: &Kept) -> ModelSpec {
    let mut spec = model.spec.clone();
    spec.lines =
        kept.lines.iter().map(|(line, segments)| line_of(model, *line, segments)).collect();
    spec.bodies = kept.bodies.iter().map(|body| model.spec.bodies[*body].clone()).collect();
    let used: Vec<usize> = spec.lines.iter().flat_map(|line| [line.from, line.to]).collect();
    for (index, joint) in spec.joints.iter_mut().enumerate() {
        joint.kind = match &joint.kind {
            JointKind::Body { body, offset_m } => {
                let new = kept.bodies.iter().position(|other| other == body);
                new.map_or(JointKind::Fixed, |body| JointKind::Body { body, offset_m: *offset_m })
            }
            // Where no line ends, nothing would hold a free joint in the solver's matrix.
            _ if !used.contains(&index) => JointKind::Fixed,
            other => other.clone(),
        };
    }
    spec
}

fn line_of(model: &Model, index: usize, segments: &Range<usize>) -> Line {
    let (line, first) = (&model.spec.lines[index], model.line_segments[index].start);
    let own = segments.start - first..segments.end - first;
    Line {
        segments_m: line.segments_m[own].to_vec(),
        start_m: Vec::new(),
        strength: Strength::default(),
        knots_m: [0.0; 2],
        ..line.clone()
    }
}

/// The state of what is left: places, motion, tension and grip as they were.
fn carried(from: &Model, was: &State, to: &Model, kept: &Kept) -> State {
    let mut state = State::start(to);
    (state.time_s, state.step) = (was.time_s, was.step);
    state.rope.earlier_dt_s = was.rope.earlier_dt_s;
    for (index, (line, segments)) in kept.lines.iter().enumerate() {
        let shift = from.line_nodes[*line].start - from.line_segments[*line].start;
        let nodes = segments.start + shift..segments.end + shift + 1;
        let (rope, old) = (&mut state.rope, &was.rope);
        let into = to.line_nodes[index].clone();
        rope.position[into.clone()].copy_from_slice(&old.position[nodes.clone()]);
        rope.velocity[into.clone()].copy_from_slice(&old.velocity[nodes.clone()]);
        rope.earlier_position[into.clone()].copy_from_slice(&old.earlier_position[nodes.clone()]);
        rope.earlier_velocity[into.clone()].copy_from_slice(&old.earlier_velocity[nodes.clone()]);
        rope.seabed_grip[into].copy_from_slice(&old.seabed_grip[nodes]);
        let into = to.line_segments[index].clone();
        rope.segment_length[into.clone()].copy_from_slice(&old.segment_length[segments.clone()]);
        rope.tension[into.clone()].copy_from_slice(&old.tension[segments.clone()]);
        rope.cut[into].copy_from_slice(&old.cut[segments.clone()]);
    }
    for (body, old) in state.bodies.iter_mut().zip(&kept.bodies) {
        body.clone_from(&was.bodies[*old]);
    }
    state
}
