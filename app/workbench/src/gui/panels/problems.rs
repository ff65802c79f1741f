//! Everything wrong with the files, each with its place and how to mend it.

use egui::{Label, RichText, ScrollArea, Sense, Ui};
use endline_gear::Diagnostic;
use endline_gear::Kind;

use super::super::desk::{Desk, Order};
use super::super::fields::place;
use super::super::layout::Panel;
use super::super::theme::Theme;

/// Draws the list of problems.
pub fn show(ui: &mut Ui, desk: &mut Desk) {
    let problems: Vec<Diagnostic> = desk.problems().cloned().collect();
    if problems.is_empty() && desk.plugins.problems.is_empty() {
        super::nothing(ui, "No problems: every file of the library and the scenario can be read.");
        return;
    }
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for problem in &problems {
            if entry(ui, problem) {
                go_to(desk, problem);
            }
        }
        for problem in &desk.plugins.problems {
            let warning = Theme::palette_of(ui).warning;
            ui.add(Label::new(RichText::new(format!("plugin: {problem}")).color(warning)).wrap());
        }
    });
}

/// One problem in two lines; answers whether it was clicked.
pub fn entry(ui: &mut Ui, problem: &Diagnostic) -> bool {
    let palette = Theme::palette_of(ui);
    let (mark, colour) =
        if problem.is_error() { ("✖", palette.error) } else { ("▲", palette.warning) };
    let row = ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        ui.horizontal(|ui| {
            ui.label(RichText::new(mark).color(colour));
            ui.label(RichText::new(place(problem)).monospace().size(12.0).color(palette.faint));
            if !problem.field.is_empty() {
                ui.label(
                    RichText::new(&problem.field).monospace().size(12.0).color(palette.accent),
                );
            }
            ui.add(Label::new(RichText::new(&problem.message).color(colour)).truncate());
        });
        if !problem.help.is_empty() {
            ui.horizontal(|ui| {
                ui.add_space(20.0);
                ui.add(Label::new(RichText::new(&problem.help).color(palette.faint)).truncate());
            });
        }
    });
    ui.add_space(4.0);
    row.response.interact(Sense::click()).on_hover_text(problem.to_string()).clicked()
}

/// Opens the panel where a problem can be mended.
fn go_to(desk: &mut Desk, problem: &Diagnostic) {
    let kind = problem.file.split_once('/').and_then(|(folder, _)| Kind::in_folder(folder));
    let table = kind.filter(|kind| super::library::KINDS.iter().any(|(shown, _)| shown == kind));
    match table {
        Some(kind) => {
            desk.library.kind = kind;
            desk.library.search.clear();
            desk.library.chosen = Some(problem.file.clone());
            desk.orders.push(Order::Show(Panel::Library));
        }
        None => desk.orders.push(Order::Show(Panel::Scenario)),
    }
}
