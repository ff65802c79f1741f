//! Shortcuts as egui has them and as they are spelled on screen.

use egui::{Key, KeyboardShortcut, Modifiers};

/// A shortcut as egui has it; `None` where a key is not known.
#[must_use]
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
#[must_use]
pub fn spelled(keys: &str) -> String {
    match keys {
        "Left" => "⏴".to_owned(),
        "Right" => "⏵".to_owned(),
        "-" => "−".to_owned(),
        "Escape" => "Esc".to_owned(),
        other => other.to_owned(),
    }
}
