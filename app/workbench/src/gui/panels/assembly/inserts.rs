//! Weak inserts and sleeves along lines: added at intervals, moved, removed.

use egui::{Grid, RichText, Ui};
use endline_gear::Kind;
use endline_session::command::EditAction;
use endline_session::edit::{Documents, assembly};
use endline_session::statics::TrialGear;

use super::{AssemblyPanel, item};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::{fields, widgets};

/// Draws inserts of lines that a gear type builds. They are stored in the scenario if it places the gear, unless the assembly has its
/// own.
pub(super) fn of_built(
    ui: &mut Ui,
    panel: &AssemblyPanel,
    shared: &mut Shared,
    (gear, is_placed): (&TrialGear, bool),
) {
    let file = &super::path(gear);
    whole(ui, shared, gear);
    for line in built_lines(panel) {
        let (own, placed) = (format!("lines.{line}"), format!("gear.0.lines.{line}"));
        let documents = &shared.workbench.project().documents;
        let has_own = documents.has(file, &format!("{own}.inserts"))
            && !documents.has(Documents::SCENARIO, &format!("{placed}.inserts"));
        if is_placed && !has_own {
            one(ui, shared, Documents::SCENARIO, &placed, &line);
        } else {
            one(ui, shared, file, &own, &line);
        }
    }
}

/// Draws the heading, and the button for inserts of whole endlines.
pub(super) fn whole(ui: &mut Ui, shared: &mut Shared, gear: &TrialGear) {
    widgets::caption(ui, "Weak inserts");
    ui.horizontal(|ui| {
        ui.label("whole endline");
        let button = ui.small_button("Put in every 60 ft");
        let help = "Adds 3 ft of weak rope every 60 ft in the top three quarters, from the buoy through all lines of each endline";
        if button.on_hover_text(help).clicked() {
            shared.perform(EditAction::AddInserts(gear.clone()));
        }
    });
}

/// Lines of the gear shown, with the pieces of a line as one.
fn built_lines(panel: &AssemblyPanel) -> Vec<String> {
    let rest = panel.drawn().a[0].rest;
    let ids = rest
        .iter()
        .flat_map(|rest| &rest.shape.lines)
        .map(|line| line.id.split(['.', '/']).next().unwrap_or_default().to_owned());
    let mut lines: Vec<String> = ids
        .filter(|id| !id.is_empty() && !id.starts_with("gangion") && !id.starts_with("groundline"))
        .collect();
    lines.dedup();
    lines.truncate(12);
    lines
}

/// Draws the inserts of a line at `field` of a file, such as `line.1`.
pub(super) fn one(ui: &mut Ui, shared: &mut Shared, file: &str, field: &str, name: &str) {
    let inserts = format!("{field}.inserts");
    let there = shared
        .workbench
        .project()
        .documents
        .document(file)
        .is_ok_and(|document| document.has(&inserts));
    ui.horizontal(|ui| {
        ui.label(name);
        if there {
            if ui
                .small_button("Take out")
                .on_hover_text("Removes the inserts of this line")
                .clicked()
            {
                alter(shared, file, |document| {
                    document.remove(&inserts).map_err(|error| error.to_string())
                });
            }
        } else if ui
            .small_button("Put in")
            .on_hover_text("Adds 3 ft of weak rope every 60 ft in the top three quarters")
            .clicked()
        {
            alter(shared, file, |document| assembly::add_inserts(document, field));
        }
    });
    if there {
        editor(ui, shared, file, &inserts);
    }
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
            item(ui, shared, file, &format!("{inserts}.rope"), Kind::Rope, false);
            ui.end_row();
            for (name, key, help) in rows {
                ui.label(RichText::new(name).color(Theme::palette_of(ui).faint))
                    .on_hover_text(help);
                let (field, width) = (format!("{inserts}.{key}"), ui.available_width() - 8.0);
                if let Some(typed) = fields::edit(
                    ui,
                    &shared.workbench.project().documents,
                    file,
                    &field,
                    width,
                    super::said(help),
                ) {
                    shared.set(file, &field, &typed);
                }
                ui.end_row();
            }
        });
    });
}
