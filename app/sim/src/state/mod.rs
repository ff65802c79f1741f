//! The defined set of all that advances in time, and nothing else.

pub mod body;
pub mod friction;
pub mod pilot;
pub mod rope;
pub mod step_control;
pub mod whale;

use glam::DVec3;

use crate::in_place::clone_in_place;
use crate::model::{JointKind, Model};
pub use body::BodyState;
pub use friction::{
    Bears, BodyGrip, BodyGrips, FrictionState, PairGrip, RopeGrip, RopeWithin, SolidGrip,
};
pub use pilot::{Begun, PilotMemory, Seen};
pub use rope::RopeState;
pub use step_control::{LimitedBy, StepControl};
pub use whale::WhaleState;

/// Everything the next step depends on, besides the model and the input.
#[derive(Debug, PartialEq)]
pub struct State {
    /// Simulated time [s].
    pub time_s: f64,
    /// Steps taken (calls of `step`).
    pub step: u64,
    /// Rope nodes and segments.
    pub rope: RopeState,
    /// Bodies, in the model's order.
    pub bodies: Vec<BodyState>,
    /// Where bodies touch the whale's skin.
    pub body_grips: BodyGrips,
    /// Where bodies touch each other.
    pub pair_grips: Vec<PairGrip>,
    /// The whale, where the model has one.
    pub whale: Option<WhaleState>,
    /// When each weak link parted [s].
    pub link_parted_s: Vec<Option<f64>>,
    /// When each line parted (rope broken or cut) [s], and how far from its end A, by unstretched length [m].
    pub line_parted: Vec<Option<(f64, f64)>>,
    /// Floats of each gear type.
    pub gear: Vec<Vec<f64>>,
    /// How long the next solver step is to be, and why.
    pub step_control: StepControl,
    /// What the whale's pilot program has seen and begun; it chooses inputs and moves nothing by itself.
    pub pilot: PilotMemory,
}

clone_in_place!(State {
    time_s,
    step,
    rope,
    bodies,
    body_grips,
    pair_grips,
    whale,
    link_parted_s,
    line_parted,
    gear,
    step_control,
    pilot
});

impl State {
    /// Unstretched rope of a segment's line from its end A to a fraction of the segment [m].
    #[must_use]
    pub fn arc(&self, model: &Model, segment: usize, fraction: f64) -> f64 {
        let first = model.line_segments[model.segment_line[segment]].start;
        self.rope.segment_length[first..segment].iter().sum::<f64>()
            + fraction * self.rope.segment_length[segment]
    }

    /// Place of a joint [m]: of the line end that meets there, or on its body.
    #[must_use]
    pub fn joint_place(&self, model: &Model, joint: usize) -> Option<DVec3> {
        let kind = &model.spec.joints.get(joint)?.kind;
        if let JointKind::Body { body, offset_m } = kind {
            let body = self.bodies.get(*body)?;
            return Some(body.position + body.orientation * *offset_m);
        }
        let node =
            model.spec.lines.iter().zip(&model.line_nodes).find_map(|(line, nodes)| match joint {
                _ if line.from == joint => Some(nodes.start),
                _ if line.to == joint => Some(nodes.end - 1),
                _ => None,
            });
        node.map(|node| self.rope.position[node])
    }

    /// Forgets all motion: the history of a rig at rest.
    pub(crate) fn rest(&mut self) {
        let rope = &mut self.rope;
        rope.velocity.fill(DVec3::ZERO);
        rope.earlier_velocity.fill(DVec3::ZERO);
        rope.earlier_position.clone_from(&rope.position);
        rope.earlier_dt_s = 0.0;
        for body in &mut self.bodies {
            body.velocity = DVec3::ZERO;
            body.earlier_velocity = DVec3::ZERO;
            body.earlier_position = body.position;
            body.spin = DVec3::ZERO;
            body.earlier_spin = DVec3::ZERO;
            body.earlier_orientation = body.orientation;
        }
    }
}
