//! The workbench on a fake or a real engine, with a copy of the shipped library, for all tests of the window.
#![allow(
    clippy::unwrap_used,
    dead_code,
    reason = "a test that cannot continue fails; no test uses all of this"
)]

use endline_gear::Document;
use endline_session::command::{Command, EditAction, RunAction};
use endline_workbench::gui::command::action::WindowCommand;
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use endline_session::PluginHost;
use endline_session::edit::Documents;
use endline_session::live::engine::{Engine, Launch, live};
use endline_session::live::{LiveView, RunCommand, Status};
use endline_session::task::Waker;
use endline_session::workbench::{Folders, Notice, Workbench};
use endline_workbench::gui::app::App;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::shared::Shared;
use endline_workbench::input::Pilot;

/// The window of a test.
pub type Window = Harness<'static, App>;

/// Short paths to what tests of the window read and do.
pub trait Reach {
    /// The workbench.
    fn workbench(&self) -> &Workbench;
    /// The workbench, as the program around it has it.
    fn workbench_mut(&mut self) -> &mut Workbench;
    /// The open files.
    fn documents(&self) -> &Documents {
        &self.workbench().project().documents
    }
    /// Changes an open file.
    fn alter(&mut self, path: &str, change: impl FnOnce(&mut Document) -> Result<(), String>) {
        let text = self.documents().altered(path, change).unwrap();
        self.perform(EditAction::Replace { path: path.to_owned(), text });
    }
    /// The run shown.
    fn view(&self) -> Arc<LiveView> {
        Arc::clone(self.workbench().view().unwrap())
    }
    /// The last notice.
    fn notice(&self) -> Notice {
        self.workbench().notice().cloned().unwrap()
    }
    /// Performs a command without drawing.
    fn perform(&mut self, command: impl Into<Command>);
    /// Sets a field of a file.
    fn set(&mut self, path: &str, field: &str, value: &str) {
        let [path, field, value] = [path, field, value].map(str::to_owned);
        self.perform(EditAction::Set { path, field, value });
    }
}

impl Reach for Window {
    fn workbench(&self) -> &Workbench {
        &self.state().shared.workbench
    }

    fn workbench_mut(&mut self) -> &mut Workbench {
        &mut self.state_mut().shared.workbench
    }

    fn perform(&mut self, command: impl Into<Command>) {
        self.state_mut().shared.perform(command);
    }
}

/// Commands that a test's engine has received, in words.
pub type Received = Rc<RefCell<Vec<String>>>;

/// An engine that records commands and changes its view immediately.
struct FakeEngine {
    received: Received,
    view: RefCell<LiveView>,
}

impl Engine for FakeEngine {
    fn send(&self, command: RunCommand) -> bool {
        let mut view = self.view.borrow_mut();
        let words = match command {
            RunCommand::Start => {
                view.status = Status::Running;
                "start".to_owned()
            }
            RunCommand::Pause => {
                view.status = Status::Paused;
                "pause".to_owned()
            }
            RunCommand::Step => "step".to_owned(),
            RunCommand::Reset => "reset".to_owned(),
            RunCommand::Speed(speed) => format!("speed {speed}"),
            RunCommand::Controls(controls) => {
                format!(
                    "controls {:.2} {:.2} {:.2} {:.2}",
                    controls.speed, controls.pitch, controls.roll, controls.yaw
                )
            }
            RunCommand::Autopilot => "autopilot".to_owned(),
            RunCommand::Load(prepared) => {
                view.model = Arc::clone(&prepared.model);
                "load".to_owned()
            }
            RunCommand::Seek(time_s) => format!("seek {time_s}"),
            RunCommand::Shift(by) => format!("shift {by}"),
            RunCommand::Inputs(inputs) => format!("inputs {}", inputs.len()),
            RunCommand::Branch => "branch".to_owned(),
            RunCommand::Rerun(prepared) => {
                view.model = Arc::clone(&prepared.model);
                "rerun".to_owned()
            }
            RunCommand::Program(thin) => format!("program {thin}"),
            RunCommand::SaveRecording(path) => format!("save {}", path.display()),
            RunCommand::KeptFrames(to) => {
                to.send(vec![Arc::clone(&view.frame)]).unwrap();
                "kept frames".to_owned()
            }
        };
        self.received.borrow_mut().push(words);
        true
    }

    fn latest(&self) -> Arc<LiveView> {
        Arc::new(self.view.borrow().clone())
    }
}

