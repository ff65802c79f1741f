//! What a user does in a session, driven by commands alone: no window, no screen.
#![allow(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test fails by panicking, and reads files that it has written"
)]

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use endline_gear::Kind;
use endline_session::command::{
    Command, EditAction, ExportAction, RunAction, StudyAction, TimeAction, declared,
};
use endline_session::edit::Documents;
use endline_session::export::chart;
use endline_session::live::Status;
use endline_session::live::engine::live;
use endline_session::workbench::{NoticeKind, Workbench};
use endline_session::{PluginHost, Recording};

/// Folders of the library.
const KINDS: [&str; 12] = [
    "ropes",
    "traps",
    "buoys",
    "weak-links",
    "knots",
    "anchors",
    "sites",
    "friction",
    "whales",
    "acts",
    "assemblies",
    "scenarios",
];

/// A copy of the shipped library in a folder of the test's own, deleted in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let root =
            std::env::temp_dir().join(format!("endline-commands-{name}-{}", std::process::id()));
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library");
        for kind in KINDS {
            std::fs::create_dir_all(root.join(kind)).unwrap();
            for entry in std::fs::read_dir(shipped.join(kind)).unwrap() {
                let entry = entry.unwrap();
                std::fs::copy(entry.path(), root.join(kind).join(entry.file_name())).unwrap();
            }
        }
        Self(root)
    }

    fn workbench(&self) -> Workbench {
        let scenario = self.0.join("scenarios/reference-a-pendulum.toml");
        let documents = Documents::open(&self.0, &scenario).unwrap();
        Workbench::new(documents, Arc::new(PluginHost::empty()), live(), Arc::new(|| {}))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder left behind is not worth failing a test for.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Takes in what threads have ready until something is so.
fn wait(workbench: &mut Workbench, what: &str, so: impl Fn(&Workbench) -> bool) {
    let patience = Instant::now() + Duration::from_secs(120);
    while !so(workbench) {
        let stands = workbench.status();
        assert!(Instant::now() < patience, "{what}: {stands:?}, {:?}", workbench.notice());
        std::thread::sleep(Duration::from_millis(2));
        workbench.refresh();
    }
}

fn status(workbench: &mut Workbench, wanted: &Status) {
    wait(workbench, &format!("{wanted:?}"), |workbench| {
        !workbench.making() && workbench.status() == Some(wanted)
    });
}

fn set(field: &str, value: &str) -> Command {
    let path = Documents::SCENARIO.to_owned();
    Command::Edit(EditAction::Set { path, field: field.into(), value: value.into() })
}

#[test]
fn a_model_that_is_ready_withdraws_what_was_said_before_it_and_not_what_was_said_since() {
    let folder = Folder::new("notice");
    let mut workbench = folder.workbench();
    status(&mut workbench, &Status::Paused);
    let refused = Command::Study(StudyAction::OptionFromEdits);
    for (said_since, duration) in [(true, "1 s"), (false, "2 s")] {
        workbench.perform(set("duration", duration)).unwrap();
        let before = workbench.perform(refused.clone()).unwrap_err();
        assert_eq!(workbench.notice().map(|notice| &notice.text), Some(&before));
        workbench.perform(Command::Run(RunAction::Apply)).unwrap();
        let since = said_since.then(|| {
            workbench.perform(Command::Run(RunAction::OpenRecording("none".into()))).unwrap_err()
        });
        wait(&mut workbench, "the model", |workbench| !workbench.making());
        assert_eq!(workbench.notice().cloned().map(|notice| notice.text), since);
    }
}

#[test]
fn an_action_that_succeeds_withdraws_the_notice_of_one_that_failed() {
    let folder = Folder::new("notice-withdrawn");
    let mut workbench = folder.workbench();
    status(&mut workbench, &Status::Paused);
    workbench.perform(Command::Run(RunAction::OpenRecording("none".into()))).unwrap_err();
    assert!(workbench.notice().is_some());
    workbench.perform(Command::Edit(EditAction::LetGo)).unwrap();
    assert!(workbench.notice().is_some(), "the end of a drag is no action of its own");
    workbench.perform(set("duration", "3 s")).unwrap();
    assert_eq!(workbench.notice(), None);
}

#[test]
fn a_library_is_opened_edited_run_sought_recorded_and_the_edit_undone_by_commands() {
    let folder = Folder::new("whole");
    let mut workbench = folder.workbench();
    status(&mut workbench, &Status::Paused);

    // Edited gear counts once it is applied.
    assert!(workbench.perform(Command::Run(RunAction::Apply)).is_err(), "nothing has changed yet");
    workbench.perform(set("duration", "1 s")).unwrap();
    workbench.perform(set("rope_nodes", "21")).unwrap();
    assert!(workbench.stale());
    workbench.perform(Command::Run(RunAction::Apply)).unwrap();
    wait(&mut workbench, "the edited model", |workbench| {
        let nodes = workbench.view().map(|view| view.model.node_count);
        !workbench.making() && nodes == Some(21) && workbench.status() == Some(&Status::Paused)
    });
    assert!(!workbench.stale());

    workbench.perform(Command::Run(RunAction::Speed(f64::INFINITY))).unwrap();
    workbench.perform(Command::Run(RunAction::Start)).unwrap();
    status(&mut workbench, &Status::Finished);
    let end = workbench.view().cloned().unwrap();
    assert!((end.newest_s - 1.0).abs() < 1e-6, "{}", end.newest_s);

    workbench.perform(Command::Time(TimeAction::Seek(0.5))).unwrap();
    wait(&mut workbench, "the middle", |workbench| workbench.view().unwrap().sought);
    let shown_s = workbench.view().unwrap().frame.time_s;
    assert!((shown_s - 0.5).abs() < 0.05, "{shown_s}");
    workbench.perform(Command::Time(TimeAction::Newest)).unwrap();
    wait(&mut workbench, "the newest moment", |workbench| !workbench.view().unwrap().sought);

    let file = folder.0.join("run.endline");
    workbench.perform(Command::Export(ExportAction::Recording(file.clone()))).unwrap();
    wait(&mut workbench, "the recording", |_| file.exists());
    assert_eq!(Recording::load(&file).unwrap().inputs.len() as u64, end.frame.step);

    // The recording runs again to the same bits, in a model of its own.
    workbench.perform(Command::Run(RunAction::OpenRecording(file))).unwrap();
    wait(&mut workbench, "the same end", |workbench| {
        let view = workbench.view().unwrap();
        !Arc::ptr_eq(&view.model, &end.model)
            && view.frame.step == end.frame.step
            && view.status != Status::Running
    });
    assert_eq!(workbench.view().unwrap().state_hash, end.state_hash);

    let table = folder.0.join("ropes.csv");
    let export = ExportAction::Table { kind: Kind::Rope, rows: None, file: table.clone() };
    workbench.perform(export.into()).unwrap();
    let rows = std::fs::read_to_string(table).unwrap().lines().count();
    assert_eq!(rows, 1 + workbench.project().documents.files("ropes").count());
    let plots = folder.0.join("tension.csv");
    let export = ExportAction::Plots { kinds: vec![chart::Kind::Tension], file: plots.clone() };
    workbench.perform(export.into()).unwrap();
    assert!(std::fs::read_to_string(plots).unwrap().lines().count() > 20);

    workbench.perform(Command::Edit(EditAction::Undo)).unwrap();
    workbench.perform(Command::Edit(EditAction::Undo)).unwrap();
    let documents = &workbench.project().documents;
    assert_eq!(documents.field(Documents::SCENARIO, "duration").unwrap(), "10 s");
    assert!(documents.unsaved().is_empty());
    assert!(workbench.perform(Command::Edit(EditAction::Undo)).is_err());
}

#[test]
fn a_duplicate_of_any_kind_has_no_error_and_claims_no_measurement() {
    let folder = Folder::new("duplicate");
    let mut workbench = folder.workbench();
    for kind in Kind::ALL.iter().copied() {
        let path = workbench.project().documents.files(kind.folder()).next().unwrap().to_owned();
        workbench.perform(Command::Edit(EditAction::Duplicate(path.clone()))).unwrap();
    }
    let documents = &workbench.project().documents;
    assert_eq!(documents.unsaved().len(), Kind::ALL.len());
    assert_eq!(documents.problems(), []);
    for path in documents.unsaved() {
        let text = documents.text(path).unwrap();
        assert!(!text.contains("\"measured\""), "{path}: {text}");
        let has_figures = !path.starts_with("assemblies");
        assert_eq!(text.contains("copied from "), has_figures, "{path}: {text}");
    }
}

#[test]
fn a_command_that_does_nothing_gives_the_reason_it_is_declared_with() {
    let folder = Folder::new("reasons");
    let mut workbench = folder.workbench();
    status(&mut workbench, &Status::Paused);
    let mut refused = 0;
    for info in declared() {
        let (Err(reason), endline_session::command::Make::Plain(command)) =
            ((info.enabled)(&workbench), &info.make)
        else {
            continue;
        };
        assert_eq!(workbench.perform(command.clone()), Err(reason.clone()), "{}", info.about.id);
        let notice = workbench.notice().unwrap();
        assert_eq!((&notice.text, notice.kind), (&reason, NoticeKind::Hint), "{}", info.about.id);
        refused += 1;
    }
    assert!(refused > 10, "little can be done before a run: {refused}");
    let replay = StudyAction::Replay { option: 0, encounter: 0 };
    assert!(workbench.perform(Command::Study(replay)).is_err());
}
