//! Rope that leaves the whale, to loose ends (trailing) and to what holds it (tethered); and contact of the whale with seabed
//! and surface.
//!
//! The extent of the trunk beyond a plane is that of ellipses across its axis: with the unit normal `n` of the plane in the
//! whale's frame, a section with centre `c` and half widths `a`, `b` [m] reaches `c·n + √(a² n_y² + b² n_z²)` [m] (support
//! function of an ellipse).

use endline_sdk::LineEnd;
use glam::DVec3;

use super::events::{EventKind, Log};
use crate::contact::ContactPoint;
use crate::model::{BodyRole, JointKind, Model};
use crate::state::{State, WhaleState};
use crate::strands::{ends_at, joint_at, other};
use crate::whale::axes::trunk_axis;
use crate::whale::{Skin, hitch};

/// Rope beyond the outermost contacts.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Beyond {
    /// Length of rope that leads to loose ends only: broken or bare ends and buoys [m].
    pub(super) trailing_m: f64,
    /// Length of rope that leads to a trap, anchor, weight or fixture [m].
    pub(super) tethered_m: f64,
    /// Bodies attached to the whale by that rope, in the model's order.
    pub(super) bodies: Vec<usize>,
}

/// Outermost contacts of each line, as lengths from its end A [m].
#[derive(Clone, Debug)]
pub(super) struct Reach {
    touched: Vec<Option<(f64, f64)>>,
}

impl Reach {
    pub(super) fn new(model: &Model) -> Self {
        Self { touched: vec![None; model.spec.lines.len()] }
    }

    /// Replaces the contacts by those of a step, and adds the line ends attached to the whale.
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

    /// Finds the rope beyond the outermost contacts.
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

/// What a walk along rope leads to.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Leads {
    /// Back to the whale, or to rope already walked.
    Back,
    /// A loose end.
    Loose,
    /// Something that holds it.
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
    /// Walks the last `length_m` of a line towards `end` and beyond; adds the length to that of its kind.
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

    /// Length of rope before the first cut in the last `length_m` of a line towards `end`; `None` without a cut [m].
    fn to_cut(&self, line: usize, end: LineEnd, length_m: f64) -> Option<f64> {
        let lengths = &self.state.rope.segment_length[self.model.line_segments[line].clone()];
        let cut = &self.state.rope.cut[self.model.line_segments[line].clone()];
        let (mut left, mut nearest) = (0.0, None);
        let mut visit = |length: &f64, cut: &bool| {
            if *cut && left < length_m {
                nearest = Some((length_m - left - length).max(0.0));
            }
            left += length;
        };
        match end {
            LineEnd::A => lengths.iter().zip(cut).for_each(|(length, cut)| visit(length, cut)),
            LineEnd::B => {
                lengths.iter().zip(cut).rev().for_each(|(length, cut)| visit(length, cut))
            }
        }
        nearest
    }

    /// What an end of a line leads to.
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

    /// Walks from a splice or buoy along every other line.
    fn on_from(&mut self, joint: usize, from: (usize, LineEnd)) -> Leads {
        let mut ends: Vec<(usize, LineEnd)> =
            self.hub(joint).into_iter().flat_map(|joint| ends_at(self.model, joint)).collect();
        ends.retain(|end| *end != from);
        if ends.is_empty() {
            return Leads::Loose;
        }
        ends.into_iter().map(|(line, end)| self.enter(line, end)).max().unwrap_or(Leads::Loose)
    }

    /// Walks a whole line from `end`; a line in contact leads back to the whale.
    fn enter(&mut self, line: usize, end: LineEnd) -> Leads {
        if self.touched[line].is_some() || self.seen[line] {
            return Leads::Back;
        }
        self.seen[line] = true;
        let whole = self.model.spec.lines[line].segments_m.iter().sum();
        self.follow(line, other(end), whole)
    }

    /// Joints that move with a joint: itself, or all joints of its body.
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

/// Distance that the whale must withdraw before another contact is reported; estimate [m].
const REARM_M: f64 = 0.5;

/// The trunk as ellipses across its axis, in the whale's frame at rest.
#[derive(Clone, Debug)]
pub(super) struct Extent {
    ellipses: Vec<(DVec3, [f64; 2])>,
    at_seabed: bool,
    at_surface: bool,
}

impl Extent {
    pub(super) fn new(skin: &Skin) -> Self {
        let sections = trunk_axis(skin).map(|axis| axis.sections).unwrap_or_default();
        let ellipse = |section: &crate::whale::axes::Section| {
            (DVec3::new(section.along_m, section.middle_m[0], section.middle_m[1]), section.half_m)
        };
        Self {
            ellipses: sections.iter().map(ellipse).collect(),
            at_seabed: false,
            at_surface: false,
        }
    }

    pub(super) fn fold(&mut self, model: &Model, whale: &WhaleState, time_s: f64, log: &mut Log) {
        if self.ellipses.is_empty() {
            return;
        }
        let top = self.reach(whale, DVec3::ZERO, DVec3::Z);
        if passes(&mut self.at_surface, top) {
            log.record(time_s, EventKind::AtSurface, "whale", top);
        }
        if let Some(seabed) = &model.spec.seabed {
            let depth = self.reach(whale, DVec3::new(0.0, 0.0, -seabed.depth_m), -seabed.normal);
            if passes(&mut self.at_seabed, depth) {
                log.record(time_s, EventKind::AtSeabed, "whale", -depth);
            }
        }
    }

    /// Extent of the trunk beyond a plane through `point` with the unit normal `out` [m].
    fn reach(&self, whale: &WhaleState, point: DVec3, out: DVec3) -> f64 {
        let own = whale.orientation.inverse() * out;
        let base = (whale.position - point).dot(out);
        let beyond = |(middle, half): &(DVec3, [f64; 2])| {
            base + middle.dot(own) + libm::hypot(half[0] * own.y, half[1] * own.z)
        };
        self.ellipses.iter().map(beyond).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Whether an extent has just become positive; true again only after a withdrawal by [`REARM_M`].
fn passes(beyond: &mut bool, reach: f64) -> bool {
    let passed = !*beyond && reach >= 0.0;
    *beyond = if *beyond { reach > -REARM_M } else { passed };
    passed
}
