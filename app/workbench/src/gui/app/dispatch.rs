//! Commands handed to what they concern: the workbench, a panel, or the window.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use egui::{Context, ViewportCommand};
use endline_session::command::{
    Command, EditAction, FileQuestion, RuleAction, RunAction, SearchAction, StudyAction,
};
use endline_session::edit::Documents;
use endline_session::edit::library_table::id_of;
use endline_session::workbench::{Event, Notice};

use super::App;
use crate::documents::{Document, page};
use crate::gui::command::action::{
    FlightAction, PanelAction, ViewAction, WindowAction, WindowCommand,
};
use crate::gui::command::{Declared, find};
use crate::gui::files::open_folder;
use crate::gui::layout;
use crate::gui::panel::PanelId;
use crate::gui::shared::Selection;

/// Simulated seconds in a real one while a hand steers.
const REAL_TIME: f64 = 1.0;
/// How much larger everything is while the 3-D view is presented alone.
const PRESENTED: f32 = 1.5;

impl App {
    /// Performs commands, one after the other.
    pub fn perform(&mut self, context: &Context, commands: Vec<WindowCommand>) {
        for command in commands {
            if let Some([now, _]) = &mut self.reported {
                now.push(command.id().to_owned());
            }
            self.select();
            let refused = find(command.id()).map_or(Ok(()), |info| info.enabled(&self.shared));
            if let Err(reason) = refused {
                self.shared.workbench.say(Notice::hint(reason));
                continue;
            }
            if let Err(reason) = self.dispatch(context, command) {
                self.shared.fault(reason);
            }
            self.take_events();
        }
    }

    fn dispatch(&mut self, context: &Context, command: WindowCommand) -> Result<(), String> {
        match command {
            WindowCommand::Workbench(command) => self.work(command),
            WindowCommand::View(action) => self.look(action),
            WindowCommand::Flight(action) => self.pilot(action),
            WindowCommand::Panel(action) => self.arrange(action),
            WindowCommand::Window(action) => self.manage(context, action),
        }
    }

    /// A command of the workbench, with what the window does for it.
    fn work(&mut self, command: Command) -> Result<(), String> {
        if let Command::Edit(EditAction::OpenScenario(path)) = &command
            && self.shared.workbench.project().documents.is_unsaved(Documents::SCENARIO)
        {
            // Another text in its place would take the edits with it.
            self.questions.opening = Some(path.clone());
            return Ok(());
        }
        if command == Command::Run(RunAction::Rerun) && self.shared.flying {
            self.stop_flying()?;
        }
        let shown = self.shown_by(&command);
        self.shared.workbench.perform(command)?;
        if let Some(panel) = shown {
            layout::open(&mut self.dock, panel);
        }
        Ok(())
    }

    /// The panel that shows what comes of a command.
    fn shown_by(&mut self, command: &Command) -> Option<PanelId> {
        let starts = matches!(command, Command::Run(RunAction::Start | RunAction::Toggle));
        if starts && layout::is_open(&self.dock, PanelId::Start) {
            // Whoever runs something wants to see it.
            layout::close(&mut self.dock, PanelId::Start);
            return Some(PanelId::View);
        }
        if matches!(command, Command::Run(RunAction::Hold | RunAction::CompareWith(_))) {
            return Some(PanelId::Compare);
        }
        if matches!(command, Command::Search(SearchAction::Open(_) | SearchAction::New)) {
            return Some(PanelId::Search);
        }
        if matches!(command, Command::Edit(EditAction::NewAssembly(_))) {
            return Some(PanelId::Assembly);
        }
        if matches!(command, Command::Rules(RuleAction::Compare(_))) {
            return Some(PanelId::Study);
        }
        let replays = matches!(
            command,
            Command::Study(StudyAction::Replay { .. })
                | Command::Search(SearchAction::Replay(_) | SearchAction::FlyOn(_))
        );
        replays.then_some(PanelId::View)
    }

