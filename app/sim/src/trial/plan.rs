//! Attachments of line ends and blocks of bodies, derived once from a model.

use glam::DVec3;

use crate::model::{JointKind, Model};

/// Where a line's end sits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Attachment {
    /// On a fixture: no freedom.
    Fixed,
    /// On a free joint with this block.
    Free(usize),
    /// On a body: blocks of its place and (next) its rotation.
    Body { block: usize, body: usize, offset: DVec3 },
}

/// Attachment of each joint and the arm from its body's origin to it.
pub(crate) type Attachments = [(Attachment, DVec3)];

/// Look-up tables of the solver for one model.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// Attachment of each joint.
    pub attachments: Vec<Attachment>,
    /// First block of each body.
    pub body_block: Vec<usize>,
    /// First node of each segment.
    pub segment_node: Vec<usize>,
    /// A node at each joint, if a line ends there.
    pub joint_node: Vec<Option<usize>>,
    /// Weight in air of all rope and bodies [N].
    pub weight_n: f64,
}

impl Plan {
    /// Derives the look-ups of a model.
    pub fn new(model: &Model) -> Self {
        let mut blocks = 0;
        let attachments = attachments(model, &mut blocks);
        let body_block =
            (0..model.spec.bodies.len()).map(|body| blocks + 2 * body).collect::<Vec<_>>();
        let attachments =
            attachments.into_iter().map(|attachment| shift_body(attachment, &body_block)).collect();
        let mut plan = Self {
            attachments,
            body_block,
            segment_node: Vec::with_capacity(model.segment_count),
            joint_node: vec![None; model.spec.joints.len()],
            weight_n: weight_n(model),
        };
        for (index, line) in model.spec.lines.iter().enumerate() {
            let first = model.line_nodes[index].start;
            plan.segment_node.extend(first..model.line_nodes[index].end - 1);
            plan.joint_node[line.from].get_or_insert(first);
            plan.joint_node[line.to].get_or_insert(model.line_nodes[index].end - 1);
        }
        plan
    }

    /// The attachment at a body's place.
    pub fn body(&self, body: usize) -> Attachment {
        Attachment::Body { block: self.body_block[body], body, offset: DVec3::ZERO }
    }

    /// Lever arm of an attachment in the world frame, from the orientations of the bodies.
    pub fn arm(attachment: Attachment, orientation: impl Fn(usize) -> glam::DQuat) -> DVec3 {
        match attachment {
            Attachment::Body { body, offset, .. } => orientation(body) * offset,
            _ => DVec3::ZERO,
        }
    }
}

/// Weight in air of all rope and bodies [N].
fn weight_n(model: &Model) -> f64 {
    let line = |line: &crate::model::Line| {
        model.spec.ropes[line.rope].mass_kg_m * line.segments_m.iter().sum::<f64>()
    };
    let rope: f64 = model.spec.lines.iter().map(line).sum();
    let bodies: f64 = model.spec.bodies.iter().map(|body| body.mass_kg).sum();
    9.81 * (rope + bodies)
}

/// Attachments of all joints; blocks of free joints are counted first, bodies follow.
fn attachments(model: &Model, blocks: &mut usize) -> Vec<Attachment> {
    let mut next = || {
        *blocks += 1;
        *blocks - 1
    };
    let attachment = |joint: &crate::model::Joint| match joint.kind {
        JointKind::Free | JointKind::Pulled { .. } => Attachment::Free(next()),
        JointKind::Fixed | JointKind::Driven { .. } | JointKind::Whale(_) => Attachment::Fixed,
        JointKind::Body { body, offset_m } => Attachment::Body { block: 0, body, offset: offset_m },
    };
    model.spec.joints.iter().map(attachment).collect()
}

fn shift_body(attachment: Attachment, body_block: &[usize]) -> Attachment {
    match attachment {
        Attachment::Body { body, offset, .. } => {
            Attachment::Body { block: body_block[body], body, offset }
        }
        other => other,
    }
}
