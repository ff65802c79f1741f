//! The start page: three purposes, recent files, and all items of the library, with a search.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use egui::{
    Align, CollapsingHeader, Frame, Label, Layout as Flow, RichText, ScrollArea, Sense, TextEdit,
    Ui, vec2,
};
use endline_session::command::{EditAction, SearchAction, StudyAction};
use endline_session::units::Units;
use item::{Group, Item};
pub use item::{What, listed as files_by_subject};

use crate::gui::command::action::{FlightAction, PanelAction, WindowAction};
use crate::gui::layout::Layout;
use crate::gui::panel::{Panel, PanelId};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::{files, widgets};

mod item;
mod sketch;

/// Width of a column of items [points].
const COLUMN: f32 = 400.0;

/// Interval between checks for new and deleted files.
const CHECK_INTERVAL: Duration = Duration::from_secs(1);

/// The start page. The library is read when the page is first shown, and again when the number of files has changed.
#[derive(Debug, Default)]
pub struct StartPanel {
    items: Option<(usize, Vec<Item>)>,
    /// Files and names of recent scenarios.
    recent: Vec<(PathBuf, String)>,
    checked: Option<Instant>,
    search: String,
}

impl Panel for StartPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let root = shared.documents().root().to_owned();
        if self.checked.is_none_or(|checked| checked.elapsed() > CHECK_INTERVAL) {
            self.checked = Some(Instant::now());
            let count = item::count(&root);
            if self.items.as_ref().is_none_or(|(seen, _)| *seen != count) {
                self.items = Some((count, item::all(&root)));
            }
            let recent = &shared.workbench.preferences().recent;
            let named = |path: &PathBuf| {
                let name = files::name_of(path).unwrap_or_else(|| files::stem(path));
                (path.clone(), name)
            };
            self.recent = recent.iter().filter(|path| path.exists()).map(named).collect();
        }
        let items = self.items.as_ref().map_or(&[][..], |(_, items)| items);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            head(ui, shared);
            purposes(ui, shared, &root);
            recent(ui, shared, &self.recent);
            ui.add_space(10.0);
            let hint = "Search scenarios, studies and cases";
            ui.add(TextEdit::singleline(&mut self.search).hint_text(hint).desired_width(COLUMN));
            listed(ui, shared, items, &self.search);
        });
    }
}

fn head(ui: &mut Ui, shared: &mut Shared) {
    ui.heading("Endline");
    ui.label("Fishing gear, and whales that get out of it alive.");
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Units on screen").color(Theme::palette_of(ui).faint));
        let now = shared.workbench.preferences().units;
        for units in Units::ALL.iter().copied() {
            if ui.radio(units == now, units.name()).on_hover_text(units.help()).clicked() {
                shared.give(WindowAction::Units(units));
            }
        }
    });
    ui.add_space(6.0);
}

fn recent(ui: &mut Ui, shared: &mut Shared, recent: &[(PathBuf, String)]) {
    if recent.is_empty() {
        return;
    }
    widgets::caption(ui, "Recent");
    ui.horizontal_wrapped(|ui| {
        for (path, name) in recent {
            if ui.link(name).on_hover_text(path.display().to_string()).clicked() {
                open(shared, What::Scenario, path);
            }
        }
    });
}

/// Opens an item in its layout.
fn open(shared: &mut Shared, what: What, path: &Path) {
    let path = path.to_owned();
    match what {
        What::Scenario => {
            shared.give(EditAction::OpenScenario(path));
            shared.give(PanelAction::Show(PanelId::View));
        }
        What::Study => {
            shared.give(StudyAction::Open(path));
            shared.give(PanelAction::Arrange(Layout::Study));
        }
        What::Observation => {
            shared.give(SearchAction::Open(path));
            shared.give(PanelAction::Arrange(Layout::Search));
        }
    }
}

/// Draws the items by group; with a search, only items with all its words, in open groups.
fn listed(ui: &mut Ui, shared: &mut Shared, items: &[Item], search: &str) {
    let mut any = false;
    let words = item::words(search);
    for group in Group::ALL.iter().copied() {
        let of: Vec<&Item> =
            items.iter().filter(|item| item.group == group && item.has(&words)).collect();
        if of.is_empty() {
            continue;
        }
        any = true;
        let title = RichText::new(format!("{}  ({})", group.title(), of.len())).strong();
        CollapsingHeader::new(title)
            .id_salt(group.title())
            .default_open(group.opens())
            .open((!search.trim().is_empty()).then_some(true))
            .show_unindented(ui, |ui| cards(ui, shared, &of));
    }
    if !any {
        widgets::nothing(ui, "Nothing in the library matches all words.");
    }
}

fn cards(ui: &mut Ui, shared: &mut Shared, items: &[&Item]) {
    let columns = ((ui.available_width() / COLUMN) as usize).max(1);
    for row in items.chunks(columns) {
        let id = row.iter().fold(ui.id(), |id, item| id.with(&item.name));
        widgets::where_seen(ui, id, |ui| {
            ui.columns(columns, |columns| {
                for (ui, item) in columns.iter_mut().zip(row) {
                    ui.with_layout(Flow::top_down(Align::Min), |ui| card(ui, shared, item));
                }
            });
        });
        ui.add_space(4.0);
    }
}