    fn look(&mut self, action: ViewAction) -> Result<(), String> {
        let view = &mut self.panels.view;
        match action {
            ViewAction::Look(from) => view.look(from),
            ViewAction::Frame => view.frame(),
            ViewAction::Split(count) => view.split(count),
            ViewAction::Pose => self.shared.posing = !self.shared.posing,
            ViewAction::Ruler => view.picks.toggle_ruler(),
            ViewAction::Inspect(picked) => view.picks.read = Some(picked),
            ViewAction::LetGo => view.picks.let_go(),
            ViewAction::SetKey => {
                let shown = self.shared.workbench.view().ok_or("no run is there yet")?;
                view.set_key(shown.frame.time_s);
            }
            ViewAction::ClearKeys => view.clear_keys(),
            ViewAction::SaveFilm(file) => {
                let film = view.begin_film(&mut self.shared, file)?;
                self.shared.film = Some(film);
            }
            ViewAction::CancelFilm => {
                self.shared.film.as_ref().ok_or("no film is being made")?.cancel();
            }
            ViewAction::SavePicture(file) => {
                view.save_picture(&self.shared, &file)?;
                let said = format!("saved {}", file.display());
                self.shared.workbench.say(Notice::done(said));
            }
        }
        Ok(())
    }

    fn pilot(&mut self, action: FlightAction) -> Result<(), String> {
        match action {
            FlightAction::Toggle if self.shared.flying => return self.stop_flying(),
            FlightAction::Toggle => return self.start_flying(),
            FlightAction::Person => self.panels.view.change_person(),
            FlightAction::NextAct => {
                let acts = self.shared.workbench.acts().len();
                self.shared.pilot.next_act(acts);
            }
            FlightAction::ChooseAct(act) => self.shared.pilot.choose_act(act),
            FlightAction::Mouth => self.shared.pilot.toggle_mouth(),
        }
        Ok(())
    }

    /// Gives the controls to keys and pad, at a pace that a hand can follow.
    fn start_flying(&mut self) -> Result<(), String> {
        self.shared.flying = true;
        let Some(view) = self.shared.workbench.view().cloned() else { return Ok(()) };
        self.shared.pilot.set_throttle(view.controls.speed.max(0.3));
        if view.speed > REAL_TIME {
            return self.shared.workbench.perform(Command::Run(RunAction::Speed(REAL_TIME)));
        }
        Ok(())
    }

    /// Leaves the controls to the pilot program.
    fn stop_flying(&mut self) -> Result<(), String> {
        self.shared.flying = false;
        self.shared.workbench.perform(Command::Run(RunAction::Autopilot))
    }

    fn arrange(&mut self, action: PanelAction) -> Result<(), String> {
        let Self { shared, panels, dock, .. } = self;
        match action {
            PanelAction::Show(panel) => layout::open(dock, panel),
            PanelAction::Close(panel) => layout::close(dock, panel),
            PanelAction::Arrange(layout) => *dock = layout.dock(),
            PanelAction::Table(kind) => {
                layout::open(dock, PanelId::Library);
                panels.library.turn_to(kind);
            }
            PanelAction::Entry(path) => {
                layout::open(dock, PanelId::Library);
                panels.library.choose(path);
            }
            PanelAction::Assembly(id) => {
                layout::open(dock, PanelId::Assembly);
                panels.assembly.choose(shared, id);
            }
            PanelAction::Duplicate => {
                let path = shared.selection.entry.clone();
                let duplicate = path.map(|path| Command::Edit(EditAction::Duplicate(path)));
                return duplicate.map_or(Ok(()), |command| self.work(command));
            }
            PanelAction::Remove => {
                let path = shared.selection.entry.clone();
                let remove = path.map(|path| Command::Edit(EditAction::Remove(path)));
                return remove.map_or(Ok(()), |command| self.work(command));
            }
            PanelAction::DeleteEntry => {
                let entry = panels.program.chosen.take();
                let delete = entry.map(|entry| Command::Edit(EditAction::DeleteEntry(entry)));
                return delete.map_or(Ok(()), |command| self.work(command));
            }
            PanelAction::ExportTable(file) => {
                let export = panels.library.export(shared, file);
                return self.work(export.into());
            }
            PanelAction::ImportTable(file) => {
                let kind = panels.library.kind();
                return self.work(EditAction::ImportTable { kind, file }.into());
            }
            PanelAction::ExportPlots(file) => {
                let export = panels.plots.export(file);
                return self.work(export.into());
            }
            PanelAction::ExportModel(path) => panels.assembly.export_model(shared, &path),
        }
        Ok(())
    }

