//! What holds ends of lines and bodies: fixtures, steady pulls and the whale.

use glam::DVec3;

use crate::balance::{Given, Source};
use crate::model::JointKind;
use crate::solver::Solver;
use crate::trial::StepContext;
use crate::trial::plan::Attachment;

impl Solver {
    /// What holds or pulls the ends of lines and the bodies that are held.
    pub(crate) fn give_ends(
        &mut self,
        context: &StepContext<'_>,
        on_nodes: &[DVec3],
        given: &mut Given,
    ) {
        let model = context.model;
        for (index, line) in model.spec.lines.iter().enumerate() {
            let (nodes, segments) = (&model.line_nodes[index], &model.line_segments[index]);
            for (joint, tip, inner, segment) in [
                (line.from, nodes.start, nodes.start + 1, segments.start),
                (line.to, nodes.end - 1, nodes.end - 2, segments.end - 1),
            ] {
                let load = on_nodes[tip] + self.pull_at(tip, inner, segment);
                let attachment = self.plan.attachments[joint];
                if attachment == Attachment::Fixed {
                    let held_by = match model.spec.joints[joint].kind {
                        JointKind::Whale(_) => Source::Skin,
                        _ => Source::Fixtures,
                    };
                    given.at_end.add(held_by, -load, self.velocity_of(context, tip));
                } else {
                    self.interface.push(attachment, self.arm(attachment), load);
                }
            }
        }
        self.give_pulled(context, given);
        for (body, block) in self.trial.bodies.iter().zip(&self.plan.body_block) {
            if body.held {
                given.at_end.add(Source::Fixtures, -self.interface.force[*block], DVec3::ZERO);
            }
        }
    }

    /// Pull of a segment on a line's end, with the tension that was solved for.
    fn pull_at(&self, tip: usize, inner: usize, segment: usize) -> DVec3 {
        if self.cut[segment] {
            return DVec3::ZERO;
        }
        let along = self.trial.place[inner] - self.trial.place[tip];
        along.normalize_or_zero() * self.trial.tension[segment].max(0.0)
    }

    /// Steady forces on free ends, and what holds such an end until its force sets in.
    fn give_pulled(&self, context: &StepContext<'_>, given: &mut Given) {
        for (index, joint) in context.model.spec.joints.iter().enumerate() {
            let (JointKind::Pulled { force_n, .. }, Attachment::Free(block)) =
                (&joint.kind, self.plan.attachments[index])
            else {
                continue;
            };
            if self.is_held(&joint.kind, false) {
                given.at_end.add(Source::Fixtures, -self.interface.force[block], DVec3::ZERO);
            } else if let Some(node) = self.plan.joint_node[index] {
                given.at_end.add(Source::Fixtures, *force_n, self.velocity_of(context, node));
            }
        }
    }
}
