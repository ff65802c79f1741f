//! What a frame looks like, as plain data, and drawing it with or without a display.

use std::path::Path;

use endline_sim::{Frame, Model};

/// A picture wanted from a frame.
pub struct RenderRequest<'a> {
    /// The gear, sea and whale.
    pub model: &'a Model,
    /// The moment shown.
    pub frame: &'a Frame,
    /// Width and height [px].
    pub size: [u32; 2],
    /// One of [`VIEW_NAMES`].
    pub view: &'a str,
    /// Tension at the top of the colour scale [N]; the frame's own peak where `None`.
    pub scale_n: Option<f64>,
    /// Line of text at the top left, such as the scenario's name.
    pub caption: &'a str,
    /// PNG file to write.
    pub out: &'a Path,
}

/// Names a picture's view may have.
pub const VIEW_NAMES: [&str; 5] = ["orbit", "side", "top", "front", "whale"];

/// Writes a PNG of a frame; needs no display.
///
/// # Errors
/// With the reason: an unknown view, no OpenGL to draw with, a file that cannot be written.
pub fn render_png(request: &RenderRequest<'_>) -> Result<(), String> {
    if !VIEW_NAMES.contains(&request.view) {
        return Err(format!("there is no view `{}`; expected one of {}", request.view, VIEW_NAMES.join(", ")));
    }
    Err("pictures are not part of this build yet".into())
}
