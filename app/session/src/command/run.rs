//! Commands that make, start, pause and compare runs, and move in their time.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use endline_sdk::Controls;
use strum::{EnumDiscriminants, EnumMessage, IntoStaticStr};

use super::info::{
    Choice, FileQuestion, Make, When, earlier_moment, has_moments, no_errors, ready, require,
    running,
};
use super::{Command, Info};
use crate::workbench::{Direction, SPEEDS, Workbench};

/// An action on the run.
#[derive(Clone, Debug, PartialEq, EnumDiscriminants)]
#[strum_discriminants(name(RunVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "run.", serialize_all = "kebab-case"))]
pub enum RunAction {
    /// Runs on from the newest moment. Makes the model first where gear or scenario have changed.
    #[strum_discriminants(strum(message = "Run"))]
    Start,
    /// Stops the run where it is.
    #[strum_discriminants(strum(message = "Pause"))]
    Pause,
    /// Runs on from the newest moment, or pauses; where an earlier moment is shown, plays on from there, or stops.
    #[strum_discriminants(strum(message = "Run or pause"))]
    Toggle,
    /// Takes one step of the solver.
    #[strum_discriminants(strum(message = "Step"))]
    Step,
    /// Goes back to the settled gear. The run so far is kept as a recording.
    #[strum_discriminants(strum(message = "Reset"))]
    Reset,
    /// Makes the model of gear and scenario as they are edited now, and goes back to its start.
    #[strum_discriminants(strum(message = "Apply changes"))]
    Apply,
    // Infinite for as fast as the solver runs.
    /// Sets how many simulated seconds pass in a real one.
    #[strum_discriminants(strum(message = "Speed"))]
    Speed(f64),
    /// Chooses the next slower speed.
    #[strum_discriminants(strum(message = "Slower"))]
    Slower,
    /// Chooses the next faster speed.
    #[strum_discriminants(strum(message = "Faster"))]
    Faster,
    /// Runs the same inputs again up to the moment shown and pauses, so that the run can continue in another way.
    #[strum_discriminants(strum(message = "Continue from the moment shown"))]
    Branch,
    /// Makes the model again, runs the same inputs up to the moment shown, then lets the pilot program steer.
    #[strum_discriminants(strum(message = "Rerun from the moment shown"))]
    Rerun,
    /// Keeps the run shown as B; gear and scenario make a new run A.
    #[strum_discriminants(strum(message = "Hold this run to compare with"))]
    Hold,
    /// Runs a recording again as B beside the run shown.
    #[strum_discriminants(strum(message = "Compare with a recording", serialize = "compare"))]
    CompareWith(PathBuf),
    /// Drops the run that the one shown is compared with.
    #[strum_discriminants(strum(message = "End the comparison"))]
    EndComparison,
    /// Makes the model of a recording and runs its inputs again.
    #[strum_discriminants(strum(message = "Open a recording"))]
    OpenRecording(PathBuf),
    /// Gives the file of a kept recording another name.
    #[strum_discriminants(strum(message = "Rename a recording"))]
    RenameRecording {
        /// Its file.
        file: PathBuf,
        /// The name without its ending.
        name: String,
    },
    /// Writes what you say of a recording beside it.
    #[strum_discriminants(strum(message = "Note on a recording"))]
    NoteRecording {
        /// Its file.
        file: PathBuf,
        /// What is said.
        note: String,
    },
    /// Moves a kept recording to the folder `deleted` beside it.
    #[strum_discriminants(strum(message = "Delete a recording"))]
    DeleteRecording(PathBuf),
    /// Sets the controls of the whale until the next are set.
    #[strum_discriminants(strum(message = "Steer the whale"))]
    Steer(Controls),
    /// Gives the controls of the whale back to the scenario's pilot program.
    #[strum_discriminants(strum(message = "Let the pilot program steer"))]
    Autopilot,
}

