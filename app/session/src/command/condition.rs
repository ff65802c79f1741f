//! When commands are enabled; each condition gives the reason where it does not hold.

use crate::workbench::{Direction, Workbench};

type Condition = Result<(), String>;

/// A reason where something is not so.
fn require(so: bool, reason: &str) -> Condition {
    if so { Ok(()) } else { Err(reason.to_owned()) }
}

/// A run is there.
pub(super) fn ready(workbench: &Workbench) -> Condition {
    require(workbench.view().is_some(), "no run is there yet")
}

/// The run goes on.
pub(super) fn running(workbench: &Workbench) -> Condition {
    require(workbench.running(), "the run is not going on")
}

/// A run is there and does not go on.
pub(super) fn is_still(workbench: &Workbench) -> Condition {
    ready(workbench)?;
    require(!workbench.running(), "pause the run first")
}

/// The run has taken steps.
pub(super) fn has_moments(workbench: &Workbench) -> Condition {
    let moments = workbench.view().is_some_and(|view| view.newest_s > 0.0);
    require(moments, "nothing was run yet")
}

/// A moment before the newest is shown.
pub(super) fn earlier_moment(workbench: &Workbench) -> Condition {
    has_moments(workbench)?;
    let sought = workbench.view().is_some_and(|view| view.sought);
    require(sought, "the newest moment is shown already")
}

/// What was run can be played.
pub(super) fn can_replay(workbench: &Workbench) -> Condition {
    has_moments(workbench)?;
    require(workbench.replaying() || !workbench.running(), "pause the run first")
}

/// No text has an error.
pub(super) fn no_errors(workbench: &Workbench) -> Condition {
    let fine = !workbench.project.documents.any_error();
    require(fine, "the gear has errors; see Problems")
}

/// Texts have changed since the model was made, and have no errors.
pub(super) fn can_apply(workbench: &Workbench) -> Condition {
    no_errors(workbench)?;
    require(workbench.stale(), "nothing has changed since the model was made")
}

/// The inputs of the run can be run in a new model.
pub(super) fn can_rerun(workbench: &Workbench) -> Condition {
    ready(workbench)?;
    no_errors(workbench)
}

/// A slower speed is there.
pub(super) fn slower(workbench: &Workbench) -> Condition {
    ready(workbench)?;
    let next = workbench.next_speed(Direction::Slower);
    require(next.is_some(), "this is the slowest speed")
}

/// A faster speed is there.
pub(super) fn faster(workbench: &Workbench) -> Condition {
    ready(workbench)?;
    let next = workbench.next_speed(Direction::Faster);
    require(next.is_some(), "this is the fastest speed")
}

/// An assembly was checked under rules.
pub(super) fn has_verdicts(workbench: &Workbench) -> Condition {
    require(workbench.rules.answer.is_some(), "check an assembly in Rules first")?;
    require(!workbench.rules.comparing(), "a study is being made already")?;
    require(!workbench.rules.writing(), "a sheet is being written already")
}

/// Edits were proposed by which the assembly checked would comply.
pub(super) fn has_edits(workbench: &Workbench) -> Condition {
    has_verdicts(workbench)?;
    let remedies = workbench.rules.answer.as_ref().and_then(|answer| answer.remedies.as_ref());
    let any = remedies.is_some_and(|remedies| remedies.numbered().next().is_some());
    require(any, "no edit is proposed")
}

/// Edits exist by which the gear meets rules that bind.
pub(super) fn has_edit_of_all(workbench: &Workbench) -> Condition {
    has_verdicts(workbench)?;
    let remedies = workbench.rules.answer.as_ref().and_then(|answer| answer.remedies.as_ref());
    let any = remedies.is_some_and(|remedies| remedies.all.is_some());
    require(any, "no edit is proposed for a rule that binds")
}

/// Two runs are compared.
pub(super) fn compares(workbench: &Workbench) -> Condition {
    require(workbench.comparison().is_some(), "no run is compared with the one shown")
}

