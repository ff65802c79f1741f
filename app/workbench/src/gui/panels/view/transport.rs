//! The transport bar: a slider for the time of the run, with marks of events and camera keys.

use egui::{Button, Color32, Rect, RichText, Sense, Shape, Stroke, Ui, pos2, vec2};
use endline_session::command::{RunAction, TimeAction};
use endline_session::live::LiveView;
use endline_sim::metrics::EventKind;

use crate::gui::command::action::WindowCommand;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::{styled, words};
use crate::scene::{CameraPath, Eye};

/// Height of the bar with the space above it [points].
pub const HEIGHT: f32 = 34.0;
/// Distance of the pointer to the mark of an event at which its text is shown [points].
const NEAR: f32 = 5.0;

/// Draws the bar.
pub fn show(ui: &mut Ui, shared: &mut Shared, path: &CameraPath<Eye>) {
    let Some(view) = shared.workbench.view().cloned() else { return };
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        buttons(ui, shared);
        let text = format!("{:.2} s", view.frame.time_s);
        let width = (ui.available_width() - 70.0).max(40.0);
        let (rect, response) = ui.allocate_exact_size(vec2(width, 20.0), Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::slider(true, view.frame.time_s, "Time"));
        let end_s = view.model.spec.settings.duration_s.max(view.newest_s).max(1e-9);
        track(ui, rect, &view, end_s);
        keys(ui, rect, path, end_s);
        scrub(ui, shared, rect, &response, &view, end_s);
        ui.label(RichText::new(text).monospace());
    });
}

fn buttons(ui: &mut Ui, shared: &mut Shared) {
    let play = if shared.workbench.replaying() { "⏸ Stop" } else { "▶ Play" };
    let all: [(&str, WindowCommand); 6] = [
        ("⏮", TimeAction::First.into()),
        ("⏴", TimeAction::Back.into()),
        (play, TimeAction::Replay.into()),
        ("⏵", TimeAction::Forward.into()),
        ("⏭", TimeAction::Newest.into()),
        ("⤴", RunAction::Branch.into()),
    ];
    for (text, command) in all {
        styled(ui, shared, Button::new(text).min_size(vec2(26.0, 20.0)), command);
    }
}

/// Draws the bar: time computed, moment shown, events.
fn track(ui: &Ui, rect: Rect, view: &LiveView, end_s: f64) {
    let palette = Theme::palette_of(ui);
    let painter = ui.painter_at(rect);
    let x = |time_s: f64| rect.left() + (time_s / end_s) as f32 * rect.width();
    let middle = Rect::from_min_max(
        pos2(rect.left(), rect.center().y - 3.0),
        pos2(rect.right(), rect.center().y + 3.0),
    );
    painter.rect_filled(middle, 3.0, palette.field);
    painter.rect_stroke(middle, 3.0, Stroke::new(1.0, palette.line), egui::StrokeKind::Inside);
    painter.rect_filled(
        middle.with_max_x(x(view.newest_s)),
        3.0,
        palette.accent.gamma_multiply(0.45),
    );
    for event in view.events.iter() {
        let at = x(event.time_s);
        let tall = if matches!(event.kind, EventKind::LinkParted | EventKind::LineParted) {
            9.0
        } else {
            6.0
        };
        let mark = Stroke::new(1.5, words::event_colour(event.kind, palette));
        painter.line_segment(
            [pos2(at, rect.center().y - tall), pos2(at, rect.center().y + tall)],
            mark,
        );
    }
    let now =
        pos2(x(view.frame.time_s).clamp(rect.left() + 5.0, rect.right() - 5.0), rect.center().y);
    painter.circle_filled(now, 6.0, if view.sought { palette.warning } else { palette.accent });
    painter.circle_stroke(
        now,
        6.0,
        Stroke::new(1.5, if ui.visuals().dark_mode { Color32::BLACK } else { Color32::WHITE }),
    );
}

/// Draws camera keys as diamonds at the bottom of the bar.
fn keys(ui: &Ui, rect: Rect, path: &CameraPath<Eye>, end_s: f64) {
    let palette = Theme::palette_of(ui);
    for time_s in path.times() {
        let at = pos2(rect.left() + (time_s / end_s) as f32 * rect.width(), rect.bottom() - 4.0);
        let corners = [vec2(-4.0, 0.0), vec2(0.0, -4.0), vec2(4.0, 0.0), vec2(0.0, 4.0)];
        let corners = corners.map(|corner| at + corner).to_vec();
        ui.painter().add(Shape::convex_polygon(corners, palette.text, Stroke::NONE));
    }
}

/// A press or drag shows its moment; over a mark the text of the event is shown.
fn scrub(
    ui: &Ui,
    shared: &mut Shared,
    rect: Rect,
    response: &egui::Response,
    view: &LiveView,
    end_s: f64,
) {
    let Some(pointer) = response.interact_pointer_pos().or(response.hover_pos()) else { return };
    let time_s =
        (f64::from((pointer.x - rect.left()) / rect.width()) * end_s).clamp(0.0, view.newest_s);
    if (response.dragged() || response.clicked()) && view.newest_s > 0.0 {
        shared.give(TimeAction::Seek(time_s));
        return;
    }
    let near = f64::from(NEAR / rect.width()) * end_s;
    let texts: Vec<String> = view
        .events
        .iter()
        .filter(|event| (event.time_s - time_s).abs() <= near)
        .take(6)
        .map(|event| {
            format!(
                "{:.2} s  {}, {}",
                event.time_s,
                words::event(event.kind),
                event.subject.replace('_', " ")
            )
        })
        .collect();
    if !texts.is_empty() && !response.dragged() {
        response.clone().on_hover_text(texts.join("\n"));
    }
    // A press takes effect immediately, not at its release.
    if response.is_pointer_button_down_on()
        && view.newest_s > 0.0
        && ui.input(|input| input.pointer.primary_pressed())
    {
        shared.give(TimeAction::Seek(time_s));
    }
}
