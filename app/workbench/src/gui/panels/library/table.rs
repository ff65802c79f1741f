//! The table: a row for each entry, a column for each field.

use egui::{Align, Button, Layout, RichText, Ui};
use egui_extras::{Column, TableBuilder, TableRow};
use endline_gear::{Field, Kind, units};
use endline_session::command::EditAction;
use endline_session::edit::library_table;

use super::rows::Row;
use super::{LibraryPanel, rows};
use crate::gui::fields;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words;

const NAME_WIDTH: f32 = 230.0;
const CELL_WIDTH: f32 = 112.0;
const ROW: f32 = 25.0;
const ROW_WITH_REASON: f32 = 41.0;

/// Edited cell: path of the file, key, new text.
type Edit = (String, &'static str, String);

/// Draws the table.
pub(super) fn show(ui: &mut Ui, panel: &mut LibraryPanel, shared: &mut Shared) {
    let kind = panel.kind;
    let (words, figures) = (kind.words(), kind.fields());
    let shown = panel.shown_rows(shared);
    let went = rows::asked(ui, kind, &shown);
    let mut builder = TableBuilder::new(ui)
        .id_salt(kind.folder())
        .striped(true)
        .resizable(true)
        .cell_layout(Layout::left_to_right(Align::Center));
    builder = builder.column(Column::initial(NAME_WIDTH).at_least(120.0).clip(true));
    builder = builder.columns(
        Column::initial(CELL_WIDTH).at_least(60.0).clip(true),
        words.len() + figures.len(),
    );
    if let Some(row) = panel.go_to.take() {
        builder = builder.scroll_to_row(row, None);
    }
    let mut edits = Vec::new();
    let table = builder.header(24.0, |mut row| header(&mut row, panel, kind));
    let heights = shown.iter().map(|row| if row.problem { ROW_WITH_REASON } else { ROW });
    table.body(|body| {
        body.heterogeneous_rows(heights, |mut row| {
            let shown = &shown[row.index()];
            row.set_selected(panel.chosen.as_ref() == Some(&shown.path));
            cells(&mut row, panel, shared, shown, &mut edits);
        });
    });
    for (path, field, value) in edits {
        shared.set(&path, field, &value);
    }
    if let Some((row, key)) = went {
        panel.go_to = Some(row);
        let documents = &shared.workbench.project().documents;
        fields::go_to(ui.ctx(), documents, &shown[row].path, key);
    }
}

fn header(row: &mut TableRow<'_, '_>, panel: &mut LibraryPanel, kind: Kind) {
    row.col(|ui| {
        if heading(
            ui,
            "Name",
            panel.sort.is_none().then_some(false),
            "name, and the file's id below",
        ) {
            panel.sort = None;
        }
    });
    for word in kind.words() {
        row.col(|ui| {
            heading(ui, &words::title(word.key), None, word.help);
        });
    }
    for field in kind.fields() {
        let sorted = panel.sort.filter(|(key, _)| *key == field.key).map(|(_, down)| down);
        row.col(|ui| {
            if heading(ui, &words::title(field.key), sorted, &field_help(field)) {
                panel.sort = Some((field.key, sorted == Some(false)));
            }
        });
    }
}

/// Draws the header of a column; returns whether it was clicked for sorting.
fn heading(ui: &mut Ui, text: &str, sorted: Option<bool>, help: &str) -> bool {
    let palette = Theme::palette_of(ui);
    let arrow = sorted.map_or("", |down| if down { " ⏷" } else { " ⏶" });
    let colour = if sorted.is_some() { palette.accent } else { palette.faint };
    let label = Button::new(RichText::new(format!("{text}{arrow}")).color(colour).size(12.0))
        .frame(false)
        .truncate();
    ui.add(label).on_hover_text(help).clicked()
}

fn field_help(field: &Field) -> String {
    let needed = if field.needed { "" } else { "\noptional" };
    format!(
        "{}\n{}, {}; such as {}{needed}",
        field.help,
        field.quantity.noun(),
        field.range.words(field.quantity),
        field.quantity.examples()
    )
}

fn cells(
    row: &mut TableRow<'_, '_>,
    panel: &mut LibraryPanel,
    shared: &mut Shared,
    shown: &Row,
    edits: &mut Vec<Edit>,
) {
    let (kind, path) = (panel.kind, shown.path.as_str());
    row.col(|ui| name_cell(ui, panel, shared, shown));
    for word in kind.words() {
        row.col(|ui| {
            if near(ui) {
                edits.extend(cell(ui, shared, path, word.key, word.help));
            }
        });
    }
    for field in kind.fields() {
        row.col(|ui| {
            if !near(ui) {
                return;
            }
            let pointed = ui.rect_contains_pointer(ui.max_rect());
            let help = if pointed {
                format!("{}{}", field_help(field), provenance(shared, kind, path, field))
            } else {
                String::new()
            };
            edits.extend(cell(ui, shared, path, field.key, &help));
            confidence(ui, shared, kind, path, field);
        });
    }
}

/// Whether a cell is visible, or next to a visible one so that Tab reaches it; other cells are not drawn.
fn near(ui: &Ui) -> bool {
    ui.clip_rect().expand2(egui::vec2(2.0 * CELL_WIDTH, 0.0)).intersects(ui.max_rect())
}

fn name_cell(ui: &mut Ui, panel: &mut LibraryPanel, shared: &mut Shared, row: &Row) {
    let (path, used) = (row.path.as_str(), row.used);
    let palette = Theme::palette_of(ui);
    let name =
        shared.workbench.project().documents.field(path, "name").unwrap_or_else(|| path.to_owned());
    let mark = if shared.workbench.project().documents.is_unsaved(path) { "• " } else { "" };
    let chosen = panel.chosen.as_deref() == Some(path);
    let colour = match (shared.workbench.project().documents.file_has_error(path), used && !chosen)
    {
        (true, _) => palette.error,
        (false, true) => palette.accent,
        (false, false) => palette.text,
    };
    let label =
        Button::selectable(chosen, RichText::new(format!("{mark}{name}")).color(colour)).truncate();
    let response = ui.add(label);
    if response.clicked() {
        panel.chosen = Some(path.to_owned());
    }
    response.context_menu(|ui| {
        for (text, action) in [
            ("Duplicate", EditAction::Duplicate(path.to_owned())),
            ("Delete", EditAction::Remove(path.to_owned())),
        ] {
            if ui.button(text).clicked() {
                shared.give(action);
                ui.close();
            }
        }
        if ui.button("Copy id").clicked() {
            ui.ctx().copy_text(library_table::id_of(path).to_owned());
            ui.close();
        }
    });
    if response.contains_pointer() {
        let notes = shared
            .workbench
            .project()
            .documents
            .field(path, "notes")
            .map_or(String::new(), |notes| format!("\n\n{notes}"));
        let unsaved = if mark.is_empty() { "" } else { "\nnot saved yet" };
        let used = if used { "\nin use by this scenario" } else { "" };
        response.on_hover_text(format!("{name}\n{path}{used}{unsaved}{notes}"));
    }
}

fn cell(ui: &mut Ui, shared: &Shared, path: &str, key: &'static str, help: &str) -> Option<Edit> {
    let width = ui.available_width() - 8.0;
    let committed = ui
        .vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            ui.add_space(1.0);
            let committed = fields::edit(
                ui,
                &shared.workbench.project().documents,
                path,
                key,
                width,
                fields::Said { hint: "", help },
            );
            if let Some(problem) = shared.workbench.project().documents.problem_at(path, key) {
                let error =
                    RichText::new(&problem.message).size(10.5).color(Theme::palette_of(ui).error);
                ui.add(egui::Label::new(error).truncate());
            }
            committed
        })
        .inner;
    committed.map(|value| (path.to_owned(), key, value))
}

