//! Rope taken in over the block in a step, and the model and state of the gear that is left. The equation is in `mod.rs`.

use std::ops::Range;

use endline_sdk::LineEnd;
use glam::DVec3;

use super::{End, Haul, HaulEvent};
use crate::model::{JointKind, Line, Model, ModelSpec, Strength};
use crate::state::State;
use crate::step::Workspace;

/// A segment shorter than this is taken aboard at once; the same length is added to the next rope [m].
const LEAST_M: f64 = 5e-3;

/// Length of line at which a body is taken aboard, because the knot does not pass the sheave; an estimate [m].
const ALONGSIDE_M: f64 = 0.3;

impl Haul {
    /// Takes in a length of rope of every line at the block, whose position at the end of the step is `block`.
    pub(super) fn take_in(&mut self, rope_m: f64, block: DVec3) {
        let mut waiting: Vec<(End, f64)> = self.ends.drain(..).map(|end| (end, rope_m)).collect();
        while let Some((end, left_m)) = waiting.pop() {
            let (tip, inner, segment) = self.tip(&end);
            let rope = &self.state.rope;
            let reach_m =
                rope.position[inner].distance(rope.position[tip]).max(rope.segment_length[segment]);
            if left_m + self.least_m(&end) < reach_m {
                self.shift(&end, left_m / reach_m, block);
                self.ends.push(end);
            } else {
                self.pass(end, left_m - reach_m, &mut waiting);
            }
        }
        self.ends.sort_by_key(|end| self.origin.lines[end.line]);
    }

    /// Length below which the segment at a line end is taken aboard at once [m].
    fn least_m(&self, end: &End) -> f64 {
        let line = &self.model.spec.lines[end.line];
        let far = if end.at == LineEnd::A { line.to } else { line.from };
        let on_body = matches!(self.model.spec.joints[far].kind, JointKind::Body { .. });
        if on_body && line.segments_m.len() == 1 { ALONGSIDE_M } else { LEAST_M }
    }

    /// Moves a line end along its segment by a share of it (outwards if negative) and drives it to the block.
    fn shift(&mut self, end: &End, share: f64, block: DVec3) {
        debug_assert!(share < 1.0, "the segment keeps a positive length");
        let (tip, inner, segment) = self.tip(end);
        let (step_s, time_s) = (self.step_s(), self.state.time_s);
        let rope = &mut self.state.rope;
        let place = rope.position[tip].lerp(rope.position[inner], share);
        let velocity_m_s = (block - place) / step_s;
        rope.segment_length[segment] *= 1.0 - share;
        rope.position[tip] = place;
        rope.earlier_position[tip] = place - velocity_m_s * rope.earlier_dt_s;
        (rope.velocity[tip], rope.earlier_velocity[tip]) = (velocity_m_s, velocity_m_s);
        let joint = &mut self.model.spec.joints[end.joint];
        joint.position_m = place;
        joint.kind = JointKind::Driven { velocity_m_s, from_s: time_s, until_s: time_s + step_s };
    }

    /// Takes the end segment of a line aboard. Adds the line ends that are then at the block to `waiting`, with the length
    /// still to take in; it is negative where too much was taken.
    fn pass(&mut self, end: End, left_m: f64, waiting: &mut Vec<(End, f64)>) {
        if self.model.line_segments[end.line].len() > 1 {
            self.drop_segment(end);
            waiting.push((end, left_m));
            return;
        }
        let line = &self.model.spec.lines[end.line];
        let far = if end.at == LineEnd::A { line.to } else { line.from };
        let (joints, body) = self.all_at(far);
        let meets = |line: &Line| joints.contains(&line.from) || joints.contains(&line.to);
        // Lines whose other end is already at the block are taken aboard with this one.
        let mut aboard = vec![end.line];
        aboard.extend(
            waiting
                .iter()
                .map(|(end, _)| end)
                .chain(&self.ends)
                .map(|end| end.line)
                .filter(|other| *other != end.line && meets(&self.model.spec.lines[*other])),
        );
        let lines = self.model.spec.lines.iter().enumerate();
        let next: Vec<usize> = lines
            .filter(|(index, line)| meets(line) && !aboard.contains(index))
            .map(|(index, _)| index)
            .collect();
        for line in next {
            let at = if joints.contains(&self.model.spec.lines[line].from) {
                LineEnd::A
            } else {
                LineEnd::B
            };
            let joint = self.own_joint(line, at);
            self.last_step.events.push(HaulEvent::Line(self.origin.lines[line]));
            waiting.push((End { line, at, joint }, left_m));
        }
        if let Some(body) = body {
            self.last_step.events.push(HaulEvent::Aboard(self.origin.bodies[body]));
        }
        waiting.retain(|(end, _)| !aboard.contains(&end.line));
        self.ends.retain(|end| !aboard.contains(&end.line));
        let renumbered = self.take_aboard(&aboard, body);
        let renumber = |end: &mut End| end.line = renumbered[end.line];
        waiting.iter_mut().map(|(end, _)| end).chain(&mut self.ends).for_each(renumber);
    }

