//! Gear in parts, of an assembly or of the scenario, as a tree from buoy to trap: add, split, remove.
//!
//! Bodies of a scenario have figures, those of an assembly name items. Only parts of an assembly have first guesses of positions.

use egui::{Grid, RichText, Slider, SliderClamping, Ui};
use endline_gear::units::{Quantity, parse};
use endline_gear::{Document, Kind};
use endline_session::command::EditAction;
use endline_session::edit::{Documents, assembly};
use endline_session::statics::TrialGear;

use super::{WhenEmpty, inserts, item, said};
use crate::gui::fields;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::{self, words};

/// Range of the length slider, relative to the length at the start of a drag.
const LONGEST: f64 = 2.0;

/// Figures of a body of a scenario: label, key and help.
const OF_OWN_BODY: [(&str, &str, &str); 4] = [
    ("Mass", "mass", "Mass, such as 1.8 kg"),
    ("Volume", "volume", "Displaced volume, such as 26.5 L"),
    ("Radius", "radius", "Radius, such as 0.19 m"),
    ("Drag area", "drag_area", "Drag coefficient times frontal area, such as 0.054 m2"),
];

/// Draws the tree.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, gear: &TrialGear) {
    let (file, is_own) = (&super::path(gear), *gear == TrialGear::Own);
    if !is_own {
        add(ui, shared, file);
    }
    widgets::caption(ui, "Bodies");
    for index in (0..count(shared, file, "body")).rev() {
        if is_own {
            own_body(ui, shared, file, index);
        } else {
            body(ui, shared, file, index);
        }
    }
    inserts::whole(ui, shared, gear);
    widgets::caption(ui, "Lines, from the buoy down");
    for index in (0..count(shared, file, "line")).rev() {
        line(ui, shared, file, index);
    }
    if count(shared, file, "link") > 0 {
        widgets::caption(ui, "Weak links");
    }
    for index in 0..count(shared, file, "link") {
        link(ui, shared, file, index);
    }
    let splices = if is_own { 0 } else { count(shared, file, "joint") };
    if splices > 0 {
        widgets::caption(ui, "Splices");
    }
    (0..splices).for_each(|index| joint(ui, shared, file, index));
}

/// Number of tables of a list.
fn count(shared: &Shared, file: &str, list: &str) -> usize {
    (0..)
        .take_while(|index| {
            shared
                .workbench
                .project()
                .documents
                .field(file, &format!("{list}.{index}.id"))
                .is_some()
        })
        .count()
}

/// Ids of the tables of a list.
fn ids(shared: &Shared, file: &str, list: &str) -> Vec<String> {
    (0..)
        .map_while(|index| {
            shared.workbench.project().documents.field(file, &format!("{list}.{index}.id"))
        })
        .collect()
}

fn change(
    shared: &mut Shared,
    file: &str,
    change: impl FnOnce(&mut Document) -> Result<(), String>,
) {
    shared.alter(file, change);
}

/// Draws the menu of parts to add.
fn add(ui: &mut Ui, shared: &mut Shared, file: &str) {
    ui.menu_button("Add ⏷", |ui| {
        for (word, kind, height) in
            [("trap", Kind::Trap, "0"), ("buoy", Kind::Buoy, "1"), ("anchor", Kind::Anchor, "0")]
        {
            if ui.button(words::title(word)).clicked() {
                let item = first_item(shared, kind);
                change(shared, file, |document| assembly::add_body(document, word, &item, height));
                ui.close();
            }
        }
        let bodies = ids(shared, file, "body");
        let two = bodies.first().zip(bodies.last()).filter(|(first, last)| first != last);
        if ui.add_enabled(two.is_some(), egui::Button::new("Line")).clicked() {
            if let Some((from, to)) = two {
                change(shared, file, |document| assembly::add_line(document, from, to));
            }
            ui.close();
        }
    });
}

/// Id of the first library item of a kind.
fn first_item(shared: &Shared, kind: Kind) -> String {
    let ids = shared.workbench.project().documents.library().ids(kind);
    ids.first().map(|id| (*id).to_owned()).unwrap_or_default()
}

/// A part in its file.
#[derive(Clone, Copy)]
struct Part<'a> {
    file: &'a str,
    /// `body`, `line`, `link` or `joint`.
    list: &'a str,
    index: usize,
}