    fn manage(&mut self, context: &Context, action: WindowAction) -> Result<(), String> {
        match action {
            WindowAction::Palette => self.palette.toggle(context),
            WindowAction::Theme(theme) => self.shared.preferences.theme = theme,
            WindowAction::Units(units) => self.shared.workbench.set_units(units),
            WindowAction::Size(size) => context.set_zoom_factor(size),
            WindowAction::CopyCommandLine => {
                let line = self.shared.workbench.command_line();
                self.copy(context, line, "command line");
            }
            WindowAction::CopyStudyLine => {
                if let Some(line) = self.shared.workbench.study_command_line() {
                    self.copy(context, line, "command lines");
                }
            }
            WindowAction::CopySearchLine => {
                if let Some(line) = self.shared.workbench.search_command_line() {
                    self.copy(context, line, "command line");
                }
            }
            WindowAction::OpenReport => {
                if let Some(page) = self.shared.workbench.report_shown() {
                    open_folder(&page)?;
                }
            }
            WindowAction::Read(document) => self.read(document)?,
            WindowAction::OpenFolder(folder) => open_folder(&folder)?,
            WindowAction::Ask(id) => self.ask(id)?,
            WindowAction::Present => self.present(context),
            WindowAction::Quit => context.send_viewport_cmd(ViewportCommand::Close),
        }
        Ok(())
    }

    /// A document in the system's browser.
    fn read(&mut self, document: Document) -> Result<(), String> {
        let folder = self.shared.pages.as_ref();
        let folder = folder.ok_or("the system names no home, where documents could be written")?;
        let page = page::write(folder, document)?;
        open_folder(&page)?;
        self.shared.workbench.say(Notice::done(format!("opened {}", page.display())));
        Ok(())
    }

    /// The 3-D view alone on the whole screen, or back.
    pub(super) fn present(&mut self, context: &Context) {
        let before = self.shared.presented_from.take();
        context.send_viewport_cmd(ViewportCommand::Fullscreen(before.is_none()));
        if let Some(size) = before {
            context.set_zoom_factor(size);
        } else {
            let size = context.zoom_factor();
            self.shared.presented_from = Some(size);
            context.set_zoom_factor(PRESENTED * size);
        }
    }

    fn copy(&mut self, context: &Context, line: String, what: &str) {
        context.copy_text(line);
        let unsaved = !self.shared.workbench.project().documents.unsaved().is_empty();
        self.shared.workbench.say(if unsaved {
            Notice::hint("copied; save first: the command reads the files")
        } else {
            Notice::done(format!("{what} copied"))
        });
    }

    /// Opens the file dialog of a command.
    fn ask(&mut self, id: &str) -> Result<(), String> {
        let Some(command) = find(id) else { return Ok(()) };
        let question: Option<FileQuestion> = command.question(&self.shared);
        let (_, waker) = self.shared.workbench.helpers();
        question.map_or(Ok(()), |question| self.dialogs.ask(command, question, &waker))
    }

    /// The command for the file that a dialog answered with.
    pub(super) fn answered(&mut self) -> Option<WindowCommand> {
        let (command, file): (Declared, PathBuf) = self.dialogs.take()?;
        command.with_file(&self.shared, file)
    }

    /// Notes what is chosen in the panels.
    pub(super) fn select(&mut self) {
        let Self { panels, dock, .. } = self;
        let [_, running] = panels.assembly.answers();
        self.shared.selection = Selection {
            entry: panels.library.chosen.clone(),
            table: panels.library.kind(),
            program_entry: panels.program.chosen,
            gear_at_rest: running.is_some_and(|answer| answer.is_ok()),
            inspects: panels.view.picks.holds(),
            camera_keys: panels.view.path.times().len(),
            open: PanelId::ALL
                .iter()
                .copied()
                .filter(|panel| layout::is_open(dock, *panel))
                .collect(),
        };
    }

    /// Shows what came about in the workbench.
    pub(super) fn take_events(&mut self) {
        for event in self.shared.workbench.take_events() {
            match event {
                Event::ProgramWritten => {
                    // The entries are others than before.
                    self.panels.program.chosen = None;
                    layout::open(&mut self.dock, PanelId::Pilot);
                }
                Event::EntryAdded(index) => self.panels.program.chosen = Some(index),
                Event::RunKept(recording) => {
                    let (_, waker) = self.shared.workbench.helpers();
                    if let Some(view) = self.shared.workbench.view().cloned() {
                        self.shared.thumbnail.begin(view, &recording, waker);
                    }
                }
                Event::AssemblyAdded(path) => {
                    self.panels.assembly.choose(&self.shared, id_of(&path).to_owned());
                }
                Event::Duplicated { from, to } => {
                    let id = id_of(&from);
                    if from.starts_with("assemblies/")
                        && self.panels.assembly.shows(&self.shared, id)
                    {
                        self.panels.assembly.choose(&self.shared, id_of(&to).to_owned());
                    }
                    self.panels.library.compare(from, to);
                }
            }
        }
    }
}
