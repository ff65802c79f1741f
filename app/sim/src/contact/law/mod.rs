//! Contact laws shared by the kinds of contact: normal force, friction, and the sharing of a patch.

pub(crate) mod barrier;
pub(crate) mod capstan_correction;
pub(crate) mod elastic_grip;
pub(crate) mod friction_arrays;
pub(crate) mod patch_shares;
pub(crate) mod skin_direction;