/// Draws the confidence of a figure as a letter in the corner of its cell: m measured, c catalogue, d derived, e estimate, or a question
/// mark for a typed value without a source.
fn confidence(ui: &Ui, shared: &Shared, kind: Kind, path: &str, field: &Field) {
    let entry =
        shared.workbench.project().documents.library().entry(kind, library_table::id_of(path));
    let Some(figure) = entry.and_then(|entry| entry.figure(field.key)) else { return };
    let palette = Theme::palette_of(ui);
    let (letter, colour) = if figure.is_unsourced() {
        ("?", palette.warning)
    } else {
        let letter = figure.confidence.word().get(..1).unwrap_or_default();
        (letter, words::confidence_colour(figure.confidence, palette))
    };
    let corner = ui.max_rect().right_top() + egui::vec2(-13.0, 4.0);
    ui.painter().text(
        corner,
        egui::Align2::RIGHT_TOP,
        letter,
        egui::FontId::proportional(9.5),
        colour,
    );
}

/// Source and confidence of a figure, if its file is valid.
fn provenance(shared: &Shared, kind: Kind, path: &str, field: &Field) -> String {
    let figure = shared
        .workbench
        .project()
        .documents
        .library()
        .entry(kind, library_table::id_of(path))
        .and_then(|entry| entry.figure(field.key));
    figure.map_or_else(String::new, |figure| {
        let si = units::format_si(figure.value, field.quantity);
        let ask = if figure.is_unsourced() { "; select the entry and enter a source" } else { "" };
        format!("\n\n= {si}\n{}: {}{ask}", figure.confidence.word(), figure.source)
    })
}
