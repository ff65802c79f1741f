//! Rope on the whale: outcome, body map, wraps, and figures by body part.

mod map;

use egui::{Grid, RichText, ScrollArea, Ui};
use endline_session::command::TimeAction;
use endline_session::figures::{PART, Part, View, WHALE, parts};
use endline_session::live::LiveView;
use endline_session::units::Units;
use endline_sim::metrics::WhaleSummary;

use crate::gui::inspector::wraps;
use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::figures::{Style, list, table};
use crate::gui::widgets::words::spoken;
use crate::gui::widgets::{self, words};
use map::SkinMap;

/// The panel of rope on the whale.
#[derive(Default)]
pub struct EntanglementPanel {
    map: SkinMap,
}

impl Panel for EntanglementPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let Some(view) = shared.workbench.view().cloned() else {
            return widgets::nothing(ui, "No run yet.");
        };
        let Some(whale) = view.summary.as_ref().and_then(|summary| summary.whale.as_ref()) else {
            return widgets::nothing(ui, "No whale in this run.");
        };
        let style = Style { view: View::Entanglement, units: shared.workbench.preferences().units };
        let parts = parts(whale, &view.frame.contacts);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let first = outcome(ui, whale, view.newest_s, style);
            self.map.show(ui, &view, whale, style.units);
            let wrap = wrap_list(ui, &view, style.units);
            shared.commands.extend(first.or(wrap).map(|chosen| TimeAction::Seek(chosen).into()));
            widgets::caption(ui, "By part");
            table(ui, PART, &parts, style, Part::is_untouched);
        });
    }
}

/// Draws the outcome and the figures of the whale; returns the moment that was clicked [s].
fn outcome(ui: &mut Ui, whale: &WhaleSummary, time_s: f64, style: Style) -> Option<f64> {
    let palette = Theme::palette_of(ui);
    let (text, meaning, colour) = words::outcome_at(whale, time_s, palette);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(text).heading().color(colour));
        let so_far = if whale.decided { "" } else { "so far: " };
        ui.label(RichText::new(format!("{so_far}{meaning}")).color(palette.faint));
    });
    let wanted = list(ui, WHALE, whale, style);
    ui.label(
        RichText::new(
            "Figures of this encounter only; they do not show how often whales meet gear.",
        )
        .small()
        .color(palette.faint),
    );
    wanted
}

/// Draws the wraps at the moment shown; returns the moment that was clicked [s].
fn wrap_list(ui: &mut Ui, view: &LiveView, units: Units) -> Option<f64> {
    let palette = Theme::palette_of(ui);
    widgets::caption(ui, "Wraps at this moment");
    let found = wraps(view);
    if found.is_empty() {
        ui.label(
            RichText::new("No rope is wrapped round a part by a quarter of a turn or more.")
                .color(palette.faint),
        );
        return None;
    }
    let mut wanted = None;
    Grid::new("wraps").num_columns(5).striped(true).spacing([14.0, 2.0]).min_row_height(17.0).show(
        ui,
        |ui| {
            for head in ["Part", "Turns", "Since", "Touching", "Rope"] {
                ui.label(RichText::new(head).small().color(palette.faint));
            }
            ui.end_row();
            for wrap in &found {
                ui.label(spoken(wrap.part.name()));
                ui.label(format!("{:.2}", wrap.turns));
                match wrap.since_s {
                    Some(since_s)
                        if ui
                            .link(format!("{since_s:.2} s"))
                            .on_hover_text("Show when it reached half a turn")
                            .clicked() =>
                    {
                        wanted = Some(since_s);
                    }
                    Some(_) => {}
                    None => {
                        ui.label(RichText::new("less than half a turn").color(palette.faint));
                    }
                }
                ui.label(units.length(wrap.touching_m));
                let lines = wrap
                    .lines
                    .iter()
                    .map(|(line, length_m)| format!("{line} {}", units.length(*length_m)));
                let lines = lines.collect::<Vec<_>>().join(", ");
                ui.label(if lines.is_empty() {
                    "loose, without contact".to_owned()
                } else {
                    lines
                });
                ui.end_row();
            }
        },
    );
    wanted
}
