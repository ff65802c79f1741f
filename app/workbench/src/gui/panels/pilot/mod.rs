//! The pilot program: a timeline with entries as bars, the form of the selected entry, and the list of reactions.

mod form;
mod tracks;

use crate::gui::command::action::PanelAction;
use endline_session::command::{EditAction, RunAction};
use std::sync::Arc;

use egui::{Button, RichText, ScrollArea, Ui};
use endline_gear::Document;
use endline_session::edit::Documents;
use endline_session::edit::pilot_program::{Entry, entries};

use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;

/// Width of the form [points].
const FORM: f32 = 292.0;

/// The pilot program on a timeline.
#[derive(Clone, Debug, Default)]
pub struct PilotPanel {
    /// Index of the selected entry.
    pub chosen: Option<usize>,
    drag: Option<tracks::Drag>,
    /// Entries, with the version of the files they were read from.
    read: Option<(u64, Arc<Vec<Entry>>)>,
}

impl PilotPanel {
    /// Entries of the scenario, read again if it has changed.
    fn entries(&mut self, documents: &Documents) -> Arc<Vec<Entry>> {
        let (version, read) =
            self.read.get_or_insert_with(|| (documents.version(), Arc::new(entries(documents))));
        if *version != documents.version() {
            (*version, *read) = (documents.version(), Arc::new(entries(documents)));
        }
        Arc::clone(read)
    }

    fn toolbar(&self, ui: &mut Ui, shared: &mut Shared, all: &[Entry]) {
        let run = shared.workbench.view().is_some_and(|view| view.newest_s > 0.0);
        let shown_s = shared.workbench.view().map_or(0.0, |view| view.frame.time_s);
        ui.horizontal_wrapped(|ui| {
            let help = "Adds an entry at the moment shown";
            if ui.button("Add entry").on_hover_text(help).clicked() {
                shared.give(EditAction::AddEntry);
            }
            if ui.add_enabled(self.chosen.is_some(), Button::new("Delete entry")).clicked() {
                shared.give(PanelAction::DeleteEntry);
            }
            let help = "Converts the controls of the run shown into entries of this program; one Undo reverts it";
            if ui.add_enabled(run, Button::new("Edit inputs of this run")).on_hover_text(help).clicked() {
                shared.give(EditAction::EditInputs);
            }
            let text = format!("Rerun from {shown_s:.2} s");
            let help = "Repeats the inputs up to the moment shown, then uses this program";
            if ui.add_enabled(run && !shared.workbench.project().documents.any_error(), Button::new(text)).on_hover_text(help).clicked() {
                shared.give(RunAction::Rerun);
            }
            let count = if all.len() == 1 { "1 entry".to_owned() } else { format!("{} entries", all.len()) };
            ui.label(RichText::new(count).color(Theme::palette_of(ui).faint));
        });
    }

    /// Draws entries whose start depends on the run.
    fn reactions(&mut self, ui: &mut Ui, all: &[Entry]) {
        let unknown: Vec<&Entry> = all.iter().filter(|entry| entry.begin_s.is_none()).collect();
        if unknown.is_empty() {
            return;
        }
        widgets::caption(ui, "Reactions: start on an event");
        for entry in unknown {
            let chosen = self.chosen == Some(entry.index);
            let label = Button::selectable(chosen, RichText::new(entry.words())).truncate();
            if ui.add(label).clicked() {
                self.chosen = Some(entry.index);
            }
        }
    }
}

impl Panel for PilotPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        if shared.workbench.project().documents.field(Documents::SCENARIO, "whale.item").is_none() {
            return widgets::nothing(ui, "This scenario has no whale to pilot.");
        }
        let all = self.entries(&shared.workbench.project().documents);
        self.chosen = self.chosen.filter(|chosen| *chosen < all.len());
        self.toolbar(ui, shared, &all);
        let whole = ui.available_rect_before_wrap();
        let beside = if self.chosen.is_some() { FORM.min(0.5 * whole.width()) } else { 0.0 };
        widgets::within(ui, whole.with_max_x(whole.right() - beside - 8.0), |ui| {
            ScrollArea::vertical().id_salt("tracks").auto_shrink(false).show(ui, |ui| {
                tracks::show(ui, self, shared, &all);
                self.reactions(ui, &all);
            });
        });
        if let Some(entry) = self.chosen.and_then(|chosen| all.get(chosen)) {
            widgets::within(ui, whole.with_min_x(whole.right() - beside), |ui| {
                ScrollArea::vertical()
                    .id_salt("form")
                    .auto_shrink(false)
                    .show(ui, |ui| form::show(ui, shared, entry));
            });
        }
    }
}

/// Edits the program as one step of undo; an error is shown in the status bar.
fn change(shared: &mut Shared, change: impl FnOnce(&mut Document) -> Result<(), String>) {
    shared.alter(Documents::SCENARIO, change);
}
