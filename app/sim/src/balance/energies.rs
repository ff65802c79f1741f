//! Energy that the gear holds: of motion, and of stretch and bending.

use crate::forces::bending::bending_energy;
use crate::metrics::energy;
use crate::model::{EnergyForm, Model};
use crate::state::State;

/// Energy that the gear holds [J].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Energies {
    /// Of motion.
    pub kinetic_j: f64,
    /// Of stretched and bent rope.
    pub elastic_j: f64,
}

impl Energies {
    /// That of a state.
    pub fn of(model: &Model, state: &State) -> Self {
        let stretch_j = energy(model, state, EnergyForm::Stretch);
        Self {
            kinetic_j: energy(model, state, EnergyForm::Kinetic),
            elastic_j: stretch_j + bending_energy(model, state),
        }
    }
}