/// Draws the heading of a part in the tree; returns whether to remove it. Lines are open initially.
fn head(ui: &mut Ui, part: Part<'_>, title: &str, show: impl FnOnce(&mut Ui)) -> bool {
    let id = ui.make_persistent_id(("part", part.file, part.list, part.index));
    let open = part.list == "line";
    let state =
        egui::collapsing_header::CollapsingState::load_with_default_open(ui.ctx(), id, open);
    let mut out = false;
    state
        .show_header(ui, |ui| {
            ui.label(title);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                out = ui.small_button("✖").on_hover_text("Removes it; Undo restores it").clicked();
            });
        })
        .body(show);
    out
}

fn take_out(shared: &mut Shared, part: Part<'_>) {
    change(shared, part.file, |document| {
        document.remove_table(part.list, part.index).map_err(|error| error.to_string())
    });
}

fn row(ui: &mut Ui, shared: &mut Shared, file: &str, name: &str, field: &str, help: &str) {
    ui.label(RichText::new(name).color(Theme::palette_of(ui).faint)).on_hover_text(help);
    let width = ui.available_width() - 8.0;
    if let Some(typed) =
        fields::edit(ui, &shared.workbench.project().documents, file, field, width, said(help))
    {
        shared.set(file, field, &typed);
    }
    ui.end_row();
}

fn body(ui: &mut Ui, shared: &mut Shared, file: &str, index: usize) {
    let at = format!("body.{index}");
    let (id, word) =
        (text(shared, file, &format!("{at}.id")), text(shared, file, &format!("{at}.kind")));
    let kind = match word.as_str() {
        "buoy" => Kind::Buoy,
        "anchor" => Kind::Anchor,
        _ => Kind::Trap,
    };
    let part = Part { file, list: "body", index };
    let out = head(ui, part, &format!("{id} ({word})"), |ui| {
        Grid::new((&at, "grid")).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            ui.label(RichText::new("Item").color(Theme::palette_of(ui).faint));
            item(ui, shared, file, &format!("{at}.item"), kind, &WhenEmpty::Missing);
            ui.end_row();
            row(
                ui,
                shared,
                file,
                "Along",
                &format!("{at}.position.0"),
                "First guess of its position along the gear, such as 20 m",
            );
            row(
                ui,
                shared,
                file,
                "Height",
                &format!("{at}.height"),
                "First guess of its height: 0 on the seabed, 1 at the surface",
            );
        });
    });
    if out {
        take_out(shared, part);
    }
}

/// Draws a body of the scenario with its figures.
fn own_body(ui: &mut Ui, shared: &mut Shared, file: &str, index: usize) {
    let at = format!("body.{index}");
    let [id, role] = ["id", "role"].map(|key| text(shared, file, &format!("{at}.{key}")));
    let part = Part { file, list: "body", index };
    let out = head(ui, part, &format!("{id} ({role})"), |ui| {
        Grid::new((&at, "grid")).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            for (name, key, help) in OF_OWN_BODY {
                let field = format!("{at}.{key}");
                if !text(shared, file, &field).is_empty() {
                    row(ui, shared, file, name, &field, help);
                }
            }
        });
    });
    if out {
        take_out(shared, part);
    }
}

fn joint(ui: &mut Ui, shared: &mut Shared, file: &str, index: usize) {
    let at = format!("joint.{index}");
    let id = text(shared, file, &format!("{at}.id"));
    let part = Part { file, list: "joint", index };
    let out = head(ui, part, &id, |ui| {
        Grid::new((&at, "grid")).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            row(
                ui,
                shared,
                file,
                "Along",
                &format!("{at}.position.0"),
                "First guess of its position along the gear",
            );
            row(
                ui,
                shared,
                file,
                "Height",
                &format!("{at}.height"),
                "First guess of its height: 0 on the seabed, 1 at the surface",
            );
        });
    });
    if out {
        take_out(shared, part);
    }
}

