//! The selected story: its actions, the terms of its distance, and its drawn quantities.

use egui::{Color32, Grid, Label, Rect, RichText, Sense, Stroke, Ui, pos2, vec2};
use endline_session::command::SearchAction;
use endline_session::encounters::in_words;
use endline_session::search::{LIKE, Stories, Story};

use crate::gui::shared::Shared;
use crate::gui::theme::{Palette, Theme};
use crate::gui::widgets;
use crate::gui::widgets::command;
use crate::gui::widgets::words::{capital, spoken};

/// Width of the longest bar [points].
const BAR: f32 = 84.0;

/// Draws a story.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared, found: &Stories, number: usize) {
    let Some(story) = found.stories.get(number) else { return };
    let palette = Theme::palette_of(ui);
    let first = capital(&spoken(&story.first_part));
    let course =
        if story.course.is_empty() { String::new() } else { format!(", {}", story.course) };
    ui.add(
        Label::new(
            RichText::new(format!("{first} first; {}{course}", story.acts_in_words())).strong(),
        )
        .wrap(),
    );
    ui.horizontal_wrapped(|ui| {
        command(ui, shared, "Show in 3-D", SearchAction::Replay(number));
        command(ui, shared, "Fly on", SearchAction::FlyOn(number));
        command(ui, shared, "Keep as scenario", SearchAction::Keep(number));
    });
    widgets::caption(ui, &format!("Distance {:.2}", story.distance));
    terms(ui, story, palette);
    if let Some(trust) = story.trust(found) {
        widgets::caption(ui, "Reliability");
        ui.add(Label::new(trust).wrap());
    }
    widgets::caption(ui, "The encounter");
    Grid::new("drawn").num_columns(2).spacing([14.0, 2.0]).min_row_height(17.0).show(ui, |ui| {
        for (name, text) in &story.drawn {
            let own = name.rsplit('.').next().unwrap_or(name);
            let own = RichText::new(spoken(own)).color(palette.faint);
            ui.label(own).on_hover_text(name);
            ui.label(in_words(text)).on_hover_text(text);
            ui.end_row();
        }
        ui.label(RichText::new("duration").color(palette.faint));
        ui.label(format!("{:.0} s", story.simulated_s));
        ui.end_row();
    });
}

/// Draws the terms of the distance as bars, largest first; a line marks the cost above which one term alone is no match.
fn terms(ui: &mut Ui, story: &Story, palette: Palette) {
    if story.terms.is_empty() {
        ui.label(
            RichText::new("The ending agrees with the observation in every detail.")
                .color(palette.good),
        );
        return;
    }
    let mut terms: Vec<&(f64, String)> = story.terms.iter().collect();
    terms.sort_by(|one, other| other.0.total_cmp(&one.0));
    let most = terms.iter().map(|(cost, _)| *cost).fold(LIKE, f64::max);
    for (cost, says) in terms {
        ui.horizontal(|ui| {
            bar(ui, cost / most, LIKE / most, palette);
            ui.label(RichText::new(format!("{cost:.2}")).monospace());
            ui.add(Label::new(says).wrap());
        });
    }
}

fn bar(ui: &mut Ui, share: f64, like: f64, palette: Palette) {
    let (rect, _) = ui.allocate_exact_size(vec2(BAR, 12.0), Sense::hover());
    let painter = ui.painter();
    let x = |share: f64| rect.left() + share as f32 * rect.width();
    painter.rect_filled(rect, 2.0, palette.field);
    let colour: Color32 = if share > like { palette.warning } else { palette.accent };
    let filled = Rect::from_min_max(rect.min, pos2(x(share).max(rect.left() + 1.0), rect.bottom()));
    painter.rect_filled(filled, 2.0, colour);
    let at = x(like).min(rect.right() - 0.5);
    painter.line_segment(
        [pos2(at, rect.top()), pos2(at, rect.bottom())],
        Stroke::new(1.0, palette.text),
    );
}
