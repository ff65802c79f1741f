//! Attributes of a gear type as a form, from the declarations of its plugin.

use egui::{Grid, RichText, Slider, SliderClamping, Ui};
use endline_gear::Kind;
use endline_gear::units::{Quantity, format_si};
use endline_sdk::{Attribute, AttributeKind};
use endline_session::command::EditAction;
use endline_session::edit::Documents;
use endline_session::statics::TrialGear;

use super::{AssemblyPanel, WhenEmpty, inserts, item, with_usual};
use crate::gui::fields;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::{self, words};

/// Draws the form.
pub(super) fn show(
    ui: &mut Ui,
    panel: &AssemblyPanel,
    shared: &mut Shared,
    shown: &TrialGear,
    gear_type: &str,
) {
    let file = &super::path(shown);
    let Some(gear) =
        shared.workbench.gear_types().into_iter().find(|gear| gear.descriptor().id == gear_type)
    else {
        let text = format!("No gear type `{gear_type}` among the plugins; see Problems.");
        ui.label(RichText::new(text).color(Theme::palette_of(ui).error));
        return;
    };
    ui.label(RichText::new(gear.descriptor().name.as_ref()).color(Theme::palette_of(ui).faint));
    let attributes = gear.descriptor().attributes.clone();
    if let Some(scope) = attributes.iter().find(|attribute| attribute.key == "scope") {
        scope_slider(ui, shared, file, scope);
    }
    let placed = shared.workbench.project().documents.field(Documents::SCENARIO, "gear.0.assembly");
    let is_placed = placed.is_some_and(|id| *shown == TrialGear::Assembly(id));
    inserts::of_built(ui, panel, shared, (shown, is_placed));
    widgets::caption(ui, "Attributes");
    Grid::new("attributes").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        for attribute in &attributes {
            let name = words::title(&attribute.key);
            ui.label(RichText::new(name).color(Theme::palette_of(ui).faint))
                .on_hover_text(help(attribute));
            cell(ui, shared, file, attribute);
            ui.end_row();
        }
    });
}

/// Draws a slider of the scope; the gear follows while it moves.
fn scope_slider(ui: &mut Ui, shared: &mut Shared, file: &str, attribute: &Attribute) {
    let AttributeKind::Number { min, max, default } = attribute.kind else { return };
    let typed = shared
        .workbench
        .project()
        .documents
        .field(file, "attributes.scope")
        .and_then(|text| text.parse::<f64>().ok());
    let mut scope = typed.unwrap_or(default);
    let slider = Slider::new(&mut scope, min.max(1.0)..=max.min(3.0))
        .clamping(SliderClamping::Never)
        .min_decimals(2)
        .max_decimals(4)
        .text("scope");
    ui.spacing_mut().slider_width = 110.0;
    let response = ui.add(slider).on_hover_text("Length of the endline divided by water depth");
    if response.changed() {
        shared.set_held(file, "attributes.scope", &super::written(scope));
    }
    if response.drag_stopped() || response.lost_focus() {
        shared.perform(EditAction::LetGo);
    }
}

fn cell(ui: &mut Ui, shared: &mut Shared, file: &str, attribute: &Attribute) {
    let field = format!("attributes.{}", attribute.key);
    let width = ui.available_width() - 8.0;
    match &attribute.kind {
        AttributeKind::Item { library, default } => {
            let Some(kind) = Kind::in_folder(library) else { return };
            let empty =
                if default.is_empty() { WhenEmpty::Nothing } else { WhenEmpty::Usual(default) };
            item(ui, shared, file, &field, kind, &empty);
        }
        AttributeKind::Choice { words, default } => {
            let documents = &shared.workbench.project().documents;
            let mut choices: Vec<(String, String)> =
                words.iter().map(|word| (word.to_string(), word.to_string())).collect();
            with_usual(&mut choices, default, documents.field(file, &field).as_deref());
            if let Some(taken) = fields::choose(
                ui,
                &shared.workbench.project().documents,
                file,
                &field,
                &choices,
                width,
            ) {
                shared.set(file, &field, &taken);
            }
        }
        AttributeKind::Number { .. } | AttributeKind::Count { .. } => {
            let (hint, help) = (usual(attribute), help(attribute));
            if let Some(typed) = fields::edit(
                ui,
                &shared.workbench.project().documents,
                file,
                &field,
                width,
                fields::Said { hint: &hint, help: &help },
            ) {
                shared.set(file, &field, &typed);
            }
        }
    }
}

/// Default value.
fn usual(attribute: &Attribute) -> String {
    let text = match &attribute.kind {
        AttributeKind::Number { default, .. } => in_unit(*default, &attribute.unit),
        AttributeKind::Count { default, .. } => default.to_string(),
        AttributeKind::Choice { default, .. } | AttributeKind::Item { default, .. } => {
            default.to_string()
        }
    };
    format!("{text} (usual)")
}

/// Help with the range.
fn help(attribute: &Attribute) -> String {
    let range = match &attribute.kind {
        AttributeKind::Number { min, max, .. } => {
            format!(
                "\nbetween {} and {}",
                in_unit(*min, &attribute.unit),
                in_unit(*max, &attribute.unit)
            )
        }
        AttributeKind::Count { min, max, .. } => format!("\na whole number from {min} to {max}"),
        AttributeKind::Choice { words, .. } => format!("\none of {}", words.join(", ")),
        AttributeKind::Item { library, .. } => format!("\nan item of {library}/"),
    };
    format!("{}{range}", attribute.help)
}

fn in_unit(value: f64, unit: &str) -> String {
    let value = words::rounded(value);
    Quantity::from_si_unit(unit)
        .map_or_else(|| format!("{value} {unit}"), |quantity| format_si(value, quantity))
}
