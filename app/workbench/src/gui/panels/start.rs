//! Where a user begins: what was open last, and the examples in their own words.

use crate::gui::command::action::PanelAction;
use endline_session::command::EditAction;
use std::path::{Path, PathBuf};

use egui::{RichText, ScrollArea, Ui};
use endline_session::units::Units;

use crate::gui::files;
use crate::gui::panel::Panel;
use crate::gui::panel_id::PanelId;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;

/// A scenario as the start page shows it.
#[derive(Clone, Debug)]
struct Example {
    path: PathBuf,
    name: String,
    notes: String,
    whale: bool,
}

/// Where a user begins; the examples of the library are read when the page is first shown.
#[derive(Debug, Default)]
pub struct StartPanel {
    examples: Option<Vec<Example>>,
}

impl Panel for StartPanel {
    fn id(&self) -> PanelId {
        PanelId::START
    }

    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let all = self
            .examples
            .get_or_insert_with(|| examples(shared.workbench.project.documents.root()));
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.heading("Endline");
            ui.label("Fishing gear, and whales that get out of it alive.");
            ui.add_space(6.0);
            units(ui, shared);
            recent(ui, shared);
            widgets::caption(ui, "Whales meeting gear");
            list(ui, shared, all.iter().filter(|example| example.whale));
            widgets::caption(ui, "Gear alone, and checks of the physics");
            list(ui, shared, all.iter().filter(|example| !example.whale));
        });
    }
}

fn units(ui: &mut Ui, shared: &mut Shared) {
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Units on screen").color(Theme::palette_of(ui).faint));
        for units in Units::ALL {
            ui.radio_value(&mut shared.workbench.preferences.units, units, units.name())
                .on_hover_text(units.help());
        }
    });
}

fn recent(ui: &mut Ui, shared: &mut Shared) {
    let recent: Vec<PathBuf> =
        shared.workbench.preferences.recent.iter().filter(|path| path.exists()).cloned().collect();
    if recent.is_empty() {
        return;
    }
    widgets::caption(ui, "Last open");
    for path in recent {
        if ui.link(path.display().to_string()).clicked() {
            open(shared, &path);
        }
    }
}

fn open(shared: &mut Shared, path: &Path) {
    shared.give(EditAction::OpenScenario(path.to_owned()));
    shared.give(PanelAction::Show(PanelId::VIEW));
}

fn list<'a>(ui: &mut Ui, shared: &mut Shared, examples: impl Iterator<Item = &'a Example>) {
    let faint = Theme::palette_of(ui).faint;
    for example in examples {
        if ui.link(&example.name).on_hover_text(example.path.display().to_string()).clicked() {
            open(shared, &example.path);
        }
        ui.indent(&example.path, |ui| {
            ui.add(egui::Label::new(RichText::new(&example.notes).color(faint)).wrap())
        });
    }
}

fn examples(root: &Path) -> Vec<Example> {
    let read = |path: PathBuf| {
        let document =
            endline_gear::Document::parse(&endline_gear::read::text(&path).ok()?).ok()?;
        let text = |field: &str| document.get(field).unwrap_or_default();
        Some(Example {
            name: text("name"),
            notes: text("notes"),
            whale: document.has("whale"),
            path,
        })
    };
    let mut examples: Vec<Example> = files::scenarios(root).into_iter().filter_map(read).collect();
    // Whoever is new begins with the plainest.
    examples.sort_by_key(|example| !files::stem(&example.path).starts_with("hello-"));
    examples
}
