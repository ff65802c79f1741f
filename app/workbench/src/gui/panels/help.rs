//! Keys and pad, from the tables that bind them.

use egui::{Grid, RichText, ScrollArea, Ui};

use crate::gui::bindings::{BINDINGS, MOUSE, When};
use crate::gui::desk::Desk;
use crate::gui::panel::Panel;
use crate::gui::panel_id::PanelId;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::input::keys::STEERING;

/// The list of keys, and of what the pad does.
#[derive(Debug, Default)]
pub struct HelpPanel;

impl Panel for HelpPanel {
    fn id(&self) -> PanelId {
        PanelId::HELP
    }

    fn ui(&mut self, ui: &mut Ui, _desk: &mut Desk) {
        show(ui);
    }
}

/// Draws the list of keys.
fn show(ui: &mut Ui) {
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        let groups = [("Anywhere", &[When::Always][..]), ("Run", &[When::Idle]), ("Looking", &[When::Looking])];
        for (group, when) in groups {
            let bound = BINDINGS.iter().filter(|binding| when.contains(&binding.when));
            let rows = bound.map(|binding| (binding.what.to_owned(), ui.ctx().format_shortcut(&binding.key), binding.pad.to_owned()));
            let mut rows: Vec<_> = rows.collect();
            if group == "Looking" {
                rows.extend(MOUSE.map(|(what, how)| (what.to_owned(), how.to_owned(), String::new())));
            }
            table(ui, group, &rows);
        }
        table(ui, "Flying", &flying(ui));
        widgets::caption(ui, "Files");
        ui.label(
            "Gear is text in the library's folder: one TOML file an item, values with their unit, such as \"3/8 in\" or \"1700 lbf\".",
        );
    });
}

type Row = (String, String, String);

fn flying(ui: &Ui) -> Vec<Row> {
    let steer =
        STEERING.iter().map(|steer| (steer.what.to_owned(), steer.keys(), steer.pad.to_owned()));
    let bound = BINDINGS.iter().filter(|binding| binding.when == When::Flying);
    let bound = bound.map(|binding| {
        (binding.what.to_owned(), ui.ctx().format_shortcut(&binding.key), binding.pad.to_owned())
    });
    steer.chain(bound).collect()
}

fn table(ui: &mut Ui, group: &str, rows: &[Row]) {
    let palette = Theme::palette_of(ui);
    widgets::caption(ui, group);
    Grid::new(group).num_columns(3).spacing([22.0, 4.0]).min_col_width(120.0).show(ui, |ui| {
        for (action, keys, pad) in rows {
            ui.label(action);
            ui.label(RichText::new(keys).monospace().color(palette.accent));
            ui.label(RichText::new(pad).color(palette.faint));
            ui.end_row();
        }
    });
}
