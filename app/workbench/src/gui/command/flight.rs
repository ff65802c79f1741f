//! Commands of the pilot.

use endline_session::command::info::require;
use endline_session::command::{Choice, Make, When};

use super::WindowInfo;
use super::action::{FlightAction, FlightVerb};
use super::view::shown;
use crate::gui::shared::Shared;

/// The actions of the pilot, declared.
pub(super) fn commands() -> Vec<WindowInfo> {
    vec![
        WindowInfo::plain(FlightAction::Toggle)
            .with_key("Ctrl+F", When::Always)
            .with_key("Escape", When::Flying)
            .only_if(shown),
        WindowInfo::plain(FlightAction::Person).with_key_and_pad("V", When::Flying, "B"),
        WindowInfo::plain(FlightAction::NextAct)
            .with_key_and_pad("N", When::Flying, "left stick pressed")
            .only_if(has_acts),
        WindowInfo::of(
            FlightVerb::ChooseAct,
            Make::Choices(|shared| {
                let acts = shared.workbench.acts().iter().enumerate();
                acts.map(|(index, act)| {
                    Choice::new(act.name.to_string(), FlightAction::ChooseAct(index).into())
                })
                .collect()
            }),
        )
        .only_if(has_acts),
        WindowInfo::plain(FlightAction::Mouth)
            .with_key_and_pad("M", When::Flying, "A")
            .only_if(flying),
    ]
}

fn has_acts(shared: &Shared) -> Result<(), String> {
    let acts = shared.workbench.acts();
    require(!acts.is_empty(), "the whale's motion has no acts")
}

fn flying(shared: &Shared) -> Result<(), String> {
    require(shared.flying, "fly the whale first")
}