/// An edit can be taken back.
pub(super) fn can_undo(workbench: &Workbench) -> Condition {
    let (undo, _) = workbench.project.documents.can_undo_redo();
    require(undo, "nothing to undo")
}

/// An edit that was taken back can be done again.
pub(super) fn can_redo(workbench: &Workbench) -> Condition {
    let (_, redo) = workbench.project.documents.can_undo_redo();
    require(redo, "nothing to redo")
}

/// A file differs from its text.
pub(super) fn unsaved(workbench: &Workbench) -> Condition {
    require(!workbench.project.documents.unsaved().is_empty(), "nothing to save")
}

/// The scenario has a whale.
pub(super) fn has_whale(workbench: &Workbench) -> Condition {
    require(workbench.project.has_whale(), "this scenario has no whale to pilot")
}

/// A study is open.
pub(super) fn study_opened(workbench: &Workbench) -> Condition {
    let opened = workbench.project.documents.study_path().is_some();
    require(opened, "open a study first")
}

/// The open study and the gear have no errors.
pub(super) fn study_runs(workbench: &Workbench) -> Condition {
    study_opened(workbench)?;
    require(workbench.study_is_sound(), "study or gear have errors; see Problems")
}

/// A study is at work or paused.
pub(super) fn study_at_work(workbench: &Workbench) -> Condition {
    require(workbench.studies.queue.current().is_some(), "no study is at work")
}

/// An observation is open.
pub(super) fn observation_opened(workbench: &Workbench) -> Condition {
    let opened = workbench.project.documents.observation_path().is_some();
    require(opened, "open an observation first")
}

/// The open observation and the gear have no errors, and no search is at work.
pub(super) fn search_runs(workbench: &Workbench) -> Condition {
    observation_opened(workbench)?;
    require(workbench.observation_is_sound(), "observation or gear have errors; see Problems")?;
    require(workbench.searches.at_work().is_none(), "a search is at work; pause or cancel it")
}

/// A search is at work or paused.
pub(super) fn search_at_work(workbench: &Workbench) -> Condition {
    require(workbench.searches.at_work().is_some(), "no search is at work")
}

/// Stories of a search are shown.
pub(super) fn has_stories(workbench: &Workbench) -> Condition {
    let stories = workbench.searches.job.as_ref().and_then(|job| job.found().stories);
    let shown = stories.is_some_and(|found| !found.stories.is_empty());
    require(shown, "no story was found yet")
}

/// Results of a study are shown.
pub(super) fn has_results(workbench: &Workbench) -> Condition {
    let shown = workbench.studies.results.shown().is_some();
    require(shown, "no results of a study are shown")
}

/// The results shown are those of a whole study, with their report.
pub(super) fn has_report(workbench: &Workbench) -> Condition {
    has_results(workbench)?;
    let written = workbench.report_shown().is_some();
    require(written, "the report is written when the study has run to its end")
}

/// Plugins can be loaded again.
pub(super) fn loads_plugins(workbench: &Workbench) -> Condition {
    require(workbench.plugins.has_loader(), "there are no folders of plugins here")
}

/// A plugin library waits to be allowed.
pub(super) fn plugins_waiting(workbench: &Workbench) -> Condition {
    let waiting = workbench.plugins.waiting().next().is_some();
    require(waiting, "no plugin waits to be allowed")
}

/// A plugin can be switched on or off.
pub(super) fn plugins_to_switch(workbench: &Workbench) -> Condition {
    loads_plugins(workbench)?;
    require(!workbench.plugins.every().is_empty(), "there are no plugins")
}

/// A plugin can be put into the scenario.
pub(super) fn plugins_to_use(workbench: &Workbench) -> Condition {
    let usable = !workbench.usable_plugins().is_empty();
    require(usable, "no plugin that the scenario does not use already")
}
