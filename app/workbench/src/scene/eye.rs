//! The eye of a pane: a camera that the mouse moves or that follows the whale; and camera paths, keys between which it moves in a film.
//!
//! Between keys at times a and b the camera is interpolated with the share s²(3 − 2s), s = (t − a) / (b − a), so that it is at rest at
//! every key. Both eyes are evaluated at each moment, so that an eye that follows the whale also does so between keys.

use egui::{PointerButton, Rect, Response, Ui};
use endline_gear::units::{self, Quantity};
use endline_session::live::LiveView;
use endline_session::scene::Scene;
use endline_sim::{Frame, Model};
use glam::{DVec2, DVec3};

use crate::scene::camera::{Camera, View};

/// The eye of a pane of the 3-D view.
#[derive(Clone, Debug)]
pub struct Eye {
    /// Camera, used if the eye does not follow the whale.
    pub camera: Camera,
    /// Whether it follows the whale.
    pub follow: bool,
    /// The last named view.
    pub named: View,
    /// Whether to frame everything at the next frame.
    pub frame_again: bool,
    /// Whether the camera moves along with the whale, at the same distance and direction.
    pub moves_along: bool,
    /// Place of the whale that the camera belongs to, if it moves along [m].
    anchor: Option<DVec3>,
    /// Offsets of the user to the camera that follows the whale: azimuth [rad], elevation [rad], zoom [notches].
    offset: [f64; 3],
}

impl Default for Eye {
    fn default() -> Self {
        Self::at(View::default())
    }
}

impl Eye {
    /// An eye at a named view.
    pub fn at(view: View) -> Self {
        Self {
            camera: Camera::default(),
            follow: view.is_of_whale(),
            named: view,
            frame_again: true,
            moves_along: false,
            anchor: None,
            offset: [0.0; 3],
        }
    }

    /// Changes to a named view.
    pub fn set_view(&mut self, view: View) {
        *self =
            Self { camera: self.camera.clone(), moves_along: self.moves_along, ..Self::at(view) };
    }

    /// Frames everything, and stops following the whale.
    pub fn frame(&mut self) {
        (self.follow, self.frame_again) = (false, true);
    }

    /// Handles the mouse: drag orbits, right drag or Shift and drag pans, the wheel zooms.
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
            self.offset = [
                self.offset[0] - drag.x * 0.008,
                self.offset[1] + drag.y * 0.008,
                self.offset[2] + notches,
            ];
        } else if response.dragged() && pan {
            self.camera.pan(drag, f64::from(response.rect.height()));
        } else if response.dragged() {
            self.camera.orbit(drag);
        }
        if !self.follow && notches != 0.0 {
            let size = response.rect.size();
            let at = response.hover_pos().map_or(0.5 * size, |at| at - response.rect.min);
            let points = |vector: egui::Vec2| DVec2::new(f64::from(vector.x), f64::from(vector.y));
            self.camera.zoom_at(notches, points(at), points(size));
        }
    }

    /// Stores the camera of a frame, for the mouse and for the frames after it.
    pub fn keep(&mut self, camera: &Camera, frame: &Frame) {
        (self.camera, self.frame_again) = (camera.clone(), false);
        self.anchor = frame.whale.as_ref().filter(|_| self.moves_along).map(|whale| whale.position);
    }

    /// Camera for the moment of a view, drawn in a rectangle.
    pub fn placed(&self, view: &LiveView, rect: Rect) -> Camera {
        self.at_moment(&view.model, &view.frame, f64::from(rect.width() / rect.height().max(1.0)))
    }

    /// Camera for a frame; `aspect` is width over height of the picture.
    pub fn at_moment(&self, model: &Model, frame: &Frame, aspect: f64) -> Camera {
        let mut camera = self.camera.clone();
        let length_m = model.spec.whale.as_ref().map_or(10.0, |whale| whale.length_m);
        if let (true, Some(whale)) = (self.follow, &frame.whale) {
            camera.follow(self.named, whale, length_m, aspect);
            if !self.named.is_first_person() {
                camera.azimuth += self.offset[0];
                camera.elevation = (camera.elevation + self.offset[1]).clamp(-1.4, 1.4);
                camera.zoom(self.offset[2]);
            }
        } else if self.frame_again {
            let places = Scene::places_of(model, frame);
            camera = Camera::of_view(self.named, &places, None, length_m, aspect);
        } else if let (true, Some(whale), Some(anchor)) =
            (self.moves_along, &frame.whale, self.anchor)
        {
            camera.target += whale.position - anchor;
        }
        camera
    }
}

/// Keys closer in time than this are the same key [s].
const SAME_S: f64 = 0.02;

/// Keys of a camera path, in order of time.
#[derive(Clone, Debug)]
pub struct CameraPath<E> {
    keys: Vec<(f64, E)>,
}

impl<E> Default for CameraPath<E> {
    fn default() -> Self {
        Self { keys: Vec::new() }
    }
}

impl<E> CameraPath<E> {
    /// Sets a key at a time [s]; replaces a key at the same time.
    pub fn set(&mut self, time_s: f64, eye: E) {
        self.keys.retain(|(at_s, _)| (at_s - time_s).abs() > SAME_S);
        let place = self.keys.partition_point(|(at_s, _)| *at_s < time_s);
        self.keys.insert(place, (time_s, eye));
    }

