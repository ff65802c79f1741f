//! Buttons that give a declared command.

use egui::{Button, Response, Ui};

use crate::gui::command::action::WindowCommand;
use crate::gui::command::find;
use crate::gui::shared::Shared;

/// A button that gives a command: its help text is the command's, and it is grey with the reason where that does nothing now.
pub fn command(
    ui: &mut Ui,
    shared: &mut Shared,
    text: &str,
    command: impl Into<WindowCommand>,
) -> Response {
    styled(ui, shared, Button::new(text), command)
}

/// A button of any look that gives a command.
pub fn styled(
    ui: &mut Ui,
    shared: &mut Shared,
    button: Button<'_>,
    command: impl Into<WindowCommand>,
) -> Response {
    let command = command.into();
    let declared = find(command.id());
    let enabled = declared.is_none_or(|info| info.enabled(shared).is_ok());
    let hint = declared.map(|info| info.hint(shared)).unwrap_or_default();
    let response = ui.add_enabled(enabled, button);
    let response =
        if enabled { response.on_hover_text(hint) } else { response.on_disabled_hover_text(hint) };
    if response.clicked() {
        shared.give(command);
    }
    response
}
