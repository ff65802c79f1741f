//! The three purposes on the start page, with buttons that open examples.

use std::path::{Path, PathBuf};

use egui::{Align, Frame, Layout as Flow, RichText, Ui};
use endline_session::command::SearchAction;

use super::item::What;
use crate::gui::command::action::{FlightAction, PanelAction};
use crate::gui::layout::Layout;
use crate::gui::panel::PanelId;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;

/// Least width of a purpose [points].
const WIDTH: f32 = 250.0;

type Action = fn(&mut Shared, &Path);

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
            ("Weak links", |shared, root| study(shared, root, "weak-links")),
            ("Kinds of gear", |shared, root| study(shared, root, "gear-types")),
            ("Check the rules", |shared, _| {
                shared.give(PanelAction::Arrange(Layout::Design));
                shared.give(PanelAction::Show(PanelId::RULES));
            }),
        ],
    },
    Purpose {
        title: "Fly, or explain a case",
        description: "Steer a whale by pad or keys; replay real cases; record an observation on a whale and search for encounters that end like it.",
        buttons: &[
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

/// Draws the purposes, side by side if there is room.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, root: &Path) {
    let columns = ((ui.available_width() / WIDTH) as usize).clamp(1, PURPOSES.len());
    for row in PURPOSES.chunks(columns) {
        ui.columns(columns, |columns| {
            for (ui, purpose) in columns.iter_mut().zip(row) {
                ui.with_layout(Flow::top_down(Align::Min), |ui| one(ui, shared, root, purpose));
            }
        });
    }
}

fn one(ui: &mut Ui, shared: &mut Shared, root: &Path, purpose: &Purpose) {
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
