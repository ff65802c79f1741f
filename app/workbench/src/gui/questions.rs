//! What the window asks: for the path of a file, what to do with edits a crash left, with unsaved ones as it closes or another scenario
//! is opened, with a file that was changed on disk, and with a plugin it does not know.
//!
//! A file dialog runs on a thread of its own, so that the window stays alive. A system without a desktop portal and without zenity
//! shows none: its answer is immediate, and the window then asks for the path itself.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Align2, Context, Key, Label, RichText, TextEdit, Ui, Window, vec2};
use endline_session::command::{EditAction, FileQuestion, FileUse, PluginAction};
use endline_session::edit::recovery::UnsavedEdits;
use endline_session::edit::saving::Keep;
use endline_session::edit::{Documents, recovery};
use endline_session::plugins::Change;
use endline_session::task::{Task, Waker};

use crate::gui::command::Declared;
use crate::gui::files::stem;
use crate::gui::shared::Shared;
use crate::gui::theme::{Theme, primary};

/// What is asked, and what was answered.
#[derive(Default)]
pub struct Questions {
    /// Edits that a crash left, with their files.
    pub left_behind: Vec<(PathBuf, UnsavedEdits)>,
    /// The scenario to be opened, while it is asked what to do with unsaved edits of the present one.
    pub opening: Option<PathBuf>,
    /// Whether it is asked what to do with unsaved edits.
    closing: bool,
    /// Whether the window may close as it is.
    leave: bool,
}

impl Questions {
    /// Offers back edits that a crash left.
    #[must_use]
    pub fn new(left_behind: Vec<(PathBuf, UnsavedEdits)>) -> Self {
        Self { left_behind, ..Self::default() }
    }

    /// The bar that offers edits back, where a crash left some.
    pub fn recovery(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let Some((file, kept)) = self.left_behind.first().cloned() else { return };
        let here = kept.root == shared.workbench.project.documents.root();
        let palette = Theme::palette_of(ui);
        ui.horizontal(|ui| {
            let count = kept.texts.len();
            let files = if count == 1 { "1 file".to_owned() } else { format!("{count} files") };
            let text =
                format!("Endline was not closed last time. Unsaved edits of {files} were kept.");
            ui.label(RichText::new(text).color(palette.warning))
                .on_hover_text(kept.texts.keys().cloned().collect::<Vec<_>>().join("\n"));
            if here {
                if primary(ui, true, "Recover").on_hover_text("Undo takes it back").clicked() {
                    shared.perform(EditAction::Recover(kept));
                    self.drop_left_behind(&file);
                }
            } else {
                ui.label(
                    RichText::new(format!("They are of {}.", kept.root.display()))
                        .color(palette.faint),
                );
            }
            if ui.button("Discard").clicked() {
                self.drop_left_behind(&file);
            }
        });
    }

    /// Drops edits that a crash left.
    fn drop_left_behind(&mut self, file: &Path) {
        // A file that cannot be removed is offered again next time.
        recovery::forget(file);
        self.left_behind.retain(|(known, _)| known != file);
    }

