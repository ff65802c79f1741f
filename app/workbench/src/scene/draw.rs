//! Drawing of a scene with three-d: into an antialiased texture, which is copied onto a window, a pane of egui or a picture.

use std::sync::{Arc, Mutex, PoisonError};

use egui::{PaintCallback, Rect};
use endline_session::scene::colour::rgb;
use endline_session::scene::mesh::Colour;
use endline_session::scene::{Look, Part, Scene};
use glam::Vec3;
use three_d::{
    Blend, Camera as ViewOfPlane, ClearState, ColorTexture, Context, CopyEffect, CoreError, Cull,
    DepthTest, ElementBuffer, Mat4, Program, RenderStates, RenderTarget, RenderTargetMultisample,
    ScissorBox, Texture2D, Vec3 as GlVec3, VertexBuffer, Viewport, WriteMask,
};

use crate::scene::camera::Camera;

use super::shaders::{self, Shaders};

/// Samples per pixel for antialiasing.
const SAMPLES: u32 = 4;

/// Colours of the sea (sRGB).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Water {
    /// Water at the seabed.
    pub low: Colour,
    /// Water just below the surface.
    pub high: Colour,
    /// Air above it.
    pub sky: Colour,
}

impl Water {
    /// For the dark theme and for pictures.
    pub const DARK: Self = Self {
        low: rgb(0x13, 0x33, 0x42),
        high: rgb(0x3d, 0x7a, 0x90),
        sky: rgb(0x6b, 0x8c, 0x99),
    };
    /// For the light theme.
    pub const LIGHT: Self = Self {
        low: rgb(0x21, 0x46, 0x56),
        high: rgb(0x5d, 0x97, 0xab),
        sky: rgb(0xb4, 0xcd, 0xd6),
    };
}

/// Draws scenes. Owns shader programs, buffers and textures on the graphics card.
pub struct Drawer {
    context: Context,
    shaders: Shaders,
    corners: VertexBuffer<[f32; 2]>,
    /// Made for the first film.
    film: Option<FilmParts>,
    loaded: Vec<Loaded>,
    depth_m: f32,
    time_s: f32,
    drift_m: Vec3,
    in_film: bool,
    /// One for each slot.
    pictures: Vec<Option<Picture>>,
}

/// What only films need.
struct FilmParts {
    shaders: Shaders,
    snow: Snow,
}

/// The last drawing of the scene for one slot.
struct Picture {
    target: RenderTargetMultisample<[u8; 4], f32>,
    picture: Option<Texture2D>,
}

/// A part on the graphics card.
struct Loaded {
    name: &'static str,
    look: Look,
    least_px: f32,
    place: VertexBuffer<[f32; 3]>,
    normal: VertexBuffer<[f32; 3]>,
    radius: VertexBuffer<f32>,
    colour: VertexBuffer<[f32; 4]>,
    grain: VertexBuffer<[f32; 3]>,
    triangles: ElementBuffer<u32>,
}

/// Uniforms of a draw call that describe the camera and the sea.
struct Uniforms {
    to_clip: Mat4,
    place: GlVec3,
    /// Vectors from the eye to the right edge, the upper edge and the middle of the picture, at unit distance.
    sight: [GlVec3; 3],
    pixel_angle: f32,
    clear_m: f32,
    hide_m: f32,
    depth_m: f32,
    time_s: f32,
    water: [GlVec3; 3],
    viewport: Viewport,
}

/// What is drawn of a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pass {
    /// The part itself.
    Whole,
    /// A dark outline.
    Edge,
}

/// Width of the dark outline of a rope [px].
const EDGE_PX: f32 = 1.0;

impl Drawer {
    /// A drawer on the current OpenGL context.
    pub fn new(gl: Arc<three_d::context::Context>) -> Result<Self, String> {
        let build = || -> Result<Self, CoreError> {
            let context = Context::from_gl_context(gl)?;
            let shaders = Shaders::new(&context, false)?;
            let corners =
                VertexBuffer::new_with_data(&context, &[[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]]);
            Ok(Self {
                context,
                shaders,
                corners,
                film: None,
                loaded: Vec::new(),
                depth_m: 1.0,
                time_s: 0.0,
                drift_m: Vec3::ZERO,
                in_film: false,
                pictures: Vec::new(),
            })
        };
        build().map_err(|error| format!("the 3-D view cannot use this OpenGL: {error}"))
    }