fn link(ui: &mut Ui, shared: &mut Shared, file: &str, index: usize) {
    let at = format!("link.{index}");
    let id = text(shared, file, &format!("{at}.id"));
    let title = format!(
        "{id} at {} of {}",
        text(shared, file, &format!("{at}.end")),
        text(shared, file, &format!("{at}.line"))
    );
    let part = Part { file, list: "link", index };
    let out = head(ui, part, &title, |ui| {
        let rating = format!("{at}.rating");
        if text(shared, file, &rating).is_empty() {
            item(ui, shared, file, &format!("{at}.item"), Kind::WeakLink, &WhenEmpty::Missing);
        } else {
            Grid::new((&at, "grid")).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
                row(
                    ui,
                    shared,
                    file,
                    "Rating",
                    &rating,
                    "Tension above which it parts, such as 600 lbf",
                );
            });
        }
    });
    if out {
        take_out(shared, part);
    }
}

fn text(shared: &Shared, file: &str, field: &str) -> String {
    shared.workbench.project().documents.field(file, field).unwrap_or_default()
}

fn line(ui: &mut Ui, shared: &mut Shared, file: &str, index: usize) {
    let at = format!("line.{index}");
    let id = text(shared, file, &format!("{at}.id"));
    let title = format!(
        "{id}: {} of {}",
        text(shared, file, &format!("{at}.length")),
        text(shared, file, &format!("{at}.rope"))
    );
    let part = Part { file, list: "line", index };
    let out = head(ui, part, &title, |ui| {
        length_slider(ui, shared, file, &at);
        Grid::new((&at, "grid")).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            ui.label(RichText::new("Rope").color(Theme::palette_of(ui).faint));
            item(ui, shared, file, &format!("{at}.rope"), Kind::Rope, &WhenEmpty::Missing);
            ui.end_row();
            row(
                ui,
                shared,
                file,
                "Length",
                &format!("{at}.length"),
                "Unstretched length, such as 24 m or 13 fathom",
            );
            row(ui, shared, file, "From", &format!("{at}.from"), "The part at its lower end");
            row(ui, shared, file, "To", &format!("{at}.to"), "The part at its upper end");
        });
        let length_m = parse(&text(shared, file, &format!("{at}.length")), Quantity::Length);
        let has_places =
            shared.workbench.project().documents.has(file, &format!("{at}.weak_places"));
        let name = if has_places { "Weak places" } else { "Weak inserts" };
        inserts::one(ui, shared, (file, &at), name, length_m.unwrap_or(0.0));
        ui.horizontal(|ui| {
            // In a scenario the position of a splice is not known.
            let split = (file != Documents::SCENARIO).then(|| ui
                .small_button("Split")
                .on_hover_text("Splits it into two lines of half the length with a splice between them, so that each can have its own rope"));
            if split.is_some_and(|button| button.clicked()) {
                change(shared, file, |document| assembly::split_line(document, index));
            }
            let ends = [("top", "to"), ("foot", "from")];
            for (word, end) in ends {
                if ui.small_button(format!("Link at the {word}")).on_hover_text("Adds a weak link here").clicked() {
                    let item = first_item(shared, Kind::WeakLink);
                    change(shared, file, |document| {
                        assembly::add_link(document, &id, end, ("item", &item))
                    });
                }
            }
        });
    });
    if out {
        take_out(shared, part);
    }
}

/// Draws a slider of the length; the gear follows while it moves.
fn length_slider(ui: &mut Ui, shared: &mut Shared, file: &str, at: &str) {
    let field = format!("{at}.length");
    let Ok(length_m) = parse(&text(shared, file, &field), Quantity::Length) else { return };
    // The range is fixed while the slider is dragged.
    let scale = ui.make_persistent_id(("longest", file, at));
    let longest_m = ui.data(|data| data.get_temp::<f64>(scale)).unwrap_or(length_m * LONGEST);
    let units = shared.workbench.preferences().units;
    let mut shown = units.of_metres(length_m);
    ui.spacing_mut().slider_width = 130.0;
    let slider =
        Slider::new(&mut shown, units.of_metres(longest_m * 0.05)..=units.of_metres(longest_m))
            .clamping(SliderClamping::Never)
            .min_decimals(1)
            .max_decimals(4);
    let response = ui.add(slider.suffix(format!(" {}", units.length_symbol())));
    if response.drag_started() {
        ui.data_mut(|data| data.insert_temp(scale, longest_m));
    }
    if response.changed() {
        let value = format!("{} {}", super::written(shown), units.length_symbol());
        shared.set_held(file, &field, &value);
    }
    if response.drag_stopped() || response.lost_focus() {
        ui.data_mut(|data| data.remove_temp::<f64>(scale));
        shared.perform(EditAction::LetGo);
    }
}