    /// Asks before unsaved edits are lost with the window.
    pub fn before_closing(&mut self, context: &Context, shared: &mut Shared) {
        let wanted = context.input(|input| input.viewport().close_requested());
        let unsaved = shared.workbench.project.documents.unsaved().len();
        if wanted && unsaved > 0 && !self.leave {
            context.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            self.closing = true;
        }
        if !self.closing {
            return;
        }
        let window = Window::new("Unsaved edits")
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, vec2(0.0, -60.0));
        window.show(context, |ui| {
            ui.label(if unsaved == 1 {
                "1 file has unsaved edits.".to_owned()
            } else {
                format!("{unsaved} files have unsaved edits.")
            });
            ui.horizontal(|ui| {
                if primary(ui, true, "Save and quit").clicked() {
                    shared.perform(EditAction::Save);
                    self.leave = shared.workbench.project.documents.unsaved().is_empty();
                    self.closing = false;
                }
                if ui.button("Quit without saving").clicked() {
                    (self.leave, self.closing) = (true, false);
                }
                if ui.button("Stay").clicked() {
                    self.closing = false;
                }
            });
        });
        if self.leave {
            shared.workbench.project.autosave.clear();
            context.send_viewport_cmd(egui::ViewportCommand::Close);
        }
    }

    /// Asks before unsaved edits of the scenario are lost with it, as another is opened.
    pub fn before_opening(&mut self, context: &Context, shared: &mut Shared) {
        let Some(path) = self.opening.clone() else { return };
        let (present, next) =
            (stem(shared.workbench.project.documents.scenario_path()), stem(&path));
        let window = Window::new("Unsaved scenario")
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, vec2(0.0, -60.0));
        window.show(context, |ui| {
            ui.label(format!("{present} has edits that are not saved. {next} takes its place."));
            ui.horizontal(|ui| {
                let mut open = false;
                if primary(ui, true, "Save and open")
                    .on_hover_text("Saves every file with edits")
                    .clicked()
                {
                    shared.perform(EditAction::Save);
                    open = !shared.workbench.project.documents.is_unsaved(Documents::SCENARIO);
                    self.opening = None;
                }
                open |= ui
                    .button("Open without saving")
                    .on_hover_text("The edits are lost; Undo does not bring them back")
                    .clicked();
                if open {
                    self.opening = None;
                    shared.perform(EditAction::OpenScenario(path));
                }
                if ui.button("Stay").clicked() {
                    self.opening = None;
                }
            });
        });
    }
}

/// Lines of a file changed on disk that are shown at most.
const LINES_SHOWN: usize = 5;

/// Asks what becomes of a file that someone else changed on disk, as edits of it are saved.
pub fn newer(context: &Context, shared: &mut Shared) {
    let documents = &shared.workbench.project.documents;
    let Some((path, theirs)) = documents.newer().next() else { return };
    let (path, name) = (path.to_owned(), documents.shown_name(path));
    let read = documents.saved_text(&path).unwrap_or_default();
    let theirs: Vec<String> = theirs
        .lines()
        .filter(|line| !read.lines().any(|known| known == *line))
        .take(LINES_SHOWN)
        .map(str::to_owned)
        .collect();
    let window = Window::new("Changed on disk")
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, -60.0))
        .max_width(460.0);
    window.show(context, |ui| {
        ui.label(RichText::new(name).strong());
        ui.add(
            Label::new("The file was changed since Endline read it. Your edits are not saved.")
                .wrap(),
        );
        if !theirs.is_empty() {
            ui.label(RichText::new("On disk it now has").color(Theme::palette_of(ui).faint));
            ui.add(Label::new(RichText::new(theirs.join("\n")).monospace().size(12.0)).truncate());
        }
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            let answers = [
                ("Keep both", Keep::Both, "Your edits go to a file of their own beside it"),
                ("Keep mine", Keep::Mine, "Your edits replace what is on disk"),
                (
                    "Take theirs",
                    Keep::Theirs,
                    "What is on disk replaces your edits; Undo brings them back",
                ),
                (
                    "Not now",
                    Keep::Undecided,
                    "The file stays as it is, and your edits stay unsaved",
                ),
            ];
            for (label, keep, help) in answers {
                let clicked =
                    if keep == Keep::Both { primary(ui, true, label) } else { ui.button(label) };
                if clicked.on_hover_text(help).clicked() {
                    shared.give(EditAction::Reconcile { path: path.clone(), keep });
                }
            }
        });
    });
}

