//! Comparison of two runs: A, the run shown, and B, held or from a recording; their figures and differences.

use crate::gui::command::action::PanelAction;
use crate::gui::widgets::command;
use egui::{Grid, RichText, ScrollArea, Ui};
use endline_session::command::RunAction;
use endline_session::edit::Documents;
use endline_session::figures::compare::{Group, SAME, groups};
use endline_session::live::{LiveView, Status};

use crate::gui::panel::{Panel, PanelId};
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets;
use crate::gui::widgets::words::capital;

/// The panel that compares two runs.
#[derive(Debug, Default)]
pub struct ComparePanel;

impl Panel for ComparePanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        show(ui, shared);
    }
}

/// Draws the comparison.
fn show(ui: &mut Ui, shared: &mut Shared) {
    buttons(ui, shared);
    let Some(other) = shared.workbench.comparison() else {
        let text = "Hold a run, change the gear or the pilot, and run again: the 3-D view shows both at one moment, plots draw A \
                    solid and B dashed. Or compare with a run of Recordings.";
        return widgets::nothing(ui, text);
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("A").strong());
        let name = shared.documents().field(Documents::SCENARIO, "name");
        let name = name.unwrap_or_else(|| shared.workbench.scenario_stem());
        ui.label(format!("{name} (solid in plots)"));
        ui.label(RichText::new("B").strong());
        ui.label(format!("{} (dashed)", other.name));
    });
    let (Some(a), Some(b)) = (shared.workbench.view().cloned(), other.view.clone()) else {
        return widgets::nothing(ui, "Assembling the model …");
    };
    standing(ui, &a, &b);
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        for group in groups(&a, &b, shared.workbench.preferences().units) {
            table(ui, &group);
        }
    });
}

fn buttons(ui: &mut Ui, shared: &mut Shared) {
    ui.horizontal_wrapped(|ui| {
        command(ui, shared, "Hold this run as B", RunAction::Hold);
        if ui.button("Recordings …").on_hover_text("Select a recording to compare with").clicked()
        {
            shared.give(PanelAction::Show(PanelId::Recordings));
        }
        command(ui, shared, "End comparison", RunAction::EndComparison);
    });
}

/// Draws how far each run has been computed, because figures of different durations are not comparable.
fn standing(ui: &mut Ui, a: &LiveView, b: &LiveView) {
    let palette = Theme::palette_of(ui);
    if b.status == Status::Running {
        ui.label(RichText::new(format!("B is replayed: {:.2} s", b.newest_s)).color(palette.faint));
    } else if (a.newest_s - b.newest_s).abs() > 0.011 {
        let text = format!(
            "A has {:.2} s, B {:.2} s. Peaks and times are comparable only over the same duration.",
            a.newest_s, b.newest_s
        );
        ui.add(egui::Label::new(RichText::new(text).color(palette.warning)).wrap());
    }
}

fn table(ui: &mut Ui, (head, rows): &Group) {
    let palette = Theme::palette_of(ui);
    widgets::caption(ui, head);
    Grid::new(head).num_columns(4).striped(true).spacing([16.0, 2.0]).min_row_height(17.0).show(
        ui,
        |ui| {
            for text in ["", "A", "B", "A − B"] {
                ui.label(RichText::new(text).small().color(palette.faint));
            }
            ui.end_row();
            for row in rows {
                let name = RichText::new(capital(&row.name)).color(palette.faint);
                ui.label(name).on_hover_text(row.help);
                ui.label(&row.a);
                ui.label(&row.b);
                let colour = if row.difference == SAME { palette.faint } else { palette.text };
                ui.label(RichText::new(&row.difference).color(colour));
                ui.end_row();
            }
        },
    );
}
