//! The workbench clicked through as a user does, without a display: edits, errors, save, run, panels.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use endline_session::PluginHost;
use endline_session::live::{Command, LiveView, Status};
use endline_session::plugins::Hook;
use endline_workbench::gui::app::App;
use endline_workbench::gui::book::Book;
use endline_workbench::gui::desk::{Desk, Order};
use endline_workbench::gui::engine::{self, Engine, Launch, Waker};
use endline_workbench::gui::layout::{self, Panel};
use endline_workbench::input::{PadAxis, PadButton, PadEvent, Pilot, ScriptedPad};

/// What a test's engine was told, in words.
type Told = Rc<RefCell<Vec<String>>>;

/// An engine that notes what it is told and does what a run would, at once.
struct FakeEngine {
    told: Told,
    view: RefCell<LiveView>,
}

impl Engine for FakeEngine {
    fn send(&self, command: Command) -> bool {
        let mut view = self.view.borrow_mut();
        let words = match command {
            Command::Start => {
                view.status = Status::Running;
                "start".to_owned()
            }
            Command::Pause => {
                view.status = Status::Paused;
                "pause".to_owned()
            }
            Command::Step => "step".to_owned(),
            Command::Reset => "reset".to_owned(),
            Command::Speed(speed) => format!("speed {speed}"),
            Command::Controls(controls) => {
                format!("controls {:.2} {:.2} {:.2} {:.2}", controls.speed, controls.pitch, controls.roll, controls.yaw)
            }
            Command::Autopilot => "autopilot".to_owned(),
            Command::WeakLinks(on) => format!("weak links {on}"),
            Command::Load(prepared) => {
                view.model = Arc::clone(&prepared.model);
                "load".to_owned()
            }
            Command::Seek(time_s) => format!("seek {time_s}"),
            Command::SaveRecording(path) => format!("save {}", path.display()),
        };
        self.told.borrow_mut().push(words);
        true
    }

    fn latest(&self) -> Arc<LiveView> {
        Arc::new(self.view.borrow().clone())
    }
}

/// A copy of the shipped library in a folder of the test's own, deleted in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let root = std::env::temp_dir().join(format!("endline-workbench-{name}-{}", std::process::id()));
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gear-library");
        for kind in ["ropes", "traps", "buoys", "weak-links", "anchors", "sites", "friction", "whales", "assemblies", "scenarios"] {
            std::fs::create_dir_all(root.join(kind)).unwrap();
            for entry in std::fs::read_dir(shipped.join(kind)).unwrap() {
                let entry = entry.unwrap();
                std::fs::copy(entry.path(), root.join(kind).join(entry.file_name())).unwrap();
            }
        }
        Self(root)
    }

    fn book(&self) -> Book {
        self.book_with("reference-a-pendulum")
    }

    fn book_with(&self, scenario: &str) -> Book {
        Book::open(&self.0, &self.0.join("scenarios").join(scenario).with_extension("toml")).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder left behind is not worth failing a test for.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The workbench on a fake engine; waits until the first model is made.
fn workbench(folder: &Folder, pilot: Pilot) -> (Harness<'static, App>, Told) {
    let told = Told::default();
    let noted = Rc::clone(&told);
    let launch: Launch = Box::new(move |prepared, _waker| {
        let told = Rc::clone(&noted);
        let view = RefCell::new(LiveView { status: Status::Paused, ..LiveView::before(&prepared) });
        let engine: Box<dyn Engine> = Box::new(FakeEngine { told, view });
        Ok(engine)
    });
    let harness = opened(folder.book(), launch, pilot);
    (harness, told)
}

fn opened(book: Book, launch: Launch, pilot: Pilot) -> Harness<'static, App> {
    opened_with(book, Arc::new(PluginHost::empty()), launch, pilot)
}