/// Asks before a plugin library is opened that is new, or has changed since it was allowed.
pub fn plugin(context: &Context, shared: &mut Shared) {
    let Some((file, ask)) = shared.workbench.plugins.asked() else { return };
    let title = if ask.change == Change::New { "A new plugin" } else { "A plugin has changed" };
    let window = Window::new(title)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, vec2(0.0, -60.0))
        .max_width(460.0);
    window.show(context, |ui| {
        let palette = Theme::palette_of(ui);
        let name =
            file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let folder = file.parent().map(|folder| folder.display().to_string()).unwrap_or_default();
        ui.label(RichText::new(name).strong());
        ui.add(Label::new(RichText::new(format!("in {folder}")).color(palette.faint)).wrap());
        ui.add_space(4.0);
        let why = if ask.change == Change::New {
            "It was never opened here."
        } else {
            "It was allowed with other content than it has now."
        };
        let place = if cfg!(unix) { "in a process of its own, but " } else { "" };
        ui.add(
            Label::new(format!(
                "{why} It runs {place}with your rights: allow it only if you trust who made it."
            ))
            .wrap(),
        );
        ui.label(
            RichText::new(format!("hash {}", ask.hash.get(..16).unwrap_or(&ask.hash)))
                .monospace()
                .size(12.0)
                .color(palette.faint),
        )
        .on_hover_text(&ask.hash);
        ui.horizontal(|ui| {
            if primary(ui, !shared.workbench.plugins.busy(), "Allow")
                .on_hover_text("It is checked in a process of its own, then loaded")
                .clicked()
            {
                shared.give(PluginAction::Allow { file: file.clone(), hash: ask.hash.clone() });
            }
            if ui.button("Not now").clicked() {
                shared.workbench.plugins.put_off(&ask);
            }
        });
    });
}

/// No user cancels a dialog sooner after it was asked for.
const AT_ONCE: Duration = Duration::from_millis(300);

/// The dialog that is open, if any.
#[derive(Default)]
pub struct Dialogs {
    task: Task<Option<PathBuf>>,
    /// The command that waits for its file.
    waiting: Option<Waiting>,
    /// The path as it is typed, where the system shows no dialog.
    typed: Option<(Waiting, String)>,
}

/// A command that waits for its file.
#[derive(Clone)]
struct Waiting {
    command: Declared,
    question: FileQuestion,
    since: Instant,
}

impl Dialogs {
    /// Asks for the file of a command.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub fn ask(
        &mut self,
        command: Declared,
        question: FileQuestion,
        waker: &Waker,
    ) -> Result<(), String> {
        let waiting = Waiting { command, question: question.clone(), since: Instant::now() };
        let asked = self.task.start("endline-dialog", move || answer(question), Arc::clone(waker));
        asked.map_err(|error| format!("the dialog cannot be opened: {error}"))?;
        self.waiting = Some(waiting);
        Ok(())
    }

    /// The command and the file that a dialog answered with, once.
    pub fn take(&mut self) -> Option<(Declared, PathBuf)> {
        let answer = self.task.poll()?;
        let waiting = self.waiting.take()?;
        match answer.ok().flatten() {
            Some(file) => Some((waiting.command, file)),
            None => {
                if waiting.since.elapsed() < AT_ONCE {
                    self.type_instead(waiting);
                }
                None
            }
        }
    }

    /// Asks for the path in the window, beginning with what a dialog would propose.
    fn type_instead(&mut self, waiting: Waiting) {
        let FileQuestion { folder, file_name, .. } = &waiting.question;
        let folder = folder.clone().or_else(|| std::env::current_dir().ok()).unwrap_or_default();
        let path = folder.join(file_name).display().to_string();
        self.typed = Some((waiting, path));
    }

    /// Whether a path is being typed: keys are for it then.
    #[must_use]
    pub fn asks(&self) -> bool {
        self.typed.is_some()
    }

    /// Draws the question for a path; answers the command and the path that was typed, once.
    pub fn show(&mut self, context: &Context) -> Option<(Declared, PathBuf)> {
        let (waiting, path) = self.typed.as_mut()?;
        let [mut taken, mut left] = [false, context.input(|input| input.key_pressed(Key::Escape))];
        let window = Window::new(format!("Path of the {}", waiting.question.sort))
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, vec2(0.0, -60.0));
        window.show(context, |ui| {
            let why =
                "This system shows no file dialog: a desktop portal or the program zenity would.";
            ui.add(
                Label::new(RichText::new(why).small().color(Theme::palette_of(ui).faint)).wrap(),
            );
            let field = ui.add(TextEdit::singleline(path).desired_width(460.0));
            if !field.has_focus() && !field.lost_focus() {
                field.request_focus();
            }
            // A letter and Enter may come in one frame: what is typed by now counts.
            let problem = problem(&waiting.question, path);
            let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            if let Some(problem) = &problem {
                ui.label(RichText::new(problem).color(Theme::palette_of(ui).warning));
            }
            ui.horizontal(|ui| {
                let ready = problem.is_none();
                let purpose = waiting.question.purpose;
                let by_enter = entered && ready && !replaces(purpose, path);
                taken = primary(ui, ready, verb(purpose, path)).clicked() || by_enter;
                left |= ui.button("Cancel").clicked();
            });
        });
        if !taken && !left {
            return None;
        }
        let (waiting, path) = self.typed.take()?;
        taken.then(|| (waiting.command, PathBuf::from(path.trim())))
    }
}

