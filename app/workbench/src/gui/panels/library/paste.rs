//! Cells pasted from the clipboard into the table.

use egui::{Event, Ui};
use endline_session::command::EditAction;
use endline_session::edit::library_table;

use super::LibraryPanel;
use crate::gui::fields;
use crate::gui::shared::Shared;

impl LibraryPanel {
    /// Pastes cells, starting at the cell with the focus, or as entries if there is a header row.
    pub(super) fn paste(&self, ui: &Ui, shared: &mut Shared) {
        let pasted = |event: &Event| matches!(event, Event::Paste(text) if text.trim_end().contains(['\t', '\n']));
        if !ui.input(|input| input.events.iter().any(pasted)) {
            return;
        }
        let (paths, keys) = (self.rows(shared), self.keys());
        let focus = ui.memory(|memory| memory.focused());
        let at = paths.iter().enumerate().find_map(|(row, path)| {
            let edited = |key: &&str| focus == Some(fields::edit_id(path, key));
            Some((row, keys.iter().position(edited)?))
        });
        if at.is_none() && (focus.is_some() || !ui.rect_contains_pointer(ui.max_rect())) {
            return;
        }
        let text = take_pasted(ui);
        let head = library_table::cells(&text).is_ok_and(|cells| {
            cells.first().is_some_and(|row| library_table::is_head(self.kind, row))
        });
        let at = match at {
            _ if head => None,
            Some((row, column)) => {
                fields::forget(ui, &paths[row], keys[column]);
                Some((paths[row..].to_vec(), keys[column..].to_vec()))
            }
            None => {
                let how = "click the first cell of the table, or copy it with its header row";
                return shared.fault(format!("not pasted: {how}"));
            }
        };
        shared.perform(EditAction::Paste { kind: self.kind, cells: text, at });
    }

    /// Keys of the columns after the name, in order.
    fn keys(&self) -> Vec<&'static str> {
        let words = self.kind.words().iter().map(|word| word.key);
        words.chain(self.kind.fields().iter().map(|field| field.key)).collect()
    }
}

/// Removes the pasted text from the events, so that no text field receives it too.
fn take_pasted(ui: &Ui) -> String {
    let mut text = String::new();
    ui.input_mut(|input| {
        input.events.retain(|event| match event {
            Event::Paste(pasted) => {
                text.clone_from(pasted);
                false
            }
            _ => true,
        });
    });
    text
}
