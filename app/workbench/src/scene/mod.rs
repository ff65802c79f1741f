//! What a frame looks like, as plain data, and drawing it with or without a display.
//!
//! One path: [`Scene::of`] makes plain triangles from a model and a frame; [`Drawer`] draws them by
//! OpenGL, in the workbench's window, in [`render_png`] and in tests alike.

pub mod bodies;
pub mod bounds;
pub mod build;
pub mod camera;
pub mod colour;
pub mod draw;
pub mod mesh;
pub mod obstacles;
pub mod offscreen;
pub mod overlay;
pub mod pick;
pub mod picture;
pub mod rope;
pub mod sea;
pub mod ticks;
pub mod whale;

pub use bounds::Bounds;
pub use build::{Look, Part, Scene, Show};
pub use camera::{Camera, View};
pub use draw::{Drawer, Water};
pub use overlay::Overlay;
pub use pick::Picked;
pub use picture::{RenderRequest, render, render_png};

#[cfg(test)]
pub(crate) mod sample;
#[cfg(test)]
mod tests;
