//! Pictures of a frame as PNG, drawn without a display by the same code as the window.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use endline_session::scene::{Scene, Show};
use endline_session::units::Units;
use endline_sim::{DVec3, Frame, Model};
use three_d::{Context, RenderTarget, ScissorBox, Viewport};

use super::camera::{Camera, View};
use super::draw::{Drawer, Water};
use super::offscreen::Offscreen;
use super::overlay::{self, Overlay};

/// Content and file of a picture.
pub struct RenderRequest<'a> {
    /// The gear, sea and whale.
    pub model: &'a Model,
    /// The frame shown.
    pub frame: &'a Frame,
    /// Width and height [px].
    pub size: [u32; 2],
    /// Name of a [`View`].
    pub view: &'a str,
    /// What is drawn.
    pub show: Show,
    /// Places that fill the picture [m]; if empty, gear and whale.
    pub fit: &'a [DVec3],
    /// Line of text at the top left, such as the scenario's name.
    pub caption: &'a str,
    /// PNG file to write.
    pub out: &'a Path,
    /// Units of the scale bar.
    pub units: Units,
}

/// Largest side of a picture [px].
const LARGEST: u32 = 8192;

/// Writes a PNG of a frame; needs no display.
/// Errors: for an unknown view, a size out of range, missing OpenGL, or a file that cannot be written.
pub fn render_png(request: &RenderRequest<'_>) -> Result<(), String> {
    let pixels = render(request)?;
    write_png(request.out, request.size, &pixels)
}

/// Returns the pixels, row by row from the top: red, green, blue, opacity.
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
    Renderer::new(request.size)?.picture(request, view)
}

/// Draws pictures of one size without a display.
pub struct Renderer {
    /// Its OpenGL context is current while it exists.
    _surface: Offscreen,
    size: [u32; 2],
    drawer: Drawer,
    context: Context,
    overlay: egui::Context,
    painter: egui_glow::Painter,
}

impl Renderer {
    /// Creates an OpenGL context for pictures of a size [px], current on this thread.
    pub fn new(size: [u32; 2]) -> Result<Self, String> {
        let surface = Offscreen::new(size)?;
        let failed = |error: &dyn std::fmt::Display| error.to_string();
        Ok(Self {
            size,
            drawer: Drawer::new(surface.gl.clone())?,
            context: Context::from_gl_context(surface.gl.clone())
                .map_err(|error| failed(&error))?,
            overlay: egui::Context::default(),
            painter: egui_glow::Painter::new(surface.gl.clone(), "", None, false)
                .map_err(|error| failed(&error))?,
            _surface: surface,
        })
    }

    /// Draws a picture from a named view, row by row from the top: red, green, blue, opacity. The request has the size of the renderer.
    pub fn picture(
        &mut self,
        request: &RenderRequest<'_>,
        view: View,
    ) -> Result<Vec<[u8; 4]>, String> {
        let RenderRequest { model, frame, fit, .. } = request;
        let aspect = f64::from(self.size[0]) / f64::from(self.size[1]);
        let length_m = model.spec.whale.as_ref().map_or(10.0, |whale| whale.length_m);
        let all = Scene::places_of(model, frame);
        let places = if fit.is_empty() { &all[..] } else { fit };
        let camera = Camera::of_view(view, places, frame.whale.as_ref(), length_m, aspect);
        Ok(self.seen_by(request, &camera, Water::DARK))
    }

    /// Draws a picture with overlay as seen by a camera.
    pub fn seen_by(
        &mut self,
        request: &RenderRequest<'_>,
        camera: &Camera,
        water: Water,
    ) -> Vec<[u8; 4]> {
        let [width, height] = self.size;
        let scene = self.draw(request, camera, water);
        let overlay = Overlay {
            caption: request.caption,
            time_s: scene.time_s,
            scale_n: if request.model.spec.lines.is_empty() { 0.0 } else { scene.scale_n },
            metres_a_point: camera.metres_a_point(f64::from(height)),
            units: request.units,
        };
        if request.show.film {
            return RenderTarget::screen(&self.context, width, height).read_color();
        }
        self.paint_over(|painter, rect| {
            if request.show.names {
                overlay::paint_names(painter, rect, camera, request.model, request.frame);
            }
            overlay::paint(painter, rect, &overlay);
        });
        RenderTarget::screen(&self.context, width, height).read_color()
    }

    /// Draws a picture without text, for thumbnails.
    pub fn bare(
        &mut self,
        request: &RenderRequest<'_>,
        camera: &Camera,
        water: Water,
    ) -> Vec<[u8; 4]> {
        let [width, height] = self.size;
        self.draw(request, camera, water);
        RenderTarget::screen(&self.context, width, height).read_color()
    }

    fn draw(&mut self, request: &RenderRequest<'_>, camera: &Camera, water: Water) -> Scene {
        let [width, height] = self.size;
        let scene = Scene::of(request.model, request.frame, &request.show);
        self.drawer.load(&scene);
        self.drawer.draw(0, camera, self.size, water);
        let clip = ScissorBox::new_at_origo(width, height);
        self.drawer.show(0, self.size, Viewport::new_at_origo(width, height), clip);
        scene
    }

    /// Paints over the surface with egui.
    fn paint_over(&mut self, paint: impl Fn(&egui::Painter, egui::Rect)) {
        let [width, height] = self.size;
        let rect =
            egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width as f32, height as f32));
        let input = egui::RawInput { screen_rect: Some(rect), ..egui::RawInput::default() };
        let mut output = self.overlay.run_ui(input, |ui| paint(ui.painter(), rect));
        let shapes =
            self.overlay.tessellate(std::mem::take(&mut output.shapes), output.pixels_per_point);
        self.painter.paint_and_update_textures(
            self.size,
            output.pixels_per_point,
            &shapes,
            &mut output.textures_delta,
        );
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        self.painter.destroy();
    }
}

/// Writes pixels as a PNG file.
pub fn write_png(out: &Path, size: [u32; 2], pixels: &[[u8; 4]]) -> Result<(), String> {
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
