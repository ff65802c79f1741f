//! Three doors: what people come to do, and where each begins.

use std::path::{Path, PathBuf};

use egui::{Align, Frame, Layout as Flow, RichText, Ui};
use endline_session::command::SearchAction;

use super::item::What;
use crate::gui::command::action::{FlightAction, PanelAction};
use crate::gui::layout::Layout;
use crate::gui::panel::PanelId;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;

/// Breadth that a door needs, in points.
const DOOR: f32 = 250.0;

type Begin = fn(&mut Shared, &Path);

/// A purpose, what it takes, and where to begin: the words of each button and what it does.
struct Door {
    title: &'static str,
    words: &'static str,
    begin: &'static [(&'static str, Begin)],
}

const DOORS: [Door; 3] = [
    Door {
        title: "Design gear",
        words: "Change traps, ropes, buoys and weak links; see the gear at slack and running tide at once; swim a whale into it.",
        begin: &[
            ("Single trap", |shared, root| design(shared, root, "hello-endline")),
            ("Trawl of ten", |shared, root| design(shared, root, "trawl-10")),
            ("On demand", |shared, root| design(shared, root, "on-demand-release")),
            ("Gillnet", |shared, root| design(shared, root, "gillnet")),
        ],
    },
    Door {
        title: "Compare for a rule",
        words: "Options on the same encounters, with intervals and a report; what laws ask of a gear, and a sheet to file.",
        begin: &[
            ("Weak links", |shared, root| study(shared, root, "weak-links")),
            ("Kinds of gear", |shared, root| study(shared, root, "gear-types")),
            ("Check the rules", |shared, _| {
                shared.give(PanelAction::Arrange(Layout::Design));
                shared.give(PanelAction::Show(PanelId::RULES));
            }),
        ],
    },
    Door {
        title: "Fly, or explain a case",
        words: "Swim the whale by pad or keys; play real cases; say what was seen on a whale and search for encounters that end like it.",
        begin: &[
            ("Fly a whale", |shared, root| {
                open(shared, root, "hello-endline");
                shared.give(PanelAction::Arrange(Layout::Fly));
                shared.give(FlightAction::Toggle);
            }),
            ("Case E25-05", |shared, root| open(shared, root, "case-e25-05-roll")),
            ("Describe a whale", |shared, _| {
                shared.give(SearchAction::New);
                shared.give(PanelAction::Arrange(Layout::Search));
            }),
        ],
    },
];

/// The doors, side by side where there is room.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, root: &Path) {
    let columns = ((ui.available_width() / DOOR) as usize).clamp(1, DOORS.len());
    for row in DOORS.chunks(columns) {
        ui.columns(columns, |columns| {
            for (ui, door) in columns.iter_mut().zip(row) {
                ui.with_layout(Flow::top_down(Align::Min), |ui| one(ui, shared, root, door));
            }
        });
    }
}

fn one(ui: &mut Ui, shared: &mut Shared, root: &Path, door: &Door) {
    let palette = Theme::palette_of(ui);
    Frame::group(ui.style()).fill(palette.field).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.set_min_height(112.0);
        ui.label(RichText::new(door.title).size(16.0).strong());
        ui.label(RichText::new(door.words).color(palette.faint));
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| {
            for (words, begin) in door.begin {
                if ui.button(*words).clicked() {
                    begin(shared, root);
                }
            }
        });
    });
}

fn scenario(root: &Path, id: &str) -> PathBuf {
    root.join(format!("scenarios/{id}.toml"))
}

fn open(shared: &mut Shared, root: &Path, id: &str) {
    super::open(shared, What::Scenario, &scenario(root, id));
}

fn design(shared: &mut Shared, root: &Path, id: &str) {
    open(shared, root, id);
    shared.give(PanelAction::Arrange(Layout::Design));
}

fn study(shared: &mut Shared, root: &Path, id: &str) {
    super::open(shared, What::Study, &root.join(format!("studies/{id}.toml")));
}
