//! From cell to cell with the keys of a spreadsheet: Enter and the arrows up and down; Tab is egui's own.

use egui::{Key, Modifiers, Ui};
use endline_gear::Kind;

use super::rows::Row;
use crate::gui::fields::edit_id;

/// The row and the key of the cell that is asked for while another has the focus; taken from what is typed.
pub(super) fn asked(ui: &Ui, kind: Kind, rows: &[Row]) -> Option<(usize, &'static str)> {
    const STEPS: [(Modifiers, Key, isize); 4] = [
        (Modifiers::SHIFT, Key::Enter, -1),
        (Modifiers::NONE, Key::Enter, 1),
        (Modifiers::NONE, Key::ArrowDown, 1),
        (Modifiers::NONE, Key::ArrowUp, -1),
    ];
    let focused = ui.memory(|memory| memory.focused())?;
    // Enter stays for the cell, which commits by it.
    let pressed = |(modifiers, key, _): &(Modifiers, Key, isize)| {
        ui.input(|input| input.key_pressed(*key) && input.modifiers == *modifiers)
    };
    let (.., step) = STEPS.into_iter().find(pressed)?;
    let keys = kind.words().iter().map(|word| word.key);
    let keys: Vec<_> = keys.chain(kind.fields().iter().map(|field| field.key)).collect();
    let cell = |row: &Row| keys.iter().find(|key| edit_id(&row.path, key) == focused).copied();
    let (row, key) = rows.iter().enumerate().find_map(|(at, row)| Some((at, cell(row)?)))?;
    let next = row.checked_add_signed(step).filter(|next| *next < rows.len())?;
    Some((next, key))
}
