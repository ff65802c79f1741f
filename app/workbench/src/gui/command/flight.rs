//! Commands of the pilot.

use endline_session::command::{Choice, Make, Shortcut, When};

use super::WindowInfo;
use super::action::FlightAction;
use super::view::shown;
use crate::gui::shared::Shared;

/// The actions of the pilot, declared.
pub static COMMANDS: &[WindowInfo] = &[
    WindowInfo::new(
        "flight.toggle",
        "Fly the whale, or stop",
        "Gives the controls of the whale to keys and game controller, or back to the pilot program.",
        Make::Plain(|| FlightAction::Toggle.into()),
    )
    .with_keys(&[Shortcut::new("Ctrl+F", When::Always), Shortcut::new("Escape", When::Flying)])
    .only_if(shown),
    WindowInfo::new(
        "flight.person",
        "First or third person",
        "Looks through the whale's eyes, or from behind it.",
        Make::Plain(|| FlightAction::Person.into()),
    )
    .with_keys(&[Shortcut::with_pad("V", When::Flying, "B")]),
    WindowInfo::new(
        "flight.next-act",
        "Next act of the whale",
        "Chooses the next act of the whale's motion.",
        Make::Plain(|| FlightAction::NextAct.into()),
    )
    .with_keys(&[Shortcut::with_pad("N", When::Flying, "left stick pressed")])
    .only_if(has_acts),
    WindowInfo::new(
        "flight.act",
        "Act",
        "Chooses an act of the whale's motion.",
        Make::Choices(|shared| {
            let acts = shared.workbench.acts().iter().enumerate();
            acts.map(|(index, act)| {
                Choice::new(act.name.to_string(), FlightAction::ChooseAct(index).into())
            })
            .collect()
        }),
    )
    .only_if(has_acts),
    WindowInfo::new(
        "flight.mouth",
        "Open or close the mouth",
        "Opens the mouth of the whale that is flown, or shuts it.",
        Make::Plain(|| FlightAction::Mouth.into()),
    )
    .with_keys(&[Shortcut::with_pad("M", When::Flying, "A")])
    .only_if(flying),
];

fn has_acts(shared: &Shared) -> Result<(), String> {
    let acts = shared.workbench.acts();
    if acts.is_empty() { Err("the whale's motion has no acts".to_owned()) } else { Ok(()) }
}

fn flying(shared: &Shared) -> Result<(), String> {
    if shared.flying { Ok(()) } else { Err("fly the whale first".to_owned()) }
}
