//! The list of events; a click shows the moment of an event and the reading of its body.

use egui::{Align, Layout, RichText, ScrollArea, Sense, TextStyle, Ui};
use endline_session::command::TimeAction;
use endline_session::units::Units;
use endline_sim::Model;
use endline_sim::metrics::Event;

use crate::gui::command::action::{ViewAction, WindowCommand};
use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::{self, words};
use crate::scene::Picked;

/// The list of events.
#[derive(Debug, Default)]
pub struct EventsPanel;

impl Panel for EventsPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        show(ui, shared);
    }
}

/// Draws the list of events, the newest last.
fn show(ui: &mut Ui, shared: &mut Shared) {
    let Some(view) = shared.workbench.view().cloned() else {
        return widgets::nothing(ui, "No run yet.");
    };
    if view.events.is_empty() {
        return widgets::nothing(
            ui,
            "No events yet. Contacts, slips, wraps and parted lines will be listed here.",
        );
    }
    let units = shared.workbench.preferences().units;
    let mut wanted = None;
    ScrollArea::vertical().auto_shrink(false).stick_to_bottom(true).show(ui, |ui| {
        for event in view.events.iter() {
            let now = (event.time_s - view.frame.time_s).abs() < 0.05;
            if row(ui, event, units, now) {
                wanted = Some(event);
            }
        }
    });
    shared.commands.extend(wanted.into_iter().flat_map(|event| answers(event, &view.model)));
}

/// Commands of a click on an event: its moment, and the reading of its body, if it has one.
fn answers(event: &Event, model: &Model) -> impl Iterator<Item = WindowCommand> {
    let body = model.spec.bodies.iter().position(|body| body.id == event.subject);
    let inspect = body.map(|body| ViewAction::Inspect(Picked::Body(body)).into());
    [TimeAction::Seek(event.time_s).into()].into_iter().chain(inspect)
}

fn row(ui: &mut Ui, event: &Event, units: Units, now: bool) -> bool {
    let palette = Theme::palette_of(ui);
    let line = ui.horizontal_wrapped(|ui| {
        let time = RichText::new(format!("{:.2} s", event.time_s));
        ui.label(time.color(if now { palette.accent } else { palette.faint }));
        ui.label(
            RichText::new(words::event(event.kind)).color(words::event_colour(event.kind, palette)),
        );
        ui.label(event.subject.replace('_', " "));
        let text = value(event, units);
        let font = TextStyle::Body.resolve(ui.style());
        let breadth = ui.painter().layout_no_wrap(text.clone(), font, palette.text).size().x;
        // Wraps in a narrow panel.
        if breadth < ui.available_size_before_wrap().x {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(text));
        } else {
            ui.label(text);
        }
    });
    line.response.interact(Sense::click()).on_hover_text("Click to show this moment").clicked()
}

/// Value of an event with its meaning, in the selected units.
fn value(event: &Event, units: Units) -> String {
    let number = match event.kind.unit() {
        "N" => units.force().text(event.value),
        "m" => units.length(event.value),
        "m/s" => units.speed(event.value),
        other => format!("{:.2} {other}", event.value),
    };
    format!("{} {number}", words::event_number(event.kind))
}

#[cfg(test)]
mod tests {
    use endline_sim::metrics::EventKind;

    use super::*;
    use crate::scene::sample;

    #[test]
    fn an_event_of_a_body_shows_its_moment_and_reads_the_body() {
        let model = sample::model();
        let event = |kind: EventKind, subject: &str| Event {
            time_s: 4.5,
            kind,
            subject: subject.to_owned(),
            value: 90.0,
        };
        let moment: WindowCommand = TimeAction::Seek(4.5).into();
        let caught: Vec<_> = answers(&event(EventKind::CaughtBuoy, "buoy"), &model).collect();
        assert_eq!(caught, [moment.clone(), ViewAction::Inspect(Picked::Body(1)).into()]);
        let undone = event(EventKind::WrapUndone, "body");
        assert_eq!(value(&undone, Units::Si), "below 90.00 turns");
        let dragged = event(EventKind::Dragged, "trap");
        assert_eq!(value(&dragged, Units::Noaa), "moved 295 ft");
        let wrapped: Vec<_> = answers(&event(EventKind::Wrap, "left_flipper"), &model).collect();
        assert_eq!(wrapped, [moment]);
    }
}