fn opened_with(book: Book, host: Arc<PluginHost>, launch: Launch, pilot: Pilot) -> Harness<'static, App> {
    let waker: Waker = Arc::new(|| {});
    let create = move |creation: &mut eframe::CreationContext<'_>| App::new(creation, Desk::new(book, host, launch, waker, pilot));
    let mut harness = Harness::builder().with_size(egui::vec2(1500.0, 940.0)).build_eframe(create);
    wait(&mut harness, |app| app.desk.view.is_some());
    harness
}

/// Draws until something is so.
fn wait(harness: &mut Harness<'static, App>, so: impl Fn(&App) -> bool) {
    let patience = Instant::now() + Duration::from_secs(30);
    while !so(harness.state()) {
        let desk = &harness.state().desk;
        assert!(Instant::now() < patience, "waited in vain: {:?}, {:?}", desk.status(), desk.notice);
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
    harness.run_steps(2);
}

/// Types into the first field that shows `old`, and commits.
fn retype(harness: &mut Harness<'static, App>, old: &str, new: &str) {
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
fn on_disk(folder: &Folder, path: &str) -> String {
    std::fs::read_to_string(folder.0.join(path)).unwrap()
}

#[test]
fn a_bad_unit_is_red_with_its_place_and_reason_and_undo_mends_it() {
    let folder = Folder::new("bad-unit");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    retype(&mut harness, "2,700 lbf", "2,700 furlong");
    let problems = harness.state().desk.book.problems().to_vec();
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert!(problems[0].file.starts_with("ropes/") && problems[0].line > 0 && problems[0].field.starts_with("strength"), "{problems:?}");
    let place = format!("{}:{}:{}", problems[0].file, problems[0].line, problems[0].column);
    assert!(harness.query_all_by_label_contains("furlong").next().is_some(), "the reason is on screen");
    assert!(harness.query_all_by_label(&place).next().is_some(), "its place is on screen: {place}");
    harness.get_by_label("Undo").click();
    harness.run_steps(3);
    assert!(harness.state().desk.book.problems().is_empty());
    assert_eq!(harness.state().desk.book.unsaved().len(), 0);
}

#[test]
fn an_edit_is_saved_with_comments_and_everything_else_as_it_was() {
    let folder = Folder::new("save");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    let before = on_disk(&folder, "ropes/nylon-1-2.toml");
    retype(&mut harness, "5,750 lbf", "25 kN");
    assert_eq!(on_disk(&folder, "ropes/nylon-1-2.toml"), before, "nothing is written before Save");
    harness.get_by_label("Save").click();
    harness.run_steps(3);
    assert_eq!(on_disk(&folder, "ropes/nylon-1-2.toml"), before.replace("5,750 lbf", "25 kN"));
    assert_eq!(harness.state().desk.notice, Some(("saved 1 file".to_owned(), false)));
}

#[test]
fn run_pause_step_reset_and_speed_reach_the_engine() {
    let folder = Folder::new("run");
    let (mut harness, told) = workbench(&folder, Pilot::default());
    for label in ["▶ Run", "⏸ Pause", "Step", "⏮ Reset", "5×"] {
        harness.get_by_label(label).click();
        harness.run_steps(3);
    }
    assert_eq!(*told.borrow(), ["start", "pause", "step", "reset", "speed 5"]);
}

#[test]
fn running_after_an_edit_first_takes_the_edited_gear_over() {
    let folder = Folder::new("stale");
    let (mut harness, told) = workbench(&folder, Pilot::default());
    harness.state_mut().desk.set(Book::SCENARIO, "duration", "7 s");
    harness.run_steps(2);
    assert!(harness.state().desk.stale());
    harness.get_by_label("▶ Run").click();
    harness.run_steps(2);
    wait(&mut harness, |app| !app.desk.stale());
    assert_eq!(*told.borrow(), ["load", "start"]);
    let duration_s = harness.state().desk.view.as_ref().unwrap().model.spec.settings.duration_s;
    assert!((duration_s - 7.0).abs() < 1e-12);
}

#[test]
fn every_panel_opens_from_the_window_menu_and_the_layout_resets() {
    let folder = Folder::new("panels");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    for panel in Panel::ALL {
        harness.state_mut().dock = egui_dock::DockState::new(vec![Panel::Run.id().to_owned()]);
        harness.run_steps(2);
        harness.get_by_label("Window").click();
        harness.run_steps(3);
        harness.get_all_by_label_contains(panel.title()).last().unwrap().click();
        harness.run_steps(3);
        assert!(layout::is_open(&harness.state().dock, panel), "{panel:?}");
    }
    harness.state_mut().desk.orders.push(Order::Arrange(layout::Layout::Design));
    harness.run_steps(2);
    assert!(layout::is_open(&harness.state().dock, Panel::Library) && layout::is_open(&harness.state().dock, Panel::View));
}

#[test]
fn the_unit_switch_changes_what_the_plot_is_labelled_in() {
    let folder = Folder::new("units");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.get_all_by_label("N").next().unwrap().click();
    harness.run_steps(3);
    assert_eq!(harness.state().desk.preferences.force.symbol(), "N");
}

#[test]
fn the_pad_steers_only_while_flying() {
    let folder = Folder::new("pad");
    let script = vec![vec![
        PadEvent::Connected("test pad".into()),
        PadEvent::Moved(PadAxis::LeftTrigger, 1.0),
        PadEvent::Moved(PadAxis::RightX, 1.0),
    ]];
    let pilot = Pilot::new(Some(Box::new(ScriptedPad { script: script.into() })));
    let (mut harness, told) = workbench(&folder, pilot);
    harness.run_steps(3);
    assert!(told.borrow().is_empty(), "hands off: {:?}", told.borrow());
    harness.get_by_label("Fly the whale").click();
    harness.run_steps(3);
    assert!(told.borrow().last().unwrap().starts_with("controls 1.00 0.00 0.00 -1.00"), "{:?}", told.borrow());
    harness.key_press(egui::Key::Escape);
    harness.run_steps(3);
    assert_eq!(told.borrow().last().unwrap(), "autopilot");
}

#[test]
fn start_on_the_pad_restarts_the_run_while_flying() {
    let folder = Folder::new("pad-start");
    let pilot = Pilot::new(Some(Box::new(LateStart(0))));
    let (mut harness, told) = workbench(&folder, pilot);
    harness.state_mut().desk.obey(&Order::Fly);
    harness.run_steps(30);
    let told = told.borrow();
    let reset = told.iter().position(|words| words == "reset").expect("reset");
    assert_eq!(told[reset + 1], "start");
}

/// A pad whose Start is pressed a while after the workbench has opened.
struct LateStart(u32);

impl endline_workbench::input::PadSource for LateStart {
    fn poll(&mut self, out: &mut Vec<PadEvent>) {
        self.0 += 1;
        if self.0.is_multiple_of(10) {
            out.push(PadEvent::Pressed(PadButton::Start));
        }
    }
}

#[test]
fn a_real_run_swings_the_pendulum_on_a_thread_of_its_own() {
    let folder = Folder::new("real");
    let host = Arc::new(PluginHost::empty());
    let mut harness = opened(folder.book(), engine::live(host), Pilot::default());
    wait(&mut harness, |app| app.desk.status() == Some(&Status::Paused));
    harness.state_mut().desk.obey(&Order::Speed(f64::INFINITY));
    harness.get_by_label("▶ Run").click();
    harness.run_steps(2);
    wait(&mut harness, |app| app.desk.view.as_ref().is_some_and(|view| view.frame.time_s > 0.2));
    let view = harness.state().desk.view.clone().unwrap();
    assert!(view.audit.solver_steps > 0 && view.audit.non_finite == 0);
    assert_eq!(view.state_hash.len(), 16, "{}", view.state_hash);
}

/// The first-party plugins, linked.
fn linked() -> Arc<PluginHost> {
    let mut host = PluginHost::empty();
    let motion = Hook::Motion(Arc::new(endline_whale_motions::Swim::default()));
    let friction = Hook::Friction(Arc::new(endline_friction_models::Coulomb::default()));
    for hook in [motion, friction].into_iter().chain(endline_gear_types::all().into_iter().map(Hook::Gear)) {
        host.add(hook).unwrap();
    }
    Arc::new(host)
}

#[test]
fn editing_the_endline_in_its_table_and_applying_changes_the_answer() {
    let folder = Folder::new("answer");
    let host = linked();
    let mut harness = opened_with(folder.book_with("hello-endline"), Arc::clone(&host), engine::live(host), Pilot::default());
    let settled_n = |harness: &Harness<'static, App>| {
        let view = harness.state().desk.view.clone().unwrap();
        view.frame.tension_n.iter().copied().fold(0.0, f64::max)
    };
    wait(&mut harness, |app| app.desk.status() == Some(&Status::Paused));
    let (before_n, earlier) = (settled_n(&harness), harness.state().desk.view.clone().unwrap());
    let rope = "ropes/sink-3-8.toml";
    assert!(harness.state().desk.book.in_use(rope), "the single's endline is made of it");
    let diameter = harness.state().desk.book.field(rope, "diameter").unwrap();
    harness.state_mut().desk.set(rope, "diameter", "7/16 in");
    harness.run_steps(2);
    harness.get_all_by_label("Apply").next().unwrap().click();
    harness.run_steps(2);
    wait(&mut harness, |app| {
        app.desk.view.as_ref().is_some_and(|view| !Arc::ptr_eq(&view.model, &earlier.model) && view.status == Status::Paused)
    });
    let after_n = settled_n(&harness);
    assert!(before_n > 1.0 && (after_n / before_n - 1.0).abs() > 0.02, "{diameter}: {before_n} N; 7/16 in: {after_n} N");
}

#[test]
fn a_duplicated_rope_is_a_file_of_its_own_once_saved() {
    let folder = Folder::new("duplicate");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.get_by_label("Nylon 1/2 in, 3-strand").click();
    harness.run_steps(2);
    harness.get_by_label("Duplicate").click();
    harness.run_steps(2);
    assert!(harness.query_all_by_label_contains("Nylon 1/2 in, 3-strand (copy)").next().is_some());
    assert!(!folder.0.join("ropes/nylon-1-2-2.toml").exists());
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::S);
    harness.run_steps(3);
    let (original, copy) = (on_disk(&folder, "ropes/nylon-1-2.toml"), on_disk(&folder, "ropes/nylon-1-2-2.toml"));
    assert_eq!(copy, original.replacen("Nylon 1/2 in, 3-strand", "Nylon 1/2 in, 3-strand (copy)", 1));
}

#[test]
fn a_model_that_cannot_be_made_says_why_in_problems() {
    let folder = Folder::new("unmade");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.state_mut().desk.obey(&Order::Open(folder.0.join("scenarios/hello-endline.toml")));
    wait(&mut harness, |app| !app.desk.making());
    let problems: Vec<String> = harness.state().desk.problems().map(|problem| problem.message.clone()).collect();
    assert!(problems.iter().any(|message| message.contains("org.endline.")), "no plugin is there, and that is told: {problems:?}");
}

#[test]
fn the_command_palette_gives_an_order_by_its_name() {
    let folder = Folder::new("palette");
    let (mut harness, told) = workbench(&folder, Pilot::default());
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::P);
    harness.run_steps(3);
    harness.event(egui::Event::Text("speed 0.25".to_owned()));
    harness.run_steps(2);
    harness.key_press(egui::Key::Enter);
    harness.run_steps(3);
    assert_eq!(*told.borrow(), ["speed 0.25"]);
}
