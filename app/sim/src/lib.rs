//! The physics of Endline: rope, bodies, water, whale, contact.
//!
//! A [`Model`] never changes; [`step`] advances a [`State`] in time under it.
//! The crate does no I/O, starts no thread, writes no log and has no global state; it reads a clock only if the caller lends
//! one.
//! SI units, f64, radians; z up, z = 0 the mean sea surface, x east, y north.

#![warn(clippy::print_stdout, clippy::print_stderr)] // results are returned as values

mod assembly;
pub mod balance;
mod bits;
mod broad_phase;
mod bucket_sort;
pub mod contact;
pub mod cost;
pub mod float;
mod forces;
pub mod frame;
mod gear_hook;
pub mod geometry;
pub mod haul;
mod matrix;
pub mod metrics;
pub mod model;
pub mod parting;
mod remesh;
mod simd;
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
