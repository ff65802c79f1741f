//! Commands that write files which others read.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use super::condition::ready;
use super::info::{FileQuestion, Make};
use super::{Command, Info};
use crate::workbench::Workbench;

/// A file to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExportAction {
    /// The run so far as a recording.
    Recording(PathBuf),
}

impl ExportAction {
    /// The identity it is declared by.
    #[must_use]
    pub fn id(&self) -> &'static str {
        match self {
            Self::Recording(_) => "export.recording",
        }
    }
}

/// The files to be written, declared.
pub static COMMANDS: &[Info] = &[Info::new(
    "export.recording",
    "Save the recording",
    "Writes the run so far as a recording, which runs again to the same bits.",
    Make::File {
        question: |workbench| {
            let name = format!("{}.endline", workbench.scenario_stem());
            FileQuestion::write("recording", &["endline"], name)
        },
        command: |_, file| Command::Export(ExportAction::Recording(file)),
    },
)
.only_if(ready)];

/// Dispatches an action.
pub(super) fn perform(workbench: &mut Workbench, action: ExportAction) -> Result<(), String> {
    match action {
        ExportAction::Recording(file) => workbench.save_recording(file),
    }
}
