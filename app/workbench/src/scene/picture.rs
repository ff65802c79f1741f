//! Pictures of a frame as PNG, drawn by the window's own code without a display.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use endline_session::scene::{Scene, Show};
use endline_session::units::Units;
use endline_sim::{DVec3, Frame, Model};
use three_d::{Context, RenderTarget, ScissorBox, Viewport};

use super::camera::{Camera, View};
use super::draw::{Drawer, Water};
use super::labels;
use super::offscreen::Offscreen;
use super::overlay::{self, Overlay};

/// A picture wanted from a frame.
pub struct RenderRequest<'a> {
    /// The gear, sea and whale.
    pub model: &'a Model,
    /// The moment shown.
    pub frame: &'a Frame,
    /// Width and height [px].
    pub size: [u32; 2],
    /// Name of a [`View`].
    pub view: &'a str,
    /// Tension at the top of the colour scale [N]; the frame's own peak where `None`.
    pub scale_n: Option<f64>,
    /// Places that fill the picture [m]; all of gear and whale where empty.
    pub fit: &'a [DVec3],
    /// Line of text at the top left, such as the scenario's name.
    pub caption: &'a str,
    /// PNG file to write.
    pub out: &'a Path,
}

/// Largest side of a picture [px].
const LARGEST: u32 = 8192;

/// Writes a PNG of a frame; needs no display.
///
/// # Errors
/// With the reason: an unknown view, a size out of range, no OpenGL to draw with, a file that cannot be written.
pub fn render_png(request: &RenderRequest<'_>) -> Result<(), String> {
    let pixels = render(request)?;
    write_png(request.out, request.size, &pixels)
}

/// The picture's pixels, row by row from the top: red, green, blue, opacity.
///
/// # Errors
/// As [`render_png`], but for the file.
pub fn render(request: &RenderRequest<'_>) -> Result<Vec<[u8; 4]>, String> {
    let view = View::named(request.view).ok_or_else(|| {
        format!("there is no view `{}`; expected one of {}", request.view, View::names())
    })?;
    if request.size.into_iter().any(|side| !(16..=LARGEST).contains(&side)) {
        let [width, height] = request.size;
        return Err(format!(
            "a picture of {width} x {height} pixels cannot be drawn; each side may have 16 to {LARGEST}"
        ));
    }
    let scene = Scene::of(
        request.model,
        request.frame,
        &Show { scale_n: request.scale_n, ..Show::default() },
    );
    let aspect = f64::from(request.size[0]) / f64::from(request.size[1]);
    let length_m = request.model.spec.whale.as_ref().map_or(10.0, |whale| whale.length_m);
    let all = Scene::places_of(request.model, request.frame);
    let places = if request.fit.is_empty() { &all } else { request.fit };
    let camera = Camera::of_view(view, places, request.frame.whale.as_ref(), length_m, aspect);
    draw(request, &scene, &camera)
}

fn draw(
    request: &RenderRequest<'_>,
    scene: &Scene,
    camera: &Camera,
) -> Result<Vec<[u8; 4]>, String> {
    let [width, height] = request.size;
    let surface = Offscreen::new(request.size)?;
    let mut drawer = Drawer::new(surface.gl.clone())?;
    drawer.load(scene);
    drawer.draw(0, camera, request.size, Water::DARK);
    drawer.show(
        0,
        request.size,
        Viewport::new_at_origo(width, height),
        ScissorBox::new_at_origo(width, height),
    );
    let overlay = Overlay {
        caption: request.caption,
        time_s: scene.time_s,
        scale_n: if request.model.spec.lines.is_empty() { 0.0 } else { scene.scale_n },
        metres_a_point: camera.metres_a_point(f64::from(height)),
        units: Units::Mixed,
    };
    write_over(&surface, request.size, |painter, rect| {
        labels::paint(painter, rect, camera, request.model, request.frame);
        overlay::paint(painter, rect, &overlay);
    })?;
    let context =
        Context::from_gl_context(surface.gl.clone()).map_err(|error| error.to_string())?;
    Ok(RenderTarget::screen(&context, width, height).read_color())
}

/// Paints onto the surface with egui.
fn write_over(
    surface: &Offscreen,
    size: [u32; 2],
    paint: impl Fn(&egui::Painter, egui::Rect),
) -> Result<(), String> {
    let rect =
        egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(size[0] as f32, size[1] as f32));
    let input = egui::RawInput { screen_rect: Some(rect), ..egui::RawInput::default() };
    let context = egui::Context::default();
    let mut output = context.run_ui(input, |ui| paint(ui.painter(), rect));
    let shapes = context.tessellate(std::mem::take(&mut output.shapes), output.pixels_per_point);
    let mut painter = egui_glow::Painter::new(surface.gl.clone(), "", None, false)
        .map_err(|error| error.to_string())?;
    painter.paint_and_update_textures(
        size,
        output.pixels_per_point,
        &shapes,
        &mut output.textures_delta,
    );
    painter.destroy();
    Ok(())
}

fn write_png(out: &Path, size: [u32; 2], pixels: &[[u8; 4]]) -> Result<(), String> {
    let explain =
        |reason: String| format!("{}: the picture cannot be written: {reason}", out.display());
    let file = File::create(out).map_err(|error| explain(error.to_string()))?;
    let mut encoder = png::Encoder::new(BufWriter::new(file), size[0], size[1]);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let bytes: Vec<u8> = pixels.iter().flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    let mut writer = encoder.write_header().map_err(|error| explain(error.to_string()))?;
    writer.write_image_data(&bytes).map_err(|error| explain(error.to_string()))
}
