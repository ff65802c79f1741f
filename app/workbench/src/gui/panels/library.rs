//! The gear library as tables: edit in place with units, located errors, save.

mod detail;
mod figures;
mod picture;

use std::sync::Arc;

use egui::{Align, Button, Layout, RichText, ScrollArea, TextEdit, Ui};
use egui_extras::{Column, TableBuilder, TableRow};
use endline_gear::Diagnostic;
use endline_gear::units;
use endline_gear::{Field, Kind};

pub use detail::{Against, Uses};

use super::super::desk::{Desk, Order};
use super::super::exchange::{self, Taken};
use super::super::fields;
use super::super::theme::{Theme, primary};

/// Kinds with a table, in the order of their tabs.
pub const KINDS: [(Kind, &str); 9] = [
    (Kind::Rope, "Ropes"),
    (Kind::Trap, "Traps"),
    (Kind::Buoy, "Buoys"),
    (Kind::WeakLink, "Weak links"),
    (Kind::Knot, "Knots"),
    (Kind::Anchor, "Anchors"),
    (Kind::Site, "Sites"),
    (Kind::Friction, "Friction"),
    (Kind::Whale, "Whales"),
];

const NAME_WIDTH: f32 = 230.0;
const CELL_WIDTH: f32 = 112.0;
const ROW: f32 = 25.0;
const ROW_WITH_REASON: f32 = 41.0;

/// What the library panel shows.
#[derive(Clone, Debug)]
pub struct LibraryState {
    /// Which table.
    pub kind: Kind,
    /// Words that a row's id or name must hold.
    pub search: String,
    /// Key of the column it is sorted by, and whether downwards; by name where `None`.
    pub sort: Option<(&'static str, bool)>,
    /// The row chosen, by its file's path.
    pub chosen: Option<String>,
    /// What the chosen row is compared with.
    pub against: Against,
    uses: Uses,
    compared: detail::Compared,
    found: Option<(Wanted, Arc<Vec<Row>>)>,
}

/// What the rows shown were found for.
#[derive(Clone, Debug, PartialEq)]
struct Wanted {
    version: u64,
    scenario: std::path::PathBuf,
    kind: Kind,
    search: String,
    sort: Option<(&'static str, bool)>,
}

/// A row of the table: its file, whether one of its cells has a problem, whether the scenario is made of it.
#[derive(Clone, Debug)]
struct Row {
    path: String,
    problem: bool,
    used: bool,
}

impl Default for LibraryState {
    fn default() -> Self {
        let (against, uses, compared) =
            (Against::Saved, Uses::default(), detail::Compared::default());
        Self {
            kind: Kind::Rope,
            search: String::new(),
            sort: None,
            chosen: None,
            against,
            uses,
            compared,
            found: None,
        }
    }
}

impl LibraryState {
    /// Another table; what is searched for stays.
    pub fn turn_to(&mut self, kind: Kind) {
        *self = Self { kind, search: std::mem::take(&mut self.search), ..Self::default() };
    }
}

/// Draws the library panel.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    paste(ui, desk);
    toolbar(ui, desk);
    ui.add_space(2.0);
    let problems = table_problems(desk);
    let mut whole = ui.available_rect_before_wrap();
    let folder = desk.library.kind.folder();
    let chosen = desk
        .library
        .chosen
        .clone()
        .filter(|path| path.starts_with(folder) && desk.documents.text(path).is_some());
    if let Some(path) = chosen {
        let (table, entry) =
            whole.split_left_right_at_x(whole.right() - (whole.width() * 0.3).clamp(220.0, 380.0));
        super::within(ui, entry.with_min_x(entry.left() + 10.0), |ui| {
            detail::show(ui, desk, &path)
        });
        whole = table;
    }
    let strip = if problems.is_empty() { 0.0 } else { 12.0 + 44.0 * problems.len().min(3) as f32 };
    let (above, below) = whole.split_top_bottom_at_y(whole.bottom() - strip);
    super::within(ui, above, |ui| {
        ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| table(ui, desk))
    });
    if !problems.is_empty() {
        super::within(ui, below, |ui| reasons(ui, &problems));
    }
}