    /// Copies the triangles of a scene to the graphics card.
    pub fn load(&mut self, scene: &Scene) {
        (self.depth_m, self.time_s) = (scene.depth_m.max(1.0) as f32, scene.time_s as f32);
        (self.drift_m, self.in_film) = (scene.drift_m.as_vec3(), scene.film);
        if self.in_film && self.film.is_none() {
            self.film = FilmParts::new(&self.context).ok();
        }
        self.loaded.retain(|loaded| scene.part(loaded.name).is_some());
        for (index, part) in scene.parts.iter().enumerate() {
            if self.loaded.get(index).is_none_or(|loaded| loaded.name != part.name) {
                self.loaded.insert(index, Loaded::new(&self.context, part));
            }
            self.loaded[index].fill(part);
        }
    }

    /// Draws the loaded scene into the texture of a slot, of `size` pixels.
    pub fn draw(&mut self, slot: usize, camera: &Camera, size: [u32; 2], water: Water) {
        let [width, height] = size.map(|side| side.max(1));
        if self.pictures.len() <= slot {
            self.pictures.resize_with(slot + 1, || None);
        }
        let known = self.pictures[slot]
            .take()
            .filter(|known| [known.target.width(), known.target.height()] == [width, height]);
        let target = known.map_or_else(
            || RenderTargetMultisample::new(&self.context, width, height, SAMPLES),
            |known| known.target,
        );
        let eye = self.eye(camera, [width, height], water);
        target.clear(ClearState::color_and_depth(0.0, 0.0, 0.0, 1.0, 1.0));
        let film = self.film.as_ref().filter(|_| self.in_film);
        let shaders = film.map_or(&self.shaders, |film| &film.shaders);
        let drawn = target.write::<CoreError>(|| {
            self.draw_backdrop(&shaders.backdrop, &eye);
            for loaded in &self.loaded {
                if loaded.look == Look::Rope && !self.in_film {
                    loaded.draw(shaders, &eye, Pass::Edge);
                }
                loaded.draw(shaders, &eye, Pass::Whole);
            }
            if let Some(film) = film {
                film.snow.draw(&eye, self.drift_m);
            }
            Ok(())
        });
        let picture = drawn.is_ok().then(|| target.resolve_color());
        self.pictures[slot] = Some(Picture { target, picture });
    }

    fn draw_backdrop(&self, program: &Program, eye: &Uniforms) {
        for (name, sight) in ["right", "up", "ahead"].into_iter().zip(eye.sight) {
            program.use_uniform(name, sight);
        }
        eye.set_sea(program);
        program.use_vertex_attribute("corner", &self.corners);
        let states = RenderStates {
            depth_test: DepthTest::Always,
            write_mask: WriteMask::COLOR,
            ..RenderStates::default()
        };
        program.draw_arrays(states, eye.viewport, 3);
    }

    /// Copies the picture of a slot onto a window of `window` pixels, at `viewport`, clipped to `clip` (both from the bottom left).
    pub fn show(&self, slot: usize, window: [u32; 2], viewport: Viewport, clip: ScissorBox) {
        if let Some(picture) = self
            .pictures
            .get(slot)
            .and_then(Option::as_ref)
            .and_then(|drawn| drawn.picture.as_ref())
        {
            let copy = CopyEffect { write_mask: WriteMask::COLOR, blend: Blend::Disabled };
            let screen = RenderTarget::screen(&self.context, window[0], window[1]);
            screen.apply_screen_effect_partially(
                clip,
                &copy,
                ViewOfPlane::new_2d(viewport),
                &[],
                Some(ColorTexture::Single(picture)),
                None,
            );
        }
    }
}

impl FilmParts {
    fn new(context: &Context) -> Result<Self, CoreError> {
        Ok(Self { shaders: Shaders::new(context, true)?, snow: Snow::new(context)? })
    }
}

impl Loaded {
    fn new(context: &Context, part: &Part) -> Self {
        Self {
            name: part.name,
            look: part.look,
            least_px: part.least_px,
            place: VertexBuffer::new(context),
            normal: VertexBuffer::new(context),
            radius: VertexBuffer::new(context),
            colour: VertexBuffer::new(context),
            grain: VertexBuffer::new(context),
            triangles: ElementBuffer::new(context),
        }
    }

    fn fill(&mut self, part: &Part) {
        let mesh = &part.mesh;
        (self.look, self.least_px) = (part.look, part.least_px);
        let arrays =
            |vectors: &[Vec3]| vectors.iter().map(|vector| vector.to_array()).collect::<Vec<_>>();
        self.place.fill(&arrays(&mesh.place));
        self.normal.fill(&arrays(&mesh.normal));
        self.grain.fill(&arrays(mesh.own_grain()));
        self.radius.fill(&mesh.radius_m);
        self.colour.fill(&mesh.colour);
        self.triangles.fill(mesh.triangles.as_flattened());
    }

