//! An assembly written out part by part, as a tree from buoy to trap: add, split, take out.

use egui::{Grid, RichText, Slider, SliderClamping, Ui};
use endline_gear::units::{Quantity, parse};
use endline_gear::{Document, Kind};

use super::{inserts, item, said};
use crate::gui::desk::Desk;
use crate::gui::fields;
use crate::gui::theme::Theme;
use crate::gui::widgets::{self, words};

/// Longest a line may be made with the slider, over its length when taken up.
const LONGEST: f64 = 2.0;

/// Draws the tree.
pub(super) fn show(ui: &mut Ui, desk: &mut Desk, file: &str) {
    add(ui, desk, file);
    widgets::caption(ui, "Bodies");
    for index in (0..count(desk, file, "body")).rev() {
        body(ui, desk, file, index);
    }
    widgets::caption(ui, "Lines, from the buoy down");
    for index in (0..count(desk, file, "line")).rev() {
        line(ui, desk, file, index);
    }
    if count(desk, file, "link") > 0 {
        widgets::caption(ui, "Weak links");
    }
    for index in 0..count(desk, file, "link") {
        link(ui, desk, file, index);
    }
    if count(desk, file, "joint") > 0 {
        widgets::caption(ui, "Splices");
    }
    for index in 0..count(desk, file, "joint") {
        joint(ui, desk, file, index);
    }
}

/// How many tables of a list there are.
fn count(desk: &Desk, file: &str, list: &str) -> usize {
    (0..)
        .take_while(|index| desk.documents.field(file, &format!("{list}.{index}.id")).is_some())
        .count()
}

/// Ids of a list's tables.
fn ids(desk: &Desk, file: &str, list: &str) -> Vec<String> {
    (0..).map_while(|index| desk.documents.field(file, &format!("{list}.{index}.id"))).collect()
}

fn change(desk: &mut Desk, file: &str, change: impl FnOnce(&mut Document) -> Result<(), String>) {
    if let Err(error) = desk.documents.alter(file, change) {
        desk.notice = Some((error, true));
    }
}

/// An id of a stem that no part has.
fn fresh(taken: &[String], stem: &str) -> String {
    let numbered = (2..).map(|number| format!("{stem}-{number}"));
    std::iter::once(stem.to_owned())
        .chain(numbered)
        .find(|id| !taken.contains(id))
        .unwrap_or_default()
}

/// The menu of what can be added.
fn add(ui: &mut Ui, desk: &mut Desk, file: &str) {
    ui.menu_button("Add ⏷", |ui| {
        for (word, kind, height) in
            [("trap", Kind::Trap, "0"), ("buoy", Kind::Buoy, "1"), ("anchor", Kind::Anchor, "0")]
        {
            if ui.button(words::title(word)).clicked() {
                add_body(desk, file, word, kind, height);
                ui.close();
            }
        }
        let bodies = ids(desk, file, "body");
        let two = bodies.first().zip(bodies.last()).filter(|(first, last)| first != last);
        if ui.add_enabled(two.is_some(), egui::Button::new("Line")).clicked() {
            if let Some((from, to)) = two {
                add_line(desk, file, from, to);
            }
            ui.close();
        }
    });
}

/// Adds a body of the first item of its kind; `height` is the first guess of its height, as a share of the depth.
fn add_body(desk: &mut Desk, file: &str, word: &str, kind: Kind, height: &str) {
    let item = first_item(desk, kind);
    let id = fresh(&ids(desk, file, "body"), word);
    let fields = [
        ("id", id.as_str()),
        ("kind", word),
        ("item", &item),
        ("position", "[\"0 m\", \"0 m\"]"),
        ("height", height),
    ];
    push(desk, file, "body", &fields);
}

/// Adds a line between two bodies.
fn add_line(desk: &mut Desk, file: &str, from: &str, to: &str) {
    let id = fresh(&ids(desk, file, "line"), "line");
    let fields = [
        ("id", id.as_str()),
        ("rope", "sink-3-8"),
        ("from", from),
        ("to", to),
        ("length", "20 fathom"),
    ];
    push(desk, file, "line", &fields);
}

/// Adds a table to a list.
fn push(desk: &mut Desk, file: &str, list: &str, fields: &[(&str, &str)]) {
    change(desk, file, |document| {
        document.push_table(list, fields).map(|_| ()).map_err(|error| error.to_string())
    });
}

/// Id of the library's first item of a kind.
fn first_item(desk: &Desk, kind: Kind) -> String {
    let ids = desk.documents.library().ids(kind);
    ids.first().map(|id| (*id).to_owned()).unwrap_or_default()
}

