//! The 3-D drawing inside egui: drawn anew only when something has changed, then copied.

use std::sync::{Arc, Mutex, PoisonError};

use egui::{PaintCallback, Rect};
use three_d::{ScissorBox, Viewport};

use crate::scene::{Camera, Drawer, Scene, Water};

/// A drawer with the scene that waits for it and what it drew last.
pub struct Canvas {
    drawer: Drawer,
    waiting: Option<Scene>,
    drawn: Option<(Camera, [u32; 2], Water)>,
}

impl Canvas {
    /// A canvas on eframe's OpenGL.
    ///
    /// # Errors
    /// Where this OpenGL cannot draw the scene.
    pub fn new(gl: Arc<three_d::context::Context>) -> Result<Self, String> {
        Ok(Self { drawer: Drawer::new(gl)?, waiting: None, drawn: None })
    }

    /// Takes a scene to be drawn next.
    pub fn load(&mut self, scene: Scene) {
        self.waiting = Some(scene);
    }

    /// What egui calls to have the canvas painted in a rectangle.
    pub fn callback(canvas: &Arc<Mutex<Self>>, rect: Rect, camera: Camera, water: Water) -> PaintCallback {
        let canvas = Arc::clone(canvas);
        let paint = egui_glow::CallbackFn::new(move |info, _painter| {
            canvas.lock().unwrap_or_else(PoisonError::into_inner).paint(&info, &camera, water);
        });
        PaintCallback { rect, callback: Arc::new(paint) }
    }

    fn paint(&mut self, info: &egui::PaintCallbackInfo, camera: &Camera, water: Water) {
        let (place, clip) = (info.viewport_in_pixels(), info.clip_rect_in_pixels());
        let side = |pixels: i32| u32::try_from(pixels).unwrap_or(0);
        let size = [side(place.width_px), side(place.height_px)];
        if size.contains(&0) {
            return;
        }
        let fresh = self.waiting.take();
        if let Some(scene) = &fresh {
            self.drawer.load(scene);
        }
        let wanted = (camera.clone(), size, water);
        if fresh.is_some() || self.drawn.as_ref() != Some(&wanted) {
            self.drawer.draw(camera, size, water);
            self.drawn = Some(wanted);
        }
        let viewport = Viewport { x: place.left_px, y: place.from_bottom_px, width: size[0], height: size[1] };
        let scissor = ScissorBox { x: clip.left_px, y: clip.from_bottom_px, width: side(clip.width_px), height: side(clip.height_px) };
        self.drawer.show(info.screen_size_px, viewport, scissor);
    }
}
