//! A study that was run, so that its panels have something to show.

use endline_session::campaign::State;
use endline_session::command::StudyAction;
use endline_session::study::queue::StudyJob;
use endline_workbench::gui::layout::Layout;

use crate::common::{Folder, on_disk};
use crate::screen::Screen;

/// Short draws of a small rig without a whale: what is looked at here is the window, not the physics.
const STUDY: &str = r#"format = 1
kind = "study"
name = "Small"
scenario = "small-rig"
encounters = 40
baseline = "strong"

[[option]]
id = "strong"
name = "Strong link"

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

/// Runs the study and opens its results.
pub fn run(screen: &mut Screen, folder: &Folder) {
    let scenario = on_disk(folder, "scenarios/study-endline-held.toml");
    let (gear, _) = scenario.split_once("[whale]").unwrap();
    // Without a whale there is none for the resolution to follow.
    let (head, rest) = gear.split_once("[resolution]").unwrap();
    let (_, rest) = rest.split_once("[site]").unwrap();
    let rig = format!("{head}[site]{rest}").replace("duration = \"660 s\"", "duration = \"0.5 s\"");
    std::fs::write(
        folder.0.join("scenarios/small-rig.toml"),
        rig.replace("rope_nodes = 500", "rope_nodes = 12"),
    )
    .unwrap();
    std::fs::create_dir_all(folder.0.join("studies")).unwrap();
    std::fs::write(folder.0.join("studies/small.toml"), STUDY).unwrap();
    let studies = &mut screen.app.shared.workbench.studies;
    (studies.folder, studies.queue.normal_priority) = (Some(folder.0.join("results")), true);
    screen.app.dock = Layout::Study.dock();
    screen.app.shared.perform(StudyAction::Open(folder.0.join("studies/small.toml")));
    screen.app.shared.perform(StudyAction::Run);
    let ended = |state: &State| matches!(state, State::Done | State::Failed(_));
    screen.wait(|app| {
        app.shared.workbench.studies.queue.jobs.last().is_none_or(|job| ended(&job.state()))
    });
    let state = screen.app.shared.workbench.studies.queue.jobs.last().map(StudyJob::state);
    assert_eq!(state, Some(State::Done), "{:?}", screen.app.shared.workbench.notice);
    screen.wait(|app| {
        !app.shared.workbench.studies.results.busy()
            && app.shared.workbench.studies.results.shown().is_some_and(|shown| shown.whole)
    });
}
