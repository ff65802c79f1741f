//! Results of a search: a table of stories, and the selected one with the terms of its distance and its actions.

use std::sync::Arc;

use egui::{
    Align, Color32, Grid, Label, Layout, Rect, RichText, ScrollArea, Sense, Stroke, Ui, pos2, vec2,
};
use egui_extras::{Column, TableBuilder, TableRow};
use endline_session::campaign::State;
use endline_session::command::SearchAction;
use endline_session::encounters::in_words;
use endline_session::search::{LIKE, SearchJob, Stories, Story};

use crate::gui::command::action::WindowAction;
use crate::gui::panel::Panel;
use crate::gui::shared::Shared;
use crate::gui::theme::{Palette, Theme};
use crate::gui::widgets;
use crate::gui::widgets::command;
use crate::gui::widgets::words::{capital, spoken};

/// Least width at which the selected story is beside the table [points].
const WIDE: f32 = 640.0;

/// Results of a search.
#[derive(Debug, Default)]
pub struct StoriesPanel {
    /// Hash of the last state of the selected story; the nearest story if it is not in the table.
    chosen: Option<String>,
}

impl Panel for StoriesPanel {
    fn ui(&mut self, ui: &mut Ui, shared: &mut Shared) {
        let job = shared.workbench.searches().job.as_ref();
        let Some(found) = job.and_then(|job| job.found().stories) else {
            return missing(ui, job);
        };
        head(ui, shared, &found);
        if found.stories.is_empty() {
            let none = if found.free_kinds == 0 {
                "No rope has touched the whale in any run so far."
            } else {
                "Rope has touched the whale, but every run so far ends with nothing on it."
            };
            return widgets::nothing(ui, none);
        }
        ui.separator();
        let number = self.number(&found);
        if ui.available_width() < WIDE {
            let height = 0.45 * ui.available_height();
            ui.allocate_ui(vec2(ui.available_width(), height), |ui| {
                self.table(ui, shared, &found, number);
            });
            ui.separator();
            return chosen(ui, shared, &found, number);
        }
        let wide = 0.62 * ui.available_width();
        let whole = ui.available_rect_before_wrap();
        let (mut left, mut right) = (whole, whole);
        left.set_right(whole.left() + wide);
        right.set_left(left.right() + 12.0);
        widgets::within(ui, left, |ui| self.table(ui, shared, &found, number));
        widgets::within(ui, right, |ui| chosen(ui, shared, &found, number));
    }
}

/// Draws the reason why there are no stories.
fn missing(ui: &mut Ui, job: Option<&SearchJob>) {
    let none = "No stories yet. Select an observation in Search and start; the first stories appear after 32 runs.";
    let reads = job.is_some_and(|job| job.request.only_reads);
    match job.map(SearchJob::state) {
        Some(State::Failed(why)) => {
            let colour = Theme::palette_of(ui).error;
            ui.add(Label::new(RichText::new(why).color(colour)).wrap());
        }
        Some(state) if state == State::Opening || (reads && state == State::Cancelling) => {
            ui.vertical_centered(|ui| ui.spinner());
            widgets::nothing(ui, "Reading the observation and its encounters …");
        }
        Some(State::Running | State::Paused) => {
            widgets::nothing(ui, "The first stories appear after 32 runs.");
        }
        _ => widgets::nothing(ui, none),
    }
}

/// Draws the result in a sentence, and a button for the report.
fn head(ui: &mut Ui, shared: &mut Shared, found: &Stories) {
    let palette = Theme::palette_of(ui);
    let Some(job) = &shared.workbench.searches().job else { return };
    let name = job.found().question.map(|question| question.observation.name.clone());
    let so_far = if job.is_unfinished() { "Still searching. " } else { "" };
    let report = job.report();
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(name.unwrap_or_default()).strong());
        ui.label(format!("{so_far}{}", found.answer()));
    });
    ui.horizontal_wrapped(|ui| {
        let draws = format!(
            "{} runs, {} of them drawn from the priors; {} of these match the observation (distance at most {LIKE}).",
            found.trials, found.net, found.net_like
        );
        let caveat = "Encounters that can end like this in the model. They do not show that it happened this way, or how often";
        ui.label(RichText::new(draws).small().color(palette.faint)).on_hover_text(caveat);
        if shared.workbench.stories_are_of_another() {
            let words = "These stories are from another observation or from before its last edits.";
            ui.label(RichText::new(words).small().color(palette.warning));
        }
        if let Some(file) = report
            && ui.small_button("Open the report").on_hover_text(file.display().to_string()).clicked()
        {
            shared.give(WindowAction::OpenFolder(file));
        }
    });
}

impl StoriesPanel {
    /// Index of the selected story.
    fn number(&self, found: &Stories) -> usize {
        let own = |story: &Story| Some(&story.state_hash) == self.chosen.as_ref();
        found.stories.iter().position(own).unwrap_or(0)
    }

