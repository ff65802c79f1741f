//! Every declared command has an observable effect, or a reason why it has none.

use std::collections::{BTreeMap, BTreeSet};

use endline_session::command::{EditAction, Make, RunAction};
use endline_session::live::Status;
use endline_session::workbench::Folders;
use endline_workbench::gui::app::App;
use endline_workbench::gui::command::action::{PanelAction, WindowAction, WindowCommand};
use endline_workbench::gui::command::{Declared, declared};
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::panels::help::markdown;
use endline_workbench::input::Pilot;

use crate::common::{
    Folder, Reach as _, Received, Window, add_study, give, linked, opened_with, wait, workbench,
};
use crate::search::add_observation;

/// Everything that a command may change, as text.
fn fingerprint(harness: &Window, received: &Received) -> String {
    let app = harness.state();
    let (shared, panels) = (&app.shared, &app.panels);
    let (workbench, documents) = (&shared.workbench, &shared.workbench.project().documents);
    let view = workbench.view().map(|view| (view.status.clone(), view.frame.step, view.speed));
    let jobs = workbench.studies().queue.jobs.iter().map(|job| job.state()).collect::<Vec<_>>();
    let texts = (
        (documents.version(), documents.scenario_path()),
        (documents.study_path(), documents.observation_path()),
    );
    let search = workbench.searches().job.as_ref().map(|job| (job.state(), job.request.only_reads));
    let work = (
        search,
        workbench.making(),
        workbench.plugins().busy(),
        workbench.studies().results.busy(),
    );
    let eyes: Vec<_> = panels.view.eyes.iter().map(|eye| (eye.named, eye.follow)).collect();
    let keys: Vec<f64> = panels.view.path.times().collect();
    let picks = (&panels.view.picks, keys, panels.view.eyes.iter().any(|eye| eye.frame_again));
    let flight = (shared.flying, shared.posing, shared.pilot.act(), shared.pilot.mouth_open());
    let chosen = (panels.library.kind(), &panels.library.chosen, panels.program.chosen);
    let dock = serde_json::to_string(&app.dock).unwrap();
    let settings = serde_json::to_string(&(&shared.preferences, &workbench.preferences())).unwrap();
    let window = (harness.ctx.zoom_factor(), app.palette.is_open(), &app.questions.opening);
    format!(
        "{received:?} {view:?} {jobs:?} {texts:?} {work:?} {eyes:?} {picks:?} {flight:?} {chosen:?} \
         {:?} {} {dock} {settings} {window:?}",
        workbench.notice(),
        workbench.comparison().is_some()
    )
}

/// Gives every command that needs no file; records which had an effect and which gave a reason.
fn every_command(
    harness: &mut Window,
    received: &Received,
    effects: &mut BTreeMap<&'static str, BTreeSet<&'static str>>,
) {
    for info in declared() {
        let offers = info.offers(&harness.state().shared);
        // A command without choices has a reason.
        if let (true, Err(reason)) = (offers.is_empty(), info.enabled(&harness.state().shared)) {
            assert!(
                !reason.is_empty(),
                "{} has no reason for its lack of choices",
                info.about().id
            );
            effects.entry(info.about().id).or_default().insert("reason");
        }
        for offer in offers {
            // A file dialog needs a display; quitting would end the test.
            let asks = matches!(offer.command, WindowCommand::Window(WindowAction::Ask(_)));
            if asks || info.about().id == "window.quit" {
                continue;
            }
            harness.workbench_mut().dismiss_notice();
            harness.run_steps(1);
            let enabled = info.enabled(&harness.state().shared);
            let before = fingerprint(harness, received);
            harness.state_mut().shared.give(offer.command.clone());
            harness.run_steps(1);
            let notice = harness.workbench().notice().cloned();
            let effect = effects.entry(info.about().id).or_default();
            match enabled {
                Ok(()) if fingerprint(harness, received) != before => {
                    effect.insert("effect");
                }
                Ok(()) => {}
                Err(reason) => {
                    assert!(!reason.is_empty(), "{} has no reason why it is disabled", offer.name);
                    assert_eq!(notice.map(|notice| notice.text), Some(reason), "{}", offer.name);
                    effect.insert("reason");
                }
            }
        }
    }
}

