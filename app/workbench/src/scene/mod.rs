//! Drawing of a scene with or without a display.
//!
//! [`Scene::of`](endline_session::scene::Scene::of) makes triangles from a model and a frame; [`Drawer`] draws them by OpenGL. The
//! window, [`render_png`] and tests use the same code.

pub mod camera;
pub mod draw;
pub mod eye;
pub mod film;
#[cfg(not(target_vendor = "apple"))]
pub mod offscreen;
pub mod overlay;
pub mod pick;
pub mod picture;
mod shaders;
pub mod silhouette;

pub use camera::{Camera, View};
pub use draw::{Canvas, Drawer, Water};
pub use eye::{CameraPath, Eye};
pub use film::Reel;
pub use overlay::Overlay;
pub use pick::Picked;
pub use picture::{RenderRequest, Renderer, render, render_png, write_png};

/// In place of `offscreen` on macOS, which has no EGL: only the window can save pictures there.
#[cfg(target_vendor = "apple")]
pub mod offscreen {
    use std::sync::Arc;

    use three_d::context::Context as Gl;

    /// An off-screen surface; macOS has none.
    pub struct Offscreen {
        /// OpenGL on the surface.
        pub gl: Arc<Gl>,
    }

    impl Offscreen {
        /// Always fails.
        /// Errors: always, with the reason and what to do instead.
        pub fn new(_size: [u32; 2]) -> Result<Self, String> {
            Err("macOS has no EGL, by which pictures are drawn without a window; open the recording in the window and save the view there".to_owned())
        }
    }
}

#[cfg(test)]
pub(crate) mod sample;
#[cfg(test)]
mod tests;