/// Whether a file that is there would be written over: that takes a click on a button that says so.
fn replaces(purpose: FileUse, path: &str) -> bool {
    purpose == FileUse::Write && PathBuf::from(path.trim()).is_file()
}

/// What is done with a path.
fn verb(purpose: FileUse, path: &str) -> &'static str {
    match purpose {
        FileUse::Read | FileUse::Folder => "Open",
        FileUse::Write if replaces(purpose, path) => "Replace this file",
        FileUse::Write => "Save",
    }
}

/// Why a path is none that is asked for.
fn problem(question: &FileQuestion, path: &str) -> Option<String> {
    let path = PathBuf::from(path.trim());
    let folder =
        || path.parent().is_some_and(|folder| folder.as_os_str().is_empty() || folder.is_dir());
    match question.purpose {
        FileUse::Read if !path.is_file() => Some("there is no such file".to_owned()),
        FileUse::Folder if !path.is_dir() => Some("there is no such folder".to_owned()),
        FileUse::Write if path.is_dir() => Some("this is a folder: add a file name".to_owned()),
        FileUse::Write if !folder() => Some("its folder is not there".to_owned()),
        _ => None,
    }
}

/// Shows a dialog and waits for its answer; `None` where the user cancels it.
fn answer(question: FileQuestion) -> Option<PathBuf> {
    let mut dialog = rfd::FileDialog::new();
    if let Some(folder) = &question.folder {
        dialog = dialog.set_directory(folder);
    }
    if !question.file_name.is_empty() {
        dialog = dialog.set_file_name(&question.file_name);
    }
    if !question.extensions.is_empty() {
        dialog = dialog.add_filter(question.sort, question.extensions);
    }
    match question.purpose {
        FileUse::Read => dialog.pick_file(),
        FileUse::Write => dialog.save_file(),
        FileUse::Folder => dialog.pick_folder(),
    }
}

#[cfg(test)]
mod tests {

    use super::*;

    #[test]
    fn a_path_is_told_what_is_wrong_with_it_before_it_is_taken() {
        let folder = std::env::temp_dir();
        let text = |path: PathBuf| path.display().to_string();
        let read = FileQuestion::read("study", &["toml"]);
        assert_eq!(problem(&read, "/no/such.toml").as_deref(), Some("there is no such file"));
        let write = FileQuestion::write("table", &["csv"], String::new());
        assert_eq!(problem(&write, &text(folder.join("new.csv"))), None);
        assert!(problem(&write, &text(folder.clone())).is_some_and(|why| why.contains("folder")));
        assert!(problem(&write, "/no/such/new.csv").is_some());
        let there = std::env::current_exe().unwrap();
        assert_eq!(verb(FileUse::Write, &text(there)), "Replace this file");
        assert_eq!(verb(FileUse::Write, &text(folder.join("new.csv"))), "Save");
        assert_eq!(problem(&FileQuestion::folder("results"), &text(folder)), None);
    }
}
