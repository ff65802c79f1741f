//! Keys, mouse and game controller, from the tables that declare them; which Endline this is, and its documents.

use std::fmt::Write;

use egui::{Grid, RichText, ScrollArea, Ui};
use endline_session::command::When;

use super::about;
use crate::gui::command::{declared, spelled};
use crate::gui::panel::{Panel, PanelId};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::input::mapping::STEERING;

/// What the mouse does in the 3-D view.
pub const MOUSE: [(&str, &str); 4] = [
    ("Read a rope, body or the skin", "click"),
    ("Orbit", "drag"),
    ("Pan", "right drag, or Shift and drag"),
    ("Zoom", "wheel"),
];

/// The list of keys, and of what the pad does.
#[derive(Debug, Default)]
pub struct HelpPanel;

impl Panel for HelpPanel {
    fn id(&self) -> PanelId {
        PanelId::HELP
    }

    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        ScrollArea::both().auto_shrink(false).show(ui, |ui| {
            about::show(ui, shared);
            widgets::caption(ui, "Files");
            ui.label("Gear is text in the library's folder: one TOML file an item, values with their unit, such as \"3/8 in\" or \"1700 lbf\".");
            for when in When::ALL {
                table(ui, when.title(), &keys(when));
            }
        });
    }
}

/// A key: what it does, how it is spelled, and the button of the game controller that does the same.
pub struct Row {
    /// What it does.
    pub what: String,
    /// The keys, or what the mouse does.
    pub keys: String,
    /// The button of the game controller; empty where none does.
    pub pad: &'static str,
}

/// The keys that hold at a time.
#[must_use]
pub fn keys(when: When) -> Vec<Row> {
    let steering = STEERING.iter().filter(|_| when == When::Flying);
    let mut rows: Vec<Row> = steering
        .map(|steer| Row { what: steer.what.to_owned(), keys: steer.keys(), pad: steer.pad })
        .collect();
    for command in declared() {
        let held = command.keys().iter().filter(|shortcut| shortcut.when == when);
        rows.extend(held.map(|shortcut| Row {
            what: command.name().to_owned(),
            keys: spelled(shortcut.keys),
            pad: shortcut.pad,
        }));
    }
    if when == When::NotFlying {
        rows.extend(MOUSE.map(|(what, how)| Row {
            what: what.to_owned(),
            keys: how.to_owned(),
            pad: "",
        }));
    }
    rows
}

/// Every command with its keys, and every key, as Markdown: what `docs/workbench.md` has.
#[must_use]
pub fn markdown() -> String {
    let mut text = String::new();
    // Writing to a text cannot fail.
    let _ = commands(&mut text).and_then(|()| steering(&mut text));
    text
}

fn commands(text: &mut String) -> std::fmt::Result {
    for (title, commands) in crate::gui::command::groups() {
        writeln!(
            text,
            "\n### {title}\n\n| command | id | keys | what it does |\n|---|---|---|---|"
        )?;
        for command in commands {
            let keys =
                command.keys().iter().map(|shortcut| format!("`{}`", spelled(shortcut.keys)));
            let (keys, help) = (keys.collect::<Vec<_>>().join(", "), command.help());
            writeln!(text, "| {} | `{}` | {keys} | {help} |", command.name(), command.id())?;
        }
    }
    Ok(())
}

fn steering(text: &mut String) -> std::fmt::Result {
    writeln!(text, "\n### Steering\n\n| what | keys | game controller |\n|---|---|---|")?;
    for row in keys(When::Flying) {
        writeln!(text, "| {} | `{}` | {} |", row.what, row.keys, row.pad)?;
    }
    Ok(())
}

fn table(ui: &mut Ui, group: &str, rows: &[Row]) {
    let palette = Theme::palette_of(ui);
    widgets::caption(ui, group);
    Grid::new(group).num_columns(3).spacing([22.0, 4.0]).min_col_width(120.0).show(ui, |ui| {
        for row in rows {
            ui.label(&row.what);
            ui.label(RichText::new(&row.keys).monospace().color(palette.accent));
            ui.label(RichText::new(row.pad).color(palette.faint));
            ui.end_row();
        }
    });
}
