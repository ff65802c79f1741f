//! Orders handed to what they concern.

use egui::Context;
use endline_session::edit::Documents;

use super::App;
use crate::gui::dialogs::{self, Question};
use crate::gui::files::stem;
use crate::gui::layout;
use crate::gui::order::{Dialog, Order};
use crate::gui::panel_id::PanelId;

impl App {
    /// Obeys orders, one after the other.
    pub(super) fn obey(&mut self, context: &Context, orders: Vec<Order>) {
        for order in orders {
            if let Some([now, _]) = &mut self.told {
                now.push(format!("{order:?}"));
            }
            self.obey_one(context, &order);
        }
    }

    /// Hands an order to what it concerns: layout, dialogs, a panel, or the desk.
    fn obey_one(&mut self, context: &Context, order: &Order) {
        match order {
            Order::Start | Order::PlayPause if layout::is_open(&self.dock, PanelId::START) => {
                // Whoever runs something wants to see it.
                layout::close(&mut self.dock, PanelId::START);
                layout::open(&mut self.dock, PanelId::VIEW);
                self.desk.obey(order);
            }
            Order::HoldRun | Order::CompareWith(_) => {
                layout::open(&mut self.dock, PanelId::COMPARE);
                self.desk.obey(order);
            }
            // Another text in its place would take the edits with it.
            Order::Open(path) if self.desk.documents.is_unsaved(Documents::SCENARIO) => {
                self.questions.opening = Some(path.clone())
            }
            Order::Show(panel) => layout::open(&mut self.dock, *panel),
            Order::Table(kind) => {
                layout::open(&mut self.dock, PanelId::LIBRARY);
                self.panels.library.turn_to(*kind);
            }
            Order::Entry(path) => {
                layout::open(&mut self.dock, PanelId::LIBRARY);
                self.panels.library.choose(path.clone());
            }
            Order::Assembly(id) => {
                layout::open(&mut self.dock, PanelId::ASSEMBLY);
                self.panels.assembly.choose(id.clone());
            }
            Order::Duplicate => self.panels.library.duplicate(&mut self.desk),
            Order::ExportTable(path) => self.panels.library.export(&mut self.desk, path),
            Order::ImportTable(path) => self.panels.library.import(&mut self.desk, path),
            Order::ExportPlots(path) => self.panels.plots.export(&mut self.desk, path),
            Order::ExportModel(path) => self.panels.assembly.export_model(&mut self.desk, path),
            Order::AddEntry => self.panels.program.add_entry(&mut self.desk),
            Order::DeleteEntry => self.panels.program.delete_entry(&mut self.desk),
            Order::EditInputs => {
                // The entries of the program that is to come are others.
                self.panels.program.chosen = None;
                self.desk.obey(order);
            }
            Order::Person => self.panels.view.change_person(),
            Order::Look(view) => self.panels.view.look(*view),
            Order::Frame => self.panels.view.frame(),
            Order::Views(count) => self.panels.view.split(*count),
            Order::Ruler => self.panels.view.picks.toggle_ruler(),
            Order::LetGo => self.panels.view.picks.let_go(),
            Order::Read(picked) => self.panels.view.picks.read = Some(*picked),
            Order::Close(panel) => layout::close(&mut self.dock, *panel),
            Order::Size(scale) => context.set_zoom_factor(*scale),
            Order::CopyStudyLine => self.copy_study_line(context),
            Order::ReplayEncounter(..) => {
                layout::open(&mut self.dock, PanelId::VIEW);
                self.desk.obey(order);
            }
            Order::Arrange(layout) => self.dock = layout.dock(),
            Order::Commands => self.palette.toggle(context),
            Order::CopyCommandLine => self.copy_command_line(context),
            Order::Ask(dialog) => self.ask(*dialog),
            _ => self.desk.obey(order),
        }
    }

    /// Opens a file dialog.
    fn ask(&mut self, dialog: Dialog) {
        let question = self.question(dialog);
        if let Err(error) = self.dialogs.ask(question) {
            self.desk.notice = Some((error, true));
        }
    }

    /// What a dialog asks: with the folder it begins in, the files it offers, and the order that its answer gives.
    fn question(&self, dialog: Dialog) -> Question {
        let library = self.desk.documents.root();
        let scenario = self.desk.documents.scenario_path();
        match dialog {
            Dialog::Scenario => dialogs::open(library, dialogs::SCENARIOS, Order::Open),
            Dialog::ScenarioAs => {
                dialogs::save_beside(scenario, dialogs::SCENARIOS, Order::ScenarioAs)
            }
            Dialog::Recording => {
                let folder = self.desk.recordings.clone().unwrap_or_default();
                dialogs::open(&folder, dialogs::RECORDINGS, Order::OpenRecording)
            }
            Dialog::SaveRecording => {
                dialogs::save(&stem(scenario), "endline", Order::SaveRecording)
            }
            Dialog::Study => {
                dialogs::open(&library.join("studies"), dialogs::STUDIES, Order::OpenStudy)
            }
            Dialog::Results => dialogs::open_folder(&self.desk.studies.root(), Order::OpenResults),
            Dialog::ExportModel(ending) => dialogs::save("gear", ending, Order::ExportModel),
            Dialog::ExportPlots(ending) => {
                dialogs::save(&stem(scenario), ending, Order::ExportPlots)
            }
            Dialog::ExportTable => {
                let name = self.panels.library.kind().folder();
                dialogs::save(name, "csv", Order::ExportTable)
            }
            Dialog::ImportTable => dialogs::open(library, dialogs::TABLES, Order::ImportTable),
        }
    }

    fn copy_command_line(&mut self, context: &Context) {
        let (line, unsaved) = self.desk.command_line();
        context.copy_text(line);
        let notice = if unsaved {
            "copied; save first: the command reads the files"
        } else {
            "command line copied"
        };
        self.desk.notice = Some((notice.to_owned(), unsaved));
    }

    fn copy_study_line(&mut self, context: &Context) {
        self.desk.notice = Some(match self.desk.study_line() {
            Some((line, unsaved)) => {
                context.copy_text(line);
                let notice = if unsaved {
                    "copied; save first: the commands read the files"
                } else {
                    "command lines copied"
                };
                (notice.to_owned(), unsaved)
            }
            None => ("open a study first".to_owned(), true),
        });
    }
}
