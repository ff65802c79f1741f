//! Table of all runs of a study, sorted and filtered; a click replays a run in the 3-D view.

use std::sync::Arc;

use egui::{Align, ComboBox, Layout, RichText, Sense, Ui};
use egui_extras::{Column, TableBuilder};
use endline_session::study::StudyResults;
use endline_session::units::ForceUnit;

use super::ResultsPanel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;

/// Sort key of runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Sort {
    /// Encounter.
    #[default]
    Encounter,
    /// Greatest tension.
    Tension,
    /// Greatest sum of wraps on all parts.
    Wraps,
    /// Outcome.
    Outcome,
}

/// A run as a row.
#[derive(Clone, Debug)]
struct RunRow {
    option: usize,
    encounter: u32,
    outcome: String,
    tension_n: Option<f64>,
    parted: String,
    wraps: f64,
    valid: bool,
    fault: String,
}

/// Rows, with the selection they were made for.
#[derive(Clone)]
pub(super) struct Listed {
    shown: Arc<StudyResults>,
    only: Option<String>,
    sort: (Sort, bool),
    rows: Arc<Vec<RunRow>>,
}

const HEADS: [(&str, Option<Sort>); 6] = [
    ("Encounter", Some(Sort::Encounter)),
    ("Option", None),
    ("Outcome", Some(Sort::Outcome)),
    ("Greatest tension", Some(Sort::Tension)),
    ("Wraps", Some(Sort::Wraps)),
    ("Parted", None),
];

/// Draws the table of runs.
pub(super) fn show(
    ui: &mut Ui,
    panel: &mut ResultsPanel,
    shared: &mut Shared,
    shown: &Arc<StudyResults>,
) {
    filter(ui, panel, shown);
    let rows = listed(panel, shown);
    let unit = shared.workbench.preferences().units.force();
    let replayed = panel.replayed;
    let mut wanted = None;
    let mut sort = panel.sort;
    let table = TableBuilder::new(ui)
        .id_salt("runs")
        .striped(true)
        .resizable(true)
        .sense(Sense::click())
        .cell_layout(Layout::left_to_right(Align::Center));
    let table = table
        .column(Column::initial(80.0))
        .column(Column::initial(130.0).clip(true))
        .columns(Column::initial(110.0).clip(true), 3)
        .column(Column::remainder().clip(true));
    table
        .header(22.0, |mut header| {
            for (name, by) in HEADS {
                header.col(|ui| head(ui, name, by, &mut sort));
            }
        })
        .body(|body| {
            body.rows(21.0, rows.len(), |mut line| {
                let row = &rows[line.index()];
                line.set_selected(replayed == Some((row.option, row.encounter)));
                cells(&mut line, row, shown, unit);
                let response =
                    line.response().on_hover_text("Click to replay this run in the 3-D view");
                if response.clicked() {
                    wanted = Some((row.option, row.encounter));
                }
            });
        });
    panel.sort = sort;
    if let Some((option, encounter)) = wanted {
        panel.replay(shared, shown, (option, encounter));
    }
}

fn filter(ui: &mut Ui, panel: &mut ResultsPanel, shown: &StudyResults) {
    ui.horizontal(|ui| {
        let only = &mut panel.only;
        let name = |id: &String| {
            shown
                .findings
                .options
                .iter()
                .find(|option| option.id == *id)
                .map_or(id.clone(), |option| option.name.clone())
        };
        let text = only.as_ref().map_or_else(|| "every option".to_owned(), name);
        ComboBox::from_id_salt("only").width(160.0).truncate().selected_text(text).show_ui(
            ui,
            |ui| {
                ui.selectable_value(only, None, "every option");
                for option in &shown.findings.options {
                    ui.selectable_value(only, Some(option.id.clone()), &option.name);
                }
            },
        );
        ui.label(RichText::new("Click a run to replay it.").color(Theme::palette_of(ui).faint));
    });
}