    /// All joints at the position of a joint, and the body they belong to.
    fn all_at(&self, joint: usize) -> (Vec<usize>, Option<usize>) {
        let joints = &self.model.spec.joints;
        let body_of = |joint: usize| match joints[joint].kind {
            JointKind::Body { body, .. } => Some(body),
            _ => None,
        };
        let Some(body) = body_of(joint) else { return (vec![joint], None) };
        ((0..joints.len()).filter(|other| body_of(*other) == Some(body)).collect(), Some(body))
    }

    /// Adds a joint for a line end at its current position; returns its index.
    fn own_joint(&mut self, line: usize, at: LineEnd) -> usize {
        let joint = self.model.spec.joints.len();
        let (tip, ..) = self.tip(&End { line, at, joint });
        let own = crate::model::Joint {
            id: format!("block-{joint}"),
            kind: JointKind::Fixed,
            position_m: self.state.rope.position[tip],
        };
        self.model.spec.joints.push(own);
        let line = &mut self.model.spec.lines[line];
        *(if at == LineEnd::A { &mut line.from } else { &mut line.to }) = joint;
        joint
    }
}

/// Indices of the remaining gear in the initial model.
#[derive(Clone, Debug, Default)]
pub(super) struct Origin {
    /// Index of each line.
    pub lines: Vec<usize>,
    /// Index of each segment.
    pub segments: Vec<usize>,
    /// Index of each body.
    pub bodies: Vec<usize>,
    /// Unconverged steps under earlier models.
    pub unconverged: u64,
}

impl Origin {
    /// Indices of complete gear.
    pub fn of(model: &Model) -> Self {
        Self {
            lines: (0..model.spec.lines.len()).collect(),
            segments: (0..model.segment_count).collect(),
            bodies: (0..model.spec.bodies.len()).collect(),
            unconverged: 0,
        }
    }
}

/// Gear to keep: each line with its segments, and bodies.
struct Kept {
    lines: Vec<(usize, Range<usize>)>,
    bodies: Vec<usize>,
}

impl Haul {
    /// Removes the segment at a line end.
    pub(super) fn drop_segment(&mut self, end: End) {
        let mut kept = self.all();
        let segments = &mut kept.lines[end.line].1;
        *segments = match end.at {
            LineEnd::A => segments.start + 1..segments.end,
            LineEnd::B => segments.start..segments.end - 1,
        };
        self.keep(&kept);
    }

    /// Removes lines and a body; returns the new index of each line, `usize::MAX` for removed ones.
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

    /// Removes lines and bodies.
    pub(super) fn leave_out(&mut self, lines: &[usize], bodies: &[usize]) {
        let mut kept = self.all();
        kept.lines.retain(|(line, _)| !lines.contains(line));
        kept.bodies.retain(|body| !bodies.contains(body));
        self.keep(&kept);
    }

    /// All gear of the current model.
    fn all(&self) -> Kept {
        let lines = self.model.line_segments.iter().cloned().enumerate().collect();
        Kept { lines, bodies: (0..self.model.spec.bodies.len()).collect() }
    }

    /// Replaces model and state by those of the gear to keep.
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

/// Spec of the gear to keep.
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
            // A free joint without lines would make the solver's matrix singular.
            _ if !used.contains(&index) => JointKind::Fixed,
            other => other.clone(),
        };
    }
    spec
}

/// A line with the segments to keep.
fn line_of(model: &Model, index: usize, segments: &Range<usize>) -> Line {
    let (line, first) = (&model.spec.lines[index], model.line_segments[index].start);
    let own = segments.start - first..segments.end - first;
    Line {
        segments_m: line.segments_m[own].to_vec(),
        start_m: Vec::new(),
        strength: Strength::default(),
        weak_places: Vec::new(),
        knots_m: [0.0; 2],
        ..line.clone()
    }
}

/// State of the remaining gear, copied from the previous state.
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
