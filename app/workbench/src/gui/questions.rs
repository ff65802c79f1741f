//! Questions to the user: edits to recover after a crash, unsaved edits before closing or opening, files changed on disk, unknown
//! plugins, and the path of a file.
//!
//! A file dialog runs on its own thread, so that the window keeps responding. A system without a desktop portal and without zenity
//! returns immediately without a dialog; the window then asks for the path itself.

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

/// Open questions and their answers.
#[derive(Default)]
pub struct Questions {
    /// Unsaved edits from before a crash, each with its recovery file.
    pub left_behind: Vec<(PathBuf, UnsavedEdits)>,
    /// Scenario to open after the question about unsaved edits of the current one.
    pub opening: Option<PathBuf>,
    /// Whether the question about unsaved edits is shown before closing.
    closing: bool,
    /// Whether the window may close without a question.
    leave: bool,
}

impl Questions {
    /// Starts with unsaved edits from before a crash.
    pub fn new(left_behind: Vec<(PathBuf, UnsavedEdits)>) -> Self {
        Self { left_behind, ..Self::default() }
    }

    /// Shows a bar that offers to recover edits, if a crash left any.
    pub fn recovery(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let Some((file, kept)) = self.left_behind.first().cloned() else { return };
        let here = kept.root == shared.documents().root();
        let palette = Theme::palette_of(ui);
        ui.horizontal(|ui| {
            let count = kept.texts.len();
            let files = if count == 1 { "1 file".to_owned() } else { format!("{count} files") };
            let text =
                format!("Endline did not close normally last time. Unsaved edits of {files} can be recovered.");
            ui.label(RichText::new(text).color(palette.warning))
                .on_hover_text(kept.texts.keys().cloned().collect::<Vec<_>>().join("\n"));
            if here {
                if primary(ui, true, "Recover").on_hover_text("Undo takes it back").clicked() {
                    shared.perform(EditAction::Recover(kept));
                    self.drop_left_behind(&file);
                }
            } else {
                ui.label(
                    RichText::new(format!("They belong to the library {}.", kept.root.display()))
                        .color(palette.faint),
                );
            }
            if ui.button("Discard").clicked() {
                self.drop_left_behind(&file);
            }
        });
    }

    /// Discards edits from before a crash.
    fn drop_left_behind(&mut self, file: &Path) {
        // If the file cannot be removed, the edits are offered again at the next start.
        recovery::forget(file);
        self.left_behind.retain(|(known, _)| known != file);
    }

