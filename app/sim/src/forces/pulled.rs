//! Free ends of rope that a steady force pulls at, held until it sets in.

use glam::DMat3;

use crate::forces::body::HELD;
use crate::model::{JointKind, Model};
use crate::solver::Solver;
use crate::trial::plan::Attachment;
use crate::trial::scheme::Scheme;

impl Solver {
    /// Adds steady forces on free ends.
    pub(crate) fn add_pulled(&mut self, model: &Model, scheme: &Scheme) {
        for (joint, attachment) in model.spec.joints.iter().zip(&self.plan.attachments) {
            let (JointKind::Pulled { force_n, .. }, Attachment::Free(block)) =
                (&joint.kind, attachment)
            else {
                continue;
            };
            if self.is_held(&joint.kind, scheme.is_static()) {
                *self.interface.at(*block, *block) += DMat3::IDENTITY * HELD;
            } else {
                self.interface.force[*block] += *force_n;
            }
        }
    }

    /// Whether a joint is held until its force sets in.
    pub(crate) fn is_held(&self, kind: &JointKind, at_rest: bool) -> bool {
        matches!(kind, JointKind::Pulled { from_s, .. } if (at_rest && *from_s >= 0.0) || self.trial.time <= *from_s)
    }
}
