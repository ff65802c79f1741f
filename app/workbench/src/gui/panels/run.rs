//! Controls of the run, its validity, and figures of the solver.

use crate::gui::command::action::{FlightAction, WindowAction};
use crate::gui::widgets::{self, command, words};
use egui::{ProgressBar, RichText, ScrollArea, Ui};
use endline_session::command::RunAction;
use endline_session::figures::{Figure, shares};
use endline_session::live::LiveView;
use endline_session::report::headline::{Sentence, Tone};
use endline_session::units::Units;
use endline_session::workbench::SPEEDS;
use endline_sim::Cost;

use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::{Theme, primary};

/// Least share of the computing time of a part that is listed; smaller parts are shown on hover.
const LEAST_LISTED: f64 = 0.05;

/// Controls of the run, and figures of the solver.
#[derive(Debug, Default)]
pub struct RunPanel;

impl Panel for RunPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        show(ui, shared);
    }
}

/// Draws the run panel.
fn show(ui: &mut Ui, shared: &mut Shared) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        buttons(ui, shared);
        let Some(view) = shared.workbench.view().cloned() else { return };
        progress(ui, &view);
        speeds(ui, shared, &view);
        if shared.workbench.stale() {
            stale(ui, shared);
        }
        fly(ui, shared);
        command(ui, shared, "Copy as command line", WindowAction::CopyCommandLine);
        state(ui, &view);
    });
}

fn buttons(ui: &mut Ui, shared: &mut Shared) {
    let running = shared.workbench.running();
    let ready = shared.workbench.view().is_some() && !shared.workbench.making();
    ui.horizontal(|ui| {
        let (text, action) =
            if running { ("⏸ Pause", RunAction::Pause) } else { ("▶ Run", RunAction::Start) };
        if primary(ui, ready, text).on_hover_text("Space").clicked() {
            shared.give(action);
        }
        command(ui, shared, "Step", RunAction::Step);
        command(ui, shared, "⏮ Reset", RunAction::Reset);
    });
}

/// Draws a note if the run shows gear from before the last edits, or another source than the scenario.
fn stale(ui: &mut Ui, shared: &mut Shared) {
    let palette = Theme::palette_of(ui);
    if shared.workbench.making() {
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label(RichText::new("assembling the model").color(palette.faint));
        });
    } else if shared.workbench.project().documents.any_error() {
        let text = "The files have errors. The run shown is from before the last edits.";
        ui.add(egui::Label::new(RichText::new(text).color(palette.error)).wrap());
    } else {
        ui.horizontal_wrapped(|ui| {
            let text = match shared.workbench.guest() {
                Some(guest) => format!("This run is {guest}, not the open scenario."),
                None => "Gear or scenario has changed.".to_owned(),
            };
            ui.label(RichText::new(text).color(palette.warning));
            command(ui, shared, "Apply", RunAction::Apply);
        });
    }
}

fn progress(ui: &mut Ui, view: &LiveView) {
    let duration = view.model.spec.settings.duration_s.max(1e-9);
    let text = format!("{:.2} of {duration:.0} s", view.frame.time_s);
    let bar =
        ProgressBar::new((view.newest_s / duration) as f32).desired_height(18.0).corner_radius(3.0);
    ui.add(
        bar.text(RichText::new(text).size(12.0).color(Theme::palette_of(ui).text))
            .fill(Theme::palette_of(ui).accent.gamma_multiply(0.45)),
    );
}

fn speeds(ui: &mut Ui, shared: &mut Shared, view: &LiveView) {
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Speed").color(Theme::palette_of(ui).faint));
        ui.spacing_mut().item_spacing.x = 2.0;
        for speed in SPEEDS {
            if ui.selectable_label(speed.is(view.speed), speed.short).clicked() {
                shared.give(RunAction::Speed(speed.factor));
            }
        }
    });
}

