//! Momentum and energy of the gear by source, and the residual of the solver.
//!
//! A source `s` exerts the force `F_s` [N] and the power `P_s = Σ F·v` [W] on the gear, both at the end of a solver step, where
//! the solver balances forces. Its impulse `J_s` [N s] and work `W_s` [J] follow the same time scheme as the state
//! (`trial/scheme.rs`): `dJ/dt = F` and `dW/dt = P` are integrated like `dx/dt = v`. With `ĵ = J - J₋` the increment of a step,
//! `h` the effective step of the scheme [s] and `e` the share of the previous increment in its history,
//!
//! `ĵ_s = h F_s + e ĵ_s,₋`, `ŵ_s = h P_s + e ŵ_s,₋`.
//!
//! For backward Euler this is force times step. The law of the scheme, `M (v - v̂) = h Σ F`, then becomes exactly
//!
//! `Σ m (v - vₙ) = Σ_s ĵ_s`,
//!
//! because `v̂ - vₙ = e (vₙ - vₙ₋₁)`. The difference of the two sides is the residual: internal forces (rope on rope, rope on
//! bodies, bodies on bodies) that do not cancel, and forces of sources that differ from those in the solution. After the second
//! stage of a two-stage step the previous increment is that of the whole step, as for velocities.
//!
//! No such identity holds for work: kinetic energy is not linear in the unknowns, and `ΔE` differs from `Σ_s ŵ_s` by the
//! damping of the scheme. Numerical damping is `Σ_s ŵ_s + ŵ_damping + ŵ_contact - ΔE`, with `E` the kinetic, stretch and
//! bending energy. A negative value means that the scheme, merged segments or a parting added energy.
//! Reference: Hairer, Lubich and Wanner 2006, Geometric Numerical Integration, section IV.1 (linear invariants).

pub(crate) mod source_forces;

use core::ops::{Add, Mul};

use glam::DVec3;
use strum::IntoStaticStr;

use crate::forces::bending::bending_energy;
use crate::metrics::energy;
use crate::model::{EnergyForm, Model};
use crate::state::State;

/// Source of momentum and energy of the gear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum Source {
    /// Weight of rope and bodies.
    Weight,
    /// Buoyancy, drag, added mass and the water's acceleration.
    Water,
    /// The whale's skin on rope and bodies, and lines attached to the whale.
    Skin,
    /// The seabed on rope and feet, with suction.
    Seabed,
    /// Obstacles on rope and bodies.
    Obstacles,
    /// Fixed and driven ends, pulled ends and held bodies.
    Fixtures,
}

/// Number of sources.
pub const SOURCES: usize = 6;

impl Source {
    /// All sources, in the order of arrays by source.
    pub const ALL: [Self; SOURCES] =
        [Self::Weight, Self::Water, Self::Skin, Self::Seabed, Self::Obstacles, Self::Fixtures];

    /// Name in files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Forces and powers at the end of a solver step, or impulses and works.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sums {
    /// Force [N] or impulse [N s] of each source on the gear.
    pub push: [DVec3; SOURCES],
    /// Power [W] or work [J] of each source on the gear.
    pub work: [f64; SOURCES],
    /// Power [W] or work [J] of the axial damping of rope.
    pub damping: f64,
    /// Power [W] or work [J] of contact within the gear: rope on rope, rope on bodies, bodies on bodies.
    pub contact: f64,
}

impl Sums {
    /// Adds a force of a source at a point with this velocity.
    pub fn add(&mut self, source: Source, force: DVec3, velocity: DVec3) {
        self.push[source as usize] += force;
        self.work[source as usize] += force.dot(velocity);
    }
}

impl Mul<f64> for Sums {
    type Output = Self;

    fn mul(self, by: f64) -> Self {
        Self {
            push: self.push.map(|push| push * by),
            work: self.work.map(|work| work * by),
            damping: self.damping * by,
            contact: self.contact * by,
        }
    }
}

impl Add for Sums {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            push: core::array::from_fn(|source| self.push[source] + other.push[source]),
            work: core::array::from_fn(|source| self.work[source] + other.work[source]),
            damping: self.damping + other.damping,
            contact: self.contact + other.contact,
        }
    }
}

/// Momentum and energy that the gear received in a solver step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Given {
    /// Forces and powers at its end.
    pub at_end: Sums,
    /// Change of the momentum of rope and bodies over it [N s].
    pub momentum_ns: DVec3,
}

