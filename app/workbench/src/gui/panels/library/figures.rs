//! Figures of the selected entry: SI value, confidence and source; the latter two can be edited.

use egui::{Grid, RichText, Ui};
use endline_gear::{Confidence, Entry, Field, Figure, Kind, units};
use endline_session::edit::library_table::id_of;

use crate::gui::fields;
use crate::gui::shared::Shared;
use crate::gui::theme::{Palette, Theme};
use crate::gui::widgets::{self, words};

/// Meaning of the levels of confidence.
const LEVELS: &str = "measured: a measurement, or published as one\ncatalogue: published by a maker, a dealer or a handbook\nderived: computed from measured figures\nestimate: from similar items";

/// Edited field and its new text.
type Edit = (String, String);

/// Draws the list.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, kind: Kind, path: &str) {
    let palette = Theme::palette_of(ui);
    widgets::caption(ui, "Figures, with confidence and source");
    let Some(entry) = shared.workbench.project().documents.library().entry(kind, id_of(path))
    else {
        ui.label(RichText::new("has errors: see the red fields").color(palette.faint));
        return;
    };
    unsourced(ui, entry, palette);
    let mut edits = Vec::new();
    Grid::new("figures").num_columns(3).striped(true).spacing([10.0, 2.0]).show(ui, |ui| {
        for (field, figure) in &entry.figures {
            ui.label(RichText::new(words::title(field.key)).color(palette.faint))
                .on_hover_text(field.help);
            ui.label(units::format_si(words::rounded(figure.value), field.quantity))
                .on_hover_text(&figure.text);
            ui.horizontal(|ui| {
                edits.extend(confidence(ui, field, figure, palette));
                edits.extend(source(ui, shared, path, field, figure));
            });
            ui.end_row();
        }
    });
    for (field, text) in edits {
        shared.set(path, &field, &text);
    }
}

/// Draws a request for missing sources.
fn unsourced(ui: &mut Ui, entry: &Entry, palette: Palette) {
    let names = entry.figures.iter().filter(|(_, figure)| figure.is_unsourced());
    let names: Vec<String> = names.map(|(field, _)| words::title(field.key)).collect();
    if !names.is_empty() {
        let ask = format!("{}: enter the source below.", names.join(", "));
        ui.label(RichText::new(ask).color(palette.warning));
    }
}

/// Draws the choice of the confidence of a figure.
fn confidence(ui: &mut Ui, field: &Field, figure: &Figure, palette: Palette) -> Option<Edit> {
    let word = |sure: Confidence| {
        RichText::new(sure.word()).small().color(words::confidence_colour(sure, palette))
    };
    let mut chosen = figure.confidence;
    let list = egui::ComboBox::from_id_salt(("confidence", field.key)).width(72.0);
    list.selected_text(word(chosen))
        .show_ui(ui, |ui| {
            for sure in Confidence::ALL.iter().copied().filter(|sure| *sure != Confidence::Assumed)
            {
                ui.selectable_value(&mut chosen, sure, word(sure));
            }
        })
        .response
        .on_hover_text(LEVELS);
    (chosen != figure.confidence)
        .then(|| (format!("{}.confidence", field.key), chosen.word().to_owned()))
}

/// Draws the source of a figure; the source of the entry is shown as a hint.
fn source(
    ui: &mut Ui,
    shared: &Shared,
    path: &str,
    field: &Field,
    figure: &Figure,
) -> Option<Edit> {
    let own = format!("{}.source", field.key);
    let documents = &shared.workbench.project().documents;
    let said = fields::Said { hint: &figure.source, help: &figure.source };
    let width = ui.available_width().max(80.0) - 8.0;
    fields::edit(ui, documents, path, &own, width, said).map(|typed| (own, typed))
}
