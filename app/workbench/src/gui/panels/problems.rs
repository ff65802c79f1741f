//! The list of problems of all files, with place and help.

use crate::gui::command::action::PanelAction;
use egui::{Label, RichText, ScrollArea, Ui};
use endline_gear::{Diagnostic, Kind};
use endline_session::edit::Documents;

use crate::gui::files::KINDS;
use crate::gui::panel::{Panel, PanelId};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;

/// The list of problems.
#[derive(Debug, Default)]
pub struct ProblemsPanel;

impl Panel for ProblemsPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        show(ui, shared);
    }
}

/// Draws the list of problems.
fn show(ui: &mut Ui, shared: &mut Shared) {
    let problems: Vec<Diagnostic> = shared.workbench.project().problems().cloned().collect();
    if problems.is_empty() && shared.workbench.plugins().problems.is_empty() {
        widgets::nothing(ui, "No problems: all files of the library and the scenario are valid.");
        return;
    }
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for problem in &problems {
            if widgets::problem(ui, problem) {
                go_to(shared, problem);
            }
        }
        for problem in &shared.workbench.plugins().problems {
            let warning = Theme::palette_of(ui).warning;
            ui.add(Label::new(RichText::new(format!("plugin: {problem}")).color(warning)).wrap());
        }
    });
}

/// Opens the panel for the file of a problem.
fn go_to(shared: &mut Shared, problem: &Diagnostic) {
    let documents = &shared.workbench.project().documents;
    for (key, panel) in
        [(Documents::STUDY, PanelId::Study), (Documents::OBSERVATION, PanelId::Search)]
    {
        if documents.shown_name(key) == problem.file {
            return shared.give(PanelAction::Show(panel));
        }
    }
    let kind = problem.file.split_once('/').and_then(|(folder, _)| Kind::in_folder(folder));
    match kind.filter(|kind| KINDS.iter().any(|(shown, _)| shown == kind)) {
        Some(_) => shared.give(PanelAction::Entry(problem.file.clone())),
        None => shared.give(PanelAction::Show(PanelId::Scenario)),
    }
}
