//! What a frame looks like, as plain data: triangles with colours, made from a model and a frame.
//!
//! Nothing here draws. The program's 3-D view draws these triangles, and
//! [`export::model`](crate::export::model) writes them to files.

pub mod bodies;
pub mod bounds;
pub mod build;
pub mod colour;
pub mod forces;
pub mod mesh;
pub mod obstacles;
pub mod rope;
mod round;
pub mod sea;
pub mod whale;

pub use bounds::Bounds;
pub use build::{Look, Part, Scene, Show};
