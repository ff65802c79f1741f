//! Momentum and energy of the gear: what each source gives rope and bodies together, and what the solver misses of it.
//!
//! A source `s` pushes with the force `F_s` and the power `P_s = Σ F·v` of its points, both at the end of a solver step, where the
//! solver balances forces. Its impulse `J_s` and work `W_s` are two more unknowns of the same time scheme (`trial/scheme.rs`):
//! `dJ/dt = F`, `dW/dt = P` are integrated as `dx/dt = v` is. With `ĵ = J - J₋` what a step adds, `h` the scheme's and `e` the share of the earlier
//! value in its history,
//!
//! `ĵ_s = h F_s + e ĵ_s,₋`, `ŵ_s = h P_s + e ŵ_s,₋`,
//!
//! which for backward Euler is force times step. The scheme's own law `M (v - v̂) = h Σ F` then reads, without any error of order,
//!
//! `Σ m (v - vₙ) = Σ_s ĵ_s`,
//!
//! because `v̂ - vₙ = e (vₙ - vₙ₋₁)`. What is left of it, the residual, is what the solver missed: forces between rope and rope, rope
//! and bodies, or bodies and bodies that do not cancel, and forces of a source that are not those it was solved with. After the
//! second stage of a step in two stages the earlier value is the whole step's, as it is for velocities.
//!
//! Work has no such identity: kinetic energy is no linear function of the unknowns, and `ΔE` differs from `Σ_s ŵ_s` by what the scheme
//! damps. `Σ_s ŵ_s + ŵ_damping + ŵ_contact - ΔE`, with `E` kinetic energy, stretch and bending, is told as numerical damping. Below zero the
//! scheme has given energy, or merged segments or a parting have.
//! Reference: Hairer, Lubich and Wanner 2006, Geometric Numerical Integration, section IV.1 (linear invariants).

mod energies;
pub(crate) mod source_forces;
mod summary;

use core::ops::{Add, Mul};

use glam::DVec3;

use crate::model::Model;
use crate::state::State;
pub(crate) use energies::Energies;
pub use summary::BalanceSummary;

/// What gives the gear momentum and energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Weight of rope and bodies.
    Weight,
    /// Buoyancy, drag, added mass and the water's acceleration.
    Water,
    /// The whale's skin on rope and bodies, and lines made fast to the whale.
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
    /// All of them, in the order of arrays by source.
    pub const ALL: [Self; SOURCES] =
        [Self::Weight, Self::Water, Self::Skin, Self::Seabed, Self::Obstacles, Self::Fixtures];

    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Weight => "weight",
            Self::Water => "water",
            Self::Skin => "skin",
            Self::Seabed => "seabed",
            Self::Obstacles => "obstacles",
            Self::Fixtures => "fixtures",
        }
    }
}

/// Forces and powers at the end of a solver step, or impulses and works.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sums {
    /// Force [N] or impulse [N s] of each source on the gear.
    pub push: [DVec3; SOURCES],
    /// Power [W] or work [J] of each source on the gear.
    pub work: [f64; SOURCES],
    /// The same of the axial damping of rope.
    pub damping: f64,
    /// The same of push and friction of the gear on itself: rope on rope and on bodies, bodies on bodies.
    pub contact: f64,
}

impl Sums {
    /// Takes in a force of a source at a point that moves with this velocity.
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

/// What a solver step gave the gear.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Given {
    /// Forces and powers at its end.
    pub at_end: Sums,
    /// Change of the momentum of rope and bodies over it [N s].
    pub momentum_ns: DVec3,
}

/// How the scheme of a solver step weighs what it gave.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights {
    /// `h` [s].
    pub h_s: f64,
    /// Share of the earlier value in the history.
    pub earlier: f64,
    /// Whether the step is the second stage of a step in two stages.
    pub second_stage: bool,
}

/// Momentum and energy of the gear since the run began.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    sum: Sums,
    /// What the last step added, as the scheme remembers it.
    last: Sums,
    momentum_ns: DVec3,
    /// Greatest size that the impulse of any source had [N s].
    greatest_ns: f64,
    /// Greatest size that the residual had [N s].
    residual_ns: f64,
    /// Impulse that a kinetic whale was given [N s].
    to_whale_ns: DVec3,
    start: Option<Energies>,
}

impl Balance {
    /// Notes the energy with which the run begins, where it has not been.
    pub(crate) fn begin(&mut self, model: &Model, state: &State) {
        if self.start.is_none() {
            self.start = Some(Energies::of(model, state));
        }
    }

    /// Takes in a solver step that is kept.
    pub(crate) fn take(&mut self, given: &Given, weights: Weights) {
        let step = given.at_end * weights.h_s + self.last * weights.earlier;
        self.sum = self.sum + step;
        self.last = if weights.second_stage { self.last + step } else { step };
        self.momentum_ns += given.momentum_ns;
        let sizes = self.sum.push.map(DVec3::length);
        self.greatest_ns = sizes.into_iter().fold(self.greatest_ns, f64::max);
        self.residual_ns = self.residual_ns.max(self.residual().length());
    }

    /// Takes in the impulse that a kinetic whale was given in a step [N s].
    pub(crate) fn take_whale(&mut self, impulse_ns: DVec3) {
        self.to_whale_ns += impulse_ns;
    }

    /// Impulse of all sources less the change of momentum [N s].
    #[must_use]
    pub fn residual(&self) -> DVec3 {
        self.sum.push.iter().sum::<DVec3>() - self.momentum_ns
    }
}
