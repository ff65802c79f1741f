//! The 3-D view: camera, what is shown, the pilot's head-up display.

use std::sync::{Arc, Mutex, PoisonError};

use egui::{PointerButton, Rect, Sense, Ui};
use endline_session::live::LiveView;
use endline_sim::Frame;
use glam::DVec2;

use super::super::canvas::Canvas;
use super::super::desk::{Desk, Order};
use super::super::hud;
use super::super::theme::Theme;
use super::super::transport;
use crate::scene::{Camera, Overlay, Scene, Show, View, Water, overlay};

/// What the top of the tension scale is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ScaleTop {
    /// The run's peak so far.
    #[default]
    Peak,
    /// The least breaking strength of the ropes.
    Strength,
}

/// State of the 3-D view.
pub struct ViewState {
    /// The eye.
    pub camera: Camera,
    /// What is shown.
    pub show: Show,
    /// Top of the tension scale.
    pub scale: ScaleTop,
    /// Whether the eye goes with the whale.
    pub follow: bool,
    /// Whether to bring everything into sight with the next frame.
    pub frame_again: bool,
    /// The last named view.
    pub named: View,
    /// The drawing, where there is OpenGL.
    pub canvas: Option<Arc<Mutex<Canvas>>>,
    /// How far the user has turned from the following camera's own direction: azimuth, elevation, nearness.
    turned: [f64; 3],
    shown: Option<(Arc<Frame>, Show, bool)>,
    scene_scale_n: f64,
}

impl Default for ViewState {
    fn default() -> Self {
        Self {
            camera: Camera::default(),
            show: Show::default(),
            scale: ScaleTop::default(),
            follow: false,
            frame_again: true,
            named: View::default(),
            canvas: None,
            turned: [0.0; 3],
            shown: None,
            scene_scale_n: 1.0,
        }
    }
}

/// Draws the 3-D view.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    toolbar(ui, desk);
    let size = ui.available_size() - egui::vec2(0.0, transport::HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size.max(egui::Vec2::ZERO), Sense::click_and_drag());
    transport::show(ui, desk);
    let Some(view) = desk.view.clone() else { return waiting(ui, rect, desk) };
    if response.clicked() || response.dragged() {
        ui.memory_mut(|memory| memory.stop_text_input());
    }
    turn(ui, &response, desk, rect);
    place_eye(&view, desk, rect);
    load(&view, desk);
    paint(ui, rect, desk);
    write_over(ui, rect, &view, desk);
}

fn toolbar(ui: &mut Ui, desk: &mut Desk) {
    let state = &mut desk.view3d;
    ui.horizontal(|ui| {
        for view in View::WHOLE {
            if ui.selectable_label(!state.follow && state.named == view, capital(view.name())).clicked() {
                state.look(view);
            }
        }
        let of_whale = if state.follow { spoken(state.named) } else { "Whale".into() };
        ui.menu_button(format!("{of_whale} ⏷"), |ui| {
            for view in View::OF_WHALE {
                if ui.selectable_label(state.follow && state.named == view, spoken(view)).clicked() {
                    state.look(view);
                    ui.close();
                }
            }
        });
        if ui.button("Frame").on_hover_text("See everything (F)").clicked() {
            state.frame();
        }
        ui.separator();
        ui.menu_button("Show ⏷", |ui| {
            ui.checkbox(&mut state.show.surface, "Sea surface");
            ui.checkbox(&mut state.show.seabed, "Seabed");
            ui.checkbox(&mut state.show.current, "Current");
            ui.checkbox(&mut state.show.contacts, "Contact");
            ui.checkbox(&mut state.show.whale, "Whale");
        });
        ui.menu_button("Colour to ⏷", |ui| {
            ui.radio_value(&mut state.scale, ScaleTop::Peak, "the run's peak");
            ui.radio_value(&mut state.scale, ScaleTop::Strength, "breaking strength");
        });
        ui.separator();
        let mut flying = desk.flying;
        if ui.toggle_value(&mut flying, "Fly").on_hover_text("Steer the whale (Ctrl+F); Esc lets go").clicked() {
            desk.orders.push(Order::Fly);
        }
    });
}

/// A view of the whale as a menu says it.
fn spoken(view: View) -> String {
    match view {
        View::Whale => "Behind the whale".into(),
        View::FirstPerson => "First person".into(),
        _ => capital(&view.name().replace('-', ", ")),
    }
}

/// A word with a capital first letter.
fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

impl ViewState {
    /// Goes to a named view.
    pub fn look(&mut self, view: View) {
        self.follow = view.is_of_whale();
        self.turned = [0.0; 3];
        self.named = view;
        self.frame_again = true;
    }

    /// Brings everything into sight.
    pub fn frame(&mut self) {
        (self.follow, self.frame_again) = (false, true);
    }

    /// Goes with the whale: as it last did, or behind it.
    pub fn go_with_whale(&mut self) {
        self.look(if self.named.is_of_whale() { self.named } else { View::Whale });
    }

    /// From third person to first and back.
    pub fn change_person(&mut self) {
        self.look(if self.named == View::FirstPerson { View::Whale } else { View::FirstPerson });
    }
}

fn waiting(ui: &Ui, rect: Rect, desk: &Desk) {
    let palette = Theme::palette_of(ui);
    ui.painter().rect_filled(rect, 0.0, palette.ground);
    let text = if desk.making() { "Making the model …" } else { "No model yet; see Problems." };
    ui.painter().text(rect.center(), egui::Align2::CENTER_CENTER, text, egui::FontId::proportional(15.0), palette.faint);
}

