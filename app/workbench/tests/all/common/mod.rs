//! The workbench on a fake engine or a real one, with a copy of the shipped library; for every test of the window.
#![allow(
    clippy::unwrap_used,
    dead_code,
    reason = "a test that cannot go on fails; no test uses all of this"
)]

use endline_session::command::RunAction;
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
use endline_workbench::gui::app::App;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::shared::Shared;
use endline_workbench::input::Pilot;

/// What a test's engine was told, in words.
pub type Told = Rc<RefCell<Vec<String>>>;

/// An engine that notes what it is told and does what a run would, at once.
struct FakeEngine {
    told: Told,
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
        self.told.borrow_mut().push(words);
        true
    }

    fn latest(&self) -> Arc<LiveView> {
        Arc::new(self.view.borrow().clone())
    }
}

/// A copy of the shipped library in a folder of the test's own, deleted in the end.
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
        self.book_with("reference-a-pendulum")
    }

    pub fn book_with(&self, scenario: &str) -> Documents {
        Documents::open(&self.0, &self.0.join("scenarios").join(scenario).with_extension("toml"))
            .unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder left behind is not worth failing a test for.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The workbench on a fake engine; waits until the first model is made.
pub fn workbench(folder: &Folder, pilot: Pilot) -> (Harness<'static, App>, Told) {
    let told = Told::default();
    let noted = Rc::clone(&told);
    let launch: Launch = Box::new(move |prepared, _host, _waker| {
        let told = Rc::clone(&noted);
        let view = RefCell::new(LiveView { status: Status::Paused, ..LiveView::before(&prepared) });
        let engine: Box<dyn Engine> = Box::new(FakeEngine { told, view });
        Ok(engine)
    });
    let harness = opened(folder.documents(), launch, pilot);
    (harness, told)
}

pub fn opened(documents: Documents, launch: Launch, pilot: Pilot) -> Harness<'static, App> {
    opened_with(documents, Arc::new(PluginHost::empty()), launch, pilot)
}

pub fn opened_with(
    documents: Documents,
    host: Arc<PluginHost>,
    launch: Launch,
    pilot: Pilot,
) -> Harness<'static, App> {
    let waker: Waker = Arc::new(|| {});
    let create = move |creation: &mut eframe::CreationContext<'_>| {
        App::new(creation, Shared::new(documents, host, launch, waker, pilot))
    };
    let mut harness = Harness::builder().with_size(egui::vec2(1500.0, 940.0)).build_eframe(create);
    wait(&mut harness, |app| app.shared.workbench.view().is_some());
    harness
}

/// One panel and no other.
pub fn only(harness: &mut Harness<'static, App>, panel: PanelId) {
    harness.state_mut().dock = egui_dock::DockState::new(vec![panel.id().to_owned()]);
    harness.run_steps(3);
}

/// Draws until something is so.
pub fn wait(harness: &mut Harness<'static, App>, so: impl Fn(&App) -> bool) {
    // A film is drawn by software beside the other tests.
    let patience = Instant::now() + Duration::from_secs(120);
    while !so(harness.state()) {
        let shared = &harness.state().shared;
        assert!(
            Instant::now() < patience,
            "waited in vain: {:?}, {:?}",
            shared.workbench.status(),
            shared.workbench.notice
        );
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
    harness.run_steps(2);
}

/// Types into the first field that shows `old`, and commits.
pub fn retype(harness: &mut Harness<'static, App>, old: &str, new: &str) {
    harness.get_all_by_value(old).next().unwrap().click();
    harness.run_steps(2);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    harness.run_steps(1);
    harness.event(egui::Event::Text(new.to_owned()));
    harness.run_steps(1);
    harness.key_press(egui::Key::Enter);
    harness.run_steps(3);
}

/// The value of a field of a file on disk.
pub fn on_disk(folder: &Folder, path: &str) -> String {
    std::fs::read_to_string(folder.0.join(path)).unwrap()
}

/// The first-party plugins, linked.
pub fn linked() -> Arc<PluginHost> {
    let mut host = PluginHost::empty();
    for hook in endline_workbench::inside::first_party() {
        host.add(hook).unwrap();
    }
    Arc::new(host)
}

/// A short encounter run to its end, with every panel that reads it.
pub fn flown(folder: &Folder) -> Harness<'static, App> {
    let mut documents = folder.book_with("hello-endline");
    for (field, value) in [("duration", "2 s"), ("rope_nodes", "120"), ("whale.position.1", "-7 m")]
    {
        documents.set("scenario", field, value).unwrap();
    }
    let mut harness = opened_with(documents, linked(), live(), Pilot::default());
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness.state_mut().shared.workbench.recordings = Some(folder.0.join("recordings"));
    harness.state_mut().shared.perform(RunAction::Speed(f64::INFINITY));
    harness.state_mut().shared.perform(RunAction::Start);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Finished));
    harness
}

/// Gives a command as a menu does, and draws until it is performed.
pub fn give(harness: &mut Harness<'static, App>, command: impl Into<WindowCommand>) {
    harness.state_mut().shared.give(command);
    harness.run_steps(1);
}

/// Drags with the mouse.
pub fn drag(harness: &mut Harness<'static, App>, from: egui::Pos2, to: egui::Pos2) {
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
