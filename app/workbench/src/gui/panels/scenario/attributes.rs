//! Attributes of motions and friction laws, as fields of the scenario with defaults; and the friction laws of rope on whale.

use egui::{Grid, Label, RichText, Ui};
use endline_gear::units::{Quantity, find, format, format_si};
use endline_gear::{Document, SURFACES};
use endline_sdk::{Attribute, AttributeKind};
use endline_session::edit::scenario::FRICTION_LAWS as ON;
use endline_session::edit::{Documents, scenario};
use endline_session::units::grouped;

use crate::gui::panels::scenario::{Edit, name, name_with_help, problem};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words;
use crate::gui::{fields, widgets};

/// Draws the attributes in a table of the scenario, such as `friction.attributes`.
pub(super) fn show(
    ui: &mut Ui,
    shared: &Shared,
    table: &str,
    attributes: &[Attribute],
    edits: &mut Vec<Edit>,
) {
    if attributes.is_empty() {
        return;
    }
    Grid::new(("attributes", table)).num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        for attribute in attributes {
            let field = format!("{table}.{}", attribute.key);
            let help = help(attribute);
            name_with_help(ui, &words::title(&attribute.key), &help);
            ui.vertical(|ui| {
                cell(ui, shared, &field, attribute, &help, edits);
                problem(ui, shared, &field);
            });
            ui.end_row();
        }
    });
}

fn cell(
    ui: &mut Ui,
    shared: &Shared,
    field: &str,
    attribute: &Attribute,
    help: &str,
    edits: &mut Vec<Edit>,
) {
    let width = ui.available_width() - 12.0;
    let typed = match &attribute.kind {
        AttributeKind::Choice { words, default } => {
            let usual = (String::new(), format!("{default} (usual)"));
            let words = words
                .iter()
                .filter(|word| *word != default)
                .map(|word| (word.to_string(), word.to_string()));
            let choices: Vec<(String, String)> = std::iter::once(usual).chain(words).collect();
            fields::choose(
                ui,
                shared.documents(),
                Documents::SCENARIO,
                field,
                &choices,
                width + 4.0,
            )
        }
        _ => fields::edit(
            ui,
            shared.documents(),
            Documents::SCENARIO,
            field,
            width,
            fields::Said { hint: &usual(attribute), help },
        ),
    };
    edits.extend(typed.map(|value| (field.to_owned(), value)));
}

/// Default value; the file of a rope's material may have another.
fn usual(attribute: &Attribute) -> String {
    match &attribute.kind {
        AttributeKind::Number { default, .. } => in_unit(*default, &attribute.unit),
        AttributeKind::Count { default, .. } => default.to_string(),
        AttributeKind::Choice { default, .. } | AttributeKind::Item { default, .. } => {
            default.to_string()
        }
    }
}

fn help(attribute: &Attribute) -> String {
    let range = match &attribute.kind {
        AttributeKind::Number { min, max, .. } => {
            format!("\n{} to {}", in_unit(*min, &attribute.unit), in_unit(*max, &attribute.unit))
        }
        AttributeKind::Count { min, max, .. } => format!("\na whole number from {min} to {max}"),
        AttributeKind::Choice { words, .. } => format!("\n{}", words.join(" or ")),
        AttributeKind::Item { library, .. } => format!("\nan item of {library}/"),
    };
    format!("{}{range}", attribute.help)
}

/// A number with its unit and at most four digits; angles are in degrees.
fn in_unit(value: f64, unit: &str) -> String {
    let Some(quantity) = Quantity::from_si_unit(unit) else {
        return format!("{} {unit}", words::rounded(value)).trim().to_owned();
    };
    let degrees = match quantity {
        Quantity::Angle => find("deg", quantity),
        Quantity::TurnRate => find("deg/s", quantity),
        _ => None,
    };
    let of_si = |si| degrees.map_or_else(|| format_si(si, quantity), |unit| format(si, unit));
    let factor = degrees.map_or(1.0, |unit| unit.factor());
    grouped(&of_si(to_digits(value / factor, 4) * factor))
}

/// A number rounded to some significant digits.
fn to_digits(value: f64, digits: i32) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let scale = 10f64.powi(digits - 1 - value.abs().log10().floor() as i32);
    (value * scale).round() / scale
}

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
pub(super) fn show_friction(ui: &mut Ui, shared: &mut Shared, edits: &mut Vec<Edit>) {
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
        show(ui, shared, &format!("{table}.attributes"), &law.descriptor().attributes, edits);
    }
}

/// Surfaces of a law as words.
fn surfaces(documents: &Documents, table: &str) -> String {
    let words = (0..).map_while(|index| {
        documents.field(Documents::SCENARIO, &format!("{table}.surfaces.{index}"))
    });
    words.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::in_unit;

    #[test]
    fn angles_are_in_degrees_and_numbers_have_four_digits() {
        for (value, unit, text) in [
            (0.174_532_925, "rad/s", "10 deg/s"),
            (0.26, "rad", "14.9 deg"),
            (1e7, "N/m2", "10,000,000 N/m2"),
            (1.0 / 3.0, "m", "0.3333 m"),
        ] {
            assert_eq!(in_unit(value, unit), text);
        }
    }
}
