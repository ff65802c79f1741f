//! The physics of Endline: rope, bodies, water, whale, contact.
//!
//! A [`Model`] never changes once made; a [`State`] walks through time under it by [`step`].
//! Nothing here reads a file or a thread, logs, or keeps a global; a clock is read only where the caller lends one to tell costs.
//! SI units, f64, radians; z up, z = 0 the mean sea surface, x east, y north.

#![warn(clippy::print_stdout, clippy::print_stderr)] // results leave as values

mod assembly;
pub mod balance;
mod broad_phase;
pub mod contact;
pub mod cost;
pub mod float;
mod forces;
pub mod frame;
mod gear_hook;
pub mod geometry;
pub mod haul;
mod in_place;
mod matrix;
pub mod metrics;
pub mod model;
mod model_check;
pub mod parting;
mod random;
mod remesh;
mod same_bits;
pub mod solids;
mod solver;
mod start;
pub mod state;
pub mod statics;
pub mod step;
mod step_control;
mod strands;
mod system;
mod trial;
pub mod water;
pub mod whale;

pub use contact::ContactPoint;
pub use cost::{Cost, CostPart};
pub use frame::Frame;
pub use glam::{DAffine3, DMat3, DQuat, DVec3, EulerRot};
pub use model::{Model, ModelSpec};
pub use state::State;
pub use statics::{Outcome, Settled, Unfound, settle};
pub use step::{Audit, Input, Stop, Workspace, step};
