//! Rope that leaves the whale: to loose ends (trailing) and to what holds it (tethered).

use endline_sdk::LineEnd;

use crate::contact::ContactPoint;
use crate::model::{BodyRole, JointKind, Model};
use crate::state::State;
use crate::strands::{ends_at, joint_at, other};
use crate::whale::hitch;

/// Lengths of rope beyond the outermost contacts [m].
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Beyond {
    /// Rope that leads to loose ends only: broken or bare ends and buoys.
    pub(super) trailing_m: f64,
    /// Rope that leads to a trap, anchor, weight or fixture.
    pub(super) tethered_m: f64,
    /// Bodies that hang on the whale by that rope, in the model's order.
    pub(super) bodies: Vec<usize>,
}

/// The outermost contacts of each line as rope length from its end A [m].
#[derive(Clone, Debug)]
pub(super) struct Reach {
    touched: Vec<Option<(f64, f64)>>,
}

impl Reach {
    pub(super) fn new(model: &Model) -> Self {
        Self { touched: vec![None; model.spec.lines.len()] }
    }

    /// Takes in the contacts of a step, and the ends made fast to the whale.
    pub(super) fn fold(&mut self, model: &Model, state: &State, contacts: &[ContactPoint]) {
        self.touched.fill(None);
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let arc = state.arc(model, contact.segment, contact.fraction);
            let span = self.touched[contact.line].get_or_insert((arc, arc));
            *span = (span.0.min(arc), span.1.max(arc));
        }
        for (line, end) in hitch::ends(model) {
            let arc = if end == LineEnd::A {
                0.0
            } else {
                model.spec.lines[line].segments_m.iter().sum()
            };
            let span = self.touched[line].get_or_insert((arc, arc));
            *span = (span.0.min(arc), span.1.max(arc));
        }
    }

    /// Rope beyond the outermost contacts.
    pub(super) fn beyond(&self, model: &Model, state: &State) -> Beyond {
        let mut walk = Walk {
            model,
            state,
            touched: &self.touched,
            seen: vec![false; model.spec.lines.len()],
            found: Beyond::default(),
        };
        for (line, span) in self.touched.iter().enumerate() {
            if let Some((low, high)) = *span {
                let whole: f64 = model.spec.lines[line].segments_m.iter().sum();
                walk.follow(line, LineEnd::A, low);
                walk.follow(line, LineEnd::B, whole - high);
            }
        }
        walk.found.bodies.sort_unstable();
        walk.found.bodies.dedup();
        walk.found
    }
}

/// Where a walk along rope led.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Leads {
    /// Back to the whale, or to rope walked before.
    Back,
    /// To a loose end.
    Loose,
    /// To something that holds.
    Held,
}

struct Walk<'a> {
    model: &'a Model,
    state: &'a State,
    touched: &'a [Option<(f64, f64)>],
    seen: Vec<bool>,
    found: Beyond,
}

impl Walk<'_> {
    /// Walks the last `length_m` of a line towards `end` and on; adds up the rope by where it leads.
    fn follow(&mut self, line: usize, end: LineEnd, length_m: f64) -> Leads {
        let (walked, leads) = match self.to_cut(line, end, length_m) {
            Some(walked) => (walked, Leads::Loose),
            None => (length_m, self.past(line, end)),
        };
        match leads {
            Leads::Back => {}
            Leads::Loose => self.found.trailing_m += walked,
            Leads::Held => self.found.tethered_m += walked,
        }
        leads
    }

    /// Rope before the first cut in the last `length_m` of a line towards `end`; `None` where it is whole [m].
    fn to_cut(&self, line: usize, end: LineEnd, length_m: f64) -> Option<f64> {
        let lengths = &self.state.rope.segment_length[self.model.line_segments[line].clone()];
        let cut = &self.state.rope.cut[self.model.line_segments[line].clone()];
        let (mut left, mut nearest) = (0.0, None);
        let mut look = |length: &f64, cut: &bool| {
            if *cut && left < length_m {
                nearest = Some((length_m - left - length).max(0.0));
            }
            left += length;
        };
        match end {
            LineEnd::A => lengths.iter().zip(cut).for_each(|(length, cut)| look(length, cut)),
            LineEnd::B => lengths.iter().zip(cut).rev().for_each(|(length, cut)| look(length, cut)),
        }
        nearest
    }

    /// Where what lies past an end of a line leads.
    fn past(&mut self, line: usize, end: LineEnd) -> Leads {
        let joint = joint_at(self.model, line, end);
        let Some(kind) = self.model.spec.joints.get(joint).map(|joint| &joint.kind) else {
            return Leads::Loose;
        };
        if let JointKind::Body { body, .. } = kind {
            self.found.bodies.push(*body);
        }
        match kind {
            JointKind::Whale(_) => Leads::Back,
            JointKind::Fixed | JointKind::Driven { .. } => Leads::Held,
            JointKind::Body { body, .. }
                if self.model.spec.bodies[*body].role != BodyRole::Buoy =>
            {
                Leads::Held
            }
            _ => self.on_from(joint, (line, end)),
        }
    }

    /// Walks on from a splice or buoy along every other line there.
    fn on_from(&mut self, joint: usize, came: (usize, LineEnd)) -> Leads {
        let mut ends: Vec<(usize, LineEnd)> =
            self.hub(joint).into_iter().flat_map(|joint| ends_at(self.model, joint)).collect();
        ends.retain(|end| *end != came);
        if ends.is_empty() {
            return Leads::Loose;
        }
        ends.into_iter().map(|(line, end)| self.enter(line, end)).max().unwrap_or(Leads::Loose)
    }

    /// Walks a whole line entered at `end`; a touched one leads back to the whale.
    fn enter(&mut self, line: usize, end: LineEnd) -> Leads {
        if self.touched[line].is_some() || self.seen[line] {
            return Leads::Back;
        }
        self.seen[line] = true;
        let whole = self.model.spec.lines[line].segments_m.iter().sum();
        self.follow(line, other(end), whole)
    }

    /// The joints that move as one with a joint: itself, or all on its body.
    fn hub(&self, joint: usize) -> Vec<usize> {
        let JointKind::Body { body, .. } = self.model.spec.joints[joint].kind else {
            return vec![joint];
        };
        let same = |kind: &JointKind| matches!(kind, JointKind::Body { body: other, .. } if *other == body);
        (0..self.model.spec.joints.len())
            .filter(|joint| same(&self.model.spec.joints[*joint].kind))
            .collect()
    }
}
