//! Weak inserts, sleeves and weak places along lines: added at intervals, moved, removed.

use egui::{Grid, RichText, Ui};
use endline_gear::Kind;
use endline_session::command::EditAction;
use endline_session::edit::{Documents, assembly};
use endline_session::statics::TrialGear;

use super::{AssemblyPanel, WhenEmpty, item};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::{fields, widgets};

/// Tables of a line with weak inserts or weak places.
const KEYS: [&str; 2] = ["inserts", "weak_places"];

/// Draws inserts and weak places of lines that a gear type builds. They are stored in the scenario if it places the gear, unless the assembly has its
/// own.
pub(super) fn of_built(
    ui: &mut Ui,
    panel: &AssemblyPanel,
    shared: &mut Shared,
    (gear, is_placed): (&TrialGear, bool),
) {
    let file = &super::path(gear);
    whole(ui, shared, gear);
    for (line, length_m) in built_lines(panel) {
        let (own, placed) = (format!("lines.{line}"), format!("gear.0.lines.{line}"));
        let documents = &shared.workbench.project().documents;
        let has = |file: &str, field: &str| {
            KEYS.iter().any(|key| documents.has(file, &format!("{field}.{key}")))
        };
        let has_own = has(file, &own) && !has(Documents::SCENARIO, &placed);
        if is_placed && !has_own {
            one(ui, shared, (Documents::SCENARIO, &placed), &line, length_m);
        } else {
            one(ui, shared, (file, &own), &line, length_m);
        }
    }
}

/// Draws the heading, and the button for inserts of whole endlines.
pub(super) fn whole(ui: &mut Ui, shared: &mut Shared, gear: &TrialGear) {
    widgets::caption(ui, "Weak inserts and places");
    ui.horizontal(|ui| {
        ui.label("whole endline");
        let button = ui.small_button("Put in every 60 ft");
        let help = "Adds 3 ft of weak rope every 60 ft in the top three quarters, from the buoy through all lines of each endline";
        if button.on_hover_text(help).clicked() {
            shared.perform(EditAction::AddInserts(gear.clone()));
        }
    });
}

/// Lines of the gear shown with their lengths [m], with the pieces of a line as one.
fn built_lines(panel: &AssemblyPanel) -> Vec<(String, f64)> {
    let rest = panel.drawn().a[0].rest;
    let mut lines: Vec<(String, f64)> = Vec::new();
    for line in rest.iter().flat_map(|rest| &rest.shape.lines) {
        let id = line.id.split(['.', '/']).next().unwrap_or_default();
        if id.is_empty() || id.starts_with("gangion") || id.starts_with("groundline") {
            continue;
        }
        match lines.last_mut().filter(|(last, _)| last == id) {
            Some((_, length_m)) => *length_m += line.length_m,
            None => lines.push((id.to_owned(), line.length_m)),
        }
    }
    lines.truncate(12);
    lines
}

/// Draws the inserts or weak places of a line of this length [m], at a field of a file, such as `line.1`.
pub(super) fn one(
    ui: &mut Ui,
    shared: &mut Shared,
    (file, field): (&str, &str),
    name: &str,
    length_m: f64,
) {
    let [inserts, places] = KEYS.map(|key| format!("{field}.{key}"));
    let document = shared.workbench.project().documents.document(file);
    let has = |key: &str| document.as_ref().is_ok_and(|document| document.has(key));
    let (has_inserts, has_places) = (has(&inserts), has(&places));
    let is_listed = has(&format!("{places}.at"));
    ui.horizontal(|ui| {
        ui.label(name);
        for (there, table, what) in
            [(has_inserts, &inserts, "inserts"), (has_places, &places, "weak places")]
        {
            let button = there.then(|| {
                let help = format!("Removes the {what} of this line");
                ui.small_button("Take out").on_hover_text(help)
            });
            if button.is_some_and(|button| button.clicked()) {
                alter(shared, file, |document| {
                    document.remove(table).map_err(|error| error.to_string())
                });
            }
        }
        if has_places {
            arrangement(ui, shared, (file, field), is_listed, length_m);
        }
        if !has_inserts && !has_places {
            add(ui, shared, file, field);
        }
    });
    if has_inserts {
        editor(ui, shared, file, &inserts);
    }
    if has_places {
        let rows: &[Row] = if is_listed { &[STRENGTH, AT] } else { &[STRENGTH, EVERY, FIRST] };
        ui.indent(&places, |ui| {
            Grid::new(("weak places", &places)).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
                rows.iter().for_each(|row| figure(ui, shared, file, &places, *row));
            });
        });
    }
}

