//! The search: start, limits, progress and best distance so far.

use std::time::Duration;

use egui::{DragValue, Label, ProgressBar, RichText, Ui};
use endline_session::campaign::State;
use endline_session::command::SearchAction;
use endline_session::search::job::SearchFound;
use endline_session::search::{DEFAULT_NET, SearchJob, whole_rounds};

use crate::gui::command::action::WindowAction;
use crate::gui::shared::Shared;
use crate::gui::theme::{Theme, primary};
use crate::gui::widgets::command;
use crate::gui::widgets::words::time_left;

/// Draws the start of a search and its progress.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared) {
    start(ui, shared);
    effort(ui, shared);
    let Some(job) = &shared.workbench.searches().job else { return };
    let (state, found) = (job.state(), job.found());
    let stale = shared.workbench.stories_are_of_another();
    if job.is_unfinished() {
        ui.ctx().request_repaint_after(Duration::from_millis(500));
    }
    if job.request.only_reads && found.trials == 0 && !matches!(state, State::Failed(_)) {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        progress(ui, job, &state, &found);
        status(ui, job, &state, &found, stale);
    });
}

/// Draws the buttons that start, pause and cancel the search.
fn start(ui: &mut Ui, shared: &mut Shared) {
    ui.horizontal_wrapped(|ui| {
        let searches = &shared.workbench.searches();
        let at_work = searches.at_work().map(SearchJob::state);
        let trials = searches.job.as_ref().map_or(0, |job| job.found().trials);
        let at_most = searches.effort.trials;
        let continues = trials > 0 && !shared.workbench.stories_are_of_another();
        if let Some(state) = at_work {
            let words = if state == State::Paused { "Resume" } else { "Pause" };
            command(ui, shared, words, SearchAction::Pause);
            command(ui, shared, "Cancel", SearchAction::Cancel);
        } else {
            let words = if continues { "Continue" } else { "Search" };
            let ready = shared.workbench.observation_is_sound();
            let help = "Runs encounters at low priority until some match. Saves no file; a cancelled search continues later";
            if primary(ui, ready, words).on_hover_text(help).clicked() {
                shared.give(SearchAction::Run);
            }
            let spent = continues && trials >= at_most;
            let why = match (ready, spent) {
                (false, _) => "has errors: see below or in Problems",
                (true, true) => "increase the runs to continue",
                (true, false) => "",
            };
            if !why.is_empty() {
                ui.label(RichText::new(why).color(Theme::palette_of(ui).faint));
            }
        }
        command(ui, shared, "Copy as command line", WindowAction::CopySearchLine);
    });
}

/// Draws the limits of the search.
fn effort(ui: &mut Ui, shared: &mut Shared) {
    let faint = Theme::palette_of(ui).faint;
    let now = shared.workbench.searches().effort;
    let mut effort = now;
    ui.horizontal_wrapped(|ui| {
        let label = |ui: &mut Ui, words: &str| ui.label(RichText::new(words).color(faint));
        let most = std::thread::available_parallelism().map_or(1, usize::from);
        label(ui, "Runs");
        ui.add(DragValue::new(&mut effort.trials).range(32..=1_000_000).speed(8))
            .on_hover_text(
                "Number of runs wanted; increase it to continue. Runs are made in rounds, and the round that reaches this number is finished",
            );
        let whole = whole_rounds(effort.trials, DEFAULT_NET);
        if whole != effort.trials {
            label(ui, &format!("({whole}: the first runs come in rounds of 32)"));
        }
        label(ui, "threads");
        ui.add(DragValue::new(&mut effort.threads).range(1..=most).speed(0.05))
            .on_hover_text("Simultaneous runs");
        label(ui, "neighbours");
        ui.add(DragValue::new(&mut effort.neighbours).range(0..=200).speed(0.1)).on_hover_text(
            "Slightly varied runs for each matching story, which show whether it depends on chance",
        );
        let help = "Runs at normal priority instead of low; the window may respond more slowly";
        ui.checkbox(&mut effort.normal_priority, "Full speed").on_hover_text(help);
    });
    if effort != now {
        shared.perform(SearchAction::Effort(effort));
    }
}

fn progress(ui: &mut Ui, job: &SearchJob, state: &State, found: &SearchFound) {
    let encounters = job.progress().encounters;
    let share = job.progress().share();
    let (share, text) = match state {
        State::Finishing => {
            (share, format!("{} of {} neighbours", encounters.done, encounters.total))
        }
        State::Running | State::Paused | State::Cancelling if encounters.total > 0 => {
            let reads = job.request.only_reads;
            let of = if reads { String::new() } else { format!(" of {}", encounters.total) };
            (share, format!("{}{of} runs", encounters.done))
        }
        State::Waiting
        | State::Opening
        | State::Running
        | State::Paused
        | State::Cancelling
        | State::Failed(_) => return,
        State::Done | State::Cancelled => {
            let share = found.trials as f32 / job.request.trials.max(1) as f32;
            (share, format!("{} runs", found.trials))
        }
    };
    ui.add(ProgressBar::new(share).desired_width(180.0).text(text));
}

/// Draws the state of the search in words.
fn status(ui: &mut Ui, job: &SearchJob, state: &State, found: &SearchFound, stale: bool) {
    let palette = Theme::palette_of(ui);
    let left = job.progress().left().map(time_left);
    let (words, colour) = match state {
        State::Waiting | State::Opening => ("opening".to_owned(), palette.warning),
        State::Cancelling if job.request.only_reads => ("reading".to_owned(), palette.warning),
        State::Cancelling => ("finishing the current runs".to_owned(), palette.warning),
        State::Running | State::Finishing => {
            (left.map_or_else(|| "running".into(), |left| format!("{left} left")), palette.good)
        }
        State::Paused => ("paused".to_owned(), palette.warning),
        State::Done => ("done".to_owned(), palette.good),
        State::Cancelled => ("finished runs are kept".to_owned(), palette.faint),
        State::Failed(why) => (why.lines().next().unwrap_or_default().to_owned(), palette.error),
    };
    let full = if let State::Failed(why) = state { why.clone() } else { words.clone() };
    ui.add(Label::new(RichText::new(words).color(colour)).truncate()).on_hover_text(full);
    if let Some(best) = found.best {
        ui.label(format!("best distance {best:.2}"));
    }
    if stale {
        ui.label(
            RichText::new("from another observation or from before its last edits")
                .color(palette.warning),
        );
    }
}