    /// Removes all keys.
    pub fn clear(&mut self) {
        self.keys.clear();
    }

    /// Times of the keys [s], in order.
    pub fn times(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.keys.iter().map(|(time_s, _)| *time_s)
    }

    /// Camera at a time [s]; `place` returns the camera of a key at that moment. `None` without keys.
    pub fn camera(&self, time_s: f64, place: impl Fn(&E) -> Camera) -> Option<Camera> {
        let next = self.keys.partition_point(|(at_s, _)| *at_s <= time_s);
        let before = next.checked_sub(1).and_then(|before| self.keys.get(before));
        Some(match (before, self.keys.get(next)) {
            (Some((from_s, from)), Some((to_s, to))) => {
                let share = (time_s - from_s) / (to_s - from_s);
                place(from).towards(&place(to), share * share * (3.0 - 2.0 * share))
            }
            (Some((_, eye)), None) | (None, Some((_, eye))) => place(eye),
            (None, None) => return None,
        })
    }
}

impl CameraPath<View> {
    /// Parses a view, `side`, or views with times, `side@0s,whale@10s`.
    pub fn read(text: &str) -> Result<Self, String> {
        let mut path = Self::default();
        for key in text.split(',').map(str::trim) {
            let (name, time) = key.split_once('@').unwrap_or((key, "0 s"));
            let view = View::named(name).ok_or_else(|| {
                format!("there is no view `{name}`; expected one of {}", View::names())
            })?;
            let time_s = units::parse(time, Quantity::Time)
                .map_err(|error| format!("`{key}` has no time: {error}"))?;
            if time_s < 0.0 {
                return Err(format!("`{key}` lies before the run; expected such as {name}@10s"));
            }
            path.set(time_s, view);
        }
        Ok(path)
    }

    /// The view, if the path has only one key.
    pub fn single(&self) -> Option<View> {
        match self.keys.as_slice() {
            [(_, view)] => Some(*view),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {

    use super::*;

    #[test]
    fn a_camera_that_moves_along_keeps_the_whale_where_it_is_in_the_picture() {
        let model = crate::scene::sample::model();
        let mut frame = crate::scene::sample::frame(&model);
        let size = DVec2::new(800.0, 600.0);
        let seen = |eye: &Eye, frame: &Frame| {
            let camera = eye.at_moment(&model, frame, size.x / size.y);
            (camera.project(frame.whale.as_ref().unwrap().position, size).unwrap(), camera)
        };
        let mut eye = Eye { moves_along: true, ..Eye::at(View::Orbit) };
        let (before, camera) = seen(&eye, &frame);
        eye.keep(&camera, &frame);
        let still = Eye { moves_along: false, ..eye.clone() };
        frame.whale.as_mut().unwrap().position += DVec3::new(9.0, -4.0, 2.0);
        assert!(seen(&eye, &frame).0.distance(before) < 1e-6);
        assert!(seen(&still, &frame).0.distance(before) > 10.0);
    }

    fn far(distance_m: f64) -> Camera {
        Camera { distance_m, ..Camera::default() }
    }

    #[test]
    fn the_camera_is_at_rest_at_its_keys_and_moves_smoothly_between_them() {
        let mut path = CameraPath::default();
        for (time_s, distance_m) in [(10.0, 40.0), (2.0, 10.0), (10.01, 90.0)] {
            path.set(time_s, distance_m);
        }
        assert_eq!(path.times().collect::<Vec<_>>(), [2.0, 10.01]);
        let at = |time_s: f64| path.camera(time_s, |eye| far(*eye)).unwrap().distance_m;
        for (time_s, there_m) in [(0.0, 10.0), (2.0, 10.0), (10.01, 90.0), (99.0, 90.0)] {
            assert!((at(time_s) - there_m).abs() < 1e-9, "{time_s}: {}", at(time_s));
        }
        // Half way, the distance is the geometric mean.
        assert!((at(6.005) - 30.0).abs() < 1e-9, "{}", at(6.005));
        let speed = |time_s: f64| (at(time_s + 1e-4) - at(time_s - 1e-4)) / 2e-4;
        assert!(speed(2.001).abs() < 0.01 && speed(6.0) > 5.0, "{} {}", speed(2.001), speed(6.0));
        assert!(CameraPath::<f64>::default().camera(1.0, |eye| far(*eye)).is_none());
    }

    #[test]
    fn views_with_times_are_parsed_and_errors_name_the_problem() {
        let path = CameraPath::read("side, whale@10 s,first-person@12.5s").unwrap();
        assert_eq!(path.times().collect::<Vec<_>>(), [0.0, 10.0, 12.5]);
        assert_eq!(CameraPath::read("top").unwrap().single(), Some(View::Top));
        for (text, words) in [
            ("sid", "no view `sid`"),
            ("side@x", "has no number"),
            ("side@10", "has no unit"),
            ("side@-1s", "before the run"),
            ("", "no view"),
        ] {
            let error = CameraPath::read(text).unwrap_err();
            assert!(error.contains(words), "{text}: {error}");
        }
    }
}
