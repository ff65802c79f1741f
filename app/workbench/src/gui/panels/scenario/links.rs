//! Weak links of the scenario: those of its gear types, those added to its lines, and whether links can part.

use egui::{Grid, RichText, Ui};
use endline_gear::{Document, Kind};
use endline_sdk::AttributeKind;
use endline_session::edit::{Documents, assembly};

use super::{Edit, flag, name, problem, rows};
use crate::gui::fields;
use crate::gui::scenario_fields::{LINKS_PART, Row};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::{self, words};

/// A change of the list of weak links.
enum Change {
    /// Adds a link at an end of a line.
    Add(String, &'static str),
    /// Removes the link with this index.
    Remove(usize),
}

/// Draws the weak links.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, edits: &mut Vec<Edit>) {
    widgets::caption(ui, "Weak links");
    of_gear(ui, shared, edits);
    let mut change = None;
    for index in 0..shared.documents().count(Documents::SCENARIO, "link") {
        let remove = one(ui, shared, index, edits);
        change = change.or(remove.then_some(Change::Remove(index)));
    }
    change = add(ui, shared).or(change);
    flag(ui, shared, &LINKS_PART, edits);
    if let Some(change) = change {
        shared.alter(Documents::SCENARIO, |document| change.make(document));
    }
}

/// Draws the links of gear types: those of the assembly, unless the scenario sets others.
fn of_gear(ui: &mut Ui, shared: &Shared, edits: &mut Vec<Edit>) {
    let placed = (0..).map_while(|index| {
        shared
            .documents()
            .field(Documents::SCENARIO, &format!("gear.{index}.assembly"))
            .map(|id| (index, id))
    });
    for (index, assembly) in placed {
        let file = format!("assemblies/{assembly}.toml");
        let wanted = shared.documents().field(&file, "gear_type");
        let Some(gear) = shared
            .workbench
            .gear_types()
            .into_iter()
            .find(|gear| Some(gear.descriptor().id.as_ref()) == wanted.as_deref())
        else {
            continue;
        };
        Grid::new(("links of gear", index)).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
            for attribute in &gear.descriptor().attributes {
                let AttributeKind::Item { library, default } = &attribute.kind else { continue };
                if Kind::in_folder(library) != Some(Kind::WeakLink) {
                    continue;
                }
                let own = shared
                    .documents()
                    .field(&file, &format!("attributes.{}", attribute.key))
                    .unwrap_or_else(|| default.to_string());
                let own = if own.is_empty() { "none".to_owned() } else { title_of(shared, &own) };
                name(ui, &words::title(&attribute.key));
                let field = format!("gear.{index}.attributes.{}", attribute.key);
                let width = ui.available_width() - 8.0;
                let choices: Vec<(String, String)> =
                    std::iter::once((String::new(), format!("{own} (assembly)")))
                        .chain(items(shared))
                        .collect();
                let taken = fields::choose(
                    ui,
                    shared.documents(),
                    Documents::SCENARIO,
                    &field,
                    &choices,
                    width,
                );
                edits.extend(taken.map(|id| (field, id)));
                ui.end_row();
            }
        });
    }
}

/// Draws a link of the scenario: its item or rating; returns whether to remove it.
fn one(ui: &mut Ui, shared: &Shared, index: usize, edits: &mut Vec<Edit>) -> bool {
    let at = format!("link.{index}");
    let text = |key: &str| {
        shared.documents().field(Documents::SCENARIO, &format!("{at}.{key}")).unwrap_or_default()
    };
    let remove = ui
        .horizontal(|ui| {
            let words =
                format!("{}, at the {} of {}", text("id"), word_of(&text("end")), text("line"));
            let out = ui.small_button("✖").on_hover_text("Removes it; Undo restores it").clicked();
            ui.add(
                egui::Label::new(RichText::new(&words).color(Theme::palette_of(ui).faint))
                    .truncate(),
            )
            .on_hover_text(&words);
            out
        })
        .inner;
    let (item, rating) = (format!("{at}.item"), format!("{at}.rating"));
    Grid::new(("link", index)).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        name(ui, "Link");
        let none = (String::new(), "none, use the rating below".to_owned());
        let choices: Vec<(String, String)> = std::iter::once(none).chain(items(shared)).collect();
        let width = ui.available_width() - 8.0;
        edits.extend(
            fields::choose(ui, shared.documents(), Documents::SCENARIO, &item, &choices, width)
                .map(|id| (item.clone(), id)),
        );
        ui.end_row();
    });
    let usual = shared
        .documents()
        .field(&format!("weak-links/{}.toml", text("item")), "rating")
        .unwrap_or_default();
    let row = [Row {
        label: "Parts above",
        field: &rating,
        usual: &usual,
        help: "Tension above which it parts, such as 600 lbf, instead of that of the link",
    }];
    problem(ui, shared, &item);
    rows(ui, shared, &rating, &row, edits);
    remove
}

/// Draws the menu of places for a new link.
fn add(ui: &mut Ui, shared: &Shared) -> Option<Change> {
    let view = shared.workbench.view()?;
    // Pieces of a line with inserts are one line in the file.
    let mut lines: Vec<&str> = view
        .model
        .spec
        .lines
        .iter()
        .map(|line| line.id.split('.').next().unwrap_or(&line.id))
        .collect();
    lines.dedup();
    let mut change = None;
    ui.menu_button("Add a weak link ⏷", |ui| {
        for line in lines {
            for end in ["to", "from"] {
                if ui.button(format!("at the {} of {line}", word_of(end))).clicked() {
                    change = Some(Change::Add(line.to_owned(), end));
                    ui.close();
                }
            }
        }
    });
    change
}

impl Change {
    fn make(self, document: &mut Document) -> Result<(), String> {
        match self {
            Self::Remove(index) => {
                document.remove_table("link", index).map_err(|error| error.to_string())
            }
            Self::Add(line, end) => assembly::add_link(document, &line, end, ("rating", "600 lbf")),
        }
    }
}

/// Name of the end of a line; lines of shipped gear run from the bottom to the buoy.
fn word_of(end: &str) -> &'static str {
    if end == "from" { "foot" } else { "top" }
}

fn items(shared: &Shared) -> Vec<(String, String)> {
    shared
        .documents()
        .library()
        .entries(Kind::WeakLink)
        .iter()
        .map(|entry| (entry.id.clone(), entry.name.clone()))
        .collect()
}

fn title_of(shared: &Shared, id: &str) -> String {
    items(shared)
        .into_iter()
        .find(|(known, _)| known == id)
        .map_or_else(|| id.to_owned(), |(_, name)| name)
}
