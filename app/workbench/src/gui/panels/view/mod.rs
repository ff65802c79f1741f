//! The 3-D view: tool bar and up to four panes with readings, ruler and the pilot's head-up display; pictures, films, full screen.

pub mod hud;
mod pane;
pub mod picking;
pub mod pose;
mod state;
mod transport;

use crate::gui::command::action::{FlightAction, ViewAction, WindowAction};
use std::sync::Arc;

use egui::{Rect, Ui, pos2};
use endline_session::live::LiveView;
use endline_session::scene::Show;

pub use state::{Drawn, ScaleTop, ViewPanel};

use crate::gui::panel::Panel;
use crate::gui::pictures::FILM_SIZES;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::command;
use crate::gui::widgets::words::capital;
use crate::scene::View;
use crate::scene::draw::MOST_PANES;
use pane::{Pane, places};

impl Panel for ViewPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        self.follow(shared);
        if !shared.presents() {
            self.toolbar(ui, shared);
        }
        let size = ui.available_size() - egui::vec2(0.0, transport::HEIGHT);
        let (rect, _) = ui.allocate_exact_size(size.max(egui::Vec2::ZERO), egui::Sense::hover());
        transport::show(ui, shared, &self.path);
        let Some(view) = shared.workbench.view().cloned() else { return waiting(ui, rect, shared) };
        let views = [Some(view), shared.workbench.compared_view()];
        self.load(&views);
        let panes = self.panes(views[1].is_some(), rect).into_iter();
        let panes = panes.filter_map(|pane| Some((pane, views[pane.run].clone()?)));
        let panes: Vec<_> = panes.collect();
        // The thing under the pointer is marked in all panes.
        self.picks.hovered = None;
        let looks = panes.iter().map(|(pane, view)| pane::look(ui, self, shared, view, *pane));
        let looks: Vec<_> = looks.collect();
        for ((pane, view), look) in panes.iter().zip(&looks) {
            pane::show(ui, self, shared, view, *pane, look);
        }
        let halves = places(rect, if views[1].is_some() { 2 } else { 1 });
        let halves = views.iter().flatten().zip(halves);
        let cards = halves
            .flat_map(|(view, half)| picking::show_cards(ui, &self.picks, shared, view, half));
        self.picks.cards = cards.collect();
    }
}

impl ViewPanel {
    /// Updates the scenes of both runs, with a common tension scale.
    fn load(&mut self, views: &[Option<Arc<LiveView>>; 2]) {
        let tops = views.iter().flatten().map(|view| state::scale_top(view, self.scale));
        self.scale_n = tops.fold(1.0, f64::max);
        let show = Show { scale_n: Some(self.scale_n), ..self.show };
        let has_opengl = self.drawn[0].canvas.is_some();
        for (drawn, view) in self.drawn.iter_mut().zip(views) {
            if let Some(view) = view {
                drawn.like(has_opengl);
                drawn.load(view, show);
            }
        }
    }

    /// All panes. Two compared runs are side by side, for at most two eyes.
    fn panes(&self, compared: bool, rect: Rect) -> Vec<Pane> {
        let (runs, most) = if compared { (2, 2) } else { (1, MOST_PANES) };
        let slots = self.eyes.len().min(most);
        let all = (0..slots).flat_map(|slot| (0..runs).map(move |run| (run, slot)));
        let places = places(rect, runs * slots);
        all.zip(places).map(|((run, slot), rect)| Pane { run, slot, rect }).collect()
    }

    fn toolbar(&mut self, ui: &mut Ui, shared: &mut Shared) {
        ui.horizontal_wrapped(|ui| {
            self.views(ui, shared);
            ui.separator();
            self.shown(ui);
            ui.separator();
            let mut ruler = self.picks.ruler;
            let help = "Click two places to measure their distance, straight and along the rope (R).\nWithout the ruler a click shows the reading of a thing.";
            if ui.toggle_value(&mut ruler, "Ruler").on_hover_text(help).clicked() {
                shared.give(ViewAction::Ruler);
            }
            let mut posing = shared.posing;
            let help = "Shows handles to drag the start of the whale: place, depth and heading";
            if ui.toggle_value(&mut posing, "Start pose").on_hover_text(help).clicked() {
                shared.give(ViewAction::Pose);
            }
            let mut flying = shared.flying;
            if ui.toggle_value(&mut flying, "Fly").on_hover_text("Steer the whale (Ctrl+F); Esc stops steering").clicked() {
                shared.give(FlightAction::Toggle);
            }
        });
    }

