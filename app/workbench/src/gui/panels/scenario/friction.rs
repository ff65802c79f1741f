//! Friction of rope on whale: the law, its attributes, and laws of their own for single surfaces.

use egui::{Grid, Label, RichText, Ui};
use endline_gear::{Document, SURFACES};
use endline_session::edit::Documents;
use endline_session::edit::scenario::{self, FRICTION_LAWS as ON};

use super::{Edit, attributes, name};
use crate::gui::fields;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;

/// A change of the friction laws for single surfaces.
enum Change {
    /// Adds a law for a surface.
    Add(&'static str, String),
    /// Removes the law with this index.
    Remove(usize),
}

impl Change {
    fn make(self, document: &mut Document) -> Result<(), String> {
        match self {
            Self::Remove(index) => {
                document.remove_table(ON, index).map_err(|error| error.to_string())
            }
            Self::Add(surface, model) => scenario::add_friction_law(document, surface, &model),
        }
    }
}

/// Draws the friction laws.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, edits: &mut Vec<Edit>) {
    widgets::caption(ui, "Friction of rope on whale");
    law(ui, shared, "friction", edits);
    let mut change = None;
    for index in 0..shared.documents().count(Documents::SCENARIO, ON) {
        let table = format!("{ON}.{index}");
        let surfaces = surfaces(shared.documents(), &table);
        ui.horizontal(|ui| {
            if ui.small_button("✖").on_hover_text("Removes it; Undo restores it").clicked() {
                change = Some(Change::Remove(index));
            }
            ui.add(
                Label::new(
                    RichText::new(format!("On {surfaces}")).color(Theme::palette_of(ui).faint),
                )
                .truncate(),
            );
        });
        law(ui, shared, &table, edits);
    }
    let usual = shared.documents().field(Documents::SCENARIO, "friction.model");
    ui.add_enabled_ui(usual.is_some(), |ui| {
        ui.menu_button("Another law for … ⏷", |ui| {
            for word in SURFACES {
                if ui.button(word).clicked() {
                    change = usual.clone().map(|model| Change::Add(word, model));
                    ui.close();
                }
            }
        });
    });
    if let Some(change) = change {
        shared.alter(Documents::SCENARIO, |document| change.make(document));
    }
}

/// Draws the law in a table of the scenario, with its attributes.
fn law(ui: &mut Ui, shared: &Shared, table: &str, edits: &mut Vec<Edit>) {
    let (host, _) = shared.workbench.helpers();
    let laws = host
        .ids()
        .into_iter()
        .filter_map(|id| host.friction(&id).map(|law| (id, law.descriptor().name.to_string())));
    let laws: Vec<(String, String)> = laws.collect();
    let field = format!("{table}.model");
    Grid::new(("law", table)).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        name(ui, "Law");
        let width = ui.available_width() - 8.0;
        let taken =
            fields::choose(ui, shared.documents(), Documents::SCENARIO, &field, &laws, width);
        edits.extend(taken.map(|id| (field.clone(), id)));
        ui.end_row();
    });
    if let Some(law) =
        shared.documents().field(Documents::SCENARIO, &field).and_then(|id| host.friction(&id))
    {
        attributes::show(
            ui,
            shared,
            &format!("{table}.attributes"),
            &law.descriptor().attributes,
            edits,
        );
    }
}

/// Surfaces of a law as words.
fn surfaces(documents: &Documents, table: &str) -> String {
    let words = (0..).map_while(|index| {
        documents.field(Documents::SCENARIO, &format!("{table}.surfaces.{index}"))
    });
    words.collect::<Vec<_>>().join(", ")
}
