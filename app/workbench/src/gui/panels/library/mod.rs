//! The gear library as tables that are edited in place.

mod detail;
mod figures;
mod paste;
mod picture;
mod rows;
mod table;

use crate::gui::command::action::{PanelAction, WindowAction};
use crate::gui::widgets::command;
use endline_session::command::{EditAction, ExportAction};
use std::path::PathBuf;
use std::sync::Arc;

use egui::{Align, Layout, RichText, ScrollArea, TextEdit, Ui};
use endline_gear::{Diagnostic, Kind};
use endline_session::edit::library_table;

pub use detail::{Against, Uses};

use crate::gui::files::KINDS;
use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::primary;
use crate::gui::widgets;
use rows::{Row, Wanted};

/// Tables of the gear library.
#[derive(Clone, Debug)]
pub struct LibraryPanel {
    /// Table shown.
    kind: Kind,
    /// Search words for id and name.
    pub search: String,
    /// Key of the sort column, and whether in descending order; `None` sorts by name.
    sort: Option<(&'static str, bool)>,
    /// Path of the selected entry.
    pub chosen: Option<String>,
    /// What the selected entry is compared with.
    against: Against,
    uses: Uses,
    compared: detail::Compared,
    found: Option<(Wanted, Arc<Vec<Row>>)>,
    /// Entry to scroll to.
    go_to: Option<usize>,
}

impl Default for LibraryPanel {
    fn default() -> Self {
        Self {
            kind: Kind::Rope,
            search: String::new(),
            sort: None,
            chosen: None,
            against: Against::Saved,
            uses: Uses::default(),
            compared: detail::Compared::default(),
            found: None,
            go_to: None,
        }
    }
}

/// Least width for tabs, search and buttons in one row [points].
const TOOLBAR: f32 = 1130.0;

impl Panel for LibraryPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        self.paste(ui, shared);
        self.toolbar(ui, shared);
        ui.add_space(2.0);
        let problems = self.problems(shared);
        let mut whole = ui.available_rect_before_wrap();
        let folder = self.kind.folder();
        let chosen = self.chosen.clone();
        let shown = |path: &String| {
            path.starts_with(folder) && shared.workbench.project().documents.text(path).is_some()
        };
        if let Some(path) = chosen.filter(shown) {
            let width = (whole.width() * 0.3).clamp(220.0, 380.0);
            let (table, entry) = whole.split_left_right_at_x(whole.right() - width);
            widgets::within(ui, entry.with_min_x(entry.left() + 10.0), |ui| {
                detail::show(ui, self, shared, &path)
            });
            whole = table;
        }
        let rows = problems.len().min(3) as f32;
        let strip = if problems.is_empty() { 0.0 } else { 12.0 + 44.0 * rows };
        let (above, below) = whole.split_top_bottom_at_y(whole.bottom() - strip);
        widgets::within(ui, above, |ui| {
            ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| table::show(ui, self, shared))
        });
        if !problems.is_empty() {
            widgets::within(ui, below, |ui| reasons(ui, &problems));
        }
    }
}

impl LibraryPanel {
    /// Kind of the table shown.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Changes the table; the search stays.
    pub fn turn_to(&mut self, kind: Kind) {
        *self = Self { kind, search: std::mem::take(&mut self.search), ..Self::default() };
    }

    /// Shows the table of an entry and selects it.
    pub fn choose(&mut self, path: String) {
        let folder = path.split_once('/').map_or("", |(folder, _)| folder);
        if let Some(kind) = Kind::in_folder(folder) {
            *self = Self { kind, chosen: Some(path), ..Self::default() };
        }
    }

    fn toolbar(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let is_broad = ui.available_width() > TOOLBAR;
        ui.horizontal_wrapped(|ui| {
            for (kind, title) in KINDS {
                if ui.selectable_label(self.kind == kind, title).clicked() {
                    self.turn_to(kind);
                }
            }
            ui.separator();
            ui.add(TextEdit::singleline(&mut self.search).hint_text("Search").desired_width(150.0));
            if is_broad {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| self.buttons(ui, shared));
            }
        });
        if !is_broad {
            ui.horizontal_wrapped(|ui| self.buttons(ui, shared));
        }
    }

    /// Draws the buttons for files, in this order for either direction of the layout.
    fn buttons(&self, ui: &mut Ui, shared: &mut Shared) {
        let mut buttons: [fn(&Self, &mut Ui, &mut Shared); 6] = [
            |_, ui, shared| drop(command(ui, shared, "Duplicate", PanelAction::Duplicate)),
            |_, ui, shared| drop(command(ui, shared, "Delete", PanelAction::Remove)),
            |library, ui, shared| {
                ui.menu_button("Table ⏷", |ui| library.table_menu(ui, shared));
            },
            |_, ui, shared| drop(command(ui, shared, "Undo", EditAction::Undo)),
            |_, ui, shared| drop(command(ui, shared, "Redo", EditAction::Redo)),
            |_, ui, shared| save(ui, shared),
        ];
        if ui.layout().prefer_right_to_left() {
            buttons.reverse();
        }
        buttons.iter().for_each(|button| button(self, ui, shared));
    }

    /// Selects the copy of an entry and compares both.
    pub fn compare(&mut self, entry: String, copy: String) {
        (self.against, self.chosen) = (Against::Entry(entry), Some(copy));
    }

    /// Draws the menu for export and import of the table.
    fn table_menu(&self, ui: &mut Ui, shared: &mut Shared) {
        for (text, id) in
            [("Save as CSV …", "panel.export-table"), ("Import CSV …", "panel.import-table")]
        {
            if command(ui, shared, text, WindowAction::Ask(id)).clicked() {
                ui.close();
            }
        }
        if ui.button("Copy for a spreadsheet").clicked() {
            let text = library_table::to_tabs(
                &shared.workbench.project().documents,
                self.kind,
                &self.rows(shared),
            );
            ui.ctx().copy_text(text);
            ui.close();
        }
        ui.label(RichText::new("Paste cells from a spreadsheet\nwith Ctrl+V in the first cell;\nwith a header row, anywhere here.").small());
    }

    /// Command that exports the table as shown.
    pub fn export(&self, shared: &Shared, file: PathBuf) -> ExportAction {
        ExportAction::Table { kind: self.kind, rows: Some(self.rows(shared).to_vec()), file }
    }

    /// Problems of the files of the table shown.
    fn problems(&self, shared: &Shared) -> Vec<Diagnostic> {
        let folder = format!("{}/", self.kind.folder());
        let own = |problem: &&Diagnostic| problem.file.starts_with(&folder);
        shared.workbench.project().documents.problems().iter().filter(own).cloned().collect()
    }
}

fn save(ui: &mut Ui, shared: &mut Shared) {
    let unsaved = shared.workbench.project().documents.unsaved().len();
    let help = "Saves all changed files (Ctrl+S); comments are kept";
    if primary(ui, unsaved > 0, "Save").on_hover_text(help).clicked() {
        shared.give(EditAction::Save);
    }
}

/// Draws the problems of the table: place, reason, help.
fn reasons(ui: &mut Ui, problems: &[Diagnostic]) {
    ui.separator();
    ScrollArea::vertical().id_salt("reasons").auto_shrink(false).show(ui, |ui| {
        for problem in problems {
            widgets::problem(ui, problem);
        }
    });
}
