//! Keys and pad.

use egui::{Grid, RichText, ScrollArea, Ui};

use super::super::theme::Theme;

/// An action with its keys and its place on the pad.
type Binding = (&'static str, &'static str, &'static str);

/// What each action is bound to, by group.
const BINDINGS: &[(&str, &[Binding])] = &[
    (
        "Workbench",
        &[
            ("This list", "F1", ""),
            ("Every command by name", "Ctrl+P", ""),
            ("Save all", "Ctrl+S", ""),
            ("Undo, redo an edit", "Ctrl+Z, Ctrl+Shift+Z", ""),
            ("Take over edited gear", "Ctrl+Enter", ""),
            ("Run, pause", "Space", "Back"),
            ("One step", "Period", ""),
            ("Restart", "Backspace", "Start"),
            ("Fly the whale, stop flying", "Ctrl+F, Esc", ""),
        ],
    ),
    (
        "3-D view",
        &[
            ("Orbit", "drag", ""),
            ("Pan", "right drag, or Shift and drag", ""),
            ("Zoom", "wheel", ""),
            ("See everything", "F", ""),
            ("Side, top, front, orbit", "1, 7, 3, 5", ""),
        ],
    ),
    (
        "Flying",
        &[
            ("Swim faster, slower", "W, S", "left trigger"),
            ("Nose up, down", "↑, ↓", "left stick"),
            ("Roll", "←, →", "left stick"),
            ("Turn to port, starboard", "A, D", "right stick"),
            ("Burst", "Shift", "right shoulder"),
            ("Open, close the mouth", "M", "A"),
            ("Flippers in, out", "Q, E", "left shoulder and right stick"),
            ("Flippers twist", "Z, C", "left shoulder and right stick"),
            ("Flippers swept forward, aft", "R, T", "right trigger; aft with left shoulder"),
            ("Choose the next act", "N", "left stick pressed"),
            ("Do the chosen act", "G", "right stick pressed"),
            ("First, third person", "V", "B"),
            ("Weak links on, off", "K", "Y"),
        ],
    ),
];

/// Draws the list of keys.
pub fn show(ui: &mut Ui) {
    let palette = Theme::palette_of(ui);
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        for (group, bindings) in BINDINGS {
            super::caption(ui, group);
            Grid::new(group).num_columns(3).spacing([22.0, 4.0]).min_col_width(120.0).show(ui, |ui| {
                for (action, keys, pad) in *bindings {
                    ui.label(*action);
                    ui.label(RichText::new(*keys).monospace().color(palette.accent));
                    ui.label(RichText::new(*pad).color(palette.faint));
                    ui.end_row();
                }
            });
        }
        super::caption(ui, "Files");
        ui.label(
            "Gear is text in the library's folder: one TOML file an item, values with their unit, such as \"3/8 in\" or \"1700 lbf\".",
        );
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Keys of the workbench and of flying hold at once; those of the view only while nobody flies.
    #[test]
    fn no_key_is_bound_twice() {
        for groups in [["Workbench", "Flying"], ["Workbench", "3-D view"]] {
            let bindings = BINDINGS.iter().filter(|(group, _)| groups.contains(group)).flat_map(|(_, bindings)| *bindings);
            let mut keys: Vec<&str> = bindings.flat_map(|(_, keys, _)| keys.split(", ")).collect();
            let count = keys.len();
            keys.sort_unstable();
            keys.dedup();
            assert_eq!(keys.len(), count, "{keys:?}");
        }
    }
}