/// A part's place in its file.
#[derive(Clone, Copy)]
struct Part<'a> {
    file: &'a str,
    /// `body`, `line`, `link` or `joint`.
    list: &'a str,
    index: usize,
}

/// A part's head in the tree; answers whether it is to be taken out. Lines are unfolded at first.
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
                out = ui
                    .small_button("✖")
                    .on_hover_text("Take it out; Undo brings it back")
                    .clicked();
            });
        })
        .body(show);
    out
}

fn take_out(desk: &mut Desk, part: Part<'_>) {
    change(desk, part.file, |document| {
        document.remove_table(part.list, part.index).map_err(|error| error.to_string())
    });
}

fn row(ui: &mut Ui, desk: &mut Desk, file: &str, name: &str, field: &str, help: &str) {
    ui.label(RichText::new(name).color(Theme::palette_of(ui).faint)).on_hover_text(help);
    let width = ui.available_width() - 8.0;
    if let Some(typed) = fields::edit(ui, &desk.documents, file, field, width, said(help)) {
        desk.set(file, field, &typed);
    }
    ui.end_row();
}

fn body(ui: &mut Ui, desk: &mut Desk, file: &str, index: usize) {
    let at = format!("body.{index}");
    let (id, word) =
        (text(desk, file, &format!("{at}.id")), text(desk, file, &format!("{at}.kind")));
    let kind = match word.as_str() {
        "buoy" => Kind::Buoy,
        "anchor" => Kind::Anchor,
        _ => Kind::Trap,
    };
    let part = Part { file, list: "body", index };
    let out = head(ui, part, &format!("{id} ({word})"), |ui| {
        Grid::new((&at, "grid")).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            ui.label(RichText::new("Item").color(Theme::palette_of(ui).faint));
            item(ui, desk, file, &format!("{at}.item"), kind, false);
            ui.end_row();
            row(
                ui,
                desk,
                file,
                "Along",
                &format!("{at}.position.0"),
                "First guess of its place along the gear, such as 20 m",
            );
            row(
                ui,
                desk,
                file,
                "Height",
                &format!("{at}.height"),
                "First guess of its height: 0 on the seabed, 1 at the surface",
            );
        });
    });
    if out {
        take_out(desk, part);
    }
}

fn joint(ui: &mut Ui, desk: &mut Desk, file: &str, index: usize) {
    let at = format!("joint.{index}");
    let id = text(desk, file, &format!("{at}.id"));
    let part = Part { file, list: "joint", index };
    let out = head(ui, part, &id, |ui| {
        Grid::new((&at, "grid")).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            row(
                ui,
                desk,
                file,
                "Along",
                &format!("{at}.position.0"),
                "First guess of its place along the gear",
            );
            row(
                ui,
                desk,
                file,
                "Height",
                &format!("{at}.height"),
                "First guess of its height: 0 on the seabed, 1 at the surface",
            );
        });
    });
    if out {
        take_out(desk, part);
    }
}

fn link(ui: &mut Ui, desk: &mut Desk, file: &str, index: usize) {
    let at = format!("link.{index}");
    let id = text(desk, file, &format!("{at}.id"));
    let title = format!(
        "{id} at {} of {}",
        text(desk, file, &format!("{at}.end")),
        text(desk, file, &format!("{at}.line"))
    );
    let part = Part { file, list: "link", index };
    let out = head(ui, part, &title, |ui| {
        item(ui, desk, file, &format!("{at}.item"), Kind::WeakLink, false);
    });
    if out {
        take_out(desk, part);
    }
}

fn text(desk: &Desk, file: &str, field: &str) -> String {
    desk.documents.field(file, field).unwrap_or_default()
}