/// Draws an item: sketch, name as a link, first sentence of the notes.
fn card(ui: &mut Ui, shared: &mut Shared, item: &Item) {
    let palette = Theme::palette_of(ui);
    ui.horizontal_top(|ui| {
        let (picture, response) = ui.allocate_exact_size(vec2(84.0, 50.0), Sense::click());
        sketch::draw(&ui.painter_at(picture), picture, &item.sketch, palette);
        ui.vertical(|ui| {
            let named = ui.link(&item.name).on_hover_text(item.path.display().to_string());
            if named.clicked() || response.clicked() {
                open(shared, item.what, &item.path);
            }
            let notes = RichText::new(&item.first_words).size(12.0).color(palette.faint);
            ui.add(Label::new(notes).wrap()).on_hover_text(&item.notes);
        });
    });
}

/// Least width of a purpose [points].
const WIDTH: f32 = 250.0;

type Action = fn(&mut Shared, &Path);

/// Id of the scenario to fly in: its whale feels the gear.
const FLIGHT: &str = "fly-endline";

/// A purpose: title, description, and buttons with their actions.
struct Purpose {
    title: &'static str,
    description: &'static str,
    buttons: &'static [(&'static str, Action)],
}

const PURPOSES: [Purpose; 3] = [
    Purpose {
        title: "Design gear",
        description: "Edit traps, ropes, buoys and weak links; see the gear at slack and running tide; let a whale meet it.",
        buttons: &[
            ("Single trap", |shared, root| design(shared, root, "hello-endline")),
            ("Trawl of ten", |shared, root| design(shared, root, "trawl-10")),
            ("On demand", |shared, root| design(shared, root, "on-demand-release")),
            ("Gillnet", |shared, root| design(shared, root, "gillnet")),
        ],
    },
    Purpose {
        title: "Compare for a rule",
        description: "Compare options on the same encounters, with confidence intervals and a report; check the rules that apply to gear, with a compliance sheet.",
        buttons: &[
            ("Weak links", |shared, root| open_study(shared, root, "weak-links")),
            ("Kinds of gear", |shared, root| open_study(shared, root, "gear-types")),
            ("Check the rules", |shared, _| {
                shared.give(PanelAction::Arrange(Layout::Design));
                shared.give(PanelAction::Show(PanelId::Rules));
            }),
        ],
    },
    Purpose {
        title: "Fly, or explain a case",
        description: "Steer a whale by pad or keys; replay real cases; record an observation on a whale and search for encounters that end like it.",
        buttons: &[
            ("Fly a whale", |shared, root| {
                open_scenario(shared, root, FLIGHT);
                shared.give(PanelAction::Arrange(Layout::Fly));
                shared.give(FlightAction::Toggle);
            }),
            ("Case E25-05", |shared, root| open_scenario(shared, root, "case-e25-05-roll")),
            ("Describe a whale", |shared, _| {
                shared.give(SearchAction::New);
                shared.give(PanelAction::Arrange(Layout::Search));
            }),
        ],
    },
];

/// Draws the purposes, side by side if there is room.
fn purposes(ui: &mut Ui, shared: &mut Shared, root: &Path) {
    let columns = ((ui.available_width() / WIDTH) as usize).clamp(1, PURPOSES.len());
    for row in PURPOSES.chunks(columns) {
        ui.columns(columns, |columns| {
            for (ui, purpose) in columns.iter_mut().zip(row) {
                ui.with_layout(Flow::top_down(Align::Min), |ui| {
                    purpose_card(ui, shared, root, purpose)
                });
            }
        });
    }
}

fn purpose_card(ui: &mut Ui, shared: &mut Shared, root: &Path, purpose: &Purpose) {
    let palette = Theme::palette_of(ui);
    Frame::group(ui.style()).fill(palette.field).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.set_min_height(112.0);
        ui.label(RichText::new(purpose.title).size(16.0).strong());
        ui.label(RichText::new(purpose.description).color(palette.faint));
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| {
            for (label, action) in purpose.buttons {
                if ui.button(*label).clicked() {
                    action(shared, root);
                }
            }
        });
    });
}

fn scenario(root: &Path, id: &str) -> PathBuf {
    root.join(format!("scenarios/{id}.toml"))
}

fn open_scenario(shared: &mut Shared, root: &Path, id: &str) {
    open(shared, What::Scenario, &scenario(root, id));
}

fn design(shared: &mut Shared, root: &Path, id: &str) {
    open_scenario(shared, root, id);
    shared.give(PanelAction::Arrange(Layout::Design));
}

fn open_study(shared: &mut Shared, root: &Path, id: &str) {
    open(shared, What::Study, &root.join(format!("studies/{id}.toml")));
}

#[cfg(test)]
mod tests {
    use endline_gear::Document;

    use super::*;

    #[test]
    fn the_whale_to_fly_feels_the_gear() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library");
        let text = endline_gear::read::text(&scenario(&root, FLIGHT)).unwrap();
        let document = Document::parse(&text).unwrap();
        assert_eq!(document.get("whale.dynamics").as_deref(), Some("kinetic"));
        assert!(document.get("gear.0.assembly").is_some());
    }
}
