//! What is out of balance, and where.

use glam::DVec3;

use crate::model::Model;
use crate::solver::Solver;
use crate::trial::plan::Attachment;

impl Solver {
    /// Greatest force out of balance at any node or interface block, as last assembled (before [`solve`](Self::solve)) [N].
    pub(crate) fn residual(&self, model: &Model) -> f64 {
        let mut interface = self.interface.force.clone();
        let mut greatest = 0.0_f64;
        for (index, line) in model.spec.lines.iter().enumerate() {
            let nodes = &model.line_nodes[index];
            for node in nodes.start + 1..nodes.end - 1 {
                greatest = greatest.max(self.tridiagonal.force[node].length());
            }
            for (joint, node) in [(line.from, nodes.start), (line.to, nodes.end - 1)] {
                match self.plan.attachments[joint] {
                    Attachment::Fixed => {}
                    Attachment::Free(block) => interface[block] += self.tridiagonal.force[node],
                    Attachment::Body { block, .. } => {
                        interface[block] += self.tridiagonal.force[node];
                        interface[block + 1] += self
                            .arm(self.plan.attachments[joint])
                            .cross(self.tridiagonal.force[node]);
                    }
                }
            }
        }
        for (index, block) in self.plan.body_block.iter().enumerate() {
            let body = &self.trial.bodies[index];
            if body.held {
                interface[*block] = DVec3::ZERO;
            }
            if body.held || body.upright {
                interface[block + 1] = DVec3::ZERO;
            }
        }
        for (joint, attachment) in model.spec.joints.iter().zip(&self.plan.attachments) {
            if let (Attachment::Free(block), true) = (attachment, self.is_held(&joint.kind, true)) {
                interface[*block] = DVec3::ZERO;
            }
        }
        // A maximum would pass over what is not a number.
        let all_finite =
            interface.iter().chain(&self.tridiagonal.force).all(|force| force.is_finite());
        if all_finite {
            interface.iter().map(|force| force.length()).fold(greatest, f64::max)
        } else {
            f64::INFINITY
        }
    }

    /// The line with the longest or a not finite move in the last solve.
    pub(crate) fn worst_line(&self, model: &Model) -> Option<usize> {
        let size = |line: &usize| {
            let steps = &self.tridiagonal.step[model.line_nodes[*line].clone()];
            steps
                .iter()
                .map(|step| if step.is_finite() { step.length() } else { f64::INFINITY })
                .fold(0.0, f64::max)
        };
        (0..model.spec.lines.len()).max_by(|one, other| size(one).total_cmp(&size(other)))
    }
}
