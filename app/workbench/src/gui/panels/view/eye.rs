//! An eye of the 3-D view: where it is, what it goes with, how the mouse turns it.

use egui::{PointerButton, Rect, Response, Ui};
use endline_session::live::LiveView;
use endline_session::scene::Scene;
use endline_sim::{Frame, Model};
use glam::DVec2;

use crate::scene::{Camera, View};

/// An eye; each pane of the 3-D view has one.
#[derive(Clone, Debug)]
pub struct Eye {
    /// Where it stands and looks.
    pub camera: Camera,
    /// Whether it goes with the whale.
    pub follow: bool,
    /// The last named view.
    pub named: View,
    /// Whether to bring everything into sight with the next frame.
    pub frame_again: bool,
    /// How far the user has turned from the following camera's own direction: azimuth, elevation, nearness.
    turned: [f64; 3],
}

impl Default for Eye {
    fn default() -> Self {
        Self::at(View::default())
    }
}

impl Eye {
    /// An eye at a named view.
    #[must_use]
    pub fn at(view: View) -> Self {
        Self {
            camera: Camera::default(),
            follow: view.is_of_whale(),
            named: view,
            frame_again: true,
            turned: [0.0; 3],
        }
    }

    /// Goes to a named view.
    pub fn look(&mut self, view: View) {
        *self = Self { camera: self.camera.clone(), ..Self::at(view) };
    }

    /// Brings everything into sight.
    pub fn frame(&mut self) {
        (self.follow, self.frame_again) = (false, true);
    }

    /// Drag orbits, right drag or Shift and drag pans, the wheel comes nearer.
    pub fn turn(&mut self, ui: &Ui, response: &Response, flying: bool) {
        let drag =
            DVec2::new(f64::from(response.drag_delta().x), f64::from(response.drag_delta().y));
        let shift = ui.input(|input| input.modifiers.shift) && !flying;
        let pan = response.dragged_by(PointerButton::Secondary)
            || response.dragged_by(PointerButton::Middle)
            || shift;
        let notches = if response.hovered() {
            f64::from(ui.input(|input| input.smooth_scroll_delta().y)) / 50.0
        } else {
            0.0
        };
        if self.follow {
            self.turned = [
                self.turned[0] - drag.x * 0.008,
                self.turned[1] + drag.y * 0.008,
                self.turned[2] + notches,
            ];
        } else if response.dragged() && pan {
            self.camera.pan(drag, f64::from(response.rect.height()));
        } else if response.dragged() {
            self.camera.orbit(drag);
        }
        if !self.follow {
            self.camera.zoom(notches);
        }
    }

    /// Where it stands for a run's moment, drawn in a rectangle.
    #[must_use]
    pub fn placed(&self, view: &LiveView, rect: Rect) -> Camera {
        self.at_moment(&view.model, &view.frame, f64::from(rect.width() / rect.height().max(1.0)))
    }

    /// Where it stands for a moment, in a picture so many times as wide as it is high.
    #[must_use]
    pub fn at_moment(&self, model: &Model, frame: &Frame, aspect: f64) -> Camera {
        let mut camera = self.camera.clone();
        let length_m = model.spec.whale.as_ref().map_or(10.0, |whale| whale.length_m);
        if let (true, Some(whale)) = (self.follow, &frame.whale) {
            camera.go_with(self.named, whale, length_m, aspect);
            if self.named != View::FirstPerson {
                camera.azimuth += self.turned[0];
                camera.elevation = (camera.elevation + self.turned[1]).clamp(-1.4, 1.4);
                camera.zoom(self.turned[2]);
            }
        } else if self.frame_again {
            let places = Scene::places_of(model, frame);
            camera = Camera::of_view(self.named, &places, None, length_m, aspect);
        }
        camera
    }
}