fn toolbar(ui: &mut Ui, desk: &mut Desk) {
    ui.horizontal(|ui| {
        for (kind, title) in KINDS {
            if ui.selectable_label(desk.library.kind == kind, title).clicked() {
                desk.library.turn_to(kind);
            }
        }
        ui.separator();
        ui.add(
            TextEdit::singleline(&mut desk.library.search).hint_text("Search").desired_width(150.0),
        );
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let unsaved = desk.documents.unsaved().len();
            if primary(ui, unsaved > 0, "Save")
                .on_hover_text("Ctrl+S: write every changed file; comments stay")
                .clicked()
            {
                desk.orders.push(Order::Save);
            }
            let (undo, redo) = desk.documents.can_undo_redo();
            if ui.add_enabled(redo, Button::new("Redo")).on_hover_text("Ctrl+Shift+Z").clicked() {
                desk.orders.push(Order::Redo);
            }
            if ui.add_enabled(undo, Button::new("Undo")).on_hover_text("Ctrl+Z").clicked() {
                desk.orders.push(Order::Undo);
            }
            ui.menu_button("Table ⏷", |ui| table_menu(ui, desk));
            let chosen = desk.library.chosen.clone();
            let copy = Button::new("Duplicate");
            if ui
                .add_enabled(chosen.is_some(), copy)
                .on_hover_text("Copy the chosen row to a file of its own (Ctrl+D)")
                .clicked()
            {
                desk.orders.push(Order::Duplicate);
            }
        });
    });
}

/// Copies the chosen row to a file of its own and compares the two.
pub fn duplicate(desk: &mut Desk) {
    let Some(path) = desk.library.chosen.clone() else {
        desk.notice = Some(("choose a row of the library first".into(), true));
        return;
    };
    match desk.documents.duplicate(&path) {
        Ok(fresh) => {
            desk.library.against = Against::Entry(path);
            desk.library.chosen = Some(fresh);
        }
        Err(error) => desk.notice = Some((error, true)),
    }
}

/// The table as a whole, out and in.
fn table_menu(ui: &mut Ui, desk: &mut Desk) {
    if ui.button("Save as CSV …").clicked() {
        desk.orders.push(Order::AskExportTable);
        ui.close();
    }
    if ui
        .button("Take in CSV …")
        .on_hover_text(
            "Rows of a known id change that entry, others are added; one Undo takes all of it back",
        )
        .clicked()
    {
        desk.orders.push(Order::AskImportTable);
        ui.close();
    }
    if ui.button("Copy for a spreadsheet").clicked() {
        let text = exchange::to_tabs(&desk.documents, desk.library.kind, &rows(desk));
        ui.ctx().copy_text(text);
        ui.close();
    }
    ui.label(RichText::new("Paste cells from a spreadsheet\nwith Ctrl+V in the first cell;\nwith a head row, anywhere here.").small());
}

/// The CSV of the shown table.
#[must_use]
pub fn csv(desk: &Desk) -> String {
    exchange::to_csv(&desk.documents, desk.library.kind, &rows(desk))
}