fn head(ui: &mut Ui, name: &str, by: Option<Sort>, sort: &mut (Sort, bool)) {
    let palette = Theme::palette_of(ui);
    let Some(by) = by else {
        ui.label(RichText::new(name).small().color(palette.faint));
        return;
    };
    let (colour, arrow) = if sort.0 == by {
        (palette.accent, if sort.1 { " ⏷" } else { " ⏶" })
    } else {
        (palette.faint, "")
    };
    let button = egui::Button::new(RichText::new(format!("{name}{arrow}")).small().color(colour))
        .frame(false);
    if ui.add(button).clicked() {
        // Numbers are sorted in descending order first.
        *sort = if sort.0 == by {
            (by, !sort.1)
        } else {
            (by, matches!(by, Sort::Tension | Sort::Wraps))
        };
    }
}

fn cells(
    line: &mut egui_extras::TableRow<'_, '_>,
    row: &RunRow,
    shown: &StudyResults,
    unit: ForceUnit,
) {
    line.col(|ui| drop(ui.label(row.encounter.to_string())));
    line.col(|ui| drop(ui.label(&shown.findings.options[row.option].name)));
    line.col(|ui| {
        let palette = Theme::palette_of(ui);
        if row.valid {
            ui.label(row.outcome.replace('_', " "));
        } else {
            ui.label(RichText::new("invalid").color(palette.error)).on_hover_text(&row.fault);
        }
    });
    line.col(|ui| {
        drop(ui.label(row.tension_n.map_or_else(|| "–".into(), |tension| unit.text(tension))))
    });
    line.col(|ui| drop(ui.label(format!("{:.2}", row.wraps))));
    line.col(|ui| drop(ui.label(&row.parted)));
}

/// Sorted and filtered rows, made again if the selection or the results have changed.
fn listed(panel: &mut ResultsPanel, shown: &Arc<StudyResults>) -> Arc<Vec<RunRow>> {
    let same = |listed: &&Listed| {
        Arc::ptr_eq(&listed.shown, shown) && listed.only == panel.only && listed.sort == panel.sort
    };
    if let Some(listed) = panel.listed.as_ref().filter(same) {
        return Arc::clone(&listed.rows);
    }
    let rows = Arc::new(rows(shown, panel.only.as_deref(), panel.sort));
    panel.listed = Some(Listed {
        shown: Arc::clone(shown),
        only: panel.only.clone(),
        sort: panel.sort,
        rows: Arc::clone(&rows),
    });
    rows
}

fn rows(shown: &StudyResults, only: Option<&str>, (sort, down): (Sort, bool)) -> Vec<RunRow> {
    let options = &shown.findings.options;
    let row = |run: &endline_session::study::runs::RunRow| {
        Some(RunRow {
            option: options.iter().position(|option| option.id == run.option)?,
            encounter: u32::try_from(run.encounter).ok()?,
            outcome: run.outcome.clone(),
            tension_n: run.peak_tension_n,
            parted: run.parted.clone(),
            wraps: run.peak_wraps(),
            valid: run.valid,
            fault: run.fault.clone(),
        })
    };
    let runs = shown.runs.rows().iter().filter(|run| only.is_none_or(|only| run.option == only));
    let mut rows: Vec<RunRow> = runs.filter_map(row).collect();
    match sort {
        Sort::Encounter => rows.sort_by_key(|row| (row.encounter, row.option)),
        Sort::Tension => rows.sort_by(|one, other| {
            one.tension_n.unwrap_or(-1.0).total_cmp(&other.tension_n.unwrap_or(-1.0))
        }),
        Sort::Wraps => rows.sort_by(|one, other| one.wraps.total_cmp(&other.wraps)),
        Sort::Outcome => rows.sort_by(|one, other| {
            one.outcome.cmp(&other.outcome).then(one.encounter.cmp(&other.encounter))
        }),
    }
    if down {
        rows.reverse();
    }
    rows
}