/// A figure of weak places: name, key and help.
type Row = (&'static str, &'static str, &'static str);

const STRENGTH: Row = (
    "Strength",
    "strength",
    "Mean strength that the line delivers at each place, such as 1,700 lbf",
);
const EVERY: Row = ("Repeat every", "every", "Distance between places, such as 60 ft");
const FIRST: Row =
    ("First at", "first", "Distance from the line's lower end to the first place, such as 30 ft");
const AT: Row =
    ("Places", "at", "Distances from the line's lower end, such as [\"10 m\", \"25 m\"]");

/// Draws the buttons that put inserts or weak places into a line.
fn add(ui: &mut Ui, shared: &mut Shared, file: &str, field: &str) {
    let help = "Adds 3 ft of weak rope every 60 ft in the top three quarters";
    if ui.small_button("Put in").on_hover_text(help).clicked() {
        alter(shared, file, |document| assembly::add_inserts(document, field));
    }
    let help = "Adds places of 1,700 lbf every 60 ft, such as sleeves, which change nothing but its strength";
    if ui.small_button("Weak places").on_hover_text(help).clicked() {
        alter(shared, file, |document| assembly::add_weak_places(document, field));
    }
}

/// Draws the button by which weak places at equal distances become a list, or the reverse.
fn arrangement(
    ui: &mut Ui,
    shared: &mut Shared,
    (file, field): (&str, &str),
    is_listed: bool,
    length_m: f64,
) {
    if is_listed {
        let help = "Replaces the list by places every 60 ft";
        if ui.small_button("At intervals").on_hover_text(help).clicked() {
            alter(shared, file, |document| assembly::space_weak_places(document, field));
        }
        return;
    }
    let help = "Replaces the interval by a list, so that each place can be moved by itself";
    if ui.small_button("As a list").on_hover_text(help).clicked() {
        alter(shared, file, |document| assembly::list_weak_places(document, field, length_m));
    }
}

/// Draws a figure of a table as a row of the grid.
fn figure(ui: &mut Ui, shared: &mut Shared, file: &str, table: &str, (name, key, help): Row) {
    ui.label(RichText::new(name).color(Theme::palette_of(ui).faint)).on_hover_text(help);
    let (field, width) = (format!("{table}.{key}"), ui.available_width() - 8.0);
    let documents = &shared.workbench.project().documents;
    if let Some(typed) = fields::edit(ui, documents, file, &field, width, super::said(help)) {
        shared.set(file, &field, &typed);
    }
    ui.end_row();
}

fn alter(
    shared: &mut Shared,
    file: &str,
    change: impl FnOnce(&mut endline_gear::Document) -> Result<(), String>,
) {
    shared.alter(file, change);
}

fn editor(ui: &mut Ui, shared: &mut Shared, file: &str, inserts: &str) {
    let rows = [
        ("Length", "length", "Length of an insert, such as 3 ft"),
        ("First at", "first", "Distance from the buoy's end to the first insert, such as 12 ft"),
        ("Repeat every", "every", "Distance between inserts, such as 60 ft"),
        (
            "Within top",
            "within",
            "Share of the line with inserts, from the buoy's end, such as 75 % or 0.75",
        ),
    ];
    ui.indent(inserts, |ui| {
        Grid::new(("inserts", inserts)).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            ui.label(RichText::new("Rope").color(Theme::palette_of(ui).faint));
            item(ui, shared, file, &format!("{inserts}.rope"), Kind::Rope, &WhenEmpty::Missing);
            ui.end_row();
            for row in rows {
                figure(ui, shared, file, inserts, row);
            }
        });
    });
}
