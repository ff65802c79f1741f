//! What happens in the run: gear, sea and whale of the scenario, as typed in its file.

use egui::{Grid, RichText, ScrollArea, Ui};
use endline_gear::Kind;

use super::super::book::Book;
use super::super::desk::{Desk, Order};
use super::super::fields;
use super::super::theme::{Theme, primary};

/// A field of the scenario's file: label, key, help.
type Row = (&'static str, &'static str, &'static str);

const SEA: &[Row] = &[
    ("Depth", "site.depth", "Water depth, over the site's, such as 40 fathom"),
    ("Current", "current.speed", "Surface speed of the current, such as 0.5 m/s or 1 kn"),
    ("Towards", "current.toward", "Compass bearing the current runs towards, such as 90 deg"),
];

const WHALE: &[Row] = &[
    ("Length", "whale.length", "Body length, snout to fluke notch, such as 13 m"),
    ("Speed", "whale.speed", "Speed through the water at the start, such as 1 m/s"),
    ("Heading", "whale.heading", "Compass bearing of the snout, such as 90 deg"),
    ("Depth", "whale.depth", "Depth of mid-body at the start, such as 12 m"),
    ("Start east", "whale.position.0", "Where mid-body starts, east of the origin"),
    ("Start north", "whale.position.1", "Where mid-body starts, north of the origin"),
];

const RUN: &[Row] = &[("Duration", "duration", "Length of the run, such as 60 s"), ("Seed", "seed", "Seed of everything drawn at random")];

/// Draws the scenario panel.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    pick(ui, desk);
    let foot = 34.0;
    ScrollArea::vertical().auto_shrink(false).max_height(ui.available_height() - foot).show(ui, |ui| {
        let mut edits: Vec<(String, String)> = Vec::new();
        gear(ui, desk, &mut edits);
        sea(ui, desk, &mut edits);
        if desk.book.field(Book::SCENARIO, "whale.item").is_some() {
            super::caption(ui, "Whale");
            rows(ui, desk, "whale", WHALE, &mut edits);
        }
        super::caption(ui, "Run");
        rows(ui, desk, "run", RUN, &mut edits);
        weak_links(ui, desk, &mut edits);
        for (field, value) in edits {
            desk.set(Book::SCENARIO, &field, &value);
        }
    });
    ui.separator();
    apply(ui, desk);
}

/// The scenario itself, out of those beside it.
fn pick(ui: &mut Ui, desk: &mut Desk) {
    let path = desk.book.scenario_path().to_owned();
    let stem = |path: &std::path::Path| path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let mark = if desk.book.is_unsaved(Book::SCENARIO) { "• " } else { "" };
    let width = ui.available_width() - 8.0;
    let shown = format!("{mark}{}", stem(&path));
    egui::ComboBox::from_id_salt("scenario").width(width).truncate().selected_text(shown).show_ui(ui, |ui| {
        for file in scenarios(desk.book.root()) {
            if ui.selectable_label(file == path, stem(&file)).clicked() && file != path {
                desk.orders.push(Order::Open(file));
            }
        }
    });
    if let Some(name) = desk.book.field(Book::SCENARIO, "name") {
        let notes = desk.book.field(Book::SCENARIO, "notes").unwrap_or_default();
        let label = egui::Label::new(RichText::new(name).color(Theme::palette_of(ui).faint)).wrap();
        ui.add(label).on_hover_text(notes);
    }
}

/// The scenarios of a library, by name.
#[must_use]
pub fn scenarios(root: &std::path::Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(root.join("scenarios")).into_iter().flatten().flatten();
    let mut files: Vec<_> = entries.map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
    files.sort();
    files
}

