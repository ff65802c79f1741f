//! Commands that write files which others read.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use endline_gear::Kind;
use strum::{EnumDiscriminants, EnumMessage, IntoStaticStr};

use super::info::{FileQuestion, Make, ready};
use super::{Command, Info};
use crate::export::chart;
use crate::workbench::Workbench;

/// A file to be written.
#[derive(Clone, Debug, PartialEq, Eq, EnumDiscriminants)]
#[strum_discriminants(name(ExportVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "export.", serialize_all = "kebab-case"))]
pub enum ExportAction {
    /// Writes the run so far as a recording, which runs again to the same bits.
    #[strum_discriminants(strum(message = "Save the recording"))]
    Recording(PathBuf),
    /// A table of the library as CSV.
    Table {
        /// The kind of its rows.
        kind: Kind,
        /// Its rows by path, in their order; all of the kind where `None`.
        rows: Option<Vec<String>>,
        /// The file.
        file: PathBuf,
    },
    /// Plots of the run: SVG, PNG or CSV by the file's extension.
    Plots {
        /// Which, in their order.
        kinds: Vec<chart::Kind>,
        /// The file.
        file: PathBuf,
    },
}

/// The files to be written, declared.
pub(super) fn commands() -> Vec<Info> {
    vec![
        Info::of(
            ExportVerb::Recording,
            Make::File {
                question: |workbench| {
                    let name = format!("{}.endline", workbench.scenario_stem());
                    FileQuestion::write("recording", &["endline"], name)
                },
                command: |_, file| Command::Export(ExportAction::Recording(file)),
            },
        )
        .only_if(ready),
    ]
}

/// Dispatches an action.
pub(super) fn perform(workbench: &mut Workbench, action: ExportAction) -> Result<(), String> {
    match action {
        ExportAction::Recording(file) => workbench.save_recording(file),
        ExportAction::Table { kind, rows, file } => workbench.export_table(kind, rows, &file),
        ExportAction::Plots { kinds, file } => workbench.export_plots(&kinds, &file),
    }
}
