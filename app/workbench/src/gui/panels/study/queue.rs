//! The queue of studies: progress and buttons of each, and results of earlier studies.

use endline_session::command::StudyAction;
use std::path::PathBuf;
use std::time::Duration;

use egui::{ProgressBar, RichText, Ui};
use endline_session::campaign::{Job, State};
use endline_session::study::queue::StudyJob;
use endline_session::study::results;

use crate::gui::shared::Shared;
use crate::gui::theme::Theme;
use crate::gui::widgets::words::time_left;

/// An action on a job.
#[derive(Clone, Copy)]
enum Act {
    Pause,
    Resume,
    Cancel,
    Forget,
}

/// Draws the queue.
pub(super) fn show(ui: &mut Ui, shared: &mut Shared) {
    let mut act = None;
    let mut wanted = None;
    for (index, job) in shared.workbench.studies.queue.jobs.iter().enumerate() {
        ui.add_space(3.0);
        if let Some(done) = row(ui, job, &mut wanted) {
            act = Some((index, done));
        }
    }
    if shared.workbench.studies.queue.jobs.iter().any(Job::at_work) {
        ui.ctx().request_repaint_after(Duration::from_millis(500));
    }
    match act {
        Some((index, Act::Pause)) => shared.workbench.studies.queue.jobs[index].pause(),
        Some((index, Act::Resume)) => shared.workbench.studies.queue.jobs[index].resume(),
        Some((index, Act::Cancel)) => shared.workbench.studies.queue.jobs[index].cancel(),
        Some((index, Act::Forget)) => drop(shared.workbench.studies.queue.jobs.remove(index)),
        None => {}
    }
    ready(ui, shared);
    shared.commands.extend(wanted.map(|chosen| StudyAction::ShowResults(chosen).into()));
}

fn row(ui: &mut Ui, job: &StudyJob, wanted: &mut Option<PathBuf>) -> Option<Act> {
    let (state, progress, palette) = (job.state(), job.progress(), Theme::palette_of(ui));
    let mut act = None;
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
                progress
                    .left()
                    .map_or_else(|| "running".into(), |left| format!("{} left", time_left(left))),
                palette.good,
            ),
            State::Paused => ("paused".to_owned(), palette.warning),
            State::Finishing => ("writing the report".to_owned(), palette.good),
            State::Cancelling => {
                ("cancelled; the encounters in progress end".to_owned(), palette.warning)
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
            State::Running | State::Opening => act = button(ui, "Pause", Act::Pause).or(act),
            State::Paused => act = button(ui, "Resume", Act::Resume).or(act),
            _ => {}
        }
        if job.is_unfinished() {
            act = button(ui, "Cancel", Act::Cancel).or(act);
        } else {
            act = button(ui, "✖", Act::Forget).or(act);
        }
        if progress.blocks.done > 0
            && let Some(folder) = job.folder()
            && ui.small_button("Results").clicked()
        {
            *wanted = Some(folder);
        }
        let full = if let State::Failed(why) = &state { why.clone() } else { words.clone() };
        ui.add(egui::Label::new(RichText::new(words).color(colour)).truncate()).on_hover_text(full);
    });
    act
}

fn button(ui: &mut Ui, text: &str, act: Act) -> Option<Act> {
    ui.small_button(text).clicked().then_some(act)
}

/// Draws the list of results of earlier studies.
fn ready(ui: &mut Ui, shared: &mut Shared) {
    let root = shared.workbench.studies.root();
    let id = egui::Id::new("ready studies");
    let count =
        shared.workbench.studies.queue.jobs.iter().filter(|job| !job.is_unfinished()).count();
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