/// Takes cells from the clipboard: from the cell being typed in on, or, with a head row, as entries.
fn paste(ui: &Ui, desk: &mut Desk) {
    let pasted = |event: &egui::Event| matches!(event, egui::Event::Paste(text) if text.trim_end().contains(['\t', '\n']));
    if !ui.input(|input| input.events.iter().any(pasted)) {
        return;
    }
    let (kind, paths) = (desk.library.kind, rows(desk));
    let keys: Vec<&'static str> = kind
        .words()
        .iter()
        .map(|word| word.key)
        .chain(kind.fields().iter().map(|field| field.key))
        .collect();
    let focus = ui.memory(|memory| memory.focused());
    let at = paths.iter().enumerate().find_map(|(row, path)| {
        let column = keys.iter().position(|key| focus == Some(fields::edit_id(path, key)))?;
        Some((row, column))
    });
    if at.is_none() && (focus.is_some() || !ui.rect_contains_pointer(ui.max_rect())) {
        return;
    }
    let mut text = String::new();
    ui.input_mut(|input| {
        input.events.retain(|event| match event {
            egui::Event::Paste(pasted) => {
                text.clone_from(pasted);
                false
            }
            _ => true,
        });
    });
    let head = exchange::cells(&text)
        .is_ok_and(|cells| cells.first().is_some_and(|row| exchange::is_head(kind, row)));
    let taken = match at {
        _ if head => exchange::import(&mut desk.documents, kind, &text),
        Some((row, column)) => {
            fields::forget(ui, &paths[row], keys[column]);
            exchange::cells(&text).and_then(|cells| {
                exchange::spread(&mut desk.documents, &paths[row..], &keys[column..], &cells)
            })
        }
        None => Err("click the cell the table begins in, or copy it with its head row".to_owned()),
    };
    desk.notice = Some(match taken {
        Ok(taken) => (taken.told(), !taken.left_out.is_empty()),
        Err(why) => (format!("not pasted: {why}"), true),
    });
}

/// Takes a CSV text into the shown table and says what came of it.
pub fn take_in(desk: &mut Desk, text: &str) {
    let taken: Result<Taken, String> =
        exchange::import(&mut desk.documents, desk.library.kind, text);
    desk.notice = Some(match taken {
        Ok(taken) => (taken.told(), !taken.left_out.is_empty()),
        Err(why) => (format!("not taken in: {why}"), true),
    });
}

/// Files of the shown table that the search lets through, in the order chosen.
fn rows(desk: &Desk) -> Vec<String> {
    let state = &desk.library;
    let words: Vec<String> =
        state.search.to_lowercase().split_whitespace().map(str::to_owned).collect();
    let name = |path: &str| desk.documents.field(path, "name").unwrap_or_default();
    let matches = |path: &&str| {
        let text = format!("{path} {}", name(path)).to_lowercase();
        words.iter().all(|word| text.contains(word))
    };
    let mut rows: Vec<String> =
        desk.documents.files(state.kind.folder()).filter(matches).map(str::to_owned).collect();
    // What this scenario is made of comes first.
    rows.sort_by_cached_key(|path| (!desk.documents.in_use(path), name(path).to_lowercase()));
    if let Some((key, down)) = state.sort {
        let field = state.kind.fields().iter().find(|field| field.key == key);
        let value = |path: &String| {
            field.and_then(|field| si_value(desk, path, field)).unwrap_or(f64::INFINITY)
        };
        rows.sort_by(|a, b| value(a).total_cmp(&value(b)));
        if down {
            rows.reverse();
        }
    }
    rows
}

/// The same as the table shows them, found anew where texts or choices have changed.
fn shown_rows(desk: &mut Desk) -> Arc<Vec<Row>> {
    let (state, version) = (&desk.library, desk.documents.version());
    let scenario = desk.documents.scenario_path().to_owned();
    let wanted = Wanted {
        version,
        scenario,
        kind: state.kind,
        search: state.search.clone(),
        sort: state.sort,
    };
    if let Some((_, rows)) = desk.library.found.as_ref().filter(|(found, _)| *found == wanted) {
        return Arc::clone(rows);
    }
    let row = |path: String| Row {
        problem: cell_problem(desk, &path).is_some(),
        used: desk.documents.in_use(&path),
        path,
    };
    let rows: Arc<Vec<Row>> = Arc::new(rows(desk).into_iter().map(row).collect());
    desk.library.found = Some((wanted, Arc::clone(&rows)));
    rows
}

/// The SI value of a cell, where it can be read.
fn si_value(desk: &Desk, path: &str, field: &Field) -> Option<f64> {
    units::parse(&desk.documents.field(path, field.key)?, field.quantity).ok()
}

