//! Movement between cells by Enter, up and down, as in a spreadsheet; egui handles Tab.

use egui::{Key, Modifiers, Ui};
use endline_gear::Kind;

use super::rows::Row;
use crate::gui::fields::edit_id;

/// Row and key of the cell that keys move to from the cell with the focus.
pub(super) fn asked(ui: &Ui, kind: Kind, rows: &[Row]) -> Option<(usize, &'static str)> {
    const STEPS: [(Modifiers, Key, isize); 4] = [
        (Modifiers::SHIFT, Key::Enter, -1),
        (Modifiers::NONE, Key::Enter, 1),
        (Modifiers::NONE, Key::ArrowDown, 1),
        (Modifiers::NONE, Key::ArrowUp, -1),
    ];
    let focused = ui.memory(|memory| memory.focused())?;
    // Enter is not consumed, because it commits the cell.
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
