//! The queue of studies: progress and buttons of each, and results of earlier studies.

use endline_session::command::StudyAction;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use egui::{ProgressBar, RichText, Ui};
use endline_session::campaign::{Job, State, pool};
use endline_session::study::queue::{Part, StudyJob};
use endline_session::study::results::{self, StudyResults};
use endline_session::study::stats::answer;

use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words::time_left;

/// Time without a finished encounter after which the panel says that encounters are in progress.
const QUIET: Duration = Duration::from_secs(20);

/// Draws the queue.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared) {
    let mut actions = Vec::new();
    for job in &shared.workbench.studies().queue.jobs {
        ui.add_space(3.0);
        row(ui, job, &mut actions);
        forecast(ui, job);
        headline(ui, job, shared.workbench.studies().results.shown());
    }
    if shared.workbench.studies().queue.jobs.iter().any(Job::at_work) {
        ui.ctx().request_repaint_after(Duration::from_millis(500));
    }
    actions.into_iter().for_each(|action| shared.give(action));
    ready(ui, shared);
}

fn row(ui: &mut Ui, job: &StudyJob, actions: &mut Vec<StudyAction>) {
    let (state, progress, palette) = (job.state(), job.progress(), Theme::palette_of(ui));
    ui.horizontal(|ui| {
        ui.add(egui::Label::new(&job.request.name).truncate())
            .on_hover_text(job.request.file.display().to_string());
    });
    ui.horizontal_wrapped(|ui| {
        let (words, colour) = match &state {
            State::Waiting => ("waiting".to_owned(), palette.faint),
            State::Opening => ("opening".to_owned(), palette.warning),
            State::Running if progress.elsewhere > 0 => (
                format!("waiting for {} encounters of other processes", progress.elsewhere),
                palette.warning,
            ),
            State::Running => (
                match (progress.left(), progress.left_range()) {
                    (Some(left), Some([low, high])) => format!(
                        "{} left, {} to {}",
                        time_left(left),
                        time_left(low),
                        time_left(high)
                    ),
                    (Some(left), None) => format!("{} left", time_left(left)),
                    (None, _) => "running".into(),
                },
                palette.good,
            ),
            State::Paused => ("paused".to_owned(), palette.warning),
            State::Finishing => ("writing the report".to_owned(), palette.good),
            State::Cancelling => {
                ("cancelled; the encounters in progress end".to_owned(), palette.warning)
            }
            State::Done if job.request.part == Part::Forecast => {
                ("forecast made".to_owned(), palette.good)
            }
            State::Done => ("done".to_owned(), palette.good),
            State::Cancelled => {
                ("cancelled; finished encounters are kept".to_owned(), palette.faint)
            }
            State::Failed(why) => {
                (why.lines().next().unwrap_or_default().to_owned(), palette.error)
            }
        };
        let encounters = progress.encounters;
        if encounters.total > 0 {
            let text = format!("{} of {} encounters", encounters.done, encounters.total);
            ui.add(ProgressBar::new(progress.share()).desired_width(170.0).text(text));
        }
        match state {
            State::Running | State::Opening => {
                button(ui, "Pause", StudyAction::PauseJob(job.request.file.clone()), actions)
            }
            State::Paused => {
                button(ui, "Resume", StudyAction::PauseJob(job.request.file.clone()), actions)
            }
            _ => {}
        }
        if job.is_unfinished() {
            button(ui, "Cancel", StudyAction::CancelJob(job.request.file.clone()), actions);
        } else {
            button(ui, "✖", StudyAction::ForgetJob(job.request.file.clone()), actions);
        }
        if progress.blocks.done > 0
            && let Some(folder) = job.folder()
            && ui.small_button("Results").clicked()
        {
            actions.push(StudyAction::ShowResults(folder));
        }
        let full = if let State::Failed(why) = &state { why.clone() } else { words.clone() };
        ui.add(egui::Label::new(RichText::new(words).color(colour)).truncate()).on_hover_text(full);
    });
}

/// Draws the forecast of a study, or how long its present encounters have run if the last one ended long ago.
fn forecast(ui: &mut Ui, job: &StudyJob) {
    let text = match (job.forecast(), job.progress().since_last()) {
        (Some(forecast), _) => forecast.cost.map(|cost| cost.words(pool::default_count())),
        (None, Some(since)) if since >= QUIET => Some(format!(
            "the present encounters have run for {}; a held whale takes minutes",
            time_left(since)
        )),
        _ => None,
    };
    if let Some(text) = text {
        let faint = Theme::palette_of(ui).faint;
        ui.add(egui::Label::new(RichText::new(text).color(faint)).wrap());
    }
}

/// Draws the verdict so far in short, if the results shown are those of the job: how many whales are held, and what is still open.
fn headline(ui: &mut Ui, job: &StudyJob, shown: Option<&Arc<StudyResults>>) {
    let own = shown.filter(|shown| job.folder().is_some_and(|folder| folder == shown.folder));
    let Some(shown) = own else { return };
    let sentences = answer(&shown.findings, &shown.findings.event);
    let mut text = sentences.first().cloned().unwrap_or_default();
    if let [_, .., last] = sentences.as_slice() {
        text = format!("{text} {last}");
    }
    let faint = Theme::palette_of(ui).faint;
    ui.add(egui::Label::new(RichText::new(text).color(faint)).wrap())
        .on_hover_text("from the encounters so far; Results has the whole verdict");
}

fn button(ui: &mut Ui, text: &str, action: StudyAction, actions: &mut Vec<StudyAction>) {
    if ui.small_button(text).clicked() {
        actions.push(action);
    }
}

/// Draws the list of results of earlier studies.
fn ready(ui: &mut Ui, shared: &mut Shared) {
    let root = shared.workbench.studies().root();
    let id = egui::Id::new("ready studies");
    let count =
        shared.workbench.studies().queue.jobs.iter().filter(|job| !job.is_unfinished()).count();
    let known = ui
        .data(|data| data.get_temp::<(usize, Vec<(PathBuf, String)>)>(id))
        .filter(|(seen, _)| *seen == count);
    let (_, found) = known.unwrap_or_else(|| (count, list(&root)));
    ui.data_mut(|data| data.insert_temp(id, (count, found.clone())));
    if found.is_empty() {
        return;
    }
    egui::CollapsingHeader::new(format!("Results of earlier studies ({})", found.len()))
        .id_salt("ready")
        .show(ui, |ui| {
            for (folder, words) in found {
                if ui.link(words).on_hover_text(folder.display().to_string()).clicked() {
                    shared.give(StudyAction::ShowResults(folder));
                }
            }
        });
}

fn list(root: &std::path::Path) -> Vec<(PathBuf, String)> {
    let words = |found: results::ResultsFolder| {
        let (label, state) = (found.label, if found.reported { "reported" } else { "not done" });
        let (options, encounters) = (label.options.len(), label.encounters);
        let words = format!("{}, {options} options, {encounters} encounters, {state}", label.study);
        (found.folder, words)
    };
    results::list(root).into_iter().map(words).collect()
}
