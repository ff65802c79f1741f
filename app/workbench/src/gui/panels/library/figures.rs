//! Every figure of the chosen entry with its SI value, how sure it is, and where it comes from.

use egui::{Grid, RichText, Ui};
use endline_gear::{Kind, units};
use endline_session::edit::library_table::id_of;

use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::{self, words};

/// Draws the list.
pub(super) fn show(ui: &mut Ui, shared: &Shared, kind: Kind, path: &str) {
    let palette = Theme::palette_of(ui);
    widgets::caption(ui, "Figures, with confidence and source");
    let Some(entry) = shared.workbench.project.documents.library().entry(kind, id_of(path)) else {
        ui.label(RichText::new("not readable yet; see what is red").color(palette.faint));
        return;
    };
    Grid::new("figures").num_columns(3).striped(true).spacing([10.0, 2.0]).show(ui, |ui| {
        for (field, figure) in &entry.figures {
            ui.label(RichText::new(words::title(field.key)).color(palette.faint))
                .on_hover_text(field.help);
            ui.label(units::format_si(figure.value, field.quantity)).on_hover_text(&figure.text);
            ui.horizontal(|ui| {
                ui.label(
                    RichText::new(figure.confidence.word())
                        .small()
                        .color(words::confidence_colour(figure.confidence, palette)),
                );
                ui.add(egui::Label::new(RichText::new(&figure.source).small()).truncate())
                    .on_hover_text(&figure.source);
            });
            ui.end_row();
        }
    });
}
