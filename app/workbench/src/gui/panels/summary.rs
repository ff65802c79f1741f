//! Results of the run: outcome, loads by body part of the whale, lines and weak links.

use egui::{Label, RichText, ScrollArea, Ui};
use endline_session::command::TimeAction;
use endline_session::figures::{LINE, LINK, PART, Part, View, WHALE, lines, parts};
use endline_session::live::LiveView;
use endline_session::report::headline::{Sentence, Tone};
use endline_sim::metrics::{Summary, WhaleSummary};

use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::figures::{Style, list, table};
use crate::gui::widgets::{self, words};

/// Greatest width of the headline, for lines that are read easily.
const WIDEST_HEADLINE: f32 = 560.0;

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
        headline(ui, shared, &view, summary);
        whole_run(ui, &view);
        let of_whale = summary.whale.as_ref().and_then(|whale| of_whale(ui, &view, whale, style));
        shared.commands.extend(
            of_whale.or(of_gear(ui, summary, style)).map(|chosen| TimeAction::Seek(chosen).into()),
        );
    });
}

/// Draws the result in sentences: the outcome in its colour if it is decided, then loads, partings and reasons for doubt.
fn headline(ui: &mut Ui, shared: &mut Shared, view: &LiveView, summary: &Summary) {
    let units = shared.workbench.preferences().units;
    let palette = Theme::palette_of(ui);
    let outcome = summary.whale.as_ref().map(|whale| {
        let (_, meaning, colour) = words::outcome(whale.outcome, palette);
        let undecided = "The run is too short for a final outcome";
        if whale.decided { (meaning, colour) } else { (undecided, palette.faint) }
    });
    ui.scope(|ui| {
        ui.set_max_width(ui.available_width().min(WIDEST_HEADLINE));
        for (place, Sentence { text, tone }) in view.headline(units).into_iter().enumerate() {
            let text = match tone {
                Tone::Result if place == 0 => RichText::new(text).heading(),
                Tone::Result => RichText::new(text),
                // The note above the headline states it and offers the correction.
                Tone::Kinematic => continue,
                Tone::Coarse => RichText::new(text).color(palette.warning),
                Tone::Invalid => RichText::new(text).color(palette.error),
            };
            match outcome.filter(|_| place == 0) {
                Some((meaning, colour)) => {
                    ui.add(Label::new(text.color(colour)).wrap()).on_hover_text(meaning)
                }
                None => ui.add(Label::new(text).wrap()),
            };
            if tone == Tone::Coarse {
                widgets::more_nodes(ui, shared);
            }
        }
    });
    ui.separator();
}

/// While an earlier moment is shown: says that the figures are not of that moment.
fn whole_run(ui: &mut Ui, view: &LiveView) {
    if view.sought {
        let text = format!(
            "These figures are of the run up to {:.2} s, not of the moment shown, {:.2} s.",
            view.newest_s, view.frame.time_s
        );
        ui.label(RichText::new(text).color(Theme::palette_of(ui).faint));
    }
}

/// Draws figures of the whale and its body parts; returns the moment that was clicked [s].
fn of_whale(ui: &mut Ui, view: &LiveView, whale: &WhaleSummary, style: Style) -> Option<f64> {
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
