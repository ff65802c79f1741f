//! The layout Study: a study designed, queued, paused, cancelled and continued, and its runs replayed.

use endline_session::command::{EditAction, StudyAction};
use endline_session::workbench::Folders;
use endline_workbench::gui::command::action::PanelAction;
use std::sync::Arc;

use egui_kittest::kittest::Queryable;
use endline_session::campaign::State;
use endline_session::edit::Documents;
use endline_session::live::{Status, engine};
use endline_session::study::queue::StudyJob;
use endline_session::study::stats::answer;
use endline_workbench::gui::app::App;
use endline_workbench::gui::layout::Layout;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::panels::results::Part;
use endline_workbench::input::Pilot;

use crate::common::{
    Folder, Reach as _, Window, add_study, give, linked, on_disk, only, opened_with, retype, wait,
};

/// The workbench in the layout Study with the small study open.
fn studying(folder: &Folder) -> Window {
    add_study(folder);
    let mut harness = opened_with(folder.documents(), linked(), engine::live(), Pilot::default());
    harness
        .workbench_mut()
        .write_to(Folders { studies: Some(folder.0.join("results")), ..Folders::default() });
    // Other tests run at the same time, so the work keeps normal priority.
    harness.perform(StudyAction::FullSpeed(true));
    give(&mut harness, PanelAction::Arrange(Layout::Study));
    give(&mut harness, StudyAction::Open(folder.0.join("studies/small.toml")));
    harness
}

fn state(app: &App) -> Option<State> {
    app.shared.workbench.studies().queue.jobs.last().map(StudyJob::state)
}

/// Waits for the end of the study and for its results.
fn done(harness: &mut Window, encounters: u64) {
    wait(harness, |app| state(app) == Some(State::Done));
    wait(harness, |app| {
        let results = &app.shared.workbench.studies().results;
        !results.busy()
            && results
                .shown()
                .is_some_and(|shown| shown.whole && shown.findings.encounters == encounters)
    });
}

#[test]
fn a_study_is_edited_and_run_and_a_run_of_it_is_replayed_to_the_bit() {
    let folder = Folder::new("study");
    let mut harness = studying(&folder);
    retype(&mut harness, "6", "7");
    assert_eq!(harness.documents().field(Documents::STUDY, "encounters").as_deref(), Some("7"));
    retype(&mut harness, "5 N", "6 N");
    harness.set("ropes/pp-3-8.toml", "strength", "2,000 lbf");
    let files = ["studies/small.toml", "ropes/pp-3-8.toml"];
    let stored = || files.map(|file| on_disk(&folder, file));
    let before = stored();
    harness.get_by_label("Run study").click();
    harness.run_steps(2);
    done(&mut harness, 7);
    assert_eq!(stored(), before, "a study saves no file");
    let unsaved = harness.documents().unsaved();
    assert_eq!(unsaved, ["ropes/pp-3-8.toml", Documents::STUDY]);

    let shown = Arc::clone(harness.workbench().studies().results.shown().unwrap());
    assert_eq!(shown.findings.baseline, 0, "the baseline is the first option");
    let parts = [
        (Part::Forest, "Difference of rates from Strong link"),
        (Part::Tensions, "Each dot is a run"),
        (Part::Sensitivity, "for parts of the range of each input"),
        (Part::Rates, "Strong link (baseline)"),
    ];
    for (part, says) in parts {
        harness.state_mut().panels.results.part = part;
        harness.run_steps(2);
        assert!(harness.query_all_by_label_contains(says).next().is_some(), "{part:?}");
    }
    harness.get_all_by_label("Runs").next().unwrap().click();
    harness.run_steps(2);
    give(&mut harness, StudyAction::Replay { option: 1, encounter: 4 });
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Finished));
    let run = shown.runs.find("weak", 4).unwrap();
    let view = harness.view();
    assert_eq!(
        view.state_hash, run.state_hash,
        "the run in the window ends in the state the table has"
    );
    assert!(!run.parted.is_empty(), "6 N part in this sea");

    (0..3).for_each(|_| give(&mut harness, EditAction::Undo));
    assert_eq!(
        harness.documents().field(Documents::STUDY, "encounters").as_deref(),
        Some("6"),
        "edits of a study are undone"
    );
}

