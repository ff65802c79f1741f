//! Force laws of rope, bodies, water and seabed, each with its contribution to the linear system.

pub(crate) mod axial;
pub(crate) mod bending;
pub(crate) mod body;
pub(crate) mod laws;
pub(crate) mod lengths;
pub(crate) mod pulled;
pub(crate) mod rope;
pub(crate) mod seabed;
pub(crate) mod suction;
pub(crate) mod tilt;
pub(crate) mod water;