/// Weights of the time scheme of a solver step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights {
    /// Effective step `h` [s].
    pub h_s: f64,
    /// Share `e` of the previous increment.
    pub earlier: f64,
    /// Whether the step is the second stage of a two-stage step.
    pub second_stage: bool,
}

/// Momentum and energy of the gear since the start of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    sum: Sums,
    /// Increment of the last step, in the history of the scheme.
    last: Sums,
    momentum_ns: DVec3,
    /// Greatest magnitude of the impulse of any source so far [N s].
    greatest_ns: f64,
    /// Greatest magnitude of the residual so far [N s].
    residual_ns: f64,
    /// Impulse on a kinetic whale [N s].
    to_whale_ns: DVec3,
    start: Option<Energies>,
}

impl Balance {
    /// Stores the initial energy on the first call.
    pub(crate) fn begin(&mut self, model: &Model, state: &State) {
        if self.start.is_none() {
            self.start = Some(Energies::of(model, state));
        }
    }

    /// Adds an accepted solver step.
    pub(crate) fn take(&mut self, given: &Given, weights: Weights) {
        let step = given.at_end * weights.h_s + self.last * weights.earlier;
        self.sum = self.sum + step;
        self.last = if weights.second_stage { self.last + step } else { step };
        self.momentum_ns += given.momentum_ns;
        let sizes = self.sum.push.map(DVec3::length);
        self.greatest_ns = sizes.into_iter().fold(self.greatest_ns, f64::max);
        self.residual_ns = self.residual_ns.max(self.residual().length());
    }

    /// Adds the impulse on a kinetic whale in a step [N s].
    pub(crate) fn take_whale(&mut self, impulse_ns: DVec3) {
        self.to_whale_ns += impulse_ns;
    }

    /// Impulse of all sources minus the change of momentum [N s].
    pub fn residual(&self) -> DVec3 {
        self.sum.push.iter().sum::<DVec3>() - self.momentum_ns
    }
}

/// Energy of the gear [J].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Energies {
    /// Kinetic energy.
    pub kinetic_j: f64,
    /// Energy of stretch and bending of rope.
    pub elastic_j: f64,
}

impl Energies {
    /// Energy of a state.
    pub fn of(model: &Model, state: &State) -> Self {
        let stretch_j = energy(model, state, EnergyForm::Stretch);
        Self {
            kinetic_j: energy(model, state, EnergyForm::Kinetic),
            elastic_j: stretch_j + bending_energy(model, state),
        }
    }
}

/// Momentum and energy of the gear from the start of a run to a state, for reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalanceSummary {
    /// Impulse of each source, in the order of [`Source::ALL`] [N s].
    pub impulse_ns: [DVec3; SOURCES],
    /// Change of momentum of rope and bodies [N s].
    pub momentum_ns: DVec3,
    /// Greatest magnitude of the impulse of any source so far [N s].
    pub greatest_ns: f64,
    /// Greatest magnitude of the residual so far [N s].
    pub residual_ns: f64,
    /// Work of each source, in the same order [J].
    pub work_j: [f64; SOURCES],
    /// Work of the axial damping of rope, negative [J].
    pub damping_j: f64,
    /// Work of contact within the gear [J].
    pub contact_j: f64,
    /// Change of kinetic energy [J].
    pub kinetic_j: f64,
    /// Change of the energy of stretch and bending [J].
    pub elastic_j: f64,
    /// Magnitude of the sum of impulse on a kinetic whale and impulse of skin on the gear, zero if they balance; `None` if the
    /// whale is not kinetic [N s].
    pub whale_missed_ns: Option<f64>,
}

impl BalanceSummary {
    /// Residual as a share of the greatest impulse; zero without impulse.
    pub fn residual_share(&self) -> f64 {
        if self.greatest_ns > 0.0 { self.residual_ns / self.greatest_ns } else { 0.0 }
    }

    /// Energy dissipated by the time scheme; negative if it added energy [J].
    pub fn numerical_damping_j(&self) -> f64 {
        let done_j = self.work_j.iter().sum::<f64>() + self.damping_j + self.contact_j;
        done_j - self.kinetic_j - self.elastic_j
    }
}

impl Balance {
    /// Balance up to a state; `None` if it was not recorded.
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
