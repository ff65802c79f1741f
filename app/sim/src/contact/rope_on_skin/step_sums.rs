//! Forces of rope on skin over a step of the model: means of forces and sums of work over its solver steps.
//!
//! With `h` a solver step, `Δt = Σ h` the step of the model, `N` a normal force, `f` friction on the rope and `s` its slip in the solver step:
//! mean normal force `Σ N h / Δt`, mean friction `Σ |f| h / Δt`, mean force on the skin `-Σ (N n + f) h / Δt`, work done against friction `-Σ f·s`.

use endline_sdk::{BodyPart, Region};
use glam::DVec3;

use crate::contact::ContactPoint;
use crate::whale::Skin;

const PARTS: usize = BodyPart::ALL.len();
const REGIONS: usize = Region::ALL.len();

/// Time integrals and work on one region.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    /// Normal force [N s].
    normal: f64,
    /// Normal force times its place to port of the midplane on the body at rest [N m s].
    port: f64,
    /// Size of friction [N s].
    friction: f64,
    /// Force of rope on skin [N s].
    force: DVec3,
    /// Work done against friction [J].
    work_j: f64,
}

/// Sums over the solver steps of a step of the model.
#[derive(Clone, Debug)]
pub struct StepSums {
    regions: [Sum; REGIONS],
    span_s: f64,
}

/// Contact with skin in a step of the model: where rope pressed at its end, and the sums over it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SkinContact<'a> {
    pub contacts: &'a [ContactPoint],
    pub sums: &'a StepSums,
}

/// Mean forces of rope on a region of skin over a step, and the work done against friction there.
#[derive(Clone, Copy, Debug, Default)]
pub struct RegionMean {
    /// Sum of normal forces [N].
    pub normal_n: f64,
    /// Sum of the sizes of friction [N].
    pub friction_n: f64,
    /// Force of rope on skin [N].
    pub force_n: DVec3,
    /// Work done against friction [J].
    pub work_j: f64,
}

impl Default for StepSums {
    fn default() -> Self {
        Self { regions: [Sum::default(); REGIONS], span_s: 0.0 }
    }
}

impl StepSums {
    /// Adds the contacts of a solver step of `dt_s`.
    pub(crate) fn take(&mut self, skin: &Skin, contacts: &[ContactPoint], dt_s: f64) {
        self.span_s += dt_s;
        for contact in contacts {
            let corners =
                skin.triangles[contact.triangle].map(|corner| skin.vertices[corner as usize].y);
            let port: f64 =
                corners.iter().zip(contact.barycentric).map(|(y, share)| y * share).sum();
            let push = contact.normal * contact.normal_force_n;
            let sum = &mut self.regions[contact.region as usize];
            sum.normal += contact.normal_force_n * dt_s;
            sum.port += contact.normal_force_n * port * dt_s;
            sum.friction += contact.friction_n.length() * dt_s;
            sum.force -= (push + contact.friction_n) * dt_s;
            sum.work_j -= contact.friction_n.dot(contact.slip_m);
        }
    }

    /// Contacts alone, as if they had held through a step of `step_s`.
    pub(crate) fn of(skin: &Skin, contacts: &[ContactPoint], step_s: f64) -> Self {
        let mut sums = Self::default();
        sums.take(skin, contacts, 1.0);
        sums.regions.iter_mut().for_each(|sum| sum.work_j = 0.0);
        for contact in contacts {
            let solver_steps = if contact.dt_s > 0.0 { step_s / contact.dt_s } else { 1.0 };
            sums.regions[contact.region as usize].work_j -=
                contact.friction_n.dot(contact.slip_m) * solver_steps;
        }
        sums
    }

    /// Means and work on a region.
    pub fn of_region(&self, region: Region) -> RegionMean {
        let Sum { normal, friction, force, work_j, .. } = self.regions[region as usize];
        let share = if self.span_s > 0.0 { 1.0 / self.span_s } else { 0.0 };
        RegionMean {
            normal_n: normal * share,
            friction_n: friction * share,
            force_n: force * share,
            work_j,
        }
    }

    /// Mean force of rope on all skin [N].
    pub fn force_n(&self) -> DVec3 {
        let sum: DVec3 = self.regions.iter().map(|sum| sum.force).sum();
        if self.span_s > 0.0 { sum / self.span_s } else { sum }
    }

    /// Work done against friction on all skin [J].
    pub fn friction_work_j(&self) -> f64 {
        self.regions.iter().map(|sum| sum.work_j).sum()
    }

    /// Mean normal force on each body part [N], and its mean place to port of the midplane on the body at rest [m].
    pub(crate) fn by_part(&self) -> [[f64; PARTS]; 2] {
        let [mut force, mut port] = [[0.0; PARTS]; 2];
        for (region, sum) in Region::ALL.iter().zip(&self.regions) {
            force[region.part() as usize] += sum.normal;
            port[region.part() as usize] += sum.port;
        }
        for (force, port) in force.iter_mut().zip(&mut port) {
            *port = if *force > 0.0 { *port / *force } else { 0.0 };
            *force = if self.span_s > 0.0 { *force / self.span_s } else { 0.0 };
        }
        [force, port]
    }
}
