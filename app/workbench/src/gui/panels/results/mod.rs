//! What a study found: rates, differences, distributions, sensitivity, claims, and every run, to be seen again.

mod figures;
mod rates;
mod runs;
mod spread;

use std::sync::Arc;

use egui::{ComboBox, RichText, ScrollArea, Ui};
use endline_gear::Event;

use super::super::desk::{Desk, Order};
use super::super::studies::Shown;
use super::super::theme::Theme;
pub use runs::{Listed, Sort};
pub use spread::Placed;

/// Which part of the results is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Part {
    /// Rates of every option, and differences from the baseline, in numbers.
    #[default]
    Rates,
    /// Differences from the baseline with their intervals.
    Forest,
    /// Greatest tensions of all runs.
    Tensions,
    /// What each drawn input does.
    Sensitivity,
    /// Claims and whether their sign holds.
    Claims,
    /// Every run.
    Runs,
}

impl Part {
    const ALL: [(Self, &'static str); 6] = [
        (Self::Rates, "Rates"),
        (Self::Forest, "Differences"),
        (Self::Tensions, "Tensions"),
        (Self::Sensitivity, "Sensitivity"),
        (Self::Claims, "Claims"),
        (Self::Runs, "Runs"),
    ];
}

/// Draws the results panel.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    let Some(shown) = desk.studies.results.shown().cloned() else {
        // Every option's model is made for it, which takes a while.
        if desk.studies.results.busy() {
            ui.vertical_centered(|ui| ui.spinner());
            return super::nothing(ui, "Reading the study and what it has found …");
        }
        let why = match &desk.studies.results.problem {
            Some(problem) => problem,
            None => {
                "No results yet. Choose a study in Study and run it, or open the results of one that was run."
            }
        };
        return super::nothing(ui, why);
    };
    head(ui, desk, &shown);
    ui.separator();
    let event = event(desk, &shown);
    match desk.studies.results.part {
        Part::Runs => runs::show(ui, desk, &shown),
        Part::Tensions => spread::show(ui, desk, &shown),
        part => {
            ScrollArea::both().id_salt("results").auto_shrink(false).show(ui, |ui| match part {
                Part::Forest => figures::forest(ui, &shown, &event),
                Part::Sensitivity => figures::tornado(ui, &shown),
                Part::Claims => rates::claims(ui, &shown),
                _ => rates::show(ui, &shown, &event),
            });
        }
    }
}

/// Name of the event shown.
fn event(desk: &Desk, shown: &Shown) -> String {
    desk.studies.results.event.clone().unwrap_or_else(|| shown.findings.event.clone())
}

fn head(ui: &mut Ui, desk: &mut Desk, shown: &Arc<Shown>) {
    let palette = Theme::palette_of(ui);
    let (study, findings) = (&shown.opened.study, &shown.findings);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(&study.name).strong()).on_hover_text(&study.notes);
        let invalid: u64 = findings.options.iter().map(|option| option.invalid).sum();
        let state = if shown.whole { "" } else { ", so far" };
        let text =
            format!("{} encounters{state}; {invalid} invalid runs left out", findings.encounters);
        ui.label(RichText::new(text).color(if shown.whole {
            palette.faint
        } else {
            palette.warning
        }));
    });
    let caveat = "Rates are relative, given an encounter, under this study's distribution of encounters; intervals of 95 %.";
    ui.label(RichText::new(caveat).small().color(palette.faint));
    ui.horizontal_wrapped(|ui| {
        for (part, name) in Part::ALL {
            if part == Part::Claims && findings.claims.is_empty() {
                continue;
            }
            ui.selectable_value(&mut desk.studies.results.part, part, name);
        }
        if matches!(desk.studies.results.part, Part::Rates | Part::Forest) {
            choose_event(ui, desk, shown);
        }
        if ui
            .button("Copy command")
            .on_hover_text("endline study report …, for a terminal")
            .clicked()
        {
            ui.ctx().copy_text(report_line(desk, shown));
        }
        if shown.folder.join("report.html").is_file() {
            ui.label(RichText::new("report.html is in its folder").small().color(palette.faint))
                .on_hover_text(shown.folder.display().to_string());
        }
    });
}

fn report_line(desk: &Desk, shown: &Shown) -> String {
    let quoted = |path: &str| format!("'{}'", path.replace('\'', "'\\''"));
    let study = quoted(&shown.opened.study.place.source.path);
    format!(
        "endline study report {study} --library {} --out {}",
        quoted(&desk.documents.root().display().to_string()),
        quoted(&shown.folder.display().to_string())
    )
}

fn choose_event(ui: &mut Ui, desk: &mut Desk, shown: &Shown) {
    let now = event(desk, shown);
    let words =
        |name: &str| Event::find(name).map_or_else(|| name.to_owned(), |event| event.words());
    ComboBox::from_id_salt("event").width(150.0).truncate().selected_text(words(&now)).show_ui(
        ui,
        |ui| {
            for event in Event::all() {
                if ui.selectable_label(event.name() == now, event.words()).clicked() {
                    desk.studies.results.event = Some(event.name());
                }
            }
        },
    );
}

/// Shows a run in the 3-D view.
fn replay(desk: &mut Desk, option: usize, encounter: u32) {
    desk.orders.push(Order::ReplayEncounter(option, encounter));
}
