//! The 3-D view: up to four panes, what is shown, what is read, the pilot's head-up display.

mod eye;
mod pane;
mod state;

use std::sync::Arc;

use egui::{Rect, Ui, pos2};
use endline_session::live::LiveView;

pub use eye::Eye;
pub use state::{Drawn, MOST, ScaleTop, ViewState};

use super::super::desk::{Desk, Order};
use super::super::theme::Theme;
use super::super::transport;
use crate::scene::{Show, View};
use pane::Pane;

/// Between two panes [points].
const GAP: f32 = 3.0;

/// Draws the 3-D view.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    toolbar(ui, desk);
    let size = ui.available_size() - egui::vec2(0.0, transport::HEIGHT);
    let (rect, _) = ui.allocate_exact_size(size.max(egui::Vec2::ZERO), egui::Sense::hover());
    transport::show(ui, desk);
    let Some(view) = desk.view.clone() else { return waiting(ui, rect, desk) };
    let views = [Some(view), desk.other_view()];
    load(desk, &views);
    for (pane, place) in panes(desk, views[1].is_some(), rect) {
        if let Some(view) = &views[pane.run] {
            pane::show(ui, desk, view, pane, place);
        }
    }
    let halves = places(rect, if views[1].is_some() { 2 } else { 1 });
    for (view, half) in views.iter().flatten().zip(halves) {
        super::super::picking::card(ui, half, desk, view);
    }
}

/// Makes the scenes anew, both to one scale of tension.
fn load(desk: &mut Desk, views: &[Option<Arc<LiveView>>; 2]) {
    let state = &mut desk.view3d;
    state.scale_n =
        views.iter().flatten().map(|view| state::scale_top(view, state.scale)).fold(1.0, f64::max);
    let show = Show { scale_n: Some(state.scale_n), ..state.show };
    let there_is_a_card = state.drawn[0].canvas.is_some();
    for (drawn, view) in state.drawn.iter_mut().zip(views) {
        if let Some(view) = view {
            drawn.like(there_is_a_card);
            drawn.load(view, show);
        }
    }
}

/// Every pane and its place. Two runs stand beside one another, for at most two eyes.
fn panes(desk: &Desk, compared: bool, rect: Rect) -> Vec<(Pane, Rect)> {
    let (runs, most) = if compared { (2, 2) } else { (1, MOST) };
    let slots = desk.view3d.eyes.len().min(most);
    let panes: Vec<Pane> =
        (0..slots).flat_map(|slot| (0..runs).map(move |run| Pane { run, slot })).collect();
    let places = places(rect, panes.len());
    panes.into_iter().zip(places).collect()
}

/// Where panes lie: beside one another, and one above the other from three on.
fn places(rect: Rect, count: usize) -> Vec<Rect> {
    let middle = rect.center();
    let left = rect.with_max_x(middle.x - GAP / 2.0);
    let right = rect.with_min_x(middle.x + GAP / 2.0);
    let halves =
        |side: Rect| [side.with_max_y(middle.y - GAP / 2.0), side.with_min_y(middle.y + GAP / 2.0)];
    match count {
        0 | 1 => vec![rect],
        2 => vec![left, right],
        3 => std::iter::once(left).chain(halves(right)).collect(),
        _ => {
            let ([a, c], [b, d]) = (halves(left), halves(right));
            vec![a, b, c, d]
        }
    }
}

fn toolbar(ui: &mut Ui, desk: &mut Desk) {
    ui.horizontal_wrapped(|ui| {
        views(ui, desk);
        ui.separator();
        shown(ui, desk);
        ui.separator();
        let mut ruler = desk.view3d.picks.ruler;
        let help = "Click two places to measure between them, straight and along the rope (R).\nWithout it a click reads what is there.";
        if ui.toggle_value(&mut ruler, "Ruler").on_hover_text(help).clicked() {
            desk.orders.push(Order::Ruler);
        }
        let mut posing = desk.posing.on;
        let help = "Handles in the view: drag where the whale starts, how deep, and where it heads";
        if ui.toggle_value(&mut posing, "Start pose").on_hover_text(help).clicked() {
            desk.orders.push(Order::Pose);
        }
        let mut flying = desk.flying;
        if ui.toggle_value(&mut flying, "Fly").on_hover_text("Steer the whale (Ctrl+F); Esc lets go").clicked() {
            desk.orders.push(Order::Fly);
        }
    });
}

/// From where the chosen pane looks, and how many there are.
fn views(ui: &mut Ui, desk: &mut Desk) {
    let count = desk.view3d.eyes.len();
    let eye = desk.view3d.eye();
    let (follow, named) = (eye.follow, eye.named);
    for view in View::WHOLE {
        if ui.selectable_label(!follow && named == view, capital(view.name())).clicked() {
            desk.view3d.look(view);
        }
    }
    let of_whale = if follow { spoken(named) } else { "Whale".into() };
    ui.menu_button(format!("{of_whale} ⏷"), |ui| {
        for view in View::OF_WHALE {
            if ui.selectable_label(follow && named == view, spoken(view)).clicked() {
                desk.view3d.look(view);
                ui.close();
            }
        }
    });
    if ui.button("Frame").on_hover_text("See everything (F)").clicked() {
        desk.view3d.frame();
    }
    let several = if count == 1 { "1 view ⏷".to_owned() } else { format!("{count} views ⏷") };
    ui.menu_button(several, |ui| {
        for count in 1..=MOST {
            let text =
                if count == 1 { "One view".to_owned() } else { format!("{count} views at once") };
            if ui.button(text).clicked() {
                desk.orders.push(Order::Views(count));
                ui.close();
            }
        }
    });
}

fn shown(ui: &mut Ui, desk: &mut Desk) {
    let state = &mut desk.view3d;
    ui.menu_button("Show ⏷", |ui| {
        ui.checkbox(&mut state.show.surface, "Sea surface");
        ui.checkbox(&mut state.show.seabed, "Seabed");
        ui.checkbox(&mut state.show.current, "Current");
        ui.checkbox(&mut state.show.contacts, "Contact");
        ui.checkbox(&mut state.show.forces, "Force of rope on skin");
        ui.checkbox(&mut state.show.whale, "Whale");
        ui.separator();
        ui.label("Brightest rope at");
        ui.radio_value(&mut state.scale, ScaleTop::Peak, "the run's peak");
        ui.radio_value(&mut state.scale, ScaleTop::Strength, "breaking strength");
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
pub(super) fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn waiting(ui: &Ui, rect: Rect, desk: &Desk) {
    let palette = Theme::palette_of(ui);
    ui.painter().rect_filled(rect, 0.0, palette.ground);
    let text = if desk.making() { "Making the model …" } else { "No model yet; see Problems." };
    let place = pos2(rect.center().x, rect.center().y);
    ui.painter().text(
        place,
        egui::Align2::CENTER_CENTER,
        text,
        egui::FontId::proportional(15.0),
        palette.faint,
    );
}
