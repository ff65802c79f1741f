//! Results of a study: rates, uncertainty, differences, tensions, sensitivity, claims, and all runs, which can be replayed.

mod figures;
mod rates;
mod runs;
mod spread;

use endline_session::command::StudyAction;
use std::sync::Arc;

use egui::{ComboBox, Label, RichText, ScrollArea, Ui};
use endline_gear::StudyEvent;
use endline_session::shell;
use endline_session::study::stats::{answer, observed, resolution};
use endline_session::study::{ResultsReader, StudyResults};
use strum::{IntoStaticStr, VariantArray};

use crate::gui::command::action::WindowAction;
use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::gui::widgets::command;
use runs::{Listed, Sort};
use spread::Placed;

/// Part of the results that is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, IntoStaticStr, VariantArray)]
pub enum Part {
    /// Table of rates and differences from the baseline.
    #[default]
    Rates,
    /// Uncertainty of rates by cause.
    #[strum(serialize = "Uncertainty")]
    Bands,
    /// Chart of differences from the baseline.
    #[strum(serialize = "Differences")]
    Forest,
    /// Greatest tensions of all runs.
    Tensions,
    /// Effect of each drawn input.
    Sensitivity,
    /// Claims and whether their sign is confirmed.
    Claims,
    /// Table of all runs.
    Runs,
}

/// Results of a study.
#[derive(Default)]
pub struct ResultsPanel {
    /// Part shown.
    pub part: Part,
    /// Name of the event shown; `None` for that of the study.
    event: Option<String>,
    /// Column by which runs are sorted, and whether in descending order.
    sort: (Sort, bool),
    /// Id of the option whose runs are listed; `None` for all.
    only: Option<String>,
    /// Option index and encounter of the last run replayed.
    replayed: Option<(usize, u32)>,
    listed: Option<Listed>,
    placed: Option<Placed>,
    /// Hash of the study that the selections above belong to.
    of: Option<String>,
}

impl Panel for ResultsPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let Some(shown) = shared.workbench.studies().results.shown().cloned() else {
            return missing(ui, &shared.workbench.studies().results);
        };
        self.begin(&shown);
        self.head(ui, shared, &shown);
        ui.separator();
        let event = self.event(&shown);
        if !matches!(self.part, Part::Runs | Part::Sensitivity | Part::Claims) {
            for sentence in answer(&shown.findings, &event) {
                ui.add(Label::new(RichText::new(sentence).strong()).wrap());
            }
            let limits = resolution(&shown.findings).into_iter().chain(observed(&shown.findings));
            let faint = Theme::palette_of(ui).faint;
            for sentence in limits {
                ui.add(Label::new(RichText::new(sentence).small().color(faint)).wrap());
            }
            ui.add_space(4.0);
        }
        let scrolled = |ui: &mut Ui, draw: &dyn Fn(&mut Ui)| {
            ScrollArea::both().id_salt("results").auto_shrink(false).show(ui, draw);
        };
        match self.part {
            Part::Runs => runs::show(ui, self, shared, &shown),
            Part::Tensions => spread::show(ui, self, shared, &shown),
            Part::Rates => scrolled(ui, &|ui| rates::show(ui, &shown, &event)),
            Part::Bands => scrolled(ui, &|ui| figures::bands(ui, &shown, &event)),
            Part::Forest => scrolled(ui, &|ui| figures::forest(ui, &shown, &event)),
            Part::Sensitivity => scrolled(ui, &|ui| figures::tornado(ui, &shown)),
            Part::Claims => scrolled(ui, &|ui| rates::claims(ui, &shown)),
        }
    }
}

/// Draws the reason why there are no results.
fn missing(ui: &mut Ui, results: &ResultsReader) {
    // The model of every option is assembled, which takes some time.
    if results.busy() {
        ui.vertical_centered(|ui| ui.spinner());
        return widgets::nothing(ui, "Reading the study and its results …");
    }
    let none =
        "No results yet. Select a study in Study and run it, or open results of an earlier one.";
    widgets::nothing(ui, results.problem.as_deref().unwrap_or(none));
}

impl ResultsPanel {
    /// Clears selections that belong to another study.
    fn begin(&mut self, shown: &StudyResults) {
        let hash = &shown.opened.hash;
        if self.of.as_ref() != Some(hash) {
            (self.event, self.only, self.replayed) = (None, None, None);
            self.of = Some(hash.clone());
        }
    }

    /// Name of the event shown.
    fn event(&self, shown: &StudyResults) -> String {
        self.event.clone().unwrap_or_else(|| shown.findings.event.clone())
    }

    fn head(&mut self, ui: &mut Ui, shared: &mut Shared, shown: &Arc<StudyResults>) {
        let palette = Theme::palette_of(ui);
        let (study, findings) = (&shown.opened.study, &shown.findings);
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(&study.name).strong()).on_hover_text(&study.notes);
            let invalid: u64 = findings.options.iter().map(|option| option.invalid).sum();
            let text = format!("{}; {invalid} invalid runs excluded", findings.extent());
            ui.label(RichText::new(text).color(if shown.whole {
                palette.faint
            } else {
                palette.warning
            }));
        });
        let caveat = "Rates are per encounter, for the distribution of encounters of this study; 95 % intervals.";
        ui.label(RichText::new(caveat).small().color(palette.faint));
        ui.horizontal_wrapped(|ui| {
            for part in Part::VARIANTS.iter().copied() {
                if part == Part::Claims && findings.claims.is_empty() {
                    continue;
                }
                ui.selectable_value(&mut self.part, part, <&str>::from(part));
            }
            if matches!(self.part, Part::Rates | Part::Bands | Part::Forest) {
                self.choose_event(ui, shown);
            }
            if ui
                .button("Copy command")
                .on_hover_text("Copies the command endline study report …")
                .clicked()
            {
                ui.ctx().copy_text(report_line(shared, shown));
            }
            command(ui, shared, "Open report", WindowAction::OpenReport);
            command(ui, shared, "Save bundle …", WindowAction::Ask("study.save-bundle"));
        });
    }

    fn choose_event(&mut self, ui: &mut Ui, shown: &StudyResults) {
        let now = self.event(shown);
        let words = |name: &str| {
            StudyEvent::find(name).map_or_else(|| name.to_owned(), |event| event.words())
        };
        ComboBox::from_id_salt("event").width(150.0).truncate().selected_text(words(&now)).show_ui(
            ui,
            |ui| {
                for event in StudyEvent::all() {
                    if ui.selectable_label(event.name() == now, event.words()).clicked() {
                        self.event = Some(event.name());
                    }
                }
            },
        );
    }

    /// Replays a run in the 3-D view; the option is by its place among the findings.
    fn replay(
        &mut self,
        shared: &mut Shared,
        shown: &StudyResults,
        (place, encounter): (usize, u32),
    ) {
        self.replayed = Some((place, encounter));
        let id = &shown.findings.options[place].id;
        if let Ok(option) = shown.opened.option(id) {
            shared.give(StudyAction::Replay { option, encounter });
        }
    }
}

fn report_line(shared: &Shared, shown: &StudyResults) -> String {
    let study = shell::word(&shown.opened.study.place.source.path);
    format!(
        "endline study report {study} --library {} --out {}",
        shell::path(shared.workbench.project().documents.root()),
        shell::path(&shown.folder)
    )
}
