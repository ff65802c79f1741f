//! The Study layout: a study designed, queued, paused, left off, gone on with, and its runs seen again.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use endline_session::command::{EditAction, StudyAction};
use endline_workbench::gui::command::action::PanelAction;
use endline_workbench::gui::command::action::WindowCommand;
use std::sync::Arc;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use endline_session::campaign::State;
use endline_session::edit::Documents;
use endline_session::live::Status;
use endline_session::live::engine;
use endline_session::study::queue::StudyJob;
use endline_session::study::stats::answer;
use endline_workbench::gui::app::App;
use endline_workbench::gui::layout::Layout;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::panels::results::Part;
use endline_workbench::input::Pilot;

use crate::common;
use crate::common::{Folder, linked, opened_with, retype};

/// Short draws of a small rig without a whale: what is looked at here is the window, not the physics.
const STUDY: &str = r#"format = 1
kind = "study"
name = "Small"
scenario = "small-rig"
encounters = 6
baseline = "strong"

# Why these two.
[[option]]
id = "strong"
name = "Strong link"
strength = "600 lbf"

[option.set]
"link.0.rating" = "600 lbf"

[[option]]
id = "weak"
name = "Weak link"

[option.set]
"link.0.rating" = "5 N"

[encounter."body.0.drag_area"]
uniform = ["0.1 m2", "0.3 m2"]
source = "assumed"

[encounter.tide]
choice = ["0.2 m/s", "0.5 m/s"]
source = "assumed"
"#;

/// Puts the small study and its scenario into the library.
pub fn add_study(folder: &Folder) {
    let scenario = common::on_disk(folder, "scenarios/study-endline-held.toml");
    let (gear, _) = scenario.split_once("[whale]").unwrap();
    // Without a whale there is none for the resolution to follow.
    let (head, rest) = gear.split_once("[resolution]").unwrap();
    let (_, rest) = rest.split_once("[site]").unwrap();
    let gear =
        format!("{head}[site]{rest}").replace("duration = \"660 s\"", "duration = \"0.5 s\"");
    std::fs::write(
        folder.0.join("scenarios/small-rig.toml"),
        gear.replace("rope_nodes = 500", "rope_nodes = 12"),
    )
    .unwrap();
    std::fs::create_dir_all(folder.0.join("studies")).unwrap();
    std::fs::write(folder.0.join("studies/small.toml"), STUDY).unwrap();
}

/// The workbench with the small study in its library, in the layout Study.
fn studying(folder: &Folder) -> Harness<'static, App> {
    add_study(folder);
    let mut harness = opened_with(folder.documents(), linked(), engine::live(), Pilot::default());
    harness.state_mut().shared.workbench.studies.folder = Some(folder.0.join("results"));
    // Other tests run beside this one.
    harness.state_mut().shared.workbench.studies.queue.normal_priority = true;
    give(&mut harness, PanelAction::Arrange(Layout::Study));
    give(&mut harness, StudyAction::Open(folder.0.join("studies/small.toml")));
    harness
}

/// Draws until something is so; encounters are run meanwhile.
fn wait(harness: &mut Harness<'static, App>, so: impl Fn(&App) -> bool) {
    let patience = std::time::Instant::now() + std::time::Duration::from_secs(120);
    while !so(harness.state()) {
        let studies = &harness.state().shared.workbench.studies;
        let told = studies.queue.jobs.last().map(|job| (job.state(), job.progress()));
        assert!(
            std::time::Instant::now() < patience,
            "waited in vain: {told:?}, {:?}",
            harness.state().shared.workbench.notice
        );
        std::thread::sleep(std::time::Duration::from_millis(20));
        harness.step();
    }
    harness.run_steps(2);
}

fn give(harness: &mut Harness<'static, App>, command: impl Into<WindowCommand>) {
    harness.state_mut().shared.give(command);
    harness.run_steps(3);
}

fn state(app: &App) -> Option<State> {
    app.shared.workbench.studies.queue.jobs.last().map(StudyJob::state)
}

/// Runs the open study to its end and waits for its results.
fn done(harness: &mut Harness<'static, App>, encounters: u64) {
    wait(harness, |app| state(app) == Some(State::Done));
    wait(harness, |app| {
        let results = &app.shared.workbench.studies.results;
        !results.busy()
            && results
                .shown()
                .is_some_and(|shown| shown.whole && shown.findings.encounters == encounters)
    });
}