/// The actions on the run, declared.
pub(super) fn commands() -> Vec<Info> {
    vec![
        Info::plain(RunAction::Toggle).with_key_and_pad("Space", When::Idle, "Back").only_if(ready),
        Info::plain(RunAction::Start).only_if(ready),
        Info::plain(RunAction::Pause).only_if(running),
        Info::plain(RunAction::Step).with_key(".", When::Idle).only_if(|workbench| {
            ready(workbench)?;
            require(!workbench.running(), "pause the run first")
        }),
        Info::plain(RunAction::Reset)
            .with_key_and_pad("Backspace", When::Idle, "Start")
            .only_if(ready),
        Info::plain(RunAction::Apply).with_key("Ctrl+Enter", When::Always).only_if(|workbench| {
            no_errors(workbench)?;
            require(workbench.stale(), "nothing has changed since the model was made")
        }),
        Info::of(
            RunVerb::Speed,
            Make::Choices(|_| {
                SPEEDS
                    .iter()
                    .map(|speed| Choice::new(speed.name, set_speed(speed.factor)))
                    .collect()
            }),
        )
        .only_if(ready),
        Info::plain(RunAction::Slower).with_key("-", When::Idle).only_if(|workbench| {
            ready(workbench)?;
            let next = workbench.next_speed(Direction::Slower);
            require(next.is_some(), "this is the slowest speed")
        }),
        Info::plain(RunAction::Faster).with_key("=", When::Idle).only_if(|workbench| {
            ready(workbench)?;
            let next = workbench.next_speed(Direction::Faster);
            require(next.is_some(), "this is the fastest speed")
        }),
        Info::plain(RunAction::Branch).only_if(earlier_moment),
        Info::plain(RunAction::Rerun).only_if(|workbench| {
            ready(workbench)?;
            no_errors(workbench)
        }),
        Info::plain(RunAction::Hold).only_if(|workbench| {
            has_moments(workbench)?;
            no_errors(workbench)
        }),
        Info::of(
            RunVerb::CompareWith,
            Make::File {
                question: recording,
                command: |_, file| Command::Run(RunAction::CompareWith(file)),
            },
        ),
        Info::plain(RunAction::EndComparison).only_if(|workbench| {
            require(workbench.comparison().is_some(), "no run is compared with the one shown")
        }),
        Info::of(
            RunVerb::OpenRecording,
            Make::File {
                question: recording,
                command: |_, file| Command::Run(RunAction::OpenRecording(file)),
            },
        ),
        Info::values(RunVerb::RenameRecording, "its file and the name"),
        Info::values(RunVerb::NoteRecording, "its file and the note"),
        Info::values(RunVerb::DeleteRecording, "its file"),
        Info::values(RunVerb::Steer, "controls").only_if(ready),
        Info::plain(RunAction::Autopilot).only_if(ready),
    ]
}

fn set_speed(factor: f64) -> Command {
    Command::Run(RunAction::Speed(factor))
}

fn recording(workbench: &Workbench) -> FileQuestion {
    let question = FileQuestion::read("recording", &["endline"]);
    match workbench.recordings.as_deref() {
        Some(folder) => question.within(folder),
        None => question,
    }
}

/// Dispatches an action.
pub(super) fn perform(workbench: &mut Workbench, action: RunAction) -> Result<(), String> {
    match action {
        RunAction::Start => workbench.start(),
        RunAction::Pause => workbench.pause(),
        RunAction::Toggle => workbench.toggle(),
        RunAction::Step => workbench.step(),
        RunAction::Reset => workbench.reset(),
        RunAction::Apply => workbench.make_model(),
        RunAction::Speed(factor) => workbench.set_speed(factor),
        RunAction::Slower => workbench.change_speed(Direction::Slower),
        RunAction::Faster => workbench.change_speed(Direction::Faster),
        RunAction::Branch => workbench.branch(),
        RunAction::Rerun => workbench.rerun(),
        RunAction::Hold => workbench.hold(),
        RunAction::CompareWith(file) => workbench.compare_with(&file),
        RunAction::EndComparison => workbench.end_comparison(),
        RunAction::OpenRecording(file) => workbench.open_recording(&file),
        RunAction::RenameRecording { file, name } => workbench.rename_recording(&file, &name),
        RunAction::NoteRecording { file, note } => workbench.note_recording(&file, note),
        RunAction::DeleteRecording(file) => workbench.delete_recording(&file),
        RunAction::Steer(controls) => workbench.steer(controls),
        RunAction::Autopilot => workbench.autopilot(),
    }
}
