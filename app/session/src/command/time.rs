//! Commands that show another moment of the run.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use strum::{EnumDiscriminants, EnumMessage, IntoStaticStr};

use super::Info;
use super::info::{When, earlier_moment, has_moments, require};
use crate::workbench::Workbench;

/// An action on the moment shown.
#[derive(Clone, Debug, PartialEq, EnumDiscriminants)]
#[strum_discriminants(name(TimeVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "time.", serialize_all = "kebab-case"))]
pub enum TimeAction {
    /// Shows the start of the run.
    #[strum_discriminants(strum(message = "First moment"))]
    First,
    /// Shows the end of the run so far.
    #[strum_discriminants(strum(message = "Newest moment"))]
    Newest,
    /// Shows the kept moment before the one shown.
    #[strum_discriminants(strum(message = "One moment back"))]
    Back,
    /// Shows the kept moment after the one shown.
    #[strum_discriminants(strum(message = "One moment on"))]
    Forward,
    /// Shows the kept moment nearest to a time.
    #[strum_discriminants(strum(message = "Show a moment"))]
    Seek(f64),
    /// Plays from the moment shown on at the chosen speed, from the start where that is the newest; or stops.
    #[strum_discriminants(strum(message = "Play what was run"))]
    Replay,
}

/// The actions on the moment shown, declared.
pub(super) fn commands() -> Vec<Info> {
    vec![
        Info::plain(TimeAction::First).with_key("Home", When::Idle).only_if(has_moments),
        Info::plain(TimeAction::Newest).with_key("End", When::Idle).only_if(earlier_moment),
        Info::plain(TimeAction::Back).with_key("Left", When::NotFlying).only_if(has_moments),
        Info::plain(TimeAction::Forward).with_key("Right", When::NotFlying).only_if(earlier_moment),
        Info::values(TimeVerb::Seek, "time in seconds").only_if(has_moments),
        Info::plain(TimeAction::Replay).with_key("P", When::Idle).only_if(|workbench| {
            has_moments(workbench)?;
            require(workbench.replaying() || !workbench.running(), "pause the run first")
        }),
    ]
}

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