fn fly(ui: &mut Ui, shared: &mut Shared) {
    ui.horizontal(|ui| {
        let mut flying = shared.flying;
        if ui
            .toggle_value(&mut flying, "Fly the whale")
            .on_hover_text("Ctrl+F; Esc stops steering. Keys and pad: F1")
            .clicked()
        {
            shared.give(FlightAction::Toggle);
        }
        let hands = shared.pilot.pad_name().unwrap_or("keyboard; no pad found").to_owned();
        ui.add(
            egui::Label::new(RichText::new(hands).color(Theme::palette_of(ui).faint)).truncate(),
        );
    });
}

fn state(ui: &mut Ui, view: &LiveView) {
    let palette = Theme::palette_of(ui);
    ui.add_space(4.0);
    let (text, bad) = words::status(&view.status);
    ui.add(
        egui::Label::new(RichText::new(text).color(if bad { palette.error } else { palette.text }))
            .wrap(),
    );
    trust(ui, view);
    cost(ui, view);
    let audit = &view.audit;
    let skin = view.model.spec.whale.as_ref().map_or(0, |whale| whale.skin.triangles.len());
    widgets::explained(
        ui,
        "run",
        &[
            (
                "Solver speed",
                format!("{:.1} × real time", view.times_real_time),
                "Simulated time per computing time, without waiting",
            ),
            ("Solver steps", audit.solver_steps.to_string(), "Time steps solved so far"),
            (
                "Of these in contact",
                audit.contact_steps.to_string(),
                "Steps with rope or gear near the whale, which are the most expensive",
            ),
            (
                "Steps repeated",
                audit.halved.to_string(),
                "Steps that did not converge and were repeated with half the length",
            ),
            (
                "Not converged",
                audit.unconverged.to_string(),
                "Steps accepted without convergence; a few are harmless, many make a run invalid",
            ),
            (
                "Rope through skin",
                audit.tunnelled.to_string(),
                "Number of times rope passed through the whale; must be 0",
            ),
            (
                "Greatest penetration",
                format!("{:.1} mm", audit.max_penetration_m * 1000.0),
                "Greatest depth of the rope's axis below the surface of the skin",
            ),
            (
                "Rope nodes",
                view.model.node_count.to_string(),
                "Nodes of the rope discretization; more nodes are finer and slower",
            ),
            ("Skin triangles", skin.to_string(), "Triangles of the whale that rope can touch"),
            (
                "State hash",
                view.state_hash.clone(),
                "Two runs with the same hash have identical states",
            ),
        ],
    );
}

/// Draws reasons to doubt the run, or not to use it.
fn trust(ui: &mut Ui, view: &LiveView) {
    let palette = Theme::palette_of(ui);
    for Sentence { text, tone } in view.headline(Units::default()) {
        let colour = match tone {
            Tone::Result => continue,
            Tone::Coarse | Tone::Kinematic => palette.warning,
            Tone::Invalid => palette.error,
        };
        ui.add(egui::Label::new(RichText::new(text).color(colour)).wrap());
    }
}

/// Draws shares of the computing time, largest first, with explanations on hover.
fn cost(ui: &mut Ui, view: &LiveView) {
    let shares = shares(&view.cost);
    if shares.is_empty() {
        return;
    }
    let listed = shares.iter().filter(|(_, share)| *share >= LEAST_LISTED);
    let listed = listed.map(|(figure, share)| format!("{} {:.0} %", figure.label, 100.0 * share));
    let text = format!("Computing time: {}", listed.collect::<Vec<_>>().join(", "));
    let part = |(figure, _): &(&Figure<Cost>, f64)| {
        let spent = figure.quantity.text(&(figure.read)(&view.cost), Units::Si);
        format!("{}: {spent}. {}", figure.label, figure.help)
    };
    let parts = shares.iter().map(part).collect::<Vec<_>>().join("\n");
    ui.add(egui::Label::new(RichText::new(text).color(Theme::palette_of(ui).faint)).wrap())
        .on_hover_text(parts);
}