    fn table(&mut self, ui: &mut Ui, shared: &mut Shared, found: &Arc<Stories>, number: usize) {
        let mut wanted = None;
        // Acts and course share the width that the narrow columns leave.
        let words = (ui.available_width() - 290.0).max(214.0);
        let table = TableBuilder::new(ui)
            .id_salt("stories")
            .striped(true)
            .resizable(true)
            .sense(Sense::click())
            .cell_layout(Layout::left_to_right(Align::Center))
            .column(Column::exact(22.0))
            .column(Column::initial(54.0))
            .column(Column::initial(76.0).clip(true))
            .column(Column::initial(0.57 * words).clip(true))
            .column(Column::initial(0.43 * words).clip(true))
            .column(Column::remainder().at_least(84.0).clip(true));
        table
            .header(20.0, |mut header| {
                for (name, help) in HEADS {
                    header.col(|ui| {
                        let faint = Theme::palette_of(ui).faint;
                        ui.label(RichText::new(name).small().color(faint)).on_hover_text(help);
                    });
                }
            })
            .body(|body| {
                body.rows(21.0, found.stories.len(), |mut line| {
                    let index = line.index();
                    let story = &found.stories[index];
                    line.set_selected(index == number);
                    cells(&mut line, index, story);
                    let hint = "Click for the terms of its distance; double-click to show it in the 3-D view";
                    let response = line.response().on_hover_text(hint);
                    if response.clicked() {
                        self.chosen = Some(story.state_hash.clone());
                    }
                    if response.double_clicked() {
                        wanted = Some(index);
                    }
                });
            });
        shared.commands.extend(wanted.map(|story| SearchAction::Replay(story).into()));
    }
}

const HEADS: [(&str, &str); 6] = [
    ("", "Rank, nearest first"),
    (
        "Distance",
        "Distance of the ending from the observation. Green, up to 1: it matches. Amber, up to 3: about one place differs. Plain, up to 6: about two. Grey: more",
    ),
    ("First", "Body part that rope touched first"),
    ("Acts", "Acts of the whale, before and after first contact"),
    ("Course", "Direction of approach, relative to the current"),
    (
        "Neighbours",
        "Share of slightly varied runs that also match; below one half the story depends on chance",
    ),
];

/// Colour of a distance. A place with rope that should have none, or the reverse, costs up to 3.
fn distance_colour(distance: f64, palette: Palette) -> Color32 {
    match distance {
        ..=LIKE => palette.good,
        ..=3.0 => palette.warning,
        ..=6.0 => palette.text,
        _ => palette.faint,
    }
}

fn cells(line: &mut TableRow<'_, '_>, index: usize, story: &Story) {
    line.col(|ui| {
        ui.add_space(4.0);
        ui.label((index + 1).to_string());
    });
    line.col(|ui| {
        let palette = Theme::palette_of(ui);
        let colour = distance_colour(story.distance, palette);
        let mirrored = if story.mirrored { " mirrored" } else { "" };
        let text = RichText::new(format!("{:.2}{mirrored}", story.distance)).color(colour);
        let response = ui.label(text);
        if story.mirrored {
            response.on_hover_text("Matches as a mirror image");
        }
    });
    line.col(|ui| drop(ui.label(spoken(&story.first_part))));
    for text in [story.acts_in_words(), story.course.to_owned()] {
        line.col(|ui| {
            // A narrow panel truncates a long text.
            ui.label(&text).on_hover_text(&text);
        });
    }
    line.col(|ui| {
        let palette = Theme::palette_of(ui);
        let Some(alike) = story.alike else { return };
        let (words, colour) =
            if story.is_fragile() { (", fragile", palette.warning) } else { ("", palette.text) };
        ui.label(RichText::new(format!("{:.0} %{words}", 100.0 * alike)).color(colour));
    });
}

/// Draws the selected story.
fn chosen(ui: &mut Ui, shared: &mut Shared, found: &Stories, number: usize) {
    ScrollArea::vertical().id_salt("story").auto_shrink(false).show(ui, |ui| {
        story(ui, shared, found, number);
    });
}

/// Width of the longest bar [points].
const BAR: f32 = 84.0;

/// Draws a story.
fn story(ui: &mut Ui, shared: &mut Shared, found: &Stories, number: usize) {
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

/// Draws the terms of the distance as bars; a line marks the cost above which one term alone is no match.
fn terms(ui: &mut Ui, story: &Story, palette: Palette) {
    if story.terms.is_empty() {
        ui.label(
            RichText::new("The ending agrees with the observation in every detail.")
                .color(palette.good),
        );
        return;
    }
    let most = story.terms.iter().map(|(cost, _)| *cost).fold(LIKE, f64::max);
    for (cost, says) in &story.terms {
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
