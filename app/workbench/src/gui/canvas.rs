//! The 3-D drawing inside egui: drawn anew only when something has changed, then copied.

use std::sync::{Arc, Mutex, PoisonError};

use egui::{PaintCallback, Rect};
use endline_session::scene::Scene;
use three_d::{ScissorBox, Viewport};

use crate::scene::{Camera, Drawer, Water};

/// Panes of the 3-D view at most.
pub const MOST_PANES: usize = 4;

/// What a slot was drawn with last.
type Drawn = (Camera, [u32; 2], Water);

/// A drawer with the scene that waits for it and what it drew last, for each slot: a pane that shows the scene.
#[derive(Default)]
pub struct Canvas {
    /// Made when it is first needed.
    drawer: Option<Drawer>,
    waiting: Option<Scene>,
    drawn: Vec<Option<Drawn>>,
}

impl Canvas {
    /// A canvas on eframe's OpenGL.
    ///
    /// # Errors
    /// Where this OpenGL cannot draw the scene.
    pub fn new(gl: Arc<three_d::context::Context>) -> Result<Self, String> {
        Ok(Self { drawer: Some(Drawer::new(gl)?), waiting: None, drawn: Vec::new() })
    }

    /// Takes a scene to be drawn next.
    pub fn load(&mut self, scene: Scene) {
        self.waiting = Some(scene);
    }

    /// What egui calls to have a slot of the canvas painted in a rectangle.
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
            // A card that cannot draw has said so when the window was opened.
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