/// A copy of the shipped library in a temporary folder, deleted at the end of the test.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(name: &str) -> Self {
        let root =
            std::env::temp_dir().join(format!("endline-workbench-{name}-{}", std::process::id()));
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library");
        for kind in [
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
            "rules",
        ] {
            std::fs::create_dir_all(root.join(kind)).unwrap();
            for entry in std::fs::read_dir(shipped.join(kind)).unwrap() {
                let entry = entry.unwrap();
                std::fs::copy(entry.path(), root.join(kind).join(entry.file_name())).unwrap();
            }
        }
        Self(root)
    }

    pub fn documents(&self) -> Documents {
        self.documents_of("reference-a-pendulum")
    }

    pub fn documents_of(&self, scenario: &str) -> Documents {
        Documents::open(&self.0, &self.0.join("scenarios").join(scenario).with_extension("toml"))
            .unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that cannot be deleted is no reason to fail a test.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The workbench on a fake engine, after the first model is assembled.
pub fn workbench(folder: &Folder, pilot: Pilot) -> (Window, Received) {
    let received = Received::default();
    let noted = Rc::clone(&received);
    let launch: Launch = Box::new(move |prepared, _host, _waker| {
        let received = Rc::clone(&noted);
        let view = RefCell::new(LiveView { status: Status::Paused, ..LiveView::before(&prepared) });
        let engine: Box<dyn Engine> = Box::new(FakeEngine { received, view });
        Ok(engine)
    });
    let harness = opened(folder.documents(), launch, pilot);
    (harness, received)
}

pub fn opened(documents: Documents, launch: Launch, pilot: Pilot) -> Window {
    opened_with(documents, Arc::new(PluginHost::empty()), launch, pilot)
}

pub fn opened_with(
    documents: Documents,
    host: Arc<PluginHost>,
    launch: Launch,
    pilot: Pilot,
) -> Window {
    let waker: Waker = Arc::new(|| {});
    let create = move |creation: &mut eframe::CreationContext<'_>| {
        App::new(creation, Shared::new(documents, host, launch, waker, pilot))
    };
    let mut harness = Harness::builder().with_size(egui::vec2(1500.0, 940.0)).build_eframe(create);
    wait(&mut harness, |app| app.shared.workbench.view().is_some());
    harness
}

/// The workbench with a scenario, on a real engine with the first-party plugins.
pub fn real(folder: &Folder, scenario: &str) -> Window {
    opened_with(folder.documents_of(scenario), linked(), live(), Pilot::default())
}

/// Shows one panel and no other.
pub fn only(harness: &mut Window, panel: PanelId) {
    harness.state_mut().dock = egui_dock::DockState::new(vec![panel.id().to_owned()]);
    harness.run_steps(3);
}

/// Draws until a condition holds.
pub fn wait(harness: &mut Window, holds: impl Fn(&App) -> bool) {
    // A film is drawn by software beside the other tests.
    let patience = Instant::now() + Duration::from_secs(120);
    while !holds(harness.state()) {
        let workbench = harness.workbench();
        let study =
            || workbench.studies().queue.jobs.last().map(|job| (job.state(), job.progress()));
        let search = || workbench.searches().job.as_ref().map(|job| (job.state(), job.progress()));
        assert!(
            Instant::now() < patience,
            "timeout: run {:?}, notice {:?}, study {:?}, search {:?}, rules {:?}",
            workbench.status(),
            workbench.notice(),
            study(),
            search(),
            workbench.rules().why
        );
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
    harness.run_steps(3);
}

/// Replaces the value of the first field that shows `old`, and commits it.
pub fn retype(harness: &mut Window, old: &str, new: &str) {
    harness.get_all_by_value(old).next().unwrap().click();
    harness.run_steps(2);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    harness.run_steps(1);
    harness.event(egui::Event::Text(new.to_owned()));
    harness.run_steps(1);
    harness.key_press(egui::Key::Enter);
    harness.run_steps(3);
}

/// Content of a file on disk.
pub fn on_disk(folder: &Folder, path: &str) -> String {
    std::fs::read_to_string(folder.0.join(path)).unwrap()
}

/// The first-party plugins, linked.
pub fn linked() -> Arc<PluginHost> {
    let mut host = PluginHost::empty();
    for hook in endline_workbench::embedded::first_party() {
        host.add(hook).unwrap();
    }
    Arc::new(host)
}

/// The workbench after a short encounter that ran to its end.
pub fn flown(folder: &Folder) -> Window {
    flown_from(folder, "-7 m")
}

/// As [`flown`], with the whale this far north of the gear at the start.
pub fn flown_from(folder: &Folder, north: &str) -> Window {
    let mut documents = folder.documents_of("hello-endline");
    for (field, value) in [("duration", "2 s"), ("rope_nodes", "120"), ("whale.position.1", north)]
    {
        documents.set("scenario", field, value).unwrap();
    }
    let mut harness = opened_with(documents, linked(), live(), Pilot::default());
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness
        .workbench_mut()
        .write_to(Folders { recordings: Some(folder.0.join("recordings")), ..Folders::default() });
    harness.perform(RunAction::Speed(f64::INFINITY));
    harness.perform(RunAction::Start);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Finished));
    harness
}

/// Gives a command as a menu does, and draws three frames.
pub fn give(harness: &mut Window, command: impl Into<WindowCommand>) {
    harness.state_mut().shared.give(command);
    harness.run_steps(3);
}

/// Drags with the mouse.
pub fn drag(harness: &mut Window, from: egui::Pos2, to: egui::Pos2) {
    let button = |pos, pressed| {
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        egui::Event::PointerButton { pos, button, pressed, modifiers }
    };
    harness.event(egui::Event::PointerMoved(from));
    harness.run_steps(1);
    harness.event(button(from, true));
    harness.run_steps(1);
    for share in [0.3, 0.7, 1.0] {
        harness.event(egui::Event::PointerMoved(from + (to - from) * share));
        harness.run_steps(1);
    }
    harness.event(button(to, false));
    harness.run_steps(2);
}

/// A study of short encounters of a small rig without a whale: tests of the window need no more physics.
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

/// Adds the small study and its scenario to the library.
pub fn add_study(folder: &Folder) {
    let scenario = on_disk(folder, "scenarios/study-endline-held.toml");
    let (gear, _) = scenario.split_once("[whale]").unwrap();
    // The resolution follows the whale, so it goes with it.
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