#[test]
fn a_study_is_edited_run_and_any_run_of_it_is_seen_again_to_the_bit() {
    let folder = Folder::new("study");
    let mut harness = studying(&folder);
    retype(&mut harness, "6", "7");
    assert_eq!(
        harness
            .state()
            .shared
            .workbench
            .project
            .documents
            .field(Documents::STUDY, "encounters")
            .as_deref(),
        Some("7")
    );
    retype(&mut harness, "5 N", "6 N");
    harness.state_mut().shared.workbench.set("ropes/pp-3-8.toml", "strength", "2,000 lbf");
    let files = ["studies/small.toml", "ropes/pp-3-8.toml"];
    let on_disk = || files.map(|file| common::on_disk(&folder, file));
    let before = on_disk();
    harness.get_by_label("Run study").click();
    harness.run_steps(2);
    done(&mut harness, 7);
    assert_eq!(on_disk(), before, "nothing is saved, and the run has what stands in the window");
    let unsaved = harness.state().shared.workbench.project.documents.unsaved();
    assert_eq!(unsaved, ["ropes/pp-3-8.toml", Documents::STUDY]);

    let shown = Arc::clone(harness.state().shared.workbench.studies.results.shown().unwrap());
    assert_eq!(shown.findings.baseline, 0, "the baseline is the first option by id");
    let parts = [
        (Part::Forest, "Difference of rates from Strong link"),
        (Part::Tensions, "Each dot is a run"),
        (Part::Sensitivity, "by parts of each input"),
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
    let view = harness.state().shared.workbench.view().cloned().unwrap();
    assert_eq!(
        view.state_hash, run.state_hash,
        "the run in the window ends in the state the table has"
    );
    assert!(!run.parted.is_empty(), "6 N part in this sea");

    (0..3).for_each(|_| give(&mut harness, EditAction::Undo));
    assert_eq!(
        harness
            .state()
            .shared
            .workbench
            .project
            .documents
            .field(Documents::STUDY, "encounters")
            .as_deref(),
        Some("6"),
        "edits of a study are taken back"
    );
}

#[test]
fn a_study_stands_still_when_paused_keeps_its_blocks_when_cancelled_and_goes_on() {
    let folder = Folder::new("queue");
    let mut harness = studying(&folder);
    harness.state_mut().shared.workbench.set(Documents::STUDY, "encounters", "400");
    give(&mut harness, StudyAction::Run);
    wait(&mut harness, |app| {
        app.shared.workbench.studies.queue.jobs[0].progress().blocks.done >= 2
    });
    give(&mut harness, StudyAction::Pause);
    assert_eq!(state(harness.state()), Some(State::Paused));
    // The encounter under way still comes to its end, later on a busy machine.
    let done = || harness.state().shared.workbench.studies.queue.jobs[0].progress().encounters.done;
    let rests = |_| {
        std::thread::sleep(std::time::Duration::from_millis(400));
        let before = done();
        std::thread::sleep(std::time::Duration::from_millis(300));
        (done() == before).then_some(before)
    };
    let before = (0..3).find_map(rests).expect("paused");
    give(&mut harness, StudyAction::Pause);
    wait(&mut harness, |app| {
        app.shared.workbench.studies.queue.jobs[0].progress().encounters.done > before
    });
    give(&mut harness, StudyAction::Cancel);
    wait(&mut harness, |app| state(app) == Some(State::Cancelled));
    let kept = harness.state().shared.workbench.studies.queue.jobs[0].progress().blocks.done;

    harness.state_mut().shared.workbench.set(Documents::STUDY, "encounters", "8");
    give(&mut harness, StudyAction::Run);
    wait(&mut harness, |app| state(app) == Some(State::Done));
    let progress = harness.state().shared.workbench.studies.queue.jobs[0].progress().encounters;
    assert_eq!(
        (progress.found, progress.done, progress.total),
        (kept.min(8), 8, 8),
        "blocks that were done are not run again"
    );
    let folder = harness.state().shared.workbench.studies.queue.jobs[0].folder().unwrap();
    for file in ["table.csv", "report.html", "bundle/study.toml"] {
        assert!(folder.join(file).is_file(), "{file}");
    }
    let workbench = &harness.state().shared.workbench;
    let line = workbench.study_command_line().unwrap();
    assert!(
        line.contains("endline study run") && line.contains(&folder.display().to_string()),
        "{line}"
    );
    give(&mut harness, StudyAction::ShowResults(folder));
    wait(&mut harness, |app| !app.shared.workbench.studies.results.busy());
    assert_eq!(
        harness.state().shared.workbench.studies.results.problem,
        None,
        "a folder of results is opened by its own bundle"
    );
}

#[test]
fn options_and_priors_are_added_and_wrong_ones_told_at_their_place() {
    let folder = Folder::new("designer");
    let mut harness = studying(&folder);
    // All of the panel is in sight.
    harness.set_size(egui::vec2(1500.0, 1400.0));
    harness.state_mut().dock = egui_dock::DockState::new(vec![PanelId::STUDY.id().to_owned()]);
    harness.run_steps(2);
    harness.get_by_label("Add option").click();
    harness.run_steps(2);
    let field = |harness: &Harness<'static, App>, field: &str| {
        harness.state().shared.workbench.project.documents.field(Documents::STUDY, field)
    };
    assert_eq!(field(&harness, "option.2.id").as_deref(), Some("weak-2"));
    assert_eq!(
        field(&harness, "option.2.set.\"link.0.rating\"").as_deref(),
        Some("5 N"),
        "an option begins as a copy"
    );
    retype(&mut harness, "0.1 m2", "0.4 m2");
    assert!(
        harness.state().shared.workbench.project.documents.file_has_error(Documents::STUDY),
        "the least is above the greatest"
    );
    assert!(harness.query_by_label_contains("the first value is not below the second").is_some());
    assert!(
        !harness.state().shared.workbench.project.documents.any_error(),
        "a single run does not mind the study"
    );
    give(&mut harness, StudyAction::Run);
    assert!(
        harness.state().shared.workbench.studies.queue.jobs.is_empty(),
        "a study with errors is not queued"
    );
    give(&mut harness, EditAction::Undo);
    assert!(!harness.state().shared.workbench.project.documents.file_has_error(Documents::STUDY));
    retype(&mut harness, "0.2 m/s, 0.5 m/s", "0.1 m/s, 0.2 m/s, 0.3 m/s");
    assert_eq!(field(&harness, "encounter.tide.choice.2").as_deref(), Some("0.3 m/s"));
}

