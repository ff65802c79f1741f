//! Attributes of motions and friction laws, as fields of the scenario with defaults; and the friction laws of rope on whale.

use egui::{Grid, Ui};
use endline_gear::units::{Quantity, format_si};
use endline_sdk::{Attribute, AttributeKind};
use endline_session::edit::Documents;

use super::{Edit, name_with_help, problem};
use crate::gui::fields;
use crate::gui::shared::Shared;
use crate::gui::widgets::words;

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

fn in_unit(value: f64, unit: &str) -> String {
    let value = words::rounded(value);
    Quantity::from_si_unit(unit).map_or_else(
        || format!("{value} {unit}").trim().to_owned(),
        |quantity| format_si(value, quantity),
    )
}
