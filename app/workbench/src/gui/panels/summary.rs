//! How the run came out: outcome, loads by part of the whale, lines and weak links.

use egui::{Grid, RichText, ScrollArea, Ui};
use endline_session::units::{ForceUnit, Units};
use endline_sim::metrics::{Summary, WhaleSummary};

use crate::gui::desk::{Desk, Order};
use crate::gui::panel::Panel;
use crate::gui::panel_id::PanelId;
use crate::gui::theme::Theme;
use crate::gui::widgets::{self, words};

/// Outcome and loads of the run.
#[derive(Debug, Default)]
pub struct SummaryPanel;

impl Panel for SummaryPanel {
    fn id(&self) -> PanelId {
        PanelId::SUMMARY
    }

    fn ui(&mut self, ui: &mut Ui, desk: &mut Desk) {
        show(ui, desk);
    }
}

/// Draws the summary.
fn show(ui: &mut Ui, desk: &mut Desk) {
    let Some(view) = desk.view.clone() else { return widgets::nothing(ui, "No run yet.") };
    let Some(summary) = &view.summary else {
        return widgets::nothing(ui, "The gear is being settled.");
    };
    let units = desk.preferences.units;
    let unit = units.force();
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        if let Some(whale) = &summary.whale {
            outcome(ui, whale, units);
            regions(ui, whale, units);
        }
        desk.orders.extend(lines(ui, summary, unit).map(Order::Seek));
        links(ui, summary, unit);
    });
}

fn outcome(ui: &mut Ui, whale: &WhaleSummary, units: Units) {
    let palette = Theme::palette_of(ui);
    let (text, meaning, colour) = words::outcome(whale.outcome, palette);
    ui.horizontal(|ui| {
        ui.label(RichText::new(text).heading().color(colour)).on_hover_text(meaning);
        if !whale.decided {
            ui.label(RichText::new("so far").color(palette.faint))
                .on_hover_text("The run is too short for this to stand");
        }
    });
    numbers(
        ui,
        "whale",
        &[
            (
                "First contact",
                whale.first_contact_s.map_or_else(|| "–".into(), |time| format!("{time:.2} s")),
            ),
            ("Time in contact", format!("{:.2} s", whale.contact_time_s)),
            ("Added drag", units.force().text(whale.drag_added_n)),
            ("Trailing rope", units.length(whale.trailing_m)),
        ],
    );
}

/// Names and values in two columns.
pub fn numbers(ui: &mut Ui, id: &str, rows: &[(&str, String)]) {
    let faint = Theme::palette_of(ui).faint;
    Grid::new(id).num_columns(2).spacing([16.0, 2.0]).min_row_height(17.0).show(ui, |ui| {
        for (name, value) in rows {
            ui.label(RichText::new(*name).color(faint));
            ui.label(RichText::new(value));
            ui.end_row();
        }
    });
}

fn heads(ui: &mut Ui, names: &[&str]) {
    let faint = Theme::palette_of(ui).faint;
    for name in names {
        ui.label(RichText::new(*name).small().color(faint));
    }
    ui.end_row();
}

fn regions(ui: &mut Ui, whale: &WhaleSummary, units: Units) {
    widgets::caption(ui, "Whale by part");
    let faint = Theme::palette_of(ui).faint;
    Grid::new("regions")
        .num_columns(5)
        .striped(true)
        .spacing([14.0, 2.0])
        .min_row_height(17.0)
        .show(ui, |ui| {
            heads(ui, &["Part", "Wraps", "Contact", "Peak force", "Friction work"]);
            for region in &whale.regions {
                let touched = region.peak_contact_length_m > 0.0;
                let text = |text: String| {
                    if touched { RichText::new(text) } else { RichText::new(text).color(faint) }
                };
                ui.label(RichText::new(region.part.name().replace('_', " ")).color(if touched {
                    ui.visuals().text_color()
                } else {
                    faint
                }));
                ui.label(text(format!("{:.2}", region.wraps)));
                ui.label(text(units.length(region.contact_length_m)));
                ui.label(text(units.force().text(region.peak_normal_n)));
                ui.label(text(format!("{:.0} J", region.friction_work_j)));
                ui.end_row();
            }
        });
}

/// Peaks of the lines; answers the moment asked for by a click on one.
fn lines(ui: &mut Ui, summary: &Summary, unit: ForceUnit) -> Option<f64> {
    let mut wanted = None;
    widgets::caption(ui, "Lines");
    Grid::new("lines").num_columns(5).striped(true).spacing([14.0, 2.0]).min_row_height(17.0).show(
        ui,
        |ui| {
            heads(ui, &["Line", "Peak", "at", "Ends now", "Parted"]);
            for line in &summary.lines {
                ui.label(&line.id);
                ui.label(unit.text(line.peak_tension_n));
                if ui
                    .link(format!("{:.2} s", line.peak_at_s))
                    .on_hover_text("See this moment")
                    .clicked()
                {
                    wanted = Some(line.peak_at_s);
                }
                ui.label(format!(
                    "{} / {}",
                    unit.text(line.end_a_tension_n),
                    unit.text(line.end_b_tension_n)
                ));
                parted(ui, line.parted_at_s);
                ui.end_row();
            }
        },
    );
    wanted
}

fn links(ui: &mut Ui, summary: &Summary, unit: ForceUnit) {
    if summary.links.is_empty() {
        return;
    }
    widgets::caption(ui, "Weak links");
    Grid::new("links").num_columns(4).striped(true).spacing([14.0, 2.0]).min_row_height(17.0).show(
        ui,
        |ui| {
            heads(ui, &["Link", "Rating", "Peak", "Parted"]);
            for link in &summary.links {
                ui.label(&link.id);
                ui.label(unit.text(link.rating_n));
                ui.label(unit.text(link.peak_tension_n));
                parted(ui, link.parted_at_s);
                ui.end_row();
            }
        },
    );
}

fn parted(ui: &mut Ui, at_s: Option<f64>) {
    let palette = Theme::palette_of(ui);
    match at_s {
        Some(time_s) => ui.label(RichText::new(format!("{time_s:.2} s")).color(palette.error)),
        None => ui.label(RichText::new("–").color(palette.faint)),
    };
}
