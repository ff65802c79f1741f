//! Whether the whale reaches the seabed or the surface, by the boxes of its trunk's cross sections.

use glam::DVec3;

use super::event::{EventKind, Log};
use crate::model::Model;
use crate::state::WhaleState;
use crate::whale::Skin;
use crate::whale::axes::trunk_axis;

/// How far the whale must move off before another touch is reported [m]; estimate.
const REARM_M: f64 = 0.5;

/// The trunk as ellipses across its axis, in the whale's frame and rest posture.
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
            log.note(time_s, EventKind::AtSurface, "whale", top);
        }
        if let Some(seabed) = &model.spec.seabed {
            let depth = self.reach(whale, DVec3::new(0.0, 0.0, -seabed.depth_m), -seabed.normal);
            if passes(&mut self.at_seabed, depth) {
                log.note(time_s, EventKind::AtSeabed, "whale", -depth);
            }
        }
    }

    /// How far the trunk reaches beyond a plane through `point`, in the direction `out` [m].
    fn reach(&self, whale: &WhaleState, point: DVec3, out: DVec3) -> f64 {
        let own = whale.orientation.inverse() * out;
        let base = (whale.position - point).dot(out);
        let beyond = |(middle, half): &(DVec3, [f64; 2])| {
            base + middle.dot(own) + libm::hypot(half[0] * own.y, half[1] * own.z)
        };
        self.ellipses.iter().map(beyond).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Whether a reach has just passed zero; reported again only after a way back of [`REARM_M`].
fn passes(beyond: &mut bool, reach: f64) -> bool {
    let passed = !*beyond && reach >= 0.0;
    *beyond = if *beyond { reach > -REARM_M } else { passed };
    passed
}