#[test]
fn every_declared_command_has_an_effect_or_a_reason() {
    let folder = Folder::new("commands");
    // Commands that open a study or an observation need one.
    add_study(&folder);
    add_observation(&folder);
    let (mut harness, received) = workbench(&folder, Pilot::default());
    harness
        .workbench_mut()
        .write_to(Folders { studies: Some(folder.0.join("results")), ..Folders::default() });
    harness
        .workbench_mut()
        .write_to(Folders { searches: Some(folder.0.join("results")), ..Folders::default() });
    let mut effects = BTreeMap::new();
    every_command(&mut harness, &received, &mut effects);
    // Again while the whale is steered, with a selected entry and an edit to undo.
    let path = folder.0.join("scenarios/hello-endline.toml");
    harness.perform(EditAction::Save);
    harness.perform(EditAction::OpenScenario(path));
    wait(&mut harness, |app| !app.shared.workbench.making());
    give(&mut harness, PanelAction::Entry("ropes/sink-3-8.toml".to_owned()));
    harness.set("ropes/sink-3-8.toml", "strength", "2,600 lbf");
    harness.state_mut().shared.flying = true;
    every_command(&mut harness, &received, &mut effects);

    for info in declared() {
        let [named, needs_file] = [
            matches!(info, Declared::Workbench(info) if !matches!(info.make, Make::Values(_)))
                || matches!(info, Declared::Window(info) if !matches!(info.make, Make::Values(_))),
            info.question(&harness.state().shared).is_some(),
        ];
        if !named || needs_file || info.about().id == "window.quit" {
            continue;
        }
        let effect = effects.get(info.about().id);
        assert!(
            effect.is_some_and(|effect| !effect.is_empty()),
            "{} does nothing",
            info.about().id
        );
    }
}

#[test]
fn commands_of_a_finished_run_have_their_effect() {
    let folder = Folder::new("commands-flown");
    let documents = folder.documents_of("reference-a-pendulum");
    let launch = endline_session::live::engine::live();
    let mut harness = opened_with(documents, linked(), launch, Pilot::default());
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness.perform(RunAction::Speed(f64::INFINITY));
    harness.perform(RunAction::Start);
    wait(&mut harness, |app| app.shared.workbench.view().is_some_and(|view| view.newest_s > 0.3));
    // A short run may end before it is paused.
    harness.perform(RunAction::Pause);
    wait(&mut harness, |app| {
        matches!(app.shared.workbench.status(), Some(Status::Paused | Status::Finished))
    });
    let command = |id: &str| declared().find(|info| info.about().id == id).unwrap();
    let give_enabled = |harness: &mut Window, id: &str| {
        let command = command(id);
        assert_eq!(command.enabled(&harness.state().shared), Ok(()), "{id}");
        give(harness, command.plain().unwrap());
    };
    let shown_s = |app: &App| app.shared.workbench.view().unwrap().frame.time_s;
    give_enabled(&mut harness, "time.first");
    wait(&mut harness, |app| shown_s(app) < 1e-9);
    give_enabled(&mut harness, "time.forward");
    wait(&mut harness, |app| shown_s(app) > 0.0);
    give_enabled(&mut harness, "time.newest");
    wait(&mut harness, |app| shown_s(app) > 0.3);
    assert!(command("time.newest").enabled(&harness.state().shared).is_err());
    give_enabled(&mut harness, "time.back");
    wait(&mut harness, |app| app.shared.workbench.view().unwrap().sought);
    give_enabled(&mut harness, "run.branch");
    wait(&mut harness, |app| !app.shared.workbench.view().unwrap().sought);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    give_enabled(&mut harness, "run.hold");
    wait(&mut harness, |app| app.shared.workbench.comparison().is_some());
    give_enabled(&mut harness, "run.end-comparison");
    assert!(harness.workbench().comparison().is_none());
}

#[test]
fn ids_and_names_of_commands_are_unique() {
    let folder = Folder::new("names");
    let (harness, _) = workbench(&folder, Pilot::default());
    let mut ids = BTreeSet::new();
    let mut names = BTreeSet::new();
    for info in declared() {
        assert!(ids.insert(info.about().id), "{} is declared twice", info.about().id);
        for offer in info.offers(&harness.state().shared) {
            assert!(names.insert(offer.name.clone()), "two commands have the name {}", offer.name);
            let asks = matches!(offer.command, WindowCommand::Window(WindowAction::Ask(_)));
            assert!(
                asks || offer.command.id() == info.about().id,
                "{} makes {}",
                info.about().id,
                offer.command.id()
            );
        }
    }
    assert!(PanelId::ALL.iter().all(|panel| names.contains(&format!("Show {}", panel.title()))));
}

#[test]
fn the_document_lists_all_commands_and_keys() {
    const START: &str = "<!-- commands -->\n";
    const END: &str = "<!-- end of commands -->";
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/workbench.md");
    let document = std::fs::read_to_string(&path).unwrap();
    let (before, rest) = document.split_once(START).unwrap();
    let (_, after) = rest.split_once(END).unwrap();
    let fresh = format!("{before}{START}{}\n{END}{after}", markdown());
    if std::env::var_os("ENDLINE_WRITE_DOCS").is_some() {
        std::fs::write(&path, &fresh).unwrap();
        return;
    }
    let first = document.lines().zip(fresh.lines()).find(|(old, new)| old != new);
    assert!(
        document == fresh,
        "docs/workbench.md is out of date, first at {first:?}: ENDLINE_WRITE_DOCS=1 with this test writes it"
    );
}
