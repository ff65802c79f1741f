//! Rope taken in over the block in a step (the equation is in `mod.rs`).

use endline_sdk::LineEnd;
use glam::DVec3;

use super::{Came, End, Haul};
use crate::model::{JointKind, Line};

/// A segment of less than this goes aboard in advance: as much of the next rope is put on in its place [m].
const LEAST_M: f64 = 5e-3;
/// A body is taken aboard with so much of its line left: nobody draws the knot into the sheave. An estimate [m].
const ALONGSIDE_M: f64 = 0.3;

impl Haul {
    /// Takes in so much rope of every line at the block, which ends the step at `block`.
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

    /// How much of the segment at a line's end goes aboard in advance [m].
    fn least_m(&self, end: &End) -> f64 {
        let line = &self.model.spec.lines[end.line];
        let far = if end.at == LineEnd::A { line.to } else { line.from };
        let on_body = matches!(self.model.spec.joints[far].kind, JointKind::Body { .. });
        if on_body && line.segments_m.len() == 1 { ALONGSIDE_M } else { LEAST_M }
    }

    /// Moves a line's end along its segment by a share of it, outwards by one below zero, and lets it be driven to the block.
    fn shift(&mut self, end: &End, share: f64, block: DVec3) {
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

    /// The end segment of a line goes aboard; what then lies at the block waits with the rope that is left to take in,
    /// or below zero with what was taken too much.
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
        // Lines whose other end is at the block already go aboard with this one.
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
            self.felt.came.push(Came::Line(self.origin.lines[line]));
            waiting.push((End { line, at, joint }, left_m));
        }
        if let Some(body) = body {
            self.felt.came.push(Came::Aboard(self.origin.bodies[body]));
        }
        waiting.retain(|(end, _)| !aboard.contains(&end.line));
        self.ends.retain(|end| !aboard.contains(&end.line));
        let renumbered = self.take_aboard(&aboard, body);
        let renumber = |end: &mut End| end.line = renumbered[end.line];
        waiting.iter_mut().map(|(end, _)| end).chain(&mut self.ends).for_each(renumber);
    }

    /// All joints at one place, that of a joint, and the body they are on.
    fn all_at(&self, joint: usize) -> (Vec<usize>, Option<usize>) {
        let joints = &self.model.spec.joints;
        let body_of = |joint: usize| match joints[joint].kind {
            JointKind::Body { body, .. } => Some(body),
            _ => None,
        };
        let Some(body) = body_of(joint) else { return (vec![joint], None) };
        ((0..joints.len()).filter(|other| body_of(*other) == Some(body)).collect(), Some(body))
    }

    /// Gives a line's end a joint of its own, where the end is now.
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
