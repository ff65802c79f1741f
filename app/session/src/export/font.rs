//! The font of pictures: the program's own, so that a picture needs no font of the system.

use std::sync::LazyLock;

use plotters::style::{FontStyle, register_font};

/// Ubuntu Light, from `assets/fonts`.
static FONT: &[u8] = include_bytes!("../../../../assets/fonts/Ubuntu-Light.ttf");

/// Makes the font known as `sans-serif` to the drawing library.
///
/// # Errors
/// Where the drawing library cannot read the font.
pub fn register() -> Result<(), String> {
    static REGISTERED: LazyLock<bool> = LazyLock::new(|| {
        [FontStyle::Normal, FontStyle::Bold, FontStyle::Italic, FontStyle::Oblique]
            .into_iter()
            .all(|style| register_font("sans-serif", style, FONT).is_ok())
    });
    if *REGISTERED { Ok(()) } else { Err("the font of pictures cannot be read".into()) }
}