fn table(ui: &mut Ui, desk: &mut Desk) {
    let kind = desk.library.kind;
    let (words, figures) = (kind.words(), kind.fields());
    let shown = shown_rows(desk);
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
    let mut edits = Vec::new();
    let table = builder.header(24.0, |mut row| header(&mut row, desk, kind));
    let heights = shown.iter().map(|row| if row.problem { ROW_WITH_REASON } else { ROW });
    table.body(|body| {
        body.heterogeneous_rows(heights, |mut row| {
            let shown = &shown[row.index()];
            row.set_selected(desk.library.chosen.as_ref() == Some(&shown.path));
            cells(&mut row, desk, shown, &mut edits);
        });
    });
    for (path, field, value) in edits {
        desk.set(&path, field, &value);
    }
}

fn header(row: &mut TableRow<'_, '_>, desk: &mut Desk, kind: Kind) {
    row.col(|ui| {
        if heading(
            ui,
            "Name",
            desk.library.sort.is_none().then_some(false),
            "name, and the file's id below",
        ) {
            desk.library.sort = None;
        }
    });
    for word in kind.words() {
        row.col(|ui| {
            heading(ui, &title(word.key), None, word.help);
        });
    }
    for field in kind.fields() {
        let sorted = desk.library.sort.filter(|(key, _)| *key == field.key).map(|(_, down)| down);
        row.col(|ui| {
            if heading(ui, &title(field.key), sorted, &field_help(field)) {
                desk.library.sort = Some((field.key, sorted == Some(false)));
            }
        });
    }
}

/// A column's head; answers whether it was clicked to sort by.
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
    let needed = if field.needed { "" } else { "\nmay be left out" };
    format!(
        "{}\n{}, {}; such as {}{needed}",
        field.help,
        field.quantity.noun(),
        field.range.words(field.quantity),
        field.quantity.examples()
    )
}

/// A number of a plugin as it is told: six digits of it.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Keys that say too little without their table.
const TITLES: [(&str, &str); 6] = [
    ("mass.length", "Mass, of length"),
    ("mass.mass", "Mass"),
    ("mass.exponent", "Mass, exponent"),
    ("age.birth", "Length at birth"),
    ("age.one_year", "Length at 1 year"),
    ("age.tenfold", "Growth, tenfold age"),
];

/// A key as a title: `stretch_at_break` is `Stretch at break`.
pub(super) fn title(key: &str) -> String {
    if let Some((_, title)) = TITLES.iter().find(|(known, _)| *known == key) {
        return (*title).to_owned();
    }
    let words = key.replace(['_', '.'], " ");
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn cells(
    row: &mut TableRow<'_, '_>,
    desk: &mut Desk,
    shown: &Row,
    edits: &mut Vec<(String, &'static str, String)>,
) {
    let (kind, path) = (desk.library.kind, shown.path.as_str());
    row.col(|ui| name_cell(ui, desk, shown));
    for word in kind.words() {
        row.col(|ui| {
            if near(ui) {
                edits.extend(cell(ui, desk, path, word.key, word.help));
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
                format!("{}{}", field_help(field), provenance(desk, path, field))
            } else {
                String::new()
            };
            edits.extend(cell(ui, desk, path, field.key, &help));
            sureness(ui, desk, path, field);
        });
    }
}

/// Whether a cell is in sight, or next to what is, so that Tab still reaches it; the others are left empty.
fn near(ui: &Ui) -> bool {
    ui.clip_rect().expand2(egui::vec2(2.0 * CELL_WIDTH, 0.0)).intersects(ui.max_rect())
}

fn name_cell(ui: &mut Ui, desk: &mut Desk, row: &Row) {
    let (path, used) = (row.path.as_str(), row.used);
    let palette = Theme::palette_of(ui);
    let name = desk.documents.field(path, "name").unwrap_or_else(|| path.to_owned());
    let mark = if desk.documents.is_unsaved(path) { "• " } else { "" };
    let chosen = desk.library.chosen.as_deref() == Some(path);
    let colour = match (desk.documents.file_has_error(path), used && !chosen) {
        (true, _) => palette.error,
        (false, true) => palette.accent,
        (false, false) => palette.text,
    };
    let label =
        Button::selectable(chosen, RichText::new(format!("{mark}{name}")).color(colour)).truncate();
    let response = ui.add(label);
    if response.clicked() {
        desk.library.chosen = Some(path.to_owned());
    }
    if response.contains_pointer() {
        let notes = desk
            .documents
            .field(path, "notes")
            .map_or(String::new(), |notes| format!("\n\n{notes}"));
        let unsaved = if mark.is_empty() { "" } else { "\nnot saved yet" };
        let used = if used { "\nin use by this scenario" } else { "" };
        response.on_hover_text(format!("{name}\n{path}{used}{unsaved}{notes}"));
    }
}

fn cell(
    ui: &mut Ui,
    desk: &Desk,
    path: &str,
    key: &'static str,
    help: &str,
) -> Option<(String, &'static str, String)> {
    let width = ui.available_width() - 8.0;
    let committed = ui
        .vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            ui.add_space(1.0);
            let committed = fields::edit(
                ui,
                &desk.documents,
                path,
                key,
                width,
                fields::Said { hint: "", help },
            );
            if let Some(problem) = desk.documents.problem_at(path, key) {
                let error =
                    RichText::new(&problem.message).size(10.5).color(Theme::palette_of(ui).error);
                ui.add(egui::Label::new(error).truncate());
            }
            committed
        })
        .inner;
    committed.map(|value| (path.to_owned(), key, value))
}

