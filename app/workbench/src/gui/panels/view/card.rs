//! The cards of the 3-D view: what is read, and what the ruler measures.

use egui::{Button, Frame, Rect, RichText, Stroke, Ui, UiBuilder, pos2, vec2};
use endline_session::live::LiveView;
use endline_session::units::Units;

use super::picking::Picks;
use crate::gui::command::action::ViewAction;
use crate::gui::inspector::{Reading, measured, read};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;

/// Width of a card [points].
const WIDTH: f32 = 268.0;

/// The cards with what is read and measured, at the upper left; answers where they lie.
pub(super) fn show(
    ui: &mut Ui,
    picks: &Picks,
    shared: &mut Shared,
    view: &LiveView,
    rect: Rect,
) -> Vec<Rect> {
    let units = shared.workbench.preferences.units;
    let readings =
        [picks.read.and_then(|picked| read(view, picked, units)), ruler(picks, view, units)];
    let mut place = Rect::from_min_size(
        rect.min + vec2(12.0, 46.0),
        vec2(WIDTH.min(rect.width() - 24.0), rect.height() - 58.0),
    );
    let mut drawn = Vec::new();
    for reading in readings.into_iter().flatten() {
        let fill = Theme::palette_of(ui).panel.gamma_multiply(0.94);
        let line = Theme::palette_of(ui).line;
        let inner = ui.scope_builder(UiBuilder::new().max_rect(place), |ui| {
            ui.set_clip_rect(rect.intersect(ui.clip_rect()));
            let frame = Frame::new()
                .fill(fill)
                .stroke(Stroke::new(1.0, line))
                .corner_radius(6.0)
                .inner_margin(8.0);
            let card = frame.show(ui, |ui| told(ui, &reading)).response.rect;
            close(ui, shared, card);
            card
        });
        drawn.push(inner.inner);
        place = Rect::from_min_max(pos2(place.left(), inner.inner.bottom() + 6.0), place.max);
    }
    drawn
}

fn ruler(picks: &Picks, view: &LiveView, units: Units) -> Option<Reading> {
    let waiting =
        |text: &str| Reading { title: "Ruler".to_owned(), rows: vec![("Next", text.to_owned())] };
    match (picks.ruler, picks.ends.len()) {
        (false, _) => None,
        (true, 0) => Some(waiting("click where to measure from")),
        (true, 1) => Some(waiting("click where to measure to")),
        (true, _) => measured(view, &picks.ends, units),
    }
}

fn told(ui: &mut Ui, reading: &Reading) {
    ui.set_width(ui.available_width());
    ui.label(RichText::new(&reading.title).strong().color(Theme::palette_of(ui).accent));
    widgets::numbers(ui, &reading.title, &reading.rows);
}

/// The button that closes a card, in its corner.
fn close(ui: &mut Ui, shared: &mut Shared, card: Rect) {
    let corner = Rect::from_min_size(card.right_top() + vec2(-26.0, 4.0), vec2(22.0, 22.0));
    if ui.put(corner, Button::new("×").frame(false)).on_hover_text("Close").clicked() {
        shared.give(ViewAction::LetGo);
    }
}
