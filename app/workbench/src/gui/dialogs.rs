//! File dialogs. Each runs on a thread of its own, so that the window stays alive, and answers with an order.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use super::order::Order;

/// What a dialog asks; `None` where the user cancels it.
pub type Question = Box<dyn FnOnce() -> Option<Order> + Send>;

/// The dialog that is open, if any.
#[derive(Default)]
pub struct Dialogs {
    answer: Option<Receiver<Option<Order>>>,
}

impl Dialogs {
    /// Opens a dialog.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub fn ask(&mut self, question: Question) -> Result<(), String> {
        let (sender, receiver) = channel();
        let asked = std::thread::Builder::new().name("endline-dialog".into()).spawn(move || {
            // Nobody waits any more where the window is gone.
            let _ = sender.send(question());
        });
        asked.map_err(|error| format!("the dialog cannot be opened: {error}"))?;
        self.answer = Some(receiver);
        Ok(())
    }

    /// The order that a dialog answered with, once.
    pub fn take(&mut self) -> Option<Order> {
        match self.answer.as_ref()?.try_recv() {
            Ok(order) => {
                self.answer = None;
                order
            }
            Err(TryRecvError::Disconnected) => {
                self.answer = None;
                None
            }
            Err(TryRecvError::Empty) => None,
        }
    }
}

/// Which files a dialog offers: their name in words, and their endings.
#[derive(Clone, Copy)]
pub struct Files {
    name: &'static str,
    endings: &'static [&'static str],
}

/// Scenarios.
pub const SCENARIOS: Files = Files { name: "scenario", endings: &["toml"] };
/// Studies.
pub const STUDIES: Files = Files { name: "study", endings: &["toml"] };
/// Recordings.
pub const RECORDINGS: Files = Files { name: "recording", endings: &["endline"] };
/// Tables of a spreadsheet.
pub const TABLES: Files = Files { name: "table", endings: &["csv", "tsv", "txt"] };

/// Asks for a file to open.
#[must_use]
pub fn open(folder: &Path, files: Files, order: fn(PathBuf) -> Order) -> Question {
    let folder = folder.to_owned();
    Box::new(move || {
        let dialog = rfd::FileDialog::new().set_directory(folder);
        dialog.add_filter(files.name, files.endings).pick_file().map(order)
    })
}

/// Asks for a folder.
#[must_use]
pub fn open_folder(folder: &Path, order: fn(PathBuf) -> Order) -> Question {
    let folder = folder.to_owned();
    Box::new(move || rfd::FileDialog::new().set_directory(folder).pick_folder().map(order))
}

/// Asks where to write a file of an ending; `name` is offered without it.
#[must_use]
pub fn save(name: &str, ending: &'static str, order: fn(PathBuf) -> Order) -> Question {
    let name = format!("{name}.{ending}");
    Box::new(move || {
        let dialog = rfd::FileDialog::new().set_file_name(name);
        dialog.add_filter(ending, &[ending]).save_file().map(order)
    })
}

/// Asks where to write a copy of a file; a name beside it is offered.
#[must_use]
pub fn save_beside(path: &Path, files: Files, order: fn(PathBuf) -> Order) -> Question {
    let folder = path.parent().map(Path::to_owned).unwrap_or_default();
    let name = format!("{}-2.toml", super::files::stem(path));
    Box::new(move || {
        let dialog = rfd::FileDialog::new().set_directory(folder).set_file_name(name);
        dialog.add_filter(files.name, files.endings).save_file().map(order)
    })
}
