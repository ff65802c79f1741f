//! The bar at the foot of the window.

use crate::gui::command::action::{PanelAction, ViewAction};
use egui::{Align, Button, Layout, RichText, Sense, Ui, vec2};
use endline_session::live::Status;
use endline_session::workbench::{Notice, NoticeKind};

use super::panel_id::PanelId;
use super::shared::Shared;
use super::theme::Theme;
use super::widgets::words;

/// Draws the status bar.
pub fn show(ui: &mut Ui, shared: &mut Shared) {
    let palette = Theme::palette_of(ui);
    ui.horizontal(|ui| {
        let (text, colour) = match shared.workbench.status() {
            None if shared.workbench.making() => ("Making the model".to_owned(), palette.warning),
            None => ("No model".to_owned(), palette.error),
            Some(status) => {
                let colour = match status {
                    Status::Running => palette.good,
                    Status::Settling => palette.warning,
                    Status::Paused | Status::Finished => palette.faint,
                    Status::Stopped(_) | Status::Failed(_) => palette.error,
                };
                (words::status(status).0, colour)
            }
        };
        let (dot, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::hover());
        ui.painter().circle_filled(dot.center(), 4.0, colour);
        ui.label(text);
        if let Some(view) = shared.workbench.view() {
            let duration = view.model.spec.settings.duration_s;
            ui.label(
                RichText::new(format!("{:.2} / {duration:.0} s", view.frame.time_s))
                    .color(palette.faint),
            );
            if view.times_real_time > 0.0 {
                ui.label(
                    RichText::new(format!("solver {:.1}× real time", view.times_real_time))
                        .color(palette.faint),
                );
            }
            if view.piloted {
                ui.label(RichText::new("piloted").color(palette.accent));
            }
        }
        film(ui, shared);
        right(ui, shared);
    });
}

/// How far a film is, with a way to end it; nothing where none is made.
fn film(ui: &mut Ui, shared: &mut Shared) {
    let Some(job) = &shared.film else { return };
    let (drawn, of) = job.counted();
    let text = RichText::new(format!("film: {drawn} of {of} pictures"));
    ui.label(text.color(Theme::palette_of(ui).accent))
        .on_hover_text(job.out().display().to_string());
    if ui.small_button("Cancel").on_hover_text("Ends the film where it is").clicked() {
        shared.give(ViewAction::CancelFilm);
    }
}

fn right(ui: &mut Ui, shared: &mut Shared) {
    let palette = Theme::palette_of(ui);
    let problems =
        shared.workbench.project.problems().count() + shared.workbench.plugins.problems.len();
    let unsaved = shared.workbench.project.documents.unsaved().len();
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let (text, colour) = match problems {
            0 => ("no problems".to_owned(), palette.faint),
            1 => ("1 problem".to_owned(), palette.error),
            count => (format!("{count} problems"), palette.error),
        };
        if ui.add(Button::new(RichText::new(text).color(colour)).frame(false)).clicked() {
            shared.give(PanelAction::Show(PanelId::PROBLEMS));
        }
        if unsaved > 0 {
            ui.label(RichText::new(format!("{unsaved} unsaved")).color(palette.warning));
        }
        let message = shared.workbench.view().and_then(|view| view.message.clone());
        let notice = shared.workbench.notice.clone().or(message.map(Notice::done));
        if let Some(Notice { text: notice, kind }) = notice {
            let colour = match kind {
                NoticeKind::Done => palette.good,
                NoticeKind::Hint => palette.warning,
                NoticeKind::Fault => palette.error,
            };
            let first = notice.lines().next().unwrap_or_default();
            ui.add(egui::Label::new(RichText::new(first).color(colour)).truncate())
                .on_hover_text(&notice);
        }
    });
}