    /// Asks about unsaved edits before the window closes.
    pub fn before_closing(&mut self, context: &Context, shared: &mut Shared) {
        let wanted = context.input(|input| input.viewport().close_requested());
        let names = unsaved_names(shared.documents());
        let unsaved = names.len();
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
            let faint = Theme::palette_of(ui).faint;
            for name in listed(&names) {
                ui.label(RichText::new(name).color(faint));
            }
            ui.horizontal(|ui| {
                if primary(ui, true, "Save and quit").clicked() {
                    shared.perform(EditAction::Save);
                    self.leave = shared.documents().unsaved().is_empty();
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
            shared.workbench.forget_unsaved();
            context.send_viewport_cmd(egui::ViewportCommand::Close);
        }
    }

    /// Asks about unsaved edits of the scenario before another one is opened.
    pub fn before_opening(&mut self, context: &Context, shared: &mut Shared) {
        let Some(path) = self.opening.clone() else { return };
        let (present, next) = (stem(shared.documents().scenario_path()), stem(&path));
        let window = Window::new("Unsaved scenario")
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, vec2(0.0, -60.0));
        window.show(context, |ui| {
            ui.label(format!("{present} has unsaved edits. Save them before {next} is opened?"));
            ui.horizontal(|ui| {
                let mut open = false;
                if primary(ui, true, "Save and open")
                    .on_hover_text("Saves every file with edits")
                    .clicked()
                {
                    shared.perform(EditAction::Save);
                    open = !shared.documents().is_unsaved(Documents::SCENARIO);
                    self.opening = None;
                }
                open |= ui
                    .button("Open without saving")
                    .on_hover_text("The edits are lost; Undo does not restore them")
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

/// Names of the files with unsaved edits, as they are shown.
pub fn unsaved_names(documents: &Documents) -> Vec<String> {
    documents.unsaved().iter().map(|path| documents.shown_name(path)).collect()
}

/// Maximum number of unsaved files that are named.
const FILES_NAMED: usize = 8;

/// The first names, and the number of the others.
fn listed(names: &[String]) -> Vec<String> {
    let shown = if names.len() > FILES_NAMED { FILES_NAMED - 1 } else { names.len() };
    let more = names.len() - shown;
    let more = (more > 0).then(|| format!("and {more} more"));
    names[..shown].iter().cloned().chain(more).collect()
}

/// Maximum number of lines shown of a file that was changed on disk.
const LINES_SHOWN: usize = 5;

/// Asks which version to keep when a file with edits was also changed on disk.
pub fn newer(context: &Context, shared: &mut Shared) {
    let documents = shared.documents();
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
            Label::new("Another program changed this file after Endline read it. Your edits are not saved yet.")
                .wrap(),
        );
        if !theirs.is_empty() {
            ui.label(RichText::new("New lines on disk").color(Theme::palette_of(ui).faint));
            ui.add(Label::new(RichText::new(theirs.join("\n")).monospace().size(12.0)).truncate());
        }
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            let answers = [
                ("Keep both", Keep::Both, "Saves your edits as a separate file in the same folder"),
                ("Keep mine", Keep::Mine, "Replaces the file on disk by your edits"),
                (
                    "Take theirs",
                    Keep::Theirs,
                    "Replaces your edits by the file on disk; Undo restores them",
                ),
                (
                    "Not now",
                    Keep::Undecided,
                    "The file is not changed, and your edits stay unsaved",
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

/// Asks before a plugin is loaded that is new or has changed since it was allowed.
pub fn plugin(context: &Context, shared: &mut Shared) {
    let Some((file, ask)) = shared.workbench.plugins().asked() else { return };
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
            "This plugin has not been allowed yet."
        } else {
            "This plugin has changed since you allowed it."
        };
        let place = if cfg!(unix) { "in a separate process, but " } else { "" };
        ui.add(
            Label::new(format!(
                "{why} It runs {place}with your rights: allow it only if you trust its author."
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
            if primary(ui, !shared.workbench.plugins().busy(), "Allow")
                .on_hover_text("Checks it in a separate process, then loads it")
                .clicked()
            {
                shared.give(PluginAction::Allow { file: file.clone(), hash: ask.hash.clone() });
            }
            if ui.button("Not now").clicked() {
                shared.workbench.put_off_plugin(&ask);
            }
        });
    });
}

/// An empty answer sooner than this comes from a system without dialogs, not from a user.
const FASTEST_USER: Duration = Duration::from_millis(300);

/// The open file dialog, if any.
#[derive(Default)]
pub struct Dialogs {
    task: Task<Option<PathBuf>>,
    /// Command that waits for its file.
    waiting: Option<Waiting>,
    /// Path being typed, if the system shows no dialog.
    typed: Option<(Waiting, String)>,
}

/// A command with its question for a file.
#[derive(Clone)]
struct Waiting {
    command: Declared,
    question: FileQuestion,
    since: Instant,
}

impl Dialogs {
    /// Opens a dialog for the file of a command.
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

    /// Returns the command and the selected file, once.
    pub fn take(&mut self) -> Option<(Declared, PathBuf)> {
        let answer = self.task.poll()?;
        let waiting = self.waiting.take()?;
        match answer.ok().flatten() {
            Some(file) => Some((waiting.command, file)),
            None => {
                if waiting.since.elapsed() < FASTEST_USER {
                    self.type_instead(waiting);
                }
                None
            }
        }
    }

    /// Asks for the path in the window, with the proposal of the dialog filled in.
    fn type_instead(&mut self, waiting: Waiting) {
        let FileQuestion { folder, file_name, .. } = &waiting.question;
        let folder = folder.clone().or_else(|| std::env::current_dir().ok()).unwrap_or_default();
        let path = folder.join(file_name).display().to_string();
        self.typed = Some((waiting, path));
    }

    /// Whether a dialog is opening or open, or a path is being typed, so that keys give no commands and do not steer.
    pub fn asks(&self) -> bool {
        self.waiting.is_some() || self.typed.is_some()
    }

    /// Draws the question for a path; returns the command and the typed path, once.
    pub fn show(&mut self, context: &Context) -> Option<(Declared, PathBuf)> {
        let (waiting, path) = self.typed.as_mut()?;
        let [mut taken, mut left] = [false, context.input(|input| input.key_pressed(Key::Escape))];
        let window = Window::new(format!("Path of the {}", waiting.question.sort))
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, vec2(0.0, -60.0));
        window.show(context, |ui| {
            let why =
                "This system shows no file dialog. Install a desktop portal or the program zenity to get one.";
            ui.add(
                Label::new(RichText::new(why).small().color(Theme::palette_of(ui).faint)).wrap(),
            );
            let field = ui.add(TextEdit::singleline(path).desired_width(460.0));
            if !field.has_focus() && !field.lost_focus() {
                field.request_focus();
            }
            // A letter and Enter can arrive in one frame, so the current text is checked.
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

/// Whether an existing file would be overwritten. That needs a click on a button that says so, not Enter.
fn replaces(purpose: FileUse, path: &str) -> bool {
    purpose == FileUse::Write && PathBuf::from(path.trim()).is_file()
}

/// Label of the button that confirms a path.
fn verb(purpose: FileUse, path: &str) -> &'static str {
    match purpose {
        FileUse::Read | FileUse::Folder => "Open",
        FileUse::Write if replaces(purpose, path) => "Replace this file",
        FileUse::Write => "Save",
    }
}

/// Why a path cannot be used; `None` if it can.
fn problem(question: &FileQuestion, path: &str) -> Option<String> {
    let path = PathBuf::from(path.trim());
    let folder =
        || path.parent().is_some_and(|folder| folder.as_os_str().is_empty() || folder.is_dir());
    match question.purpose {
        FileUse::Read if !path.is_file() => Some("the file does not exist".to_owned()),
        FileUse::Folder if !path.is_dir() => Some("the folder does not exist".to_owned()),
        FileUse::Write if path.is_dir() => Some("this is a folder; add a file name".to_owned()),
        FileUse::Write if !folder() => Some("the folder of this file does not exist".to_owned()),
        _ => None,
    }
}

/// Shows a dialog and waits; returns `None` if the user cancels.
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
    use crate::gui::command::find;

    #[test]
    fn keys_are_held_back_from_the_opening_of_a_dialog_until_its_answer() {
        let mut dialogs = Dialogs::default();
        assert!(!dialogs.asks());
        let command = find("view.save-picture").unwrap();
        let question = FileQuestion::write("picture", &["png"], "a.png".to_owned());
        let waiting = Waiting { command, question, since: Instant::now() };
        dialogs.waiting = Some(waiting.clone());
        assert!(dialogs.asks(), "its window is not up yet");
        dialogs.waiting = None;
        dialogs.type_instead(waiting);
        assert!(dialogs.asks(), "the path is typed in this window");
    }

    #[test]
    fn unsaved_files_are_named_up_to_a_number() {
        let names = |count: usize| -> Vec<String> {
            (0..count).map(|number| format!("ropes/{number}.toml")).collect()
        };
        assert_eq!(listed(&names(1)), ["ropes/0.toml"]);
        assert_eq!(listed(&names(8)).len(), 8);
        let many = listed(&names(20));
        assert_eq!((many.len(), many[7].as_str()), (8, "and 13 more"));
    }

    #[test]
    fn an_unusable_path_gets_a_reason_before_it_is_confirmed() {
        let folder = std::env::temp_dir();
        let text = |path: PathBuf| path.display().to_string();
        let read = FileQuestion::read("study", &["toml"]);
        assert_eq!(problem(&read, "/no/such.toml").as_deref(), Some("the file does not exist"));
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