    /// Draws the view of the active pane, pictures and films, and the number of panes.
    fn views(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let count = self.eyes.len();
        let eye = self.eye();
        let (follow, named) = (eye.follow, eye.named);
        for view in View::WHOLE {
            if ui.selectable_label(!follow && named == view, capital(view.name())).clicked() {
                self.look(view);
            }
        }
        // Titles of menus do not change, so that no button moves.
        let of_whale = ui.menu_button("Whale ⏷", |ui| {
            for view in View::OF_WHALE {
                if ui.selectable_label(follow && named == view, spoken(view)).clicked() {
                    self.look(view);
                    ui.close();
                }
            }
            ui.separator();
            ui.checkbox(&mut self.eye().moves_along, "Move along with it")
                .on_hover_text("Orbit, side, top and front keep the whale in sight");
        });
        let now = if follow { format!("{} now", spoken(named)) } else { String::new() };
        of_whale.response.on_hover_text(format!("Views that go with the whale\n{now}").trim_end());
        if ui.button("Frame").on_hover_text("Show everything (F)").clicked() {
            self.frame();
        }
        command(ui, shared, "Picture …", WindowAction::Ask("view.save-picture"));
        self.films(ui, shared);
        self.keys(ui, shared);
        ui.menu_button("Views ⏷", |ui| {
            for panes in 1..=MOST_PANES {
                let text = if panes == 1 {
                    "One view".to_owned()
                } else {
                    format!("{panes} views at once")
                };
                if ui.selectable_label(panes == count, text).clicked() {
                    shared.give(ViewAction::Split(panes));
                    ui.close();
                }
            }
        });
    }

    /// Draws the menu of a film: its size, the part of the run, and what that amounts to.
    fn films(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let end_s = shared.workbench.view().map_or(0.0, |view| view.newest_s);
        ui.menu_button("Film ⏷", |ui| {
            for size in FILM_SIZES {
                let text = format!("{} × {} pixels", size[0], size[1]);
                ui.radio_value(&mut self.film.size, size, text);
            }
            ui.separator();
            // The end of the whole run grows with the run; it is stored only where it is chosen.
            let [mut from_s, mut to_s] = self.film.span_s.map(|time_s| time_s.min(end_s));
            let [first, last] = [0.0..=to_s, from_s..=end_s];
            let time = |value, range| {
                egui::DragValue::new(value).suffix(" s").speed(0.1).max_decimals(2).range(range)
            };
            let changed = ui.horizontal(|ui| {
                ui.label("From");
                let first = ui.add(time(&mut from_s, first)).changed();
                ui.label("to");
                ui.add(time(&mut to_s, last)).changed() || first
            });
            if changed.inner {
                self.film.span_s = [from_s, to_s];
            }
            if ui.button("Whole run").clicked() {
                self.film.span_s = [0.0, f64::INFINITY];
            }
            let pictures = self.film.pictures(end_s);
            let [gif, mp4] = self.film.megabytes(pictures);
            let counted =
                if pictures == 1 { "1 picture".to_owned() } else { format!("{pictures} pictures") };
            ui.label(format!("{counted}: about {gif:.0} MB as GIF, {mp4:.1} MB as MP4"));
            ui.separator();
            command(ui, shared, "Save the film …", WindowAction::Ask("view.save-film"));
        });
    }

    /// Draws the menu of camera keys for a film.
    fn keys(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let count = self.path.times().len();
        let help = "The camera of a film moves from key to key: choose a view and a moment, set a key, then go to the next moment.";
        let menu = ui.menu_button("Camera ⏷", |ui| {
            ui.label(format!("Keys set: {count}"));
            command(ui, shared, "Set a camera key here", ViewAction::SetKey);
            command(ui, shared, "Clear the camera keys", ViewAction::ClearKeys);
            ui.add_enabled(count > 0, egui::Checkbox::new(&mut self.along, "Preview the film"))
                .on_hover_text("The active pane shows the camera of the film");
        });
        menu.response.on_hover_text(help);
    }

    fn shown(&mut self, ui: &mut Ui) {
        ui.menu_button("Show ⏷", |ui| {
            ui.checkbox(&mut self.show.film, "Film look").on_hover_text(
                "For films and print: no marks, scales or text, rope in its own colour, particles and shafts of light in the water",
            );
            ui.separator();
            ui.checkbox(&mut self.show.surface, "Sea surface");
            ui.checkbox(&mut self.show.seabed, "Seabed");
            ui.checkbox(&mut self.show.whale, "Whale");
            ui.add_enabled_ui(!self.show.film, |ui| {
                ui.checkbox(&mut self.show.current, "Current");
                ui.checkbox(&mut self.show.contacts, "Contact");
                ui.checkbox(&mut self.show.forces, "Force on skin");
                ui.checkbox(&mut self.show.names, "Names of small bodies");
            });
            ui.separator();
            ui.label("Top of the tension scale");
            ui.radio_value(&mut self.scale, ScaleTop::Peak, "peak of the run");
            ui.radio_value(&mut self.scale, ScaleTop::Strength, "least breaking strength");
        });
    }
}

/// Name of a view of the whale in menus.
fn spoken(view: View) -> String {
    match view {
        View::Whale => "Behind the whale".into(),
        View::FirstPerson => "First person, ahead".into(),
        View::LeftEye => "First person, left eye".into(),
        View::RightEye => "First person, right eye".into(),
        _ => capital(&view.name().replace('-', ", ")),
    }
}

fn waiting(ui: &Ui, rect: Rect, shared: &Shared) {
    let palette = Theme::palette_of(ui);
    ui.painter().rect_filled(rect, 0.0, palette.ground);
    let text = if shared.workbench.making() {
        "Assembling the model …"
    } else {
        "No model yet; see Problems."
    };
    let place = pos2(rect.center().x, rect.center().y);
    ui.painter().text(
        place,
        egui::Align2::CENTER_CENTER,
        text,
        egui::FontId::proportional(15.0),
        palette.faint,
    );
}
