//! Table of tension and float height for depths and currents.

use egui::{Grid, ProgressBar, RichText, Ui};
use endline_session::edit::Documents;
use endline_session::statics::{TrialGear, sweep};
use endline_session::units::Units;

use super::{Answer, AssemblyPanel};
use crate::gui::shared::Shared;
use crate::gui::theme::{Theme, primary};

/// Draws the table.
pub(super) fn show(ui: &mut Ui, panel: &mut AssemblyPanel, shared: &Shared, gear: &TrialGear) {
    panel.swept.poll();
    let wanted = (shared.workbench.project().documents.version(), gear.clone());
    let (done, all) = panel.swept.progress();
    ui.horizontal(|ui| {
        let fresh = panel.swept_for.as_ref() == Some(&wanted);
        if done < all && fresh {
            ui.add(
                ProgressBar::new(done as f32 / all as f32)
                    .desired_width(160.0)
                    .text(format!("{done} of {all}")),
            );
            if ui.button("Cancel").clicked() {
                panel.swept.cancel();
                panel.swept_for = None;
            }
        } else {
            let text = if fresh { "Compute again" } else { "Compute" };
            if primary(ui, true, text)
                .on_hover_text("Solves the statics for every depth and current")
                .clicked()
            {
                start(panel, shared, gear);
            }
            if !fresh && done > 0 {
                ui.label(
                    RichText::new("from before the last edits")
                        .color(Theme::palette_of(ui).warning),
                );
            }
        }
        ui.label(
            RichText::new("greatest tension; floats pulled under are marked ⏷")
                .color(Theme::palette_of(ui).faint),
        );
    });
    if all > 0 {
        table(ui, panel, shared.workbench.preferences().units);
    }
}

fn start(panel: &mut AssemblyPanel, shared: &Shared, gear: &TrialGear) {
    let scenario = shared
        .workbench
        .project()
        .documents
        .text(Documents::SCENARIO)
        .unwrap_or_default()
        .to_owned();
    let (library, (host, waker)) =
        (shared.workbench.project().documents.library().clone(), shared.workbench.helpers());
    panel.swept.ask(&scenario, &library, sweep::trials(gear), &host, &waker);
    panel.swept_for = Some((shared.workbench.project().documents.version(), gear.clone()));
}

fn table(ui: &mut Ui, panel: &AssemblyPanel, units: Units) {
    let faint = Theme::palette_of(ui).faint;
    let currents = sweep::currents_m_s();
    Grid::new("sweep").num_columns(currents.len() + 1).striped(true).spacing([20.0, 3.0]).show(
        ui,
        |ui| {
            ui.label(RichText::new("Depth").small().color(faint));
            for current_m_s in currents {
                ui.label(RichText::new(units.speed(current_m_s)).small().color(faint));
            }
            ui.end_row();
            for (row, depth_m) in sweep::depths_m().into_iter().enumerate() {
                ui.label(RichText::new(units.depth(depth_m)).color(faint));
                for column in 0..currents.len() {
                    cell(ui, panel.swept.newest(row * currents.len() + column), units);
                }
                ui.end_row();
            }
        },
    );
}

fn cell(ui: &mut Ui, answer: Option<&Answer>, units: Units) {
    let palette = Theme::palette_of(ui);
    match answer {
        None => ui.label(RichText::new("…").color(palette.faint)),
        Some(Err(why)) => ui.label(RichText::new("–").color(palette.faint)).on_hover_text(why),
        Some(Ok(rest)) => {
            let (most, under) = (rest.greatest_tension_n(), rest.has_buoy_under_water());
            let color = match (rest.shape.converged, under) {
                (false, _) => palette.error,
                (true, true) => palette.warning,
                (true, false) => palette.text,
            };
            let mark = if under { " ⏷" } else { "" };
            ui.label(RichText::new(format!("{}{mark}", units.force().text(most))).color(color))
                .on_hover_text(&rest.shape.outcome)
        }
    };
}
