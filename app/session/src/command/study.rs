//! Commands that open, run and inspect studies.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use super::edit::stem;
use super::info::{Choice, FileQuestion, Make};
use super::info::{has_report, has_results, study_at_work, study_opened, study_runs};
use super::{Command, Info};
use crate::edit::Documents;
use crate::edit::library_table::id_of;
use crate::locate;
use crate::workbench::Workbench;

/// An action on studies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StudyAction {
    /// Open a study and the results it already has.
    Open(PathBuf),
    /// Open a copy of the open study.
    Duplicate,
    /// Make the unsaved edits of scenario and gear an option of the open study.
    OptionFromEdits,
    /// Add an option of the open study with another assembly, by its id.
    OptionWithAssembly(String),
    /// Run the open study, or continue it.
    Run,
    /// Pause the running study, or resume it.
    Pause,
    /// Take the study at work out of the queue.
    Cancel,
    /// Pause a study of the queue, by its file, or continue it.
    PauseJob(PathBuf),
    /// Take a study out of the queue, by its file; what was run stays.
    CancelJob(PathBuf),
    /// Remove a study that has ended from the list, by its file.
    ForgetJob(PathBuf),
    /// Run studies at ordinary priority, or behind everything else.
    FullSpeed(bool),
    /// Show the results in a folder.
    ShowResults(PathBuf),
    /// Write the files that reproduce the results shown, and their report, into a folder.
    SaveBundle(PathBuf),
    /// Run an encounter of the results shown again.
    Replay {
        /// Index of the option.
        option: usize,
        /// Index of the encounter.
        encounter: u32,
    },
}

impl StudyAction {
    /// The identity it is declared by.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Open(_) => "study.open",
            Self::Duplicate => "study.duplicate",
            Self::OptionFromEdits => "study.option-from-edits",
            Self::OptionWithAssembly(_) => "study.option-with-assembly",
            Self::Run => "study.run",
            Self::Pause => "study.pause",
            Self::Cancel => "study.cancel",
            Self::PauseJob(_) => "study.pause-job",
            Self::CancelJob(_) => "study.cancel-job",
            Self::ForgetJob(_) => "study.forget-job",
            Self::FullSpeed(_) => "study.full-speed",
            Self::ShowResults(_) => "study.results",
            Self::SaveBundle(_) => "study.save-bundle",
            Self::Replay { .. } => "study.replay",
        }
    }
}

/// The actions on studies, declared.
pub static COMMANDS: &[Info] = &[
    Info::new(
        "study.open",
        "Open study",
        "Opens a study of the library for editing, and the results it already has.",
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
    Info::new(
        "study.duplicate",
        "Duplicate the study",
        "Copies the open study to a file of its own and opens the copy.",
        Make::Plain(|| Command::Study(StudyAction::Duplicate)),
    )
    .only_if(study_opened),
    Info::new(
        "study.option-from-edits",
        "Add an option from unsaved edits",
        "Makes the unsaved edits of the scenario and its gear an option of the open study; scenario and gear go back to their files.",
        Make::Plain(|| Command::Study(StudyAction::OptionFromEdits)),
    )
    .only_if(study_opened),
    Info::new(
        "study.option-with-assembly",
        "Add an option with the assembly",
        "Adds an option to the open study whose gear is another assembly.",
        Make::Choices(|workbench| {
            let files = workbench.project.documents.files("assemblies");
            let choice = |id: &str| {
                Choice::new(id, Command::Study(StudyAction::OptionWithAssembly(id.to_owned())))
            };
            files.map(|file| choice(id_of(file))).collect()
        }),
    )
    .only_if(study_opened),
    Info::new(
        "study.run",
        "Run the study",
        "Runs what is missing of the open study behind everything else on the machine, on the texts as they stand in the window. Saves nothing.",
        Make::Plain(|| Command::Study(StudyAction::Run)),
    )
    .only_if(study_runs),
    Info::new(
        "study.pause",
        "Pause or resume the study",
        "Pauses the study after the encounters in progress, or resumes it.",
        Make::Plain(|| Command::Study(StudyAction::Pause)),
    )
    .only_if(study_at_work),
    Info::new(
        "study.cancel",
        "Cancel the study",
        "Takes the study at work out of the queue. Encounters that were run stay.",
        Make::Plain(|| Command::Study(StudyAction::Cancel)),
    )
    .only_if(study_at_work),
    Info::new(
        "study.pause-job",
        "Pause or continue a study of the queue",
        "Pauses a study of the queue after the encounters in progress, or continues it.",
        Make::Values("its file"),
    ),
    Info::new(
        "study.cancel-job",
        "Cancel a study of the queue",
        "Takes a study out of the queue. Encounters that were run stay.",
        Make::Values("its file"),
    ),
    Info::new(
        "study.forget-job",
        "Remove a study from the list",
        "Removes a study that has ended from the list of the queue. Its results stay.",
        Make::Values("its file"),
    ),
    Info::new(
        "study.full-speed",
        "Studies at full speed",
        "Runs studies at ordinary priority, or behind everything else on the machine.",
        Make::Values("on or off"),
    ),
    Info::new(
        "study.results",
        "Open a study's results",
        "Shows the results in a folder.",
        Make::File {
            question: |workbench| {
                FileQuestion::folder("results of a study").within(&workbench.studies.root())
            },
            command: |_, folder| Command::Study(StudyAction::ShowResults(folder)),
        },
    ),
    Info::new(
        "study.save-bundle",
        "Save the study's bundle",
        "Writes a folder with the report of the results shown, their numbers, and the study, scenario and library that reproduce them.",
        Make::File {
            question: |_| FileQuestion::folder("folder for the bundle"),
            command: |_, folder| Command::Study(StudyAction::SaveBundle(folder)),
        },
    )
    .only_if(has_report),
    Info::new(
        "study.replay",
        "Run an encounter again",
        "Runs an encounter of the results shown again, up to where it ended in the study.",
        Make::Values("option, encounter"),
    )
    .only_if(has_results),
];

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
        StudyAction::Run => workbench.queue_study(),
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