#[test]
fn a_forecast_times_the_next_twelve_encounters_which_the_study_keeps() {
    let folder = Folder::new("forecast");
    let mut harness = studying(&folder);
    harness.set(Documents::STUDY, "encounters", "40");
    for timed_before in [0, 12] {
        give(&mut harness, StudyAction::Forecast);
        wait(&mut harness, |app| state(app) == Some(State::Done));
        let forecast = harness.workbench().studies().queue.jobs[0].forecast().unwrap();
        let cost = forecast.cost.unwrap();
        assert_eq!((forecast.done, cost.timed), (timed_before + 12, 12));
        assert_eq!(cost.left, 28 - timed_before);
        harness.run_steps(2);
        assert!(harness.query_by_label_contains("for each of 12 timed encounters").is_some());
    }
    give(&mut harness, StudyAction::Run);
    wait(&mut harness, |app| state(app) == Some(State::Done));
    let job = &harness.workbench().studies().queue.jobs[0];
    assert_eq!(job.progress().encounters.found, 24, "encounters of a forecast are not run again");
    assert!(job.forecast().is_none());
}

#[test]
fn a_study_stops_when_paused_and_keeps_its_blocks_when_cancelled_and_continued() {
    let folder = Folder::new("queue");
    let mut harness = studying(&folder);
    harness.set(Documents::STUDY, "encounters", "400");
    give(&mut harness, StudyAction::Run);
    wait(&mut harness, |app| {
        app.shared.workbench.studies().queue.jobs[0].progress().blocks.done >= 2
    });
    give(&mut harness, StudyAction::Pause);
    assert_eq!(state(harness.state()), Some(State::Paused));
    // The encounter in progress still ends, later on a busy machine.
    let done = || harness.workbench().studies().queue.jobs[0].progress().encounters.done;
    let paused = |_| {
        std::thread::sleep(std::time::Duration::from_millis(400));
        let before = done();
        std::thread::sleep(std::time::Duration::from_millis(300));
        (done() == before).then_some(before)
    };
    let before = (0..3).find_map(paused).expect("paused");
    give(&mut harness, StudyAction::Pause);
    wait(&mut harness, |app| {
        app.shared.workbench.studies().queue.jobs[0].progress().encounters.done > before
    });
    give(&mut harness, StudyAction::Cancel);
    wait(&mut harness, |app| state(app) == Some(State::Cancelled));
    let kept = harness.workbench().studies().queue.jobs[0].progress().blocks.done;

    harness.set(Documents::STUDY, "encounters", "8");
    give(&mut harness, StudyAction::Run);
    wait(&mut harness, |app| state(app) == Some(State::Done));
    let progress = harness.workbench().studies().queue.jobs[0].progress().encounters;
    assert_eq!(
        (progress.found, progress.done, progress.total),
        (kept.min(8), 8, 8),
        "finished blocks are not run again"
    );
    let folder = harness.workbench().studies().queue.jobs[0].folder().unwrap();
    for file in ["table.csv", "report.html", "bundle/study.toml"] {
        assert!(folder.join(file).is_file(), "{file}");
    }
    let workbench = harness.workbench();
    let line = workbench.study_command_line().unwrap();
    assert!(
        line.contains("endline study run") && line.contains(&folder.display().to_string()),
        "{line}"
    );
    give(&mut harness, StudyAction::ShowResults(folder));
    wait(&mut harness, |app| !app.shared.workbench.studies().results.busy());
    assert_eq!(
        harness.workbench().studies().results.problem,
        None,
        "a folder of results is opened from its bundle"
    );
}

#[test]
fn options_and_priors_are_edited_and_errors_are_reported_at_their_place() {
    let folder = Folder::new("designer");
    let mut harness = studying(&folder);
    // The whole panel is visible.
    harness.set_size(egui::vec2(1500.0, 1400.0));
    only(&mut harness, PanelId::Study);
    harness.get_by_label("Add option").click();
    harness.run_steps(2);
    let field = |harness: &Window, field: &str| harness.documents().field(Documents::STUDY, field);
    assert_eq!(field(&harness, "option.2.id").as_deref(), Some("weak-2"));
    assert_eq!(
        field(&harness, "option.2.set.\"link.0.rating\"").as_deref(),
        Some("5 N"),
        "a new option is a copy"
    );
    retype(&mut harness, "0.1 m2", "0.4 m2");
    assert!(
        harness.documents().file_has_error(Documents::STUDY),
        "the minimum is above the maximum"
    );
    assert!(harness.query_by_label_contains("the first value is not below the second").is_some());
    assert!(!harness.documents().any_error(), "errors of the study do not affect a single run");
    give(&mut harness, StudyAction::Run);
    assert!(
        harness.workbench().studies().queue.jobs.is_empty(),
        "a study with errors is not queued"
    );
    give(&mut harness, EditAction::Undo);
    assert!(!harness.documents().file_has_error(Documents::STUDY));
    retype(&mut harness, "0.2 m/s, 0.5 m/s", "0.1 m/s, 0.2 m/s, 0.3 m/s");
    assert_eq!(field(&harness, "encounter.tide.choice.2").as_deref(), Some("0.3 m/s"));
}