/// Drag orbits, right drag or Shift and drag pans, the wheel comes nearer.
fn turn(ui: &Ui, response: &egui::Response, desk: &mut Desk, rect: Rect) {
    let state = &mut desk.view3d;
    let drag = DVec2::new(f64::from(response.drag_delta().x), f64::from(response.drag_delta().y));
    let shift = ui.input(|input| input.modifiers.shift) && !desk.flying;
    let pan = response.dragged_by(PointerButton::Secondary) || response.dragged_by(PointerButton::Middle) || shift;
    let notches = if response.hovered() { f64::from(ui.input(|input| input.smooth_scroll_delta().y)) / 50.0 } else { 0.0 };
    if state.follow {
        state.turned = [state.turned[0] - drag.x * 0.008, state.turned[1] + drag.y * 0.008, state.turned[2] + notches];
    } else if response.dragged() && pan {
        state.camera.pan(drag, f64::from(rect.height()));
    } else if response.dragged() {
        state.camera.orbit(drag);
    }
    if !state.follow {
        state.camera.zoom(notches);
    }
}

fn place_eye(view: &LiveView, desk: &mut Desk, rect: Rect) {
    let state = &mut desk.view3d;
    let length_m = view.model.spec.whale.as_ref().map_or(10.0, |whale| whale.length_m);
    if let (true, Some(whale)) = (state.follow, &view.frame.whale) {
        let aspect = f64::from(rect.width() / rect.height().max(1.0));
        state.camera.go_with(state.named, whale, length_m, aspect);
        if state.named != View::FirstPerson {
            state.camera.azimuth += state.turned[0];
            state.camera.elevation = (state.camera.elevation + state.turned[1]).clamp(-1.4, 1.4);
            state.camera.zoom(state.turned[2]);
        }
    } else if state.frame_again {
        let places = Scene::places_of(&view.model, &view.frame);
        let aspect = f64::from(rect.width() / rect.height().max(1.0));
        state.camera = Camera::of_view(state.named, &places, None, length_m, aspect);
    }
    state.frame_again = false;
}

/// Makes the scene anew where the moment or what is shown has changed.
fn load(view: &LiveView, desk: &mut Desk) {
    let state = &mut desk.view3d;
    let scale_n = scale_top(view, state.scale);
    let show = Show { scale_n: Some(scale_n), ..state.show };
    let dark = desk.preferences.theme == Theme::Dark;
    let same = state.shown.as_ref().is_some_and(|(frame, shown, _)| Arc::ptr_eq(frame, &view.frame) && *shown == show);
    if same {
        return;
    }
    state.scene_scale_n = scale_n;
    state.shown = Some((Arc::clone(&view.frame), show, dark));
    if let Some(canvas) = &state.canvas {
        let scene = Scene::of(&view.model, &view.frame, &show);
        canvas.lock().unwrap_or_else(PoisonError::into_inner).load(scene);
    }
}

/// Tension at the top of the colour scale [N].
fn scale_top(view: &LiveView, top: ScaleTop) -> f64 {
    let peak = || view.summary.iter().flat_map(|summary| &summary.lines).map(|line| line.peak_tension_n).fold(0.0, f64::max);
    let strength = || view.model.segment_strength_n.iter().copied().filter(|strength| strength.is_finite()).fold(f64::INFINITY, f64::min);
    let value = match top {
        ScaleTop::Peak => peak(),
        ScaleTop::Strength => strength(),
    };
    let now = view.frame.tension_n.iter().copied().fold(0.0, f64::max);
    if value.is_finite() && value > 0.0 { value } else { now }.max(1.0)
}

fn paint(ui: &Ui, rect: Rect, desk: &Desk) {
    let state = &desk.view3d;
    match &state.canvas {
        Some(canvas) => {
            let water = if desk.preferences.theme == Theme::Dark { Water::DARK } else { Water::LIGHT };
            ui.painter().add(Canvas::callback(canvas, rect, state.camera.clone(), water));
        }
        None => {
            ui.painter().rect_filled(rect, 0.0, Theme::palette_of(ui).ground);
        }
    }
}

fn write_over(ui: &Ui, rect: Rect, view: &LiveView, desk: &Desk) {
    let state = &desk.view3d;
    let caption = match (view.sought, desk.stale()) {
        (true, _) => "looking back",
        (false, true) => "before the last edits",
        (false, false) => "",
    };
    let painter = ui.painter().with_clip_rect(rect);
    let metres_a_point = state.camera.metres_a_point(f64::from(rect.height()));
    overlay::paint(&painter, rect, &Overlay { caption, time_s: view.frame.time_s, scale_n: state.scene_scale_n, metres_a_point });
    let felt = desk.rumble.strength(ui.input(|input| input.time));
    if felt > 0.0 {
        let warning = Theme::palette_of(ui).warning;
        painter.rect_stroke(
            rect,
            0.0,
            egui::Stroke::new(10.0 * felt as f32, warning.gamma_multiply(felt as f32)),
            egui::StrokeKind::Inside,
        );
        ui.ctx().request_repaint();
    }
    if desk.flying {
        let act = desk.pilot.chosen_act(desk.acts().len()).map(|act| desk.acts()[act].name.as_ref());
        hud::paint(&painter, rect, view, desk.preferences.units, &hud::told(&view.controls, act, desk.pilot.hands()));
    }
}
