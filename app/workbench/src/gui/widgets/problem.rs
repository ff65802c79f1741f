//! A problem of a file as two lines on screen.

use egui::{Label, RichText, Sense, Ui};
use endline_gear::Diagnostic;
use endline_session::edit::problems::place;

use super::super::theme::Theme;

/// One problem in two lines; answers whether it was clicked.
pub fn entry(ui: &mut Ui, problem: &Diagnostic) -> bool {
    let palette = Theme::palette_of(ui);
    let (mark, colour) =
        if problem.is_error() { ("✖", palette.error) } else { ("⚠", palette.warning) };
    let row = ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        ui.horizontal(|ui| {
            ui.label(RichText::new(mark).color(colour));
            ui.label(RichText::new(place(problem)).monospace().size(12.0).color(palette.faint));
            if !problem.field.is_empty() {
                ui.label(
                    RichText::new(&problem.field).monospace().size(12.0).color(palette.accent),
                );
            }
            ui.add(Label::new(RichText::new(&problem.message).color(colour)).truncate());
        });
        if !problem.help.is_empty() {
            ui.horizontal(|ui| {
                ui.add_space(20.0);
                ui.add(Label::new(RichText::new(&problem.help).color(palette.faint)).truncate());
            });
        }
    });
    ui.add_space(4.0);
    row.response.interact(Sense::click()).on_hover_text(problem.to_string()).clicked()
}
