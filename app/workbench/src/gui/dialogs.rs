//! File dialogs. Each runs on a thread of its own, so that the window stays alive.
//!
//! A system without a desktop portal and without zenity shows none: its answer comes at once. The window then asks for the path itself.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Align2, Context, Key, Label, RichText, TextEdit, Window, vec2};
use endline_session::command::{FileQuestion, FileUse};
use endline_session::task::{Task, Waker};

use super::command::Declared;
use super::theme::{Theme, primary};

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
