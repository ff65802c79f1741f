//! Results of the run: outcome, loads by body part of the whale, lines and weak links.

use egui::{RichText, ScrollArea, Ui};
use endline_session::command::TimeAction;
use endline_session::figures::{LINE, LINK, PART, Part, View, WHALE, lines, parts};
use endline_session::live::LiveView;
use endline_sim::metrics::{Summary, WhaleSummary};

use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::figures::{Style, list, table};
use crate::gui::widgets::{self, words};

/// Outcome and loads of the run.
#[derive(Debug, Default)]
pub struct SummaryPanel;

impl Panel for SummaryPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        show(ui, shared);
    }
}

/// Draws the summary.
fn show(ui: &mut Ui, shared: &mut Shared) {
    let Some(view) = shared.workbench.view().cloned() else {
        return widgets::nothing(ui, "No run yet.");
    };
    let Some(summary) = &view.summary else {
        return widgets::nothing(ui, "The statics of the gear are being solved.");
    };
    let style = Style { view: View::Summary, units: shared.workbench.preferences().units };
    widgets::kinematic_whale(ui, shared, &view);
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        let of_whale = summary.whale.as_ref().and_then(|whale| of_whale(ui, &view, whale, style));
        shared.commands.extend(
            of_whale.or(of_gear(ui, summary, style)).map(|chosen| TimeAction::Seek(chosen).into()),
        );
    });
}

/// Draws outcome and body parts; returns the moment that was clicked [s].
fn of_whale(ui: &mut Ui, view: &LiveView, whale: &WhaleSummary, style: Style) -> Option<f64> {
    let palette = Theme::palette_of(ui);
    let (text, meaning, colour) = words::outcome(whale.outcome, palette);
    ui.horizontal(|ui| {
        ui.label(RichText::new(text).heading().color(colour)).on_hover_text(meaning);
        if !whale.decided {
            ui.label(RichText::new("so far").color(palette.faint))
                .on_hover_text("The run is too short for a final outcome");
        }
    });
    let wanted = list(ui, WHALE, whale, style);
    widgets::caption(ui, "Whale by part");
    let parts = parts(whale, &view.frame.contacts);
    wanted.or(table(ui, PART, &parts, style, Part::is_untouched))
}

/// Draws lines and weak links; returns the moment that was clicked [s].
fn of_gear(ui: &mut Ui, summary: &Summary, style: Style) -> Option<f64> {
    widgets::caption(ui, "Lines");
    let wanted = table(ui, LINE, &lines(summary, &[]), style, |_| false);
    if summary.links.is_empty() {
        return wanted;
    }
    widgets::caption(ui, "Weak links");
    wanted.or(table(ui, LINK, &summary.links, style, |_| false))
}
