//! What happened when; a click shows that moment.

use egui::{Align, Layout, RichText, ScrollArea, Sense, Ui};
use endline_session::units::ForceUnit;
use endline_sim::metrics::{Event, EventKind};

use super::super::desk::{Desk, Order};
use super::super::theme::{Palette, Theme};

/// Draws the list of events, the newest last.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    let Some(view) = desk.view.clone() else { return super::nothing(ui, "No run yet.") };
    if view.events.is_empty() {
        return super::nothing(
            ui,
            "Nothing has happened yet. Contact, slip, wraps and parted lines will be listed here.",
        );
    }
    let unit = desk.preferences.units.force();
    let mut wanted = None;
    ScrollArea::vertical().auto_shrink(false).stick_to_bottom(true).show(ui, |ui| {
        for event in view.events.iter() {
            let now = (event.time_s - view.frame.time_s).abs() < 0.05;
            if row(ui, event, unit, now) {
                wanted = Some(event.time_s);
            }
        }
    });
    desk.orders.extend(wanted.map(Order::Seek));
}

fn row(ui: &mut Ui, event: &Event, unit: ForceUnit, now: bool) -> bool {
    let palette = Theme::palette_of(ui);
    let line = ui.horizontal(|ui| {
        let time = RichText::new(format!("{:.2} s", event.time_s));
        ui.label(time.color(if now { palette.accent } else { palette.faint }));
        ui.label(RichText::new(what(event.kind)).color(colour(event.kind, palette)));
        ui.label(event.subject.replace('_', " "));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(value(event, unit)));
    });
    line.response.interact(Sense::click()).on_hover_text("Click to see this moment").clicked()
}

/// A kind of event in a few words.
#[must_use]
pub fn what(kind: EventKind) -> String {
    let words = kind.name().replace('_', " ");
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// The colour of a kind of event.
pub(in super::super) fn colour(kind: EventKind, palette: Palette) -> egui::Color32 {
    match kind {
        EventKind::LinkParted | EventKind::LineParted => palette.error,
        EventKind::Wrap | EventKind::Dragged | EventKind::PulledUnder => palette.warning,
        _ => palette.text,
    }
}

/// An event's number with its unit; forces in the unit chosen.
fn value(event: &Event, unit: ForceUnit) -> String {
    match event.kind.unit() {
        "N" => unit.text(event.value),
        other => format!("{:.2} {other}", event.value),
    }
}