    fn draw(&self, shaders: &Shaders, eye: &Uniforms, pass: Pass) {
        let program = shaders.of_part(self.look, pass);
        let grid_m = match self.look {
            Look::Seabed { grid_m } | Look::Surface { grid_m } => grid_m,
            _ => 0.0,
        };
        eye.set_sea(program);
        program.use_uniform("to_clip", eye.to_clip);
        program.use_uniform("pixel_angle", eye.pixel_angle);
        program.use_uniform("least_px", self.least_px);
        program.use_uniform("edge_px", if pass == Pass::Edge { EDGE_PX } else { 0.0 });
        program.use_uniform_if_required("grid_m", grid_m);
        program.use_vertex_attribute("place", &self.place);
        program.use_vertex_attribute("normal", &self.normal);
        program.use_vertex_attribute("radius", &self.radius);
        if program.requires_attribute("colour") {
            program.use_vertex_attribute("colour", &self.colour);
        }
        if program.requires_attribute("grain") {
            program.use_vertex_attribute("grain", &self.grain);
        }
        let states = render_states(matches!(self.look, Look::Surface { .. }), pass);
        program.draw_elements(states, eye.viewport, &self.triangles);
    }
}

/// Light that the shaders show as a colour of the screen; as `light_of` in `sea.glsl`.
fn light_of([red, green, blue, _]: Colour) -> GlVec3 {
    let light = |part: f32| {
        let share = 0.95 * part * part;
        share / (1.0 - share)
    };
    GlVec3::new(light(red), light(green), light(blue))
}

fn render_states(see_through: bool, pass: Pass) -> RenderStates {
    let (blend, write_mask) = if see_through {
        (Blend::TRANSPARENCY, WriteMask::COLOR)
    } else {
        (Blend::Disabled, WriteMask::COLOR_AND_DEPTH)
    };
    // Only the far side of the wider tube is drawn, so that it outlines the rope and never covers it.
    let cull = if pass == Pass::Edge { Cull::Front } else { Cull::None };
    RenderStates { depth_test: DepthTest::LessOrEqual, cull, blend, write_mask }
}

/// Particles that drift with the water in films.
struct Snow {
    program: Program,
    seed: VertexBuffer<[f32; 3]>,
    corner: VertexBuffer<[f32; 3]>,
    triangles: ElementBuffer<u32>,
}

/// Number of particles in the cell of 8 m that repeats around the eye.
const PARTICLES: u32 = 9000;

impl Snow {
    /// Errors: shaders that this OpenGL refuses.
    fn new(context: &Context) -> Result<Self, CoreError> {
        let program = shaders::of_snow(context)?;
        // The additive recurrence of the plastic number spreads points evenly without a lattice that the eye would see
        // (Roberts 2018).
        const STEPS: [f64; 3] =
            [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3];
        let place = |index: u32| STEPS.map(|step| (0.5 + step * f64::from(index)).fract() as f32);
        let radius_m =
            |index: u32| 0.0012 + 0.0022 * ((f64::from(index) * 0.618_034).fract() as f32).powi(3);
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let all = 0..PARTICLES;
        let seeds: Vec<_> = all.clone().flat_map(|index| [place(index); 4]).collect();
        let squares: Vec<_> =
            all.clone().flat_map(|index| corners.map(|[x, y]| [x, y, radius_m(index)])).collect();
        let triangles: Vec<_> =
            all.flat_map(|index| [0, 1, 2, 0, 2, 3].map(|corner| 4 * index + corner)).collect();
        Ok(Self {
            program,
            seed: VertexBuffer::new_with_data(context, &seeds),
            corner: VertexBuffer::new_with_data(context, &squares),
            triangles: ElementBuffer::new_with_data(context, &triangles),
        })
    }

    /// Draws the particles in water that has drifted by `drift_m`.
    fn draw(&self, eye: &Uniforms, drift_m: Vec3) {
        let program = &self.program;
        eye.set_sea(program);
        program.use_uniform("to_clip", eye.to_clip);
        program.use_uniform("pixel_angle", eye.pixel_angle);
        program.use_uniform("drift_m", GlVec3::new(drift_m.x, drift_m.y, drift_m.z));
        for (name, sight) in ["right", "up"].into_iter().zip(eye.sight) {
            let length = sight.x.hypot(sight.y).hypot(sight.z);
            program.use_uniform(name, sight * (1.0 / length.max(1e-9)));
        }
        program.use_vertex_attribute("seed", &self.seed);
        program.use_vertex_attribute("corner", &self.corner);
        let states = RenderStates {
            depth_test: DepthTest::LessOrEqual,
            cull: Cull::None,
            blend: Blend::TRANSPARENCY,
            write_mask: WriteMask::COLOR,
        };
        program.draw_elements(states, eye.viewport, &self.triangles);
    }
}

