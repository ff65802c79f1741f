//! The friction hook: normal forces and slips in, tangential forces and their derivatives out.

use crate::hook::{Descriptor, HookError};

/// All contacts of one solver pass, as arrays of equal length.
///
/// Vectors are in the world frame; `slip` lies in the plane across `normal`.
#[derive(Clone, Copy, Debug)]
pub struct Contacts<'a> {
    /// Length of the step [s].
    pub dt_s: f64,
    /// Normal force, never negative [N].
    pub normal_force_n: &'a [f64],
    /// Unit normal, from skin to rope.
    pub normal: &'a [[f64; 3]],
    /// Unit vector fixed to the skin, across the normal: athwart the whale at rest, and so on the racks of baleen along
    /// the plates. A bristle kept by its parts along this and along `normal x grain` turns with the whale.
    pub grain: &'a [[f64; 3]],
    /// Unit vector along the rope; for a contact of a trap, buoy or anchor: the normal.
    pub along: &'a [[f64; 3]],
    /// Tangential displacement of rope against skin since the start of the step [m].
    pub slip_m: &'a [[f64; 3]],
    /// Length of rope of the contact [m].
    pub length_m: &'a [f64],
    /// Coefficient of friction of this rope on this region, from the gear library.
    pub coefficient: &'a [f64],
    /// Number of the skin [`Region`](crate::Region).
    pub region: &'a [u32],
    /// Index of the rope material in the model; for a contact of a trap, buoy or anchor: `u32::MAX`.
    pub rope: &'a [u32],
    /// Floats of the model at the start of the step, `state_len` for each contact;
    /// zero for a new contact.
    pub state: &'a [f64],
}

impl Contacts<'_> {
    /// Number of contacts.
    #[must_use]
    pub fn len(&self) -> usize {
        self.normal_force_n.len()
    }

    /// Whether there are no contacts.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.normal_force_n.is_empty()
    }
}

/// Response of a friction model for one contact.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrictionResponse {
    /// Force of skin on rope, in the plane across the normal [N].
    pub force_n: [f64; 3],
    /// Its derivative by slip, row by row: `d force[i] / d slip[j]` [N/m].
    pub by_slip: [[f64; 3]; 3],
    /// Its derivative by the normal force [1].
    pub by_normal_force: [f64; 3],
}

/// A law of friction, a pure function within a step: the solver may call
/// [`respond`](Self::respond) many times; floats advance only in [`advance`](Self::advance).
pub trait FrictionModel: Send + Sync {
    /// Identity and attributes.
    fn descriptor(&self) -> &Descriptor;

    /// Forces and derivatives for all contacts of one solver pass.
    ///
    /// The solver also calls it with a normal force of 1e9 N, under which rope should not slip. From that response it takes the stiffness of
    /// a contact that holds. An error there is ignored.
    ///
    /// # Errors
    /// With a message for the user; the run ends with it.
    fn respond(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [FrictionResponse],
    ) -> Result<(), HookError>;

    /// Once a step is accepted: the floats at its end, `state_len` for each contact.
    ///
    /// # Errors
    /// With a message for the user; the run ends with it.
    fn advance(
        &self,
        attributes: &[f64],
        contacts: &Contacts<'_>,
        out: &mut [f64],
    ) -> Result<(), HookError>;
}
