//! The run's controls and how it does.

use egui::{Button, ProgressBar, RichText, ScrollArea, Ui};
use endline_session::live::LiveView;
use endline_session::live::engine::SPEEDS;

use crate::gui::desk::{Desk, Order};
use crate::gui::panel::Panel;
use crate::gui::panel_id::PanelId;
use crate::gui::theme::{Theme, primary};
use crate::gui::widgets::{self, words};

/// Controls of the run, and figures of the solver.
#[derive(Debug, Default)]
pub struct RunPanel;

impl Panel for RunPanel {
    fn id(&self) -> PanelId {
        PanelId::RUN
    }

    fn ui(&mut self, ui: &mut Ui, desk: &mut Desk) {
        show(ui, desk);
    }
}

/// Draws the run panel.
fn show(ui: &mut Ui, desk: &mut Desk) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        buttons(ui, desk);
        if desk.stale() {
            stale(ui, desk);
        }
        let Some(view) = desk.view.clone() else { return };
        progress(ui, &view);
        speeds(ui, desk, &view);
        fly(ui, desk);
        if ui
            .button("Copy as command line")
            .on_hover_text(
                "The command that gives this run, for a terminal or a script (Ctrl+Shift+C)",
            )
            .clicked()
        {
            desk.orders.push(Order::CopyCommandLine);
        }
        state(ui, &view);
    });
}

fn buttons(ui: &mut Ui, desk: &mut Desk) {
    let running = desk.running();
    let ready = desk.view.is_some() && !desk.making();
    ui.horizontal(|ui| {
        let (text, order) =
            if running { ("⏸ Pause", Order::Pause) } else { ("▶ Run", Order::Start) };
        if primary(ui, ready, text).on_hover_text("Space").clicked() {
            desk.orders.push(order);
        }
        if ui
            .add_enabled(ready && !running, Button::new("Step"))
            .on_hover_text("One step (period)")
            .clicked()
        {
            desk.orders.push(Order::Step);
        }
        if ui
            .add_enabled(ready, Button::new("⏮ Reset"))
            .on_hover_text("Back to the settled gear (Backspace)")
            .clicked()
        {
            desk.orders.push(Order::Reset);
        }
    });
}

/// Says that the run shows gear from before the last edits.
fn stale(ui: &mut Ui, desk: &mut Desk) {
    let palette = Theme::palette_of(ui);
    if desk.making() {
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label(RichText::new("making the model").color(palette.faint));
        });
    } else if desk.documents.any_error() {
        let text = "The gear has errors. The run shown is from before them.";
        ui.add(egui::Label::new(RichText::new(text).color(palette.error)).wrap());
    } else {
        ui.horizontal(|ui| {
            ui.label(RichText::new("Gear or scenario changed.").color(palette.warning));
            if ui.button("Apply").on_hover_text("Make the model anew (Ctrl+Enter)").clicked() {
                desk.orders.push(Order::Apply);
            }
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

fn speeds(ui: &mut Ui, desk: &mut Desk, view: &LiveView) {
    ui.horizontal(|ui| {
        ui.label(RichText::new("Speed").color(Theme::palette_of(ui).faint));
        ui.spacing_mut().item_spacing.x = 2.0;
        for (speed, text) in SPEEDS {
            let chosen = if speed.is_infinite() {
                view.speed >= 999.0
            } else {
                (view.speed - speed).abs() < 1e-9
            };
            if ui.selectable_label(chosen, text).clicked() {
                desk.orders.push(Order::Speed(speed));
            }
        }
    });
}

fn fly(ui: &mut Ui, desk: &mut Desk) {
    ui.horizontal(|ui| {
        let mut flying = desk.flying;
        if ui
            .toggle_value(&mut flying, "Fly the whale")
            .on_hover_text("Ctrl+F; Esc lets go. Keys and pad: F1")
            .clicked()
        {
            desk.orders.push(Order::Fly);
        }
        let hands = desk.pilot.pad_name().unwrap_or("keyboard; no pad found").to_owned();
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
    let audit = &view.audit;
    widgets::numbers(
        ui,
        "run",
        &[
            ("Solver speed", format!("{:.1} × real time", view.times_real_time)),
            ("Solver steps", audit.solver_steps.to_string()),
            ("Of these in contact", audit.contact_steps.to_string()),
            ("Redone, unconverged", format!("{}, {}", audit.halved, audit.unconverged)),
            ("Tunnelled", audit.tunnelled.to_string()),
            ("Deepest in skin", format!("{:.1} mm", audit.max_penetration_m * 1000.0)),
            ("Rope nodes, triangles", size(view)),
            ("State hash", view.state_hash.clone()),
        ],
    );
}

fn size(view: &LiveView) -> String {
    let triangles = view.model.spec.whale.as_ref().map_or(0, |whale| whale.skin.triangles.len());
    format!("{}, {triangles}", view.model.node_count)
}