fn line(ui: &mut Ui, desk: &mut Desk, file: &str, index: usize) {
    let at = format!("line.{index}");
    let id = text(desk, file, &format!("{at}.id"));
    let title = format!(
        "{id}: {} of {}",
        text(desk, file, &format!("{at}.length")),
        text(desk, file, &format!("{at}.rope"))
    );
    let part = Part { file, list: "line", index };
    let out = head(ui, part, &title, |ui| {
        length_slider(ui, desk, file, &at);
        Grid::new((&at, "grid")).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            ui.label(RichText::new("Rope").color(Theme::palette_of(ui).faint));
            item(ui, desk, file, &format!("{at}.rope"), Kind::Rope, false);
            ui.end_row();
            row(
                ui,
                desk,
                file,
                "Length",
                &format!("{at}.length"),
                "Unstretched length, such as 24 m or 13 fathom",
            );
            row(ui, desk, file, "From", &format!("{at}.from"), "The part at its lower end");
            row(ui, desk, file, "To", &format!("{at}.to"), "The part at its upper end");
        });
        inserts::one(ui, desk, file, &at, "Weak inserts");
        ui.horizontal(|ui| {
            if ui
                .small_button("Split")
                .on_hover_text("Two lines of half the length with a splice between, to give them ropes of their own")
                .clicked()
            {
                split(desk, file, index);
            }
            let ends = [("top", "to"), ("foot", "from")];
            for (word, end) in ends {
                if ui.small_button(format!("Link at the {word}")).on_hover_text("Put a weak link here").clicked() {
                    add_link(desk, file, &id, end);
                }
            }
        });
    });
    if out {
        take_out(desk, part);
    }
}

fn add_link(desk: &mut Desk, file: &str, line: &str, end: &str) {
    let id = fresh(&ids(desk, file, "link"), &format!("{line}-link"));
    let item = first_item(desk, Kind::WeakLink);
    let fields = [("id", id.as_str()), ("item", &item), ("line", line), ("end", end)];
    push(desk, file, "link", &fields);
}

/// Length under the hand; the gear follows while it moves.
fn length_slider(ui: &mut Ui, desk: &mut Desk, file: &str, at: &str) {
    let field = format!("{at}.length");
    let Ok(length_m) = parse(&text(desk, file, &field), Quantity::Length) else { return };
    // The end of the scale stays while the slider is held.
    let scale = ui.make_persistent_id(("longest", file, at));
    let longest_m = ui.data(|data| data.get_temp::<f64>(scale)).unwrap_or(length_m * LONGEST);
    let units = desk.preferences.units;
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
    if response.changed()
        && let Err(error) = desk.documents.set_held(
            file,
            &field,
            &format!("{} {}", super::written(shown), units.length_symbol()),
        )
    {
        desk.notice = Some((error, true));
    }
    if response.drag_stopped() || response.lost_focus() {
        ui.data_mut(|data| data.remove_temp::<f64>(scale));
        desk.documents.let_go();
    }
}

/// Two lines of half the length in place of one, a splice between them.
fn split(desk: &mut Desk, file: &str, index: usize) {
    let at = format!("line.{index}");
    let field = |key: &str| text(desk, file, &format!("{at}.{key}"));
    let Ok(length_m) = parse(&field("length"), Quantity::Length) else { return };
    let (id, rope, to) = (field("id"), field("rope"), field("to"));
    let (joint, upper) = (
        fresh(&ids(desk, file, "joint"), &format!("{id}-splice")),
        fresh(&ids(desk, file, "line"), &format!("{id}-top")),
    );
    let places = [&field("from"), &to].map(|part| place_of(desk, file, part));
    let middle = |axis: usize| f64::midpoint(places[0][axis], places[1][axis]);
    let half = format!("{:.2} m", length_m / 2.0);
    let position = format!("[\"{:.1} m\", \"0 m\"]", middle(0));
    let height = format!("{:.2}", middle(1));
    change(desk, file, |document| {
        let told = |error: endline_gear::EditError| error.to_string();
        document
            .push_table("joint", &[("id", &joint), ("position", &position), ("height", &height)])
            .map_err(told)?;
        document.set(&format!("{at}.to"), &joint).map_err(told)?;
        document.set(&format!("{at}.length"), &half).map_err(told)?;
        let fields = [
            ("id", upper.as_str()),
            ("rope", &rope),
            ("from", &joint),
            ("to", &to),
            ("length", &half),
        ];
        document.push_table("line", &fields).map(|_| ()).map_err(told)
    });
}

/// First guess of a part's place along the gear [m] and its height as a share of depth.
fn place_of(desk: &Desk, file: &str, part: &str) -> [f64; 2] {
    let part = part.split(':').next().unwrap_or(part);
    let lists = ["body", "joint"];
    let found = lists.iter().find_map(|list| {
        ids(desk, file, list)
            .iter()
            .position(|id| id == part)
            .map(|index| format!("{list}.{index}"))
    });
    let Some(at) = found else { return [0.0; 2] };
    let along =
        parse(&text(desk, file, &format!("{at}.position.0")), Quantity::Length).unwrap_or(0.0);
    [along, parse(&text(desk, file, &format!("{at}.height")), Quantity::Ratio).unwrap_or(0.0)]
}
