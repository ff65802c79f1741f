//! Free ends of rope that a steady force pulls at, held until it sets in.

use glam::DMat3;

use super::Solver;
use super::body::HELD;
use super::hubs::Seat;
use super::scheme::Scheme;
use crate::model::{JointKind, Model};

impl Solver {
    /// Adds steady forces on free ends.
    pub(super) fn add_pulled(&mut self, model: &Model, scheme: &Scheme) {
        for (joint, seat) in model.spec.joints.iter().zip(&self.plan.seats) {
            let (JointKind::Pulled { force_n, .. }, Seat::Free(block)) = (&joint.kind, seat) else {
                continue;
            };
            if self.is_held(&joint.kind, scheme.is_static()) {
                *self.hubs.at(*block, *block) += DMat3::IDENTITY * HELD;
            } else {
                self.hubs.force[*block] += *force_n;
            }
        }
    }

    /// Whether a joint is held until its force sets in.
    pub(super) fn is_held(&self, kind: &JointKind, at_rest: bool) -> bool {
        matches!(kind, JointKind::Pulled { from_s, .. } if (at_rest && *from_s >= 0.0) || self.trial.time <= *from_s)
    }
}
