//! The search at work: how long it may take, how far it is, and what is best so far.

use std::time::Duration;

use egui::{DragValue, Label, ProgressBar, RichText, Ui};
use endline_session::campaign::State;
use endline_session::command::SearchAction;
use endline_session::search::SearchJob;
use endline_session::search::job::SearchFound;

use crate::gui::command::action::WindowAction;
use crate::gui::shared::Shared;
use crate::gui::theme::{Theme, primary};
use crate::gui::widgets::command;
use crate::gui::widgets::words::time_left;

/// Draws what begins a search, and the search at work.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared) {
    begin(ui, shared);
    effort(ui, shared);
    let Some(job) = &shared.workbench.searches.job else { return };
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
        said(ui, job, &state, &found, stale);
    });
}

/// The one thing to do next.
fn begin(ui: &mut Ui, shared: &mut Shared) {
    ui.horizontal_wrapped(|ui| {
        let searches = &shared.workbench.searches;
        let at_work = searches.at_work().map(SearchJob::state);
        let trials = searches.job.as_ref().map_or(0, |job| job.found().trials);
        let at_most = searches.trials;
        let goes_on = trials > 0 && !shared.workbench.stories_are_of_another();
        if let Some(state) = at_work {
            let words = if state == State::Paused { "Resume" } else { "Pause" };
            command(ui, shared, words, SearchAction::Pause);
            command(ui, shared, "Cancel", SearchAction::Cancel);
        } else {
            let words = if goes_on { "Search on" } else { "Search" };
            let ready = shared.workbench.observation_is_sound();
            let help = "Run encounters behind everything else until some end like this. Nothing is saved; a search that was cancelled continues later";
            if primary(ui, ready, words).on_hover_text(help).clicked() {
                shared.give(SearchAction::Run);
            }
            let spent = goes_on && trials >= at_most;
            let why = match (ready, spent) {
                (false, _) => "errors below, or in Problems",
                (true, true) => "give more runs to go on",
                (true, false) => "",
            };
            if !why.is_empty() {
                ui.label(RichText::new(why).color(Theme::palette_of(ui).faint));
            }
        }
        command(ui, shared, "Copy as command line", WindowAction::CopySearchLine);
    });
}

/// How long to search, and with what.
fn effort(ui: &mut Ui, shared: &mut Shared) {
    let faint = Theme::palette_of(ui).faint;
    let searches = &mut shared.workbench.searches;
    ui.horizontal_wrapped(|ui| {
        let label = |ui: &mut Ui, words: &str| ui.label(RichText::new(words).color(faint));
        let most = std::thread::available_parallelism().map_or(1, usize::from);
        label(ui, "Runs");
        ui.add(DragValue::new(&mut searches.trials).range(32..=1_000_000).speed(8))
            .on_hover_text("At most; give more to search on");
        label(ui, "threads");
        ui.add(DragValue::new(&mut searches.threads).range(1..=most).speed(0.05))
            .on_hover_text("Runs at a time");
        label(ui, "neighbours");
        ui.add(DragValue::new(&mut searches.neighbours).range(0..=200).speed(0.1)).on_hover_text(
            "Runs beside every story that ends alike, each a little different: they tell whether it hangs on chance",
        );
        let help = "At ordinary priority, not behind everything else on the machine; the window may draw more slowly";
        ui.checkbox(&mut searches.normal_priority, "Full speed").on_hover_text(help);
    });
}

fn progress(ui: &mut Ui, job: &SearchJob, state: &State, found: &SearchFound) {
    let encounters = job.progress().encounters;
    let share = job.progress().share();
    let of = job.request.trials;
    let (share, text) = match state {
        State::Finishing => {
            (share, format!("{} of {} neighbours", encounters.done, encounters.total))
        }
        State::Running | State::Paused | State::Cancelling if encounters.total > 0 => {
            (share, format!("{} of {of} runs", encounters.done))
        }
        State::Waiting
        | State::Opening
        | State::Running
        | State::Paused
        | State::Cancelling
        | State::Failed(_) => return,
        State::Done | State::Cancelled => {
            let share = found.trials as f32 / of.max(1) as f32;
            (share, format!("{} runs", found.trials))
        }
    };
    ui.add(ProgressBar::new(share).desired_width(180.0).text(text));
}

/// How the search stands, in words.
fn said(ui: &mut Ui, job: &SearchJob, state: &State, found: &SearchFound, stale: bool) {
    let palette = Theme::palette_of(ui);
    let left = job.progress().left().map(time_left);
    let (words, colour) = match state {
        State::Waiting | State::Opening => ("opening".to_owned(), palette.warning),
        State::Cancelling if job.request.only_reads => ("reading".to_owned(), palette.warning),
        State::Cancelling => ("finishing the runs in progress".to_owned(), palette.warning),
        State::Running | State::Finishing => {
            (left.map_or_else(|| "running".into(), |left| format!("{left} left")), palette.good)
        }
        State::Paused => ("paused".to_owned(), palette.warning),
        State::Done => ("done".to_owned(), palette.good),
        State::Cancelled => ("runs are stored".to_owned(), palette.faint),
        State::Failed(why) => (why.lines().next().unwrap_or_default().to_owned(), palette.error),
    };
    let told = if let State::Failed(why) = state { why.clone() } else { words.clone() };
    ui.add(Label::new(RichText::new(words).color(colour)).truncate()).on_hover_text(told);
    if let Some(best) = found.best {
        ui.label(format!("least distance {best:.2}"));
    }
    if stale {
        ui.label(
            RichText::new("of another observation, or before it was edited").color(palette.warning),
        );
    }
}
