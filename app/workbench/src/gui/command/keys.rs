//! Keys of the window: shortcuts as egui has them, as they are spelled on screen, and the commands they give.

use egui::{Context, Event, Key, KeyboardShortcut, Modifiers};
use endline_session::command::When;

use crate::gui::command::action::{WindowAction, WindowCommand};
use crate::gui::command::declared;
use crate::gui::fields;
use crate::gui::shared::Shared;

/// A key and the command it gives.
struct Bound {
    key: KeyboardShortcut,
    when: When,
    command: WindowCommand,
}

/// Every key with its command.
fn bound() -> impl Iterator<Item = Bound> {
    declared().filter_map(|info| Some((info, info.plain()?))).flat_map(|(info, command)| {
        info.about().keys.iter().filter_map(move |shortcut| {
            let (key, when) = (to_egui(shortcut.keys)?, shortcut.when);
            Some(Bound { key, when, command: command.clone() })
        })
    })
}

/// Commands given by keys since the last frame.
pub fn commands(context: &Context, shared: &Shared) -> Vec<WindowCommand> {
    if !context.input(|input| input.events.iter().any(|event| matches!(event, Event::Key { .. }))) {
        return Vec::new();
    }
    let typing = context.egui_wants_keyboard_input();
    // A box that was only reached, as the next cell is by Enter, has nothing of its own to undo.
    let untouched = fields::is_untouched(context);
    let holds = |bound: &Bound| match bound.when {
        When::Always => true,
        When::Idle => !typing || (untouched && bound.key.modifiers.command),
        When::NotFlying => !typing && !shared.flying,
        When::Flying => !typing && shared.flying,
    };
    let mut wanted: Vec<Bound> = bound().filter(holds).collect();
    // The one with more modifiers first: Ctrl+Shift+Z is not Ctrl+Z.
    wanted.sort_by_key(|bound| std::cmp::Reverse(count(bound.key.modifiers)));
    // What comes after Ctrl+P in one slow frame is typed into the list of commands.
    let palette = WindowCommand::Window(WindowAction::Palette);
    let palette = wanted.iter().find(|bound| bound.command == palette);
    let palette = palette.and_then(|bound| place(context, bound.key));
    let before = |bound: &Bound| {
        let place = place(context, bound.key);
        palette.is_none_or(|palette| place.is_none_or(|place| place <= palette))
    };
    let wanted: Vec<Bound> = wanted.into_iter().filter(before).collect();
    // Each press counts: in one slow frame there may be several.
    let pressed = |bound: Bound| {
        let KeyboardShortcut { modifiers, logical_key } = bound.key;
        let times = context.input_mut(|input| input.count_and_consume_key(modifiers, logical_key));
        std::iter::repeat_n(bound.command, times)
    };
    wanted.into_iter().flat_map(pressed).collect()
}

/// Where among the events of this frame a key was first pressed.
fn place(context: &Context, shortcut: KeyboardShortcut) -> Option<usize> {
    let pressed = |event: &Event| matches!(event, Event::Key { key, pressed: true, .. } if *key == shortcut.logical_key);
    context.input(|input| input.events.iter().position(pressed))
}

fn count(modifiers: Modifiers) -> u32 {
    [modifiers.shift, modifiers.command, modifiers.ctrl, modifiers.alt]
        .into_iter()
        .map(u32::from)
        .sum()
}

/// A shortcut as egui has it; `None` where a key is not known.
pub fn to_egui(keys: &str) -> Option<KeyboardShortcut> {
    let mut modifiers = Modifiers::NONE;
    let mut rest = keys;
    while let Some((held, more)) = rest.split_once('+').filter(|(_, more)| !more.is_empty()) {
        modifiers = modifiers.plus(match held {
            "Ctrl" => Modifiers::COMMAND,
            "Shift" => Modifiers::SHIFT,
            "Alt" => Modifiers::ALT,
            _ => return None,
        });
        rest = more;
    }
    Key::from_name(rest).map(|key| KeyboardShortcut::new(modifiers, key))
}

/// A shortcut as it is spelled on screen.
pub fn spelled(keys: &str) -> String {
    match keys {
        "Left" => "⏴".to_owned(),
        "Right" => "⏵".to_owned(),
        "-" => "−".to_owned(),
        "Escape" => "Esc".to_owned(),
        other => other.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::mapping::STEERING;

    #[test]
    fn every_shortcut_is_a_key_of_a_plain_command_and_none_is_given_twice() {
        let declared: usize = declared().map(|info| info.about().keys.len()).sum();
        let all: Vec<Bound> = bound().collect();
        assert_eq!(all.len(), declared, "each shortcut is understood, and gives a command");
        for (index, one) in all.iter().enumerate() {
            for other in &all[..index] {
                let twice = one.key == other.key && one.when.overlaps(other.when);
                assert!(!twice, "{} and {}", one.command.id(), other.command.id());
            }
            for steer in STEERING.iter().flat_map(|steer| [Some(steer.more), steer.less]).flatten()
            {
                let plain = one.key.modifiers.is_none() && one.when != When::NotFlying;
                let steers = plain && one.key.logical_key == steer;
                assert!(!steers, "the key of {} steers", one.command.id());
            }
        }
    }
}
