//! Where a user begins: what was open last, and the examples in their own words.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{RichText, ScrollArea, Ui};
use endline_session::units::Units;

use super::super::desk::{Desk, Order};
use super::super::layout::Panel;
use super::super::theme::Theme;

/// A scenario as the start page shows it.
#[derive(Clone, Debug)]
struct Example {
    path: PathBuf,
    name: String,
    notes: String,
    whale: bool,
}

/// The examples of a library, read when the page is first shown.
#[derive(Clone, Debug, Default)]
pub struct StartState {
    examples: Option<Arc<[Example]>>,
}

/// Draws the start page.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    let examples =
        desk.start.examples.get_or_insert_with(|| examples(desk.documents.root()).into()).clone();
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.heading("Endline");
        ui.label("Fishing gear, and whales that get out of it alive.");
        ui.add_space(6.0);
        units(ui, desk);
        recent(ui, desk);
        super::caption(ui, "Whales meeting gear");
        list(ui, desk, examples.iter().filter(|example| example.whale));
        super::caption(ui, "Gear alone, and checks of the physics");
        list(ui, desk, examples.iter().filter(|example| !example.whale));
    });
}

fn units(ui: &mut Ui, desk: &mut Desk) {
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Units on screen").color(Theme::palette_of(ui).faint));
        for units in Units::ALL {
            ui.radio_value(&mut desk.preferences.units, units, units.name())
                .on_hover_text(units.help());
        }
    });
}

fn recent(ui: &mut Ui, desk: &mut Desk) {
    let recent: Vec<PathBuf> =
        desk.preferences.recent.iter().filter(|path| path.exists()).cloned().collect();
    if recent.is_empty() {
        return;
    }
    super::caption(ui, "Last open");
    for path in recent {
        if ui.link(path.display().to_string()).clicked() {
            open(desk, &path);
        }
    }
}

fn open(desk: &mut Desk, path: &Path) {
    desk.orders.push(Order::Open(path.to_owned()));
    desk.orders.push(Order::Show(Panel::View));
}

fn list<'a>(ui: &mut Ui, desk: &mut Desk, examples: impl Iterator<Item = &'a Example>) {
    let faint = Theme::palette_of(ui).faint;
    for example in examples {
        if ui.link(&example.name).on_hover_text(example.path.display().to_string()).clicked() {
            open(desk, &example.path);
        }
        ui.indent(&example.path, |ui| {
            ui.add(egui::Label::new(RichText::new(&example.notes).color(faint)).wrap())
        });
    }
}

fn examples(root: &Path) -> Vec<Example> {
    let read = |path: PathBuf| {
        let document = endline_gear::Document::parse(&std::fs::read_to_string(&path).ok()?).ok()?;
        let text = |field: &str| document.get(field).unwrap_or_default();
        Some(Example {
            name: text("name"),
            notes: text("notes"),
            whale: document.has("whale"),
            path,
        })
    };
    let mut examples: Vec<Example> =
        super::scenario::scenarios(root).into_iter().filter_map(read).collect();
    // Whoever is new begins with the plainest.
    examples.sort_by_key(|example| {
        !example.path.file_stem().is_some_and(|stem| stem.to_string_lossy().starts_with("hello-"))
    });
    examples
}
