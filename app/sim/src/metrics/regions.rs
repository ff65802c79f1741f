//! Rope on each part and each patch of the whale: length, force, pressure, work of friction.

use endline_sdk::{BodyPart, Region};
use glam::DVec3;

use super::summary::PatchSummary;
use crate::contact::ContactPoint;
use crate::contact::rope_on_skin::step_sums::{RegionMean, StepSums};
use crate::model::Model;
use crate::state::State;

const PARTS: usize = BodyPart::ALL.len();
const PATCHES: usize = Region::ALL.len();

/// Loads of every part and patch.
#[derive(Clone, Debug, Default)]
pub(super) struct Loads {
    pub(super) parts: [Load; PARTS],
    pub(super) patches: [Load; PATCHES],
}

/// Load of one part or patch, now and at its greatest; forces are means over a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Load {
    pub(super) length_m: f64,
    pub(super) normal_n: f64,
    /// Force of rope on skin: pushes and friction, as vectors [N].
    pub(super) force_n: DVec3,
    /// Sum of the friction forces, however they point [N].
    pub(super) friction_n: f64,
    /// Greatest tension of any segment that presses [N].
    pub(super) tension_n: f64,
    /// Fastest slip of any contact [m/s].
    pub(super) slip_m_s: f64,
    pub(super) peak_length_m: f64,
    pub(super) peak_normal_n: f64,
    pub(super) peak_friction_n: f64,
    pub(super) peak_tension_n: f64,
    pub(super) peak_line_load_n_m: f64,
    pub(super) peak_pressure_pa: f64,
    pub(super) work_j: f64,
    pub(super) peak_wraps: f64,
    pub(super) peak_touching_wraps: f64,
    /// Level of wraps last reported [turns].
    pub(super) told_wraps: f64,
}

impl Loads {
    /// Takes in the contacts at the end of a step, and what they did over all of it.
    pub(super) fn fold(
        &mut self,
        model: &Model,
        state: &State,
        contacts: &[ContactPoint],
        sums: &StepSums,
    ) {
        let Self { parts, patches } = self;
        parts.iter_mut().chain(patches.iter_mut()).for_each(Load::begin);
        for contact in contacts.iter().filter(|contact| contact.normal_force_n > 0.0) {
            let tension_n = state.rope.tension[contact.segment].max(0.0);
            for load in
                [&mut parts[contact.region.part() as usize], &mut patches[contact.region as usize]]
            {
                load.take(model, contact, tension_n);
            }
        }
        for region in Region::ALL {
            let mean = sums.of_region(region);
            for load in [&mut parts[region.part() as usize], &mut patches[region as usize]] {
                load.bear(&mean);
            }
        }
        parts.iter_mut().chain(patches.iter_mut()).for_each(Load::end);
    }

    /// What bore on each patch, in the order of [`Region::ALL`].
    pub(super) fn patches(&self) -> Vec<PatchSummary> {
        let summary = |(region, load): (&Region, &Load)| PatchSummary {
            region: *region,
            contact_length_m: load.length_m,
            normal_n: load.normal_n,
            friction_n: load.friction_n,
            force_n: load.force_n,
            tension_n: load.tension_n,
            peak_contact_length_m: load.peak_length_m,
            peak_normal_n: load.peak_normal_n,
            peak_friction_n: load.peak_friction_n,
            peak_tension_n: load.peak_tension_n,
            peak_line_load_n_m: load.peak_line_load_n_m,
            peak_pressure_pa: load.peak_pressure_pa,
            friction_work_j: load.work_j,
        };
        Region::ALL.iter().zip(&self.patches).map(summary).collect()
    }
}

impl Load {
    fn begin(&mut self) {
        (self.length_m, self.normal_n, self.slip_m_s) = (0.0, 0.0, 0.0);
        (self.force_n, self.friction_n, self.tension_n) = (DVec3::ZERO, 0.0, 0.0);
    }

    fn take(&mut self, model: &Model, contact: &ContactPoint, tension_n: f64) {
        self.length_m += contact.length_m;
        self.tension_n = self.tension_n.max(tension_n);
        self.slip_m_s = self.slip_m_s.max(slip_speed(contact));
        let line_load =
            if contact.length_m > 0.0 { contact.normal_force_n / contact.length_m } else { 0.0 };
        let width = model.spec.ropes[model.spec.lines[contact.line].rope].diameter_m;
        self.peak_line_load_n_m = self.peak_line_load_n_m.max(line_load);
        self.peak_pressure_pa =
            self.peak_pressure_pa.max(if width > 0.0 { line_load / width } else { 0.0 });
    }

    /// Takes in mean forces and work over a step.
    fn bear(&mut self, mean: &RegionMean) {
        self.normal_n += mean.normal_n;
        self.force_n += mean.force_n;
        self.friction_n += mean.friction_n;
        self.work_j += mean.work_j;
    }

    fn end(&mut self) {
        self.peak_length_m = self.peak_length_m.max(self.length_m);
        self.peak_normal_n = self.peak_normal_n.max(self.normal_n);
        self.peak_friction_n = self.peak_friction_n.max(self.friction_n);
        self.peak_tension_n = self.peak_tension_n.max(self.tension_n);
    }
}

/// Speed of rope over skin in the last solver step [m/s].
fn slip_speed(contact: &ContactPoint) -> f64 {
    if contact.dt_s > 0.0 { contact.slip_m.length() / contact.dt_s } else { 0.0 }
}
