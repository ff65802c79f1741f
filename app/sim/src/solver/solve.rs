//! Solves the assembled system: lines down to their ends, the interface system, and back.

use glam::DVec3;

use crate::model::Model;
use crate::solver::Solver;
use crate::system::block_tridiagonal::Ends;
use crate::trial::plan::Attachment;
use crate::trial::plan::Plan;

impl Solver {
    /// Solves the assembled system; the moves lie in `tridiagonal.step` and `interface.step`.
    pub(crate) fn solve(&mut self, model: &Model) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            let (attachment_a, attachment_b) =
                (self.plan.attachments[line.from], self.plan.attachments[line.to]);
            let (nodes, segments) = (&model.line_nodes[index], &model.line_segments[index]);
            let ends =
                self.tridiagonal.eliminate(nodes, segments, attachment_a != Attachment::Fixed);
            self.join(attachment_a, attachment_b, &ends);
        }
        self.interface.solve();
        for (index, line) in model.spec.lines.iter().enumerate() {
            let (attachment_a, attachment_b) =
                (self.plan.attachments[line.from], self.plan.attachments[line.to]);
            let step_a = self.interface.step_of(attachment_a, self.arm(attachment_a));
            let step_b = self.interface.step_of(attachment_b, self.arm(attachment_b));
            self.tridiagonal.substitute(
                &model.line_nodes[index],
                &model.line_segments[index],
                attachment_a != Attachment::Fixed,
                step_a,
                step_b,
            );
        }
        self.correct_for_rope_contact(model);
    }

    /// Longest solved move of any node or body [m].
    pub(crate) fn longest(&self) -> f64 {
        let nodes =
            self.tridiagonal.step.iter().map(|step| step.length_squared()).fold(0.0, f64::max);
        let bodies = self
            .plan
            .body_block
            .iter()
            .map(|block| self.interface.step[*block].length_squared())
            .fold(nodes, f64::max);
        bodies.sqrt()
    }

    /// Longest solved move of any body [m].
    pub(crate) fn longest_of_bodies(&self) -> f64 {
        let moves = self.plan.body_block.iter().map(|block| self.interface.step[*block].length());
        moves.fold(0.0, f64::max)
    }

    /// Adds what a line leaves on its ends to the interface system.
    pub(crate) fn join(&mut self, attachment_a: Attachment, attachment_b: Attachment, ends: &Ends) {
        let (arm_a, arm_b) = (self.arm(attachment_a), self.arm(attachment_b));
        self.interface.push(attachment_a, arm_a, ends.force_a);
        self.interface.push(attachment_b, arm_b, ends.force_b);
        self.interface.add(attachment_a, arm_a, attachment_a, arm_a, ends.aa);
        self.interface.add(attachment_a, arm_a, attachment_b, arm_b, ends.ab);
        self.interface.add(attachment_b, arm_b, attachment_a, arm_a, ends.ba);
        self.interface.add(attachment_b, arm_b, attachment_b, arm_b, ends.bb);
    }

    pub(crate) fn arm(&self, attachment: Attachment) -> DVec3 {
        Plan::arm(attachment, |body| self.trial.bodies[body].orientation)
    }
}
