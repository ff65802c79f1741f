//! Drawing a scene with or without a display.
//!
//! One path: [`Scene::of`](endline_session::scene::Scene::of) makes plain triangles from a model and
//! a frame; [`Drawer`] draws them by OpenGL, in the workbench's window, in [`render_png`] and in
//! tests.

pub mod camera;
pub mod camera_path;
pub mod draw;
pub mod film;
pub mod labels;
#[cfg_attr(target_vendor = "apple", path = "no_offscreen.rs")]
pub mod offscreen;
pub mod overlay;
pub mod pick;
pub mod picture;
pub mod reel;
pub mod silhouette;

pub use camera::{Camera, View};
pub use camera_path::CameraPath;
pub use draw::{Drawer, Water};
pub use overlay::Overlay;
pub use pick::Picked;
pub use picture::{RenderRequest, Renderer, render, render_png, write_png};
pub use reel::Reel;

#[cfg(test)]
pub(crate) mod sample;
#[cfg(test)]
mod tests;