#[test]
fn a_design_becomes_an_option_its_results_are_said_in_words_and_its_bundle_is_saved() {
    let folder = Folder::new("design-option");
    let mut harness = studying(&folder);
    let field = |harness: &Harness<'static, App>, text: &str, field: &str| {
        harness.state().shared.workbench.project.documents.field(text, field)
    };
    give(&mut harness, StudyAction::OptionFromEdits);
    let refused = harness.state().shared.workbench.notice.clone().unwrap();
    assert!(refused.text.contains("open small-rig"), "another scenario is open: {}", refused.text);
    give(&mut harness, EditAction::OpenScenario(folder.0.join("scenarios/small-rig.toml")));
    give(&mut harness, StudyAction::OptionFromEdits);
    let refused = harness.state().shared.workbench.notice.clone().unwrap();
    assert!(refused.text.contains("nothing is edited"), "{}", refused.text);

    let old = field(&harness, Documents::SCENARIO, "link.0.rating").unwrap();
    harness.state_mut().shared.workbench.set(Documents::SCENARIO, "link.0.rating", "7 N");
    give(&mut harness, StudyAction::OptionFromEdits);
    let made = |key: &str| field(&harness, Documents::STUDY, &format!("option.2.{key}"));
    assert_eq!(made("id").as_deref(), Some("design"));
    assert_eq!(made("name").as_deref(), Some("link rating 7 N"));
    assert_eq!(made("set.\"link.0.rating\"").as_deref(), Some("7 N"));
    let now = field(&harness, Documents::SCENARIO, "link.0.rating");
    assert_eq!(now, Some(old), "the baseline stays as its file has it");
    assert!(
        !harness.state().shared.workbench.project.documents.file_has_error(Documents::STUDY),
        "the option assembles"
    );

    harness.get_by_label("Run study").click();
    harness.run_steps(2);
    done(&mut harness, 6);
    let shown = Arc::clone(harness.state().shared.workbench.studies.results.shown().unwrap());
    assert_eq!(shown.findings.options.len(), 3);
    for sentence in answer(&shown.findings, &shown.findings.event) {
        harness.get_by_label(&sentence);
    }
    harness.get_by_label_contains("6 encounters are few");
    let report = harness.state().shared.workbench.report_shown().expect("a report");
    assert!(std::fs::read_to_string(report).unwrap().contains("6 encounters are few"));
    let out = folder.0.join("out");
    give(&mut harness, StudyAction::SaveBundle(out.clone()));
    for part in ["report.html", "findings.json", "bundle/study.toml", "bundle/gear-library/ropes"] {
        assert!(out.join("small").join(part).exists(), "{part}");
    }
    give(&mut harness, StudyAction::SaveBundle(out));
    let refused = harness.state().shared.workbench.notice.clone().unwrap();
    assert!(refused.text.contains("is there already"), "{}", refused.text);
}

#[test]
fn a_field_is_found_by_its_meaning_and_a_wrong_value_is_told_before_anything_is_run() {
    let folder = Folder::new("settable");
    let mut harness = studying(&folder);
    harness.state_mut().dock = egui_dock::DockState::new(vec![PanelId::STUDY.id().to_owned()]);
    harness.run_steps(2);
    harness.get_all_by_label_contains("Set a field").next().unwrap().click();
    harness.run_steps(4);
    harness.event(egui::Event::Text("surface speed".to_owned()));
    harness.run_steps(2);
    assert!(harness.query_by_label("Sea: Depth").is_none(), "a search leaves out the rest");
    harness.get_by_label("Sea: Current").click();
    harness.run_steps(2);
    let set = "option.0.set.\"current.speed\"";
    let value = |harness: &Harness<'static, App>| {
        harness.state().shared.workbench.project.documents.field(Documents::STUDY, set)
    };
    assert_eq!(value(&harness).as_deref(), Some("0.25 m/s"), "it begins as the scenario has it");

    let clean = |app: &App| app.shared.workbench.studies.check.is_clean();
    give(&mut harness, change(set, "1,700 lbf every 60 ft"));
    wait(&mut harness, |app| !clean(app));
    let problem = harness.state().shared.workbench.studies.check.problems()[0].clone();
    assert!(problem.message.contains("option `strong`"), "{problem}");
    assert!(problem.excerpt.contains("every 60 ft"), "told at the setting: {problem}");
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