/// A letter in the cell's corner for how sure its figure is: m measured, d derived, e estimate.
fn sureness(ui: &Ui, desk: &Desk, path: &str, field: &Field) {
    let entry = desk.documents.library().entry(desk.library.kind, exchange::id_of(path));
    let Some(figure) = entry.and_then(|entry| entry.figure(field.key)) else { return };
    let letter = figure.sureness.word().get(..1).unwrap_or_default();
    let colour = figures::colour(figure.sureness, Theme::palette_of(ui));
    let corner = ui.max_rect().right_top() + egui::vec2(-13.0, 4.0);
    ui.painter().text(
        corner,
        egui::Align2::RIGHT_TOP,
        letter,
        egui::FontId::proportional(9.5),
        colour,
    );
}

/// Source and sureness of a figure, where its file can be read.
fn provenance(desk: &Desk, path: &str, field: &Field) -> String {
    let kind = desk.library.kind;
    let id = path.rsplit('/').next().unwrap_or(path).trim_end_matches(".toml");
    let figure = desk.documents.library().entry(kind, id).and_then(|entry| entry.figure(field.key));
    figure.map_or_else(String::new, |figure| {
        let si = units::format_si(figure.value, field.quantity);
        format!("\n\n= {si}\n{}: {}", figure.sureness.word(), figure.source)
    })
}

/// Any problem at a cell of a row.
fn cell_problem<'a>(desk: &'a Desk, path: &str) -> Option<&'a Diagnostic> {
    let kind = desk.library.kind;
    let keys =
        kind.words().iter().map(|word| word.key).chain(kind.fields().iter().map(|field| field.key));
    keys.filter_map(|key| desk.documents.problem_at(path, key)).next()
}

/// Problems of the files of the shown table.
fn table_problems(desk: &Desk) -> Vec<Diagnostic> {
    let folder = format!("{}/", desk.library.kind.folder());
    desk.documents
        .problems()
        .iter()
        .filter(|problem| problem.file.starts_with(&folder))
        .cloned()
        .collect()
}

/// What is wrong in the table, below it: place, reason, how to mend it.
fn reasons(ui: &mut Ui, problems: &[Diagnostic]) {
    ui.separator();
    ScrollArea::vertical().id_salt("reasons").auto_shrink(false).show(ui, |ui| {
        for problem in problems {
            super::problems::entry(ui, problem);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_readable() {
        assert_eq!(title("stretch_at_break"), "Stretch at break");
        assert_eq!(title("head.mouth"), "Head mouth");
    }
}