fn gear(ui: &mut Ui, desk: &Desk, edits: &mut Vec<(String, String)>) {
    if desk.book.field(Book::SCENARIO, "gear.0.assembly").is_none() {
        return;
    }
    super::caption(ui, "Gear");
    Grid::new("gear").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        for index in 0..9 {
            let field = format!("gear.{index}.assembly");
            if desk.book.field(Book::SCENARIO, &field).is_none() {
                break;
            }
            name(ui, "Assembly");
            choice(ui, desk, &field, Kind::Assembly, edits);
            ui.end_row();
        }
    });
}

fn sea(ui: &mut Ui, desk: &Desk, edits: &mut Vec<(String, String)>) {
    super::caption(ui, "Sea");
    if desk.book.field(Book::SCENARIO, "site.item").is_some() {
        Grid::new("site").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            name(ui, "Site");
            choice(ui, desk, "site.item", Kind::Site, edits);
            ui.end_row();
        });
    }
    rows(ui, desk, "sea", SEA, edits);
}

/// Labels to the left all as wide, so that the groups line up.
fn name(ui: &mut Ui, text: &str) {
    let (rect, _) = ui.allocate_exact_size(egui::vec2(74.0, 20.0), egui::Sense::hover());
    let colour = Theme::palette_of(ui).faint;
    ui.painter().text(rect.left_center(), egui::Align2::LEFT_CENTER, text, egui::FontId::proportional(13.0), colour);
}

fn choice(ui: &mut Ui, desk: &Desk, field: &str, kind: Kind, edits: &mut Vec<(String, String)>) {
    let library = desk.book.library();
    let choices: Vec<(String, String)> = library.entries(kind).iter().map(|entry| (entry.id.clone(), entry.name.clone())).collect();
    let width = ui.available_width() - 8.0;
    edits.extend(fields::choose(ui, &desk.book, Book::SCENARIO, field, &choices, width).map(|id| (field.to_owned(), id)));
}

fn rows(ui: &mut Ui, desk: &Desk, id: &str, rows: &[Row], edits: &mut Vec<(String, String)>) {
    Grid::new(id).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        for (label, field, help) in rows {
            name(ui, label);
            let width = ui.available_width() - 12.0;
            ui.vertical(|ui| {
                let hint = of_site(&desk.book, field);
                let typed = fields::edit(ui, &desk.book, Book::SCENARIO, field, width, fields::Said { hint: &hint, help });
                edits.extend(typed.map(|value| ((*field).to_owned(), value)));
                if let Some(problem) = desk.book.problem_at(Book::SCENARIO, field) {
                    let error = RichText::new(fields::told(problem)).size(11.0).color(Theme::palette_of(ui).error);
                    ui.add(egui::Label::new(error).wrap());
                }
            });
            ui.end_row();
        }
    });
}

/// What the site gives where the scenario itself names nothing.
fn of_site(book: &Book, field: &str) -> String {
    let key = match field {
        "site.depth" => "depth",
        "current.speed" => "current",
        _ => return String::new(),
    };
    let file = |item: String| format!("sites/{item}.toml");
    let site = book.field(Book::SCENARIO, "site.item").map(file);
    let given = site.and_then(|path| book.field(&path, &format!("{key}.value")).or_else(|| book.field(&path, key)));
    given.map_or_else(String::new, |value| format!("{value} (site)"))
}

fn weak_links(ui: &mut Ui, desk: &Desk, edits: &mut Vec<(String, String)>) {
    let mut on = desk.book.field(Book::SCENARIO, "weak_links").is_none_or(|text| text == "true");
    if ui.checkbox(&mut on, "Weak links part").on_hover_text("Off: links hold whatever they are rated (K when flying)").changed() {
        edits.push(("weak_links".into(), on.to_string()));
    }
}

fn apply(ui: &mut Ui, desk: &mut Desk) {
    let wanted = desk.stale() && !desk.making() && !desk.book.any_error();
    ui.horizontal(|ui| {
        if primary(ui, wanted, "Apply").on_hover_text("Make the model from the present texts (Ctrl+Enter)").clicked() {
            desk.orders.push(Order::Apply);
        }
        if desk.making() {
            ui.spinner();
        }
    });
}
