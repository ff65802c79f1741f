//! Free ends of rope that a constant force pulls. Each is held in place until its force begins.

use glam::DMat3;

use crate::forces::body::HELD;
use crate::model::{JointKind, Model};
use crate::system::LinearSystem;
use crate::trial::Trial;
use crate::trial::plan::{Attachment, Plan};
use crate::trial::scheme::Scheme;

/// Adds constant forces on free ends.
pub(crate) fn add_pulled(
    model: &Model,
    scheme: &Scheme,
    (plan, trial): (&Plan, &Trial),
    system: &mut LinearSystem,
) {
    for (joint, attachment) in model.spec.joints.iter().zip(&plan.attachments) {
        let (JointKind::Pulled { force_n, .. }, Attachment::Free(block)) =
            (&joint.kind, attachment)
        else {
            continue;
        };
        if is_held(trial, &joint.kind, scheme.is_static()) {
            *system.interface.at(*block, *block) += DMat3::IDENTITY * HELD;
        } else {
            system.interface.force[*block] += *force_n;
        }
    }
}

/// Whether a joint is held until its force begins.
pub(crate) fn is_held(trial: &Trial, kind: &JointKind, at_rest: bool) -> bool {
    matches!(kind, JointKind::Pulled { from_s, .. } if (at_rest && *from_s >= 0.0) || trial.time <= *from_s)
}
