//! Commands that make, start, pause and compare runs, and move in their time.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use endline_sdk::Controls;

use super::info::{Choice, FileQuestion, Make, Shortcut, When};
use super::info::{
    can_apply, can_rerun, compares, earlier_moment, faster, has_moments, is_still, no_errors,
    ready, running, slower,
};
use super::{Command, Info};
use crate::workbench::{Direction, SPEEDS, Workbench};

/// An action on the run.
#[derive(Clone, Debug, PartialEq)]
pub enum RunAction {
    /// Run on; first takes over edited gear.
    Start,
    /// Stand still.
    Pause,
    /// Run where it stands still, pause where it runs, play or stop where an earlier moment is shown.
    Toggle,
    /// Take one step.
    Step,
    /// Back to the settled gear.
    Reset,
    /// Make the model of the texts as they stand.
    Apply,
    /// Simulated seconds for each real one; infinite for as fast as the solver runs.
    Speed(f64),
    /// The next slower speed.
    Slower,
    /// The next faster speed.
    Faster,
    /// Run again up to the moment shown.
    Branch,
    /// Run the inputs up to the moment shown in a new model; then its pilot program steers.
    Rerun,
    /// Keep the run shown to compare with; the texts make a new one.
    Hold,
    /// Run a recording again to compare with.
    CompareWith(PathBuf),
    /// Compare no more.
    EndComparison,
    /// Run a recording again and show it.
    OpenRecording(PathBuf),
    /// Give a kept recording another name.
    RenameRecording {
        /// Its file.
        file: PathBuf,
        /// The name without its ending.
        name: String,
    },
    /// Say something of a kept recording.
    NoteRecording {
        /// Its file.
        file: PathBuf,
        /// What is said.
        note: String,
    },
    /// Take a kept recording out of the list.
    DeleteRecording(PathBuf),
    /// Steer the whale: these controls hold until the next.
    Steer(Controls),
    /// Let the scenario's pilot program steer.
    Autopilot,
}

impl RunAction {
    /// The identity it is declared by.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Start => "run.start",
            Self::Pause => "run.pause",
            Self::Toggle => "run.toggle",
            Self::Step => "run.step",
            Self::Reset => "run.reset",
            Self::Apply => "run.apply",
            Self::Speed(_) => "run.speed",
            Self::Slower => "run.slower",
            Self::Faster => "run.faster",
            Self::Branch => "run.branch",
            Self::Rerun => "run.rerun",
            Self::Hold => "run.hold",
            Self::CompareWith(_) => "run.compare",
            Self::EndComparison => "run.end-comparison",
            Self::OpenRecording(_) => "run.open-recording",
            Self::RenameRecording { .. } => "run.rename-recording",
            Self::NoteRecording { .. } => "run.note-recording",
            Self::DeleteRecording(_) => "run.delete-recording",
            Self::Steer(_) => "run.steer",
            Self::Autopilot => "run.autopilot",
        }
    }
}

