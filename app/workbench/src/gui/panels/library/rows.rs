//! Rows of the table, filtered and sorted; movement between its cells by Enter, up and down, as in a spreadsheet (egui handles Tab).

use std::path::PathBuf;
use std::sync::Arc;

use egui::{Key, Modifiers, Ui};
use endline_gear::{Diagnostic, Field, Kind, units};

use super::LibraryPanel;
use crate::gui::fields::edit_id;
use crate::gui::shared::Shared;

/// Selection that the rows were made for.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wanted {
    version: u64,
    scenario: PathBuf,
    kind: Kind,
    search: String,
    sort: Option<(&'static str, bool)>,
}

/// A row of the table.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// Path of its file.
    pub(super) path: String,
    /// Whether one of its cells has a problem.
    pub(super) problem: bool,
    /// Whether the scenario uses it.
    pub(super) used: bool,
}

impl LibraryPanel {
    /// Files of the table that match the search, sorted.
    pub(super) fn rows(&self, shared: &Shared) -> Vec<String> {
        let words: Vec<String> =
            self.search.to_lowercase().split_whitespace().map(str::to_owned).collect();
        let name = |path: &str| {
            shared.workbench.project().documents.field(path, "name").unwrap_or_default()
        };
        let matches = |path: &&str| {
            let text = format!("{path} {}", name(path)).to_lowercase();
            words.iter().all(|word| text.contains(word))
        };
        let mut rows: Vec<String> = shared
            .workbench
            .project()
            .documents
            .files(self.kind.folder())
            .filter(matches)
            .map(str::to_owned)
            .collect();
        // Entries used by the scenario first.
        rows.sort_by_cached_key(|path| {
            (!shared.workbench.project().documents.in_use(path), name(path).to_lowercase())
        });
        if let Some((key, down)) = self.sort {
            let field = self.kind.fields().iter().find(|field| field.key == key);
            let value = |path: &String| {
                field.and_then(|field| si_value(shared, path, field)).unwrap_or(f64::INFINITY)
            };
            rows.sort_by(|a, b| value(a).total_cmp(&value(b)));
            if down {
                rows.reverse();
            }
        }
        rows
    }

    /// Rows, made again if files or the selection have changed.
    pub(super) fn shown_rows(&mut self, shared: &Shared) -> Arc<Vec<Row>> {
        let wanted = Wanted {
            version: shared.workbench.project().documents.version(),
            scenario: shared.workbench.project().documents.scenario_path().to_owned(),
            kind: self.kind,
            search: self.search.clone(),
            sort: self.sort,
        };
        if let Some((_, rows)) = self.found.as_ref().filter(|(found, _)| *found == wanted) {
            return Arc::clone(rows);
        }
        let row = |path: String| Row {
            problem: cell_problem(shared, self.kind, &path).is_some(),
            used: shared.workbench.project().documents.in_use(&path),
            path,
        };
        let rows: Arc<Vec<Row>> = Arc::new(self.rows(shared).into_iter().map(row).collect());
        self.found = Some((wanted, Arc::clone(&rows)));
        rows
    }
}

/// SI value of a cell, if valid.
fn si_value(shared: &Shared, path: &str, field: &Field) -> Option<f64> {
    units::parse(&shared.workbench.project().documents.field(path, field.key)?, field.quantity).ok()
}

/// First problem at a cell of a row.
fn cell_problem<'a>(shared: &'a Shared, kind: Kind, path: &str) -> Option<&'a Diagnostic> {
    let keys =
        kind.words().iter().map(|word| word.key).chain(kind.fields().iter().map(|field| field.key));
    keys.filter_map(|key| shared.workbench.project().documents.problem_at(path, key)).next()
}

/// Row and key of the cell that keys move to from the cell with the focus.
pub(super) fn asked(ui: &Ui, kind: Kind, rows: &[Row]) -> Option<(usize, &'static str)> {
    const STEPS: [(Modifiers, Key, isize); 4] = [
        (Modifiers::SHIFT, Key::Enter, -1),
        (Modifiers::NONE, Key::Enter, 1),
        (Modifiers::NONE, Key::ArrowDown, 1),
        (Modifiers::NONE, Key::ArrowUp, -1),
    ];
    let focused = ui.memory(|memory| memory.focused())?;
    // Enter is not consumed, because it commits the cell.
    let pressed = |(modifiers, key, _): &(Modifiers, Key, isize)| {
        ui.input(|input| input.key_pressed(*key) && input.modifiers == *modifiers)
    };
    let (.., step) = STEPS.into_iter().find(pressed)?;
    let keys = kind.words().iter().map(|word| word.key);
    let keys: Vec<_> = keys.chain(kind.fields().iter().map(|field| field.key)).collect();
    let cell = |row: &Row| keys.iter().find(|key| edit_id(&row.path, key) == focused).copied();
    let (row, key) = rows.iter().enumerate().find_map(|(at, row)| Some((at, cell(row)?)))?;
    let next = row.checked_add_signed(step).filter(|next| *next < rows.len())?;
    Some((next, key))
}
