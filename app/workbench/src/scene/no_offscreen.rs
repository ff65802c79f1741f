//! In the place of `offscreen` on macOS, which has no EGL: pictures can be saved in the window alone.

use std::sync::Arc;

use three_d::context::Context as Gl;

/// An off-screen surface, which there is none of.
pub struct Offscreen {
    /// OpenGL on the surface.
    pub gl: Arc<Gl>,
}

impl Offscreen {
    /// None.
    ///
    /// # Errors
    /// Always, with why and what to do.
    pub fn new(_size: [u32; 2]) -> Result<Self, String> {
        Err("macOS has no EGL, by which pictures are drawn without a window; open the recording in the window and save the view there".to_owned())
    }
}