impl Drawer {
    fn eye(&self, camera: &Camera, size: [u32; 2], water: Water) -> Uniforms {
        let [width, height] = size;
        let aspect = f64::from(width) / f64::from(height);
        let seen_m = camera.metres_a_point(1.0) as f32;
        let gl = |vector: Vec3| GlVec3::new(vector.x, vector.y, vector.z);
        let (right, up, ahead) = camera.axes();
        let half = (camera.field_of_view / 2.0).tan();
        Uniforms {
            to_clip: Mat4::from(camera.matrix(aspect).as_mat4().to_cols_array_2d()),
            place: gl(camera.eye().as_vec3()),
            sight: [right * half * aspect, up * half, ahead].map(|vector| gl(vector.as_vec3())),
            pixel_angle: (camera.metres_a_point(f64::from(height)) / camera.distance_m) as f32,
            clear_m: camera.distance_m as f32,
            hide_m: 2.5 * seen_m + 30.0,
            depth_m: self.depth_m,
            time_s: self.time_s,
            water: [water.low, water.high, water.sky].map(light_of),
            viewport: Viewport::new_at_origo(width, height),
        }
    }
}

impl Uniforms {
    /// Sets the uniforms of `sea.glsl`.
    fn set_sea(&self, program: &Program) {
        program.use_uniform("eye", self.place);
        program.use_uniform("depth_m", self.depth_m);
        program.use_uniform_if_required("clear_m", self.clear_m);
        for (name, colour) in ["water_low", "water_high", "sky"].into_iter().zip(self.water) {
            program.use_uniform_if_required(name, colour);
        }
        program.use_uniform_if_required("hide_m", self.hide_m);
        program.use_uniform_if_required("time_s", self.time_s);
    }
}

/// Maximum number of panes of the 3-D view.
pub const MOST_PANES: usize = 4;

/// Camera, size and colours of the last drawing of a slot.
type Drawn = (Camera, [u32; 2], Water);

/// The 3-D drawing inside egui. It has a slot for each pane that shows the scene, and draws a slot again only after a change.
#[derive(Default)]
pub struct Canvas {
    /// Made at the first use.
    drawer: Option<Drawer>,
    waiting: Option<Scene>,
    drawn: Vec<Option<Drawn>>,
}

impl Canvas {
    /// A canvas on the OpenGL context of eframe.
    pub fn new(gl: Arc<three_d::context::Context>) -> Result<Self, String> {
        Ok(Self { drawer: Some(Drawer::new(gl)?), waiting: None, drawn: Vec::new() })
    }

    /// Sets the scene to be drawn next.
    pub fn load(&mut self, scene: Scene) {
        self.waiting = Some(scene);
    }

    /// Callback by which egui paints a slot of the canvas in a rectangle.
    pub fn callback(
        canvas: &Arc<Mutex<Self>>,
        slot: usize,
        rect: Rect,
        camera: Camera,
        water: Water,
    ) -> PaintCallback {
        let canvas = Arc::clone(canvas);
        let paint = egui_glow::CallbackFn::new(move |info, painter| {
            let mut canvas = canvas.lock().unwrap_or_else(PoisonError::into_inner);
            canvas.paint(painter.gl(), slot, &info, &camera, water);
        });
        PaintCallback { rect, callback: Arc::new(paint) }
    }

    fn paint(
        &mut self,
        gl: &Arc<three_d::context::Context>,
        slot: usize,
        info: &egui::PaintCallbackInfo,
        camera: &Camera,
        water: Water,
    ) {
        let (place, clip) = (info.viewport_in_pixels(), info.clip_rect_in_pixels());
        let side = |pixels: i32| u32::try_from(pixels).unwrap_or(0);
        let size = [side(place.width_px), side(place.height_px)];
        if size.contains(&0) {
            return;
        }
        if self.drawer.is_none() {
            // An error was already reported when the window was opened.
            self.drawer = Drawer::new(Arc::clone(gl)).ok();
        }
        let Some(drawer) = &mut self.drawer else { return };
        if let Some(scene) = self.waiting.take() {
            drawer.load(&scene);
            self.drawn.clear();
        }
        if self.drawn.len() <= slot {
            self.drawn.resize(slot + 1, None);
        }
        let wanted = (camera.clone(), size, water);
        if self.drawn[slot].as_ref() != Some(&wanted) {
            drawer.draw(slot, camera, size, water);
            self.drawn[slot] = Some(wanted);
        }
        let viewport =
            Viewport { x: place.left_px, y: place.from_bottom_px, width: size[0], height: size[1] };
        let scissor = ScissorBox {
            x: clip.left_px,
            y: clip.from_bottom_px,
            width: side(clip.width_px),
            height: side(clip.height_px),
        };
        drawer.show(slot, info.screen_size_px, viewport, scissor);
    }
}
