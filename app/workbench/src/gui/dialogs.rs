//! File dialogs. Each runs on a thread of its own, so that the window stays alive.

use std::path::PathBuf;
use std::sync::Arc;

use endline_session::command::{FileQuestion, FileUse};
use endline_session::task::{Task, Waker};

use super::command::Declared;

/// The dialog that is open, if any.
#[derive(Default)]
pub struct Dialogs {
    task: Task<Option<PathBuf>>,
    /// The command that waits for its file.
    waiting: Option<Declared>,
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
        let asked = self.task.start("endline-dialog", move || answer(question), Arc::clone(waker));
        asked.map_err(|error| format!("the dialog cannot be opened: {error}"))?;
        self.waiting = Some(command);
        Ok(())
    }

    /// The command and the file that a dialog answered with, once.
    pub fn take(&mut self) -> Option<(Declared, PathBuf)> {
        let answer = self.task.poll()?;
        let command = self.waiting.take()?;
        // A dialog that was cancelled, or broke, gives no file.
        answer.ok().flatten().map(|file| (command, file))
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