#[test]
fn edits_become_an_option_results_are_summarised_in_words_and_the_bundle_is_saved() {
    let folder = Folder::new("design-option");
    let mut harness = studying(&folder);
    let field = |harness: &Window, text: &str, field: &str| harness.documents().field(text, field);
    give(&mut harness, StudyAction::OptionFromEdits);
    let refused = harness.notice();
    assert!(refused.text.contains("open small-rig"), "another scenario is open: {}", refused.text);
    give(&mut harness, EditAction::OpenScenario(folder.0.join("scenarios/small-rig.toml")));
    give(&mut harness, StudyAction::OptionFromEdits);
    let refused = harness.notice();
    assert!(refused.text.contains("nothing is edited"), "{}", refused.text);

    let old = field(&harness, Documents::SCENARIO, "link.0.rating").unwrap();
    harness.set(Documents::SCENARIO, "link.0.rating", "7 N");
    give(&mut harness, StudyAction::OptionFromEdits);
    let made = |key: &str| field(&harness, Documents::STUDY, &format!("option.2.{key}"));
    assert_eq!(made("id").as_deref(), Some("design"));
    assert_eq!(made("name").as_deref(), Some("link rating 7 N"));
    assert_eq!(made("set.\"link.0.rating\"").as_deref(), Some("7 N"));
    let now = field(&harness, Documents::SCENARIO, "link.0.rating");
    assert_eq!(now, Some(old), "the baseline is that of the file");
    assert!(!harness.documents().file_has_error(Documents::STUDY), "the option can be assembled");

    harness.get_by_label("Run study").click();
    harness.run_steps(2);
    done(&mut harness, 6);
    let shown = Arc::clone(harness.workbench().studies().results.shown().unwrap());
    assert_eq!(shown.findings.options.len(), 3);
    let sentences = answer(&shown.findings, &shown.findings.event);
    assert!(sentences[0].contains("no whale was held in 6 valid encounters"), "{sentences:?}");
    for sentence in &sentences {
        harness.get_by_label(sentence);
    }
    let report = harness.workbench().report_shown().expect("a report");
    assert!(
        std::fs::read_to_string(report)
            .unwrap()
            .contains("no whale was held in 6 valid encounters")
    );
    let out = folder.0.join("out");
    give(&mut harness, StudyAction::SaveBundle(out.clone()));
    for part in ["report.html", "findings.json", "bundle/study.toml", "bundle/gear-library/ropes"] {
        assert!(out.join("small").join(part).exists(), "{part}");
    }
    give(&mut harness, StudyAction::SaveBundle(out));
    let refused = harness.notice();
    assert!(refused.text.contains("is there already"), "{}", refused.text);
}

#[test]
fn a_field_is_found_by_its_meaning_and_a_wrong_value_is_reported_before_the_run() {
    let folder = Folder::new("settable");
    let mut harness = studying(&folder);
    only(&mut harness, PanelId::Study);
    harness.get_all_by_label_contains("Set a field").next().unwrap().click();
    harness.run_steps(4);
    harness.event(egui::Event::Text("surface speed".to_owned()));
    harness.run_steps(2);
    assert!(harness.query_by_label("Sea: Depth").is_none(), "fields that do not match are hidden");
    harness.get_by_label("Sea: Current").click();
    harness.run_steps(2);
    let set = "option.0.set.\"current.speed\"";
    let value = |harness: &Window| harness.documents().field(Documents::STUDY, set);
    assert_eq!(
        value(&harness).as_deref(),
        Some("0.25 m/s"),
        "it starts with the value of the scenario"
    );

    let clean = |app: &App| app.shared.workbench.studies().check.is_clean();
    give(&mut harness, change(set, "1,700 lbf every 60 ft"));
    wait(&mut harness, |app| !clean(app));
    let problem = harness.workbench().studies().check.problems()[0].clone();
    assert!(problem.message.contains("option `strong`"), "{problem}");
    assert!(problem.excerpt.contains("every 60 ft"), "located at the setting: {problem}");
    give(&mut harness, EditAction::Undo);
    wait(&mut harness, clean);
}

fn change(field: &str, value: &str) -> EditAction {
    EditAction::Set {
        path: Documents::STUDY.to_owned(),
        field: field.to_owned(),
        value: value.to_owned(),
    }
}
