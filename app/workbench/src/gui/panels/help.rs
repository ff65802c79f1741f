//! Keys, mouse and pad, from the tables that declare them; version and documents.

use std::fmt::Write;

use egui::{Grid, RichText, ScrollArea, Ui};
use endline_session::VERSION;
use endline_session::command::{About, When};

use crate::documents;
use crate::gui::command::action::WindowAction;
use crate::gui::command::{declared, spelled};
use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::input::mapping::STEERING;

/// Actions of the mouse in the 3-D view.
pub const MOUSE: [(&str, &str); 4] = [
    ("Read a rope, body or the skin", "click"),
    ("Orbit", "drag"),
    ("Pan", "right drag, or Shift and drag"),
    ("Zoom", "wheel"),
];

/// Address of the repository.
const REPOSITORY: &str = env!("CARGO_PKG_REPOSITORY");

/// The panel of keys and help.
#[derive(Debug, Default)]
pub struct HelpPanel;

impl Panel for HelpPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        ScrollArea::both().auto_shrink(false).show(ui, |ui| {
            for when in When::ALL.iter().copied() {
                table(ui, when.title(), &keys(when));
            }
            widgets::caption(ui, "Files");
            ui.label("Gear is text in the folder of the library: one TOML file per item, with values such as \"3/8 in\" or \"1700 lbf\".");
            about(ui, shared);
        });
    }
}

/// A key: its function, its name, and the control of the pad with the same function.
pub struct Row {
    /// Function.
    pub what: String,
    /// Keys, or action of the mouse.
    pub keys: String,
    /// Control of the pad; empty if there is none.
    pub pad: &'static str,
}

/// Keys that apply in a situation.
pub fn keys(when: When) -> Vec<Row> {
    let steering = STEERING.iter().filter(|_| when == When::Flying);
    let mut rows: Vec<Row> = steering
        .map(|steer| Row { what: steer.what.to_owned(), keys: steer.keys(), pad: steer.pad })
        .collect();
    for command in declared() {
        let held = command.about().keys.iter().filter(|shortcut| shortcut.when == when);
        rows.extend(held.map(|shortcut| Row {
            what: command.about().name.to_owned(),
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

/// All commands and keys as Markdown, for `docs/workbench.md`.
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
            let About { id, name, help, keys } = command.about();
            let keys = keys.iter().map(|shortcut| format!("`{}`", spelled(shortcut.keys)));
            let keys = keys.collect::<Vec<_>>().join(", ");
            writeln!(text, "| {name} | `{id}` | {keys} | {help} |")?;
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

/// Draws version, licence, citation and documents.
fn about(ui: &mut Ui, shared: &mut Shared) {
    let faint = Theme::palette_of(ui).faint;
    widgets::caption(ui, "About");
    let rows = [
        ("Version", VERSION.to_owned()),
        ("Licence", format!("{}, at your choice", env!("CARGO_PKG_LICENSE"))),
        ("Library", shared.workbench.project().documents.root().display().to_string()),
    ];
    widgets::numbers(ui, "about", &rows);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(citation()).color(faint));
        if ui.small_button("Copy").on_hover_text("Copies the citation").clicked() {
            ui.ctx().copy_text(citation());
        }
    });
    for group in documents::groups() {
        widgets::caption(ui, group.title);
        ui.horizontal_wrapped(|ui| {
            for document in &group.documents {
                if ui.link(document.title).on_hover_text(document.contents).clicked() {
                    shared.give(WindowAction::Read(*document));
                }
                ui.add_space(14.0);
            }
        });
    }
}

/// Year of this version.
const YEAR: u16 = 2026;

/// Citation of this version in a paper; `CITATION.cff` has the same fields.
fn citation() -> String {
    format!(
        "The Endline authors ({YEAR}). Endline {VERSION}: a workbench for fishing gear that entangled whales can escape from. Computer program. {REPOSITORY}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_citation_names_version_and_place() {
        assert!(citation().contains(VERSION) && citation().ends_with(REPOSITORY));
        let file = include_str!("../../../../../CITATION.cff");
        for field in [format!("version: {}", env!("CARGO_PKG_VERSION")), REPOSITORY.to_owned()] {
            assert!(file.contains(&field), "CITATION.cff has no {field}");
        }
        assert!(REPOSITORY.starts_with("https://"), "{REPOSITORY}");
    }
}
