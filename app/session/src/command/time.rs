//! Commands that show another moment of the run.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use super::info::{Make, Shortcut, When};
use super::info::{can_replay, earlier_moment, has_moments};
use super::{Command, Info};
use crate::workbench::Workbench;

/// An action on the moment shown.
#[derive(Clone, Debug, PartialEq)]
pub enum TimeAction {
    /// Show the first moment.
    First,
    /// Show the newest moment.
    Newest,
    /// Show the kept moment before the one shown.
    Back,
    /// Show the kept moment after the one shown.
    Forward,
    /// Show the kept moment nearest to a time [s].
    Seek(f64),
    /// Play from the moment shown on, or stop.
    Replay,
}

impl TimeAction {
    /// The identity it is declared by.
    pub fn id(&self) -> &'static str {
        match self {
            Self::First => "time.first",
            Self::Newest => "time.newest",
            Self::Back => "time.back",
            Self::Forward => "time.forward",
            Self::Seek(_) => "time.seek",
            Self::Replay => "time.replay",
        }
    }
}

/// The actions on the moment shown, declared.
pub static COMMANDS: &[Info] = &[
    Info::new(
        "time.first",
        "First moment",
        "Shows the start of the run.",
        Make::Plain(|| Command::Time(TimeAction::First)),
    )
    .with_keys(&[Shortcut::new("Home", When::Idle)])
    .only_if(has_moments),
    Info::new(
        "time.newest",
        "Newest moment",
        "Shows the end of the run so far.",
        Make::Plain(|| Command::Time(TimeAction::Newest)),
    )
    .with_keys(&[Shortcut::new("End", When::Idle)])
    .only_if(earlier_moment),
    Info::new(
        "time.back",
        "One moment back",
        "Shows the kept moment before the one shown.",
        Make::Plain(|| Command::Time(TimeAction::Back)),
    )
    .with_keys(&[Shortcut::new("Left", When::NotFlying)])
    .only_if(has_moments),
    Info::new(
        "time.forward",
        "One moment on",
        "Shows the kept moment after the one shown.",
        Make::Plain(|| Command::Time(TimeAction::Forward)),
    )
    .with_keys(&[Shortcut::new("Right", When::NotFlying)])
    .only_if(earlier_moment),
    Info::new(
        "time.seek",
        "Show a moment",
        "Shows the kept moment nearest to a time.",
        Make::Values("time in seconds"),
    )
    .only_if(has_moments),
    Info::new(
        "time.replay",
        "Play what was run",
        "Plays from the moment shown on at the chosen speed, from the start where that is the newest; or stops.",
        Make::Plain(|| Command::Time(TimeAction::Replay)),
    )
    .with_keys(&[Shortcut::new("P", When::Idle)])
    .only_if(can_replay),
];

/// Dispatches an action.
pub(super) fn perform(workbench: &mut Workbench, action: TimeAction) -> Result<(), String> {
    match action {
        TimeAction::First => workbench.seek(0.0),
        TimeAction::Newest => workbench.seek(f64::MAX),
        TimeAction::Back => workbench.shift(-1),
        TimeAction::Forward => workbench.shift(1),
        TimeAction::Seek(time_s) => workbench.seek(time_s),
        TimeAction::Replay => workbench.replay(),
    }
}
