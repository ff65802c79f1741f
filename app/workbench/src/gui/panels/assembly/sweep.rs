//! Tension and float height of the gear over depths and currents.

use egui::{Grid, ProgressBar, RichText, Ui};
use endline_session::edit::Documents;
use endline_session::statics::Trial;
use endline_session::statics::{RigAtRest, TrialGear, TrialSea};
use endline_session::units::Units;
use endline_sim::model::BodyRole;

use super::side::top_m;
use super::{Answer, AssemblyPanel};
use crate::gui::shared::Shared;
use crate::gui::theme::{Theme, primary};

/// Depths of water [fathom].
const DEPTHS: [u32; 6] = [5, 10, 20, 40, 60, 100];
/// Surface speeds of the current [kn].
const CURRENTS_KN: [f64; 5] = [0.0, 0.5, 1.0, 1.5, 2.0];

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
                .on_hover_text("Settle the gear in every depth and current")
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
    let sea = |fathom: u32, knots: f64| TrialSea {
        depth: Some(format!("{fathom} fathom")),
        current_m_s: Some(Units::Noaa.to_m_s(knots)),
    };
    let trial = |fathom: u32, knots: f64| Trial { gear: gear.clone(), sea: sea(fathom, knots) };
    let trials = DEPTHS
        .iter()
        .flat_map(|depth| CURRENTS_KN.iter().map(|current| trial(*depth, *current)))
        .collect();
    let scenario = shared
        .workbench
        .project()
        .documents
        .text(Documents::SCENARIO)
        .unwrap_or_default()
        .to_owned();
    let (library, (host, waker)) =
        (shared.workbench.project().documents.library().clone(), shared.workbench.helpers());
    panel.swept.ask(&scenario, &library, trials, &host, &waker);
    panel.swept_for = Some((shared.workbench.project().documents.version(), gear.clone()));
}

fn table(ui: &mut Ui, panel: &AssemblyPanel, units: Units) {
    let faint = Theme::palette_of(ui).faint;
    Grid::new("sweep").num_columns(CURRENTS_KN.len() + 1).striped(true).spacing([20.0, 3.0]).show(
        ui,
        |ui| {
            ui.label(RichText::new("Depth").small().color(faint));
            for current in CURRENTS_KN {
                ui.label(
                    RichText::new(units.speed(Units::Noaa.to_m_s(current))).small().color(faint),
                );
            }
            ui.end_row();
            for (row, fathom) in DEPTHS.iter().enumerate() {
                ui.label(RichText::new(units.depth(f64::from(*fathom) * 1.8288)).color(faint));
                for column in 0..CURRENTS_KN.len() {
                    cell(ui, panel.swept.newest(row * CURRENTS_KN.len() + column), units);
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
            let most = rest
                .shape
                .lines
                .iter()
                .flat_map(|line| &line.tension_N)
                .copied()
                .fold(0.0, f64::max);
            let under = any_under(rest);
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

fn any_under(rest: &RigAtRest) -> bool {
    let bodies = rest.model.spec.bodies.iter().zip(&rest.shape.bodies);
    bodies.filter(|(body, _)| body.role == BodyRole::Buoy).any(|(body, at)| top_m(body, at) < 0.0)
}
