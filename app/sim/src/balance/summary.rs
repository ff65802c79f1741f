//! The balance as it is reported.

use glam::DVec3;

use super::{Balance, Energies, SOURCES, Source};
use crate::model::Model;
use crate::state::State;

/// Momentum and energy of the gear from the start of a run to a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalanceSummary {
    /// Impulse of each source, in the order of [`Source::ALL`] [N s].
    pub impulse_ns: [DVec3; SOURCES],
    /// Change of momentum of rope and bodies [N s].
    pub momentum_ns: DVec3,
    /// Greatest size that the impulse of any source had [N s].
    pub greatest_ns: f64,
    /// Greatest size that the sum of impulses less the change of momentum had [N s].
    pub residual_ns: f64,
    /// Work of each source, in the same order [J].
    pub work_j: [f64; SOURCES],
    /// Work of the axial damping of rope: below zero [J].
    pub damping_j: f64,
    /// Work of push and friction of the gear on itself [J].
    pub contact_j: f64,
    /// Change of kinetic energy [J].
    pub kinetic_j: f64,
    /// Change of the energy of stretch and bending [J].
    pub elastic_j: f64,
    /// What a kinetic whale was given by the gear and the gear by skin, added up; `None` where the whale is not kinetic [N s].
    pub whale_missed_ns: Option<f64>,
}

impl BalanceSummary {
    /// The residual as a share of the greatest impulse; zero where nothing gave any.
    #[must_use]
    pub fn residual_share(&self) -> f64 {
        if self.greatest_ns > 0.0 { self.residual_ns / self.greatest_ns } else { 0.0 }
    }

    /// Energy that the time scheme took; below zero it gave some [J].
    #[must_use]
    pub fn numerical_damping_j(&self) -> f64 {
        let done_j = self.work_j.iter().sum::<f64>() + self.damping_j + self.contact_j;
        done_j - self.kinetic_j - self.elastic_j
    }
}

impl Balance {
    /// The balance up to a state; `None` where none was kept.
    #[must_use]
    pub fn summary(&self, model: &Model, state: &State) -> Option<BalanceSummary> {
        let (start, now) = (self.start?, Energies::of(model, state));
        let is_kinetic = model.spec.whale.as_ref().is_some_and(|whale| whale.kinetic.is_some());
        let missed = self.to_whale_ns + self.sum.push[Source::Skin as usize];
        Some(BalanceSummary {
            impulse_ns: self.sum.push,
            momentum_ns: self.momentum_ns,
            greatest_ns: self.greatest_ns,
            residual_ns: self.residual_ns,
            work_j: self.sum.work,
            damping_j: self.sum.damping,
            contact_j: self.sum.contact,
            kinetic_j: now.kinetic_j - start.kinetic_j,
            elastic_j: now.elastic_j - start.elastic_j,
            whale_missed_ns: is_kinetic.then(|| missed.length()),
        })
    }
}
