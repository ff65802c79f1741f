//! Commands that open, run and inspect studies.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use strum::{EnumDiscriminants, EnumMessage, IntoStaticStr};

use super::edit::stem;
use super::info::{Choice, FileQuestion, Make, has_results, require, study_at_work, study_opened};
use super::{Command, Info};
use crate::edit::Documents;
use crate::edit::library_table::id_of;
use crate::locate;
use crate::study::queue::Part;
use crate::workbench::Workbench;

/// An action on studies.
#[derive(Clone, Debug, PartialEq, Eq, EnumDiscriminants)]
#[strum_discriminants(name(StudyVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "study.", serialize_all = "kebab-case"))]
pub enum StudyAction {
    /// Opens a study of the library for editing, and the results it already has.
    #[strum_discriminants(strum(message = "Open study"))]
    Open(PathBuf),
    /// Copies the open study to a file of its own and opens the copy.
    #[strum_discriminants(strum(message = "Duplicate the study"))]
    Duplicate,
    /// Makes the unsaved edits of the scenario and its gear an option of the open study; scenario and gear go back to their files.
    #[strum_discriminants(strum(message = "Add an option from unsaved edits"))]
    OptionFromEdits,
    /// Adds an option to the open study whose gear is another assembly.
    #[strum_discriminants(strum(message = "Add an option with the assembly"))]
    OptionWithAssembly(String),
    /// Runs what is missing of the open study behind everything else on the machine, on the texts as they stand in the window. Saves nothing.
    #[strum_discriminants(strum(message = "Run the study"))]
    Run,
    /// Runs the next twelve encounters of the open study, and forecasts how long the others take. They remain part of the study.
    #[strum_discriminants(strum(message = "Forecast the time of the study"))]
    Forecast,
    /// Pauses the study after the encounters in progress, or resumes it.
    #[strum_discriminants(strum(message = "Pause or resume the study"))]
    Pause,
    /// Takes the study at work out of the queue. Encounters that were run stay.
    #[strum_discriminants(strum(message = "Cancel the study"))]
    Cancel,
    /// Pauses a study of the queue after the encounters in progress, or continues it.
    #[strum_discriminants(strum(message = "Pause or continue a study of the queue"))]
    PauseJob(PathBuf),
    /// Takes a study out of the queue. Encounters that were run stay.
    #[strum_discriminants(strum(message = "Cancel a study of the queue"))]
    CancelJob(PathBuf),
    /// Removes a study that has ended from the list of the queue. Its results stay.
    #[strum_discriminants(strum(message = "Remove a study from the list"))]
    ForgetJob(PathBuf),
    /// Runs studies at ordinary priority, or behind everything else on the machine.
    #[strum_discriminants(strum(message = "Studies at full speed"))]
    FullSpeed(bool),
    /// Shows the results in a folder.
    #[strum_discriminants(strum(message = "Open a study's results", serialize = "results"))]
    ShowResults(PathBuf),
    /// Writes a folder with the report of the results shown, their numbers, and the study, scenario and library that reproduce them.
    #[strum_discriminants(strum(message = "Save the study's bundle"))]
    SaveBundle(PathBuf),
    /// Runs an encounter of the results shown again, up to where it ended in the study.
    #[strum_discriminants(strum(message = "Run an encounter again"))]
    Replay {
        /// Index of the option.
        option: usize,
        /// Index of the encounter.
        encounter: u32,
    },
}

/// The actions on studies, declared.
pub(super) fn commands() -> Vec<Info> {
    vec![
        Info::of(
            StudyVerb::Open,
            Make::Choices(|workbench| {
                locate::studies(workbench.project.documents.root())
                    .into_iter()
                    .map(|path| Choice::new(stem(&path), open(path)))
                    .collect()
            }),
        ),
        Info::new(
            "study.open-file",
            "Open a study's file",
            "Opens a study from any folder.",
            Make::File {
                question: |workbench| {
                    let folder = workbench.project.documents.root().join("studies");
                    FileQuestion::read("study", &["toml"]).within(&folder)
                },
                command: |_, file| open(file),
            },
        ),
        Info::plain(StudyAction::Duplicate).only_if(study_opened),
        Info::plain(StudyAction::OptionFromEdits).only_if(study_opened),
        Info::of(
            StudyVerb::OptionWithAssembly,
            Make::Choices(|workbench| {
                let files = workbench.project.documents.files("assemblies");
                let choice = |id: &str| {
                    Choice::new(id, Command::Study(StudyAction::OptionWithAssembly(id.to_owned())))
                };
                files.map(|file| choice(id_of(file))).collect()
            }),
        )
        .only_if(study_opened),
        Info::plain(StudyAction::Run).only_if(study_can_run),
        Info::plain(StudyAction::Forecast).only_if(study_can_run),
        Info::plain(StudyAction::Pause).only_if(study_at_work),
        Info::plain(StudyAction::Cancel).only_if(study_at_work),
        Info::values(StudyVerb::PauseJob, "its file"),
        Info::values(StudyVerb::CancelJob, "its file"),
        Info::values(StudyVerb::ForgetJob, "its file"),
        Info::values(StudyVerb::FullSpeed, "on or off"),
        Info::of(
            StudyVerb::ShowResults,
            Make::File {
                question: |workbench| {
                    FileQuestion::folder("results of a study").within(&workbench.studies.root())
                },
                command: |_, folder| Command::Study(StudyAction::ShowResults(folder)),
            },
        ),
        Info::of(
            StudyVerb::SaveBundle,
            Make::File {
                question: |_| FileQuestion::folder("folder for the bundle"),
                command: |_, folder| Command::Study(StudyAction::SaveBundle(folder)),
            },
        )
        .only_if(|workbench| {
            has_results(workbench)?;
            let written = workbench.report_shown().is_some();
            require(written, "the report is written when the study has run to its end")
        }),
        Info::values(StudyVerb::Replay, "option, encounter").only_if(has_results),
    ]
}

fn study_can_run(workbench: &Workbench) -> Result<(), String> {
    study_opened(workbench)?;
    require(workbench.study_is_sound(), "study or gear have errors; see Problems")
}

fn open(path: PathBuf) -> Command {
    Command::Study(StudyAction::Open(path))
}

/// Dispatches an action.
pub(super) fn perform(workbench: &mut Workbench, action: StudyAction) -> Result<(), String> {
    match action {
        StudyAction::Open(path) => workbench.open_study(&path),
        StudyAction::Duplicate => workbench.duplicate_study(),
        StudyAction::OptionFromEdits => workbench.add_option(Documents::option_from_edits),
        StudyAction::OptionWithAssembly(id) => {
            workbench.add_option(|documents| documents.option_with_assembly(&id))
        }
        StudyAction::Run => workbench.queue_study(Part::Whole),
        StudyAction::Forecast => workbench.queue_study(Part::Forecast),
        StudyAction::Pause => workbench.pause_study(),
        StudyAction::Cancel => workbench.cancel_study(),
        StudyAction::PauseJob(file) => workbench.pause_job(&file),
        StudyAction::CancelJob(file) => workbench.cancel_job(&file),
        StudyAction::ForgetJob(file) => workbench.forget_job(&file),
        StudyAction::FullSpeed(on) => {
            workbench.studies.queue.normal_priority = on;
            Ok(())
        }
        StudyAction::ShowResults(folder) => workbench.show_results(&folder),
        StudyAction::SaveBundle(folder) => workbench.save_bundle(&folder),
        StudyAction::Replay { option, encounter } => workbench.replay_encounter(option, encounter),
    }
}