/// The actions on the run, declared.
pub static COMMANDS: &[Info] = &[
    Info::new(
        "run.toggle",
        "Run or pause",
        "Runs on from the newest moment, or pauses; where an earlier moment is shown, plays on from there, or stops.",
        Make::Plain(|| Command::Run(RunAction::Toggle)),
    )
    .with_keys(&[Shortcut::with_pad("Space", When::Idle, "Back")])
    .only_if(ready),
    Info::new(
        "run.start",
        "Run",
        "Runs on from the newest moment. Makes the model first where gear or scenario have changed.",
        Make::Plain(|| Command::Run(RunAction::Start)),
    )
    .only_if(ready),
    Info::new(
        "run.pause",
        "Pause",
        "Stops the run where it is.",
        Make::Plain(|| Command::Run(RunAction::Pause)),
    )
    .only_if(running),
    Info::new(
        "run.step",
        "Step",
        "Takes one step of the solver.",
        Make::Plain(|| Command::Run(RunAction::Step)),
    )
    .with_keys(&[Shortcut::new(".", When::Idle)])
    .only_if(is_still),
    Info::new(
        "run.reset",
        "Reset",
        "Goes back to the settled gear. The run so far is kept as a recording.",
        Make::Plain(|| Command::Run(RunAction::Reset)),
    )
    .with_keys(&[Shortcut::with_pad("Backspace", When::Idle, "Start")])
    .only_if(ready),
    Info::new(
        "run.apply",
        "Apply changes",
        "Makes the model of gear and scenario as they are edited now, and goes back to its start.",
        Make::Plain(|| Command::Run(RunAction::Apply)),
    )
    .with_keys(&[Shortcut::new("Ctrl+Enter", When::Always)])
    .only_if(can_apply),
    Info::new(
        "run.speed",
        "Speed",
        "Sets how many simulated seconds pass in a real one.",
        Make::Choices(|_| {
            SPEEDS.iter().map(|speed| Choice::new(speed.name, set_speed(speed.factor))).collect()
        }),
    )
    .only_if(ready),
    Info::new(
        "run.slower",
        "Slower",
        "Chooses the next slower speed.",
        Make::Plain(|| Command::Run(RunAction::Slower)),
    )
    .with_keys(&[Shortcut::new("-", When::Idle)])
    .only_if(slower),
    Info::new(
        "run.faster",
        "Faster",
        "Chooses the next faster speed.",
        Make::Plain(|| Command::Run(RunAction::Faster)),
    )
    .with_keys(&[Shortcut::new("=", When::Idle)])
    .only_if(faster),
    Info::new(
        "run.branch",
        "Continue from the moment shown",
        "Runs the same inputs again up to the moment shown and pauses, so that the run can continue in another way.",
        Make::Plain(|| Command::Run(RunAction::Branch)),
    )
    .only_if(earlier_moment),
    Info::new(
        "run.rerun",
        "Rerun from the moment shown",
        "Makes the model again, runs the same inputs up to the moment shown, then lets the pilot program steer.",
        Make::Plain(|| Command::Run(RunAction::Rerun)),
    )
    .only_if(can_rerun),
    Info::new(
        "run.hold",
        "Hold this run to compare with",
        "Keeps the run shown as B; gear and scenario make a new run A.",
        Make::Plain(|| Command::Run(RunAction::Hold)),
    )
    .only_if(can_hold),
    Info::new(
        "run.compare",
        "Compare with a recording",
        "Runs a recording again as B beside the run shown.",
        Make::File {
            question: recording,
            command: |_, file| Command::Run(RunAction::CompareWith(file)),
        },
    ),
    Info::new(
        "run.end-comparison",
        "End the comparison",
        "Drops the run that the one shown is compared with.",
        Make::Plain(|| Command::Run(RunAction::EndComparison)),
    )
    .only_if(compares),
    Info::new(
        "run.open-recording",
        "Open a recording",
        "Makes the model of a recording and runs its inputs again.",
        Make::File {
            question: recording,
            command: |_, file| Command::Run(RunAction::OpenRecording(file)),
        },
    ),
    Info::new(
        "run.rename-recording",
        "Rename a recording",
        "Gives the file of a kept recording another name.",
        Make::Values("its file and the name"),
    ),
    Info::new(
        "run.note-recording",
        "Note on a recording",
        "Writes what you say of a recording beside it.",
        Make::Values("its file and the note"),
    ),
    Info::new(
        "run.delete-recording",
        "Delete a recording",
        "Moves a kept recording to the folder `deleted` beside it.",
        Make::Values("its file"),
    ),
    Info::new(
        "run.steer",
        "Steer the whale",
        "Sets the controls of the whale until the next are set.",
        Make::Values("controls"),
    )
    .only_if(ready),
    Info::new(
        "run.autopilot",
        "Let the pilot program steer",
        "Gives the controls of the whale back to the scenario's pilot program.",
        Make::Plain(|| Command::Run(RunAction::Autopilot)),
    )
    .only_if(ready),
];

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

fn can_hold(workbench: &Workbench) -> Result<(), String> {
    has_moments(workbench).and_then(|()| no_errors(workbench))
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
