//! CPU time of the window's thread for each frame, without the rasteriser.
//!
//! `cargo bench -p endline --bench frames` prints a table: fastest time, median and 95th percentile in milliseconds, and the limit;
//! `-- typing` and similar arguments measure one part. CPU time of the drawing thread depends on other work on the machine only by caches
//! and clock rate. The median is the result; the 95th percentile shows how busy the machine was.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::disallowed_methods,
    reason = "a measurement that cannot continue stops, and prints its results"
)]

#[path = "../../tests/all/common/mod.rs"]
mod common;
mod screen;

use endline_session::command::{EditAction, RunAction, StudyAction, TimeAction};
use endline_session::workbench::Folders;
use std::time::Instant;

use endline_session::campaign::State;
use endline_session::live::Status;
use endline_session::scene::Scene;
use endline_session::study::queue::StudyJob;

use common::{Folder, add_study, on_disk};
use egui::{Event, Key, Modifiers, PointerButton, pos2};
use endline_workbench::gui::layout::Layout;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::scene::{Drawer, offscreen::Offscreen};
use screen::{Screen, thread_cpu_s};

/// A measurement in a copy of the library.
type Measure = fn(&Folder);

/// Measurements by name.
const PARTS: [(&str, Measure); 4] =
    [("start", starting), ("typing", typing), ("playing", playing), ("scrubbing", scrubbing)];

/// Argument with which this program measures one start in a separate process.
const ONE_START: &str = "one-start";

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let has = |word: &str| arguments.iter().any(|argument| argument == word);
    // `cargo test --benches` only checks that it builds.
    if has("--test") {
        return;
    }
    if has(ONE_START) {
        return one_start();
    }
    println!(
        "{:<62} {:>8} {:>8} {:>8}      limit",
        "CPU time of the window's own thread", "fastest", "median", "95 %"
    );
    let every = PARTS.iter().all(|(name, _)| !has(name));
    for (name, measure) in PARTS.into_iter().filter(|(name, _)| every || has(name)) {
        measure(&Folder::new(&format!("frames-{name}")));
    }
}

/// Prints a measurement: name, fastest time, median, 95th percentile and limit.
fn report(name: &str, mut times_s: Vec<f64>, limit: &str) {
    times_s.sort_by(f64::total_cmp);
    let at = |share: f64| 1e3 * times_s[((times_s.len() - 1) as f64 * share) as usize];
    println!("{name:<62} {:>8.2} {:>8.2} {:>8.2} ms   {limit}", at(0.0), at(0.5), at(0.95));
}

/// Time from the start of the process to its first frame with panels, without the start of OpenGL.
fn starting(_: &Folder) {
    let program = std::env::current_exe().unwrap();
    let times = (0..9).map(|_| {
        let output = std::process::Command::new(&program).arg(ONE_START).output().unwrap().stdout;
        String::from_utf8(output).unwrap().trim().parse::<f64>().unwrap()
    });
    report("from the start of the process to its first frame", times.collect(), "1000 ms");
}

/// Prints the time of one start [s]: loader of the system, library, plugins, fonts, all panels of the layout.
fn one_start() {
    let loaded_s = thread_cpu_s();
    // The time for the copy of the library is subtracted.
    let folder = Folder::new("frames-one-start");
    let copied_s = thread_cpu_s();
    let mut screen = Screen::new(folder.documents_of("hello-endline"));
    screen.frame(Vec::new());
    println!("{}", thread_cpu_s() - copied_s + loaded_s);
}

/// Typing in a table of 1,000 ropes, in a cell and in the search, and the commit of an edit.
fn typing(folder: &Folder) {
    let shipped = std::fs::read_to_string(folder.0.join("ropes/sink-3-8.toml")).unwrap();
    for index in 0..1000 {
        let text = shipped.replacen("name = \"", &format!("name = \"{index:04} "), 1);
        std::fs::write(folder.0.join(format!("ropes/many-{index:04}.toml")), text).unwrap();
    }
    let mut screen = Screen::new(folder.documents());
    screen.wait(|app| app.shared.workbench.view().is_some());
    screen.app.dock = Layout::Design.dock();
    screen.settle(5);
    screen.open_alone(PanelId::Library);
    screen.settle(5);
    let letter = |index: usize| {
        vec![Event::Text(if index.is_multiple_of(2) { "1" } else { "2" }.to_owned())]
    };
    click(&mut screen, pos2(420.0, 300.0));
    report(
        "a letter typed in a cell of a table of 1,000 ropes",
        (0..60).map(|index| screen.frame(letter(index))).collect(),
        "16 ms",
    );
    screen.frame(vec![key(Key::Escape)]);
    let mut committed = Vec::new();
    for _ in 0..5 {
        click(&mut screen, pos2(420.0, 300.0));
        screen.frame(letter(0));
        let version = screen.app.shared.workbench.project().documents.version();
        committed.push(screen.frame(vec![key(Key::Enter)]));
        assert!(
            screen.app.shared.workbench.project().documents.version() > version,
            "the edit is made"
        );
        screen.app.shared.perform(EditAction::Undo);
        screen.settle(3);
    }
    report("  the edit committed: all files read and compared again", committed, "");
    let mut found = Vec::new();
    for _ in 0..10 {
        screen.app.panels.library.search.clear();
        screen.frame(Vec::new());
        for _ in 0..4 {
            screen.app.panels.library.search.push('0');
            found.push(screen.frame(Vec::new()));
        }
    }
    report("  a letter typed in its search", found, "16 ms");
}

fn key(key: Key) -> Event {
    Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE }
}

/// Clicks into a field.
fn click(screen: &mut Screen, at: egui::Pos2) {
    let button = |pressed| Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    screen.frame(vec![Event::PointerMoved(at)]);
    screen.frame(vec![button(true)]);
    screen.frame(vec![button(false)]);
    assert!(screen.context.egui_wants_keyboard_input(), "no text field has the focus");
}

/// A run of 500 nodes while it is computed and while it is played back, with every panel open and filled.
fn playing(folder: &Folder) {
    let mut documents = folder.documents_of("hello-endline");
    for (field, value) in [("rope_nodes", "500"), ("whale.position.1", "-7 m")] {
        documents.set("scenario", field, value).unwrap();
    }
    let mut screen = Screen::new(documents);
    screen
        .app
        .shared
        .workbench
        .write_to(Folders { recordings: Some(folder.0.join("recordings")), ..Folders::default() });
    run_study(&mut screen, folder);
    screen.wait(|app| app.shared.workbench.status() == Some(&Status::Paused));
    screen.app.panels.library.chosen = Some("ropes/sink-3-8.toml".to_owned());
    screen.open_all();
    screen.wait(|app| app.panels.assembly.settled());
    screen.app.shared.perform(RunAction::Speed(f64::INFINITY));
    screen.app.shared.perform(RunAction::Start);
    screen.wait(|app| {
        app.shared
            .workbench
            .view()
            .is_some_and(|view| view.newest_s > 1.5 && !view.frame.contacts.is_empty())
    });
    screen.app.shared.perform(RunAction::Speed(1.0));
    screen.settle(5);
    let nodes = screen.app.shared.workbench.view().unwrap().model.node_count;
    let panels = PanelId::ALL.len();
    report(
        &format!("a frame, {nodes} nodes computed, all {panels} panels open"),
        screen.moments(60),
        "4 ms",
    );
    screen.app.shared.perform(RunAction::Pause);
    screen.wait(|app| app.shared.workbench.status() == Some(&Status::Paused));
    report(
        &format!("a frame, {nodes} nodes played back, all {panels} panels open"),
        played(&mut screen, 100),
        "4 ms",
    );
    uploaded(&screen);
    for panel in PanelId::ALL.iter().copied() {
        screen.open_alone(panel);
        screen.settle(3);
        report(&format!("  {} alone", panel.title()), played(&mut screen, 20), "");
    }
}

/// Times of a number of frames of playback, each of a different moment [s].
fn played(screen: &mut Screen, count: usize) -> Vec<f64> {
    let newest_s = screen.app.shared.workbench.view().unwrap().newest_s;
    let times = (1..=count).map(|index| {
        screen.app.shared.perform(TimeAction::Seek((index as f64 / 30.0) % newest_s));
        screen.sleep_until_woken();
        screen.frame(Vec::new())
    });
    times.collect()
}

/// Transfer of the triangles of the scene to OpenGL, if it works without a display.
fn uploaded(screen: &Screen) {
    let Ok(offscreen) = Offscreen::new([64, 64]) else {
        return println!("no OpenGL here: the transfer of a scene is not measured");
    };
    let mut drawer = Drawer::new(offscreen.gl.clone()).unwrap();
    let (shared, mut made, mut handed) = (&screen.app.shared, Vec::new(), Vec::new());
    for _ in 0..40 {
        let (view, start) = (shared.workbench.view().unwrap(), thread_cpu_s());
        let scene = Scene::of(&view.model, &view.frame, &screen.app.panels.view.show);
        made.push(thread_cpu_s() - start);
        let start = thread_cpu_s();
        drawer.load(&scene);
        handed.push(thread_cpu_s() - start);
    }
    report("  of which triangles of the scene", made, "");
    report("  in addition transfer to OpenGL", handed, "");
}

/// Jumps to moments of a recording of ten minutes, with every panel open.
fn scrubbing(folder: &Folder) {
    let mut documents = folder.documents_of("hello-endline");
    for (field, value) in
        [("duration", "600 s"), ("rope_nodes", "20"), ("whale.position.0", "400 m")]
    {
        documents.set("scenario", field, value).unwrap();
    }
    let mut screen = Screen::new(documents);
    screen.wait(|app| app.shared.workbench.status() == Some(&Status::Paused));
    screen.app.shared.perform(RunAction::Speed(f64::INFINITY));
    screen.app.shared.perform(RunAction::Start);
    let start = Instant::now();
    screen.wait(|app| {
        matches!(app.shared.workbench.status(), Some(Status::Finished | Status::Stopped(_)))
    });
    let newest_s = screen.app.shared.workbench.view().unwrap().newest_s;
    println!("a recording of {newest_s:.0} s was made in {:.0} s", start.elapsed().as_secs_f64());
    assert!(newest_s > 599.0, "ten minutes");
    screen.open_all();
    screen.wait(|app| app.panels.assembly.settled());
    let mut jumps = Jumps::default();
    for jump in 0..60 {
        let time_s = newest_s * (f64::from(jump) * 0.618_034).fract();
        jumps.to(&mut screen, time_s);
    }
    jumps.report(newest_s);
}

/// Cost of jumps until everything of their moment is drawn.
#[derive(Default)]
struct Jumps {
    cpu_s: Vec<f64>,
    real_s: Vec<f64>,
    frames: Vec<u32>,
}

impl Jumps {
    /// Seeks a moment as the transport bar does, and draws until it is shown.
    fn to(&mut self, screen: &mut Screen, time_s: f64) {
        // Of 30 moments a second, every eighth is stored in ten minutes.
        let near = |screen: &Screen| {
            screen
                .app
                .shared
                .workbench
                .view()
                .is_some_and(|view| (view.frame.time_s - time_s).abs() < 0.14)
        };
        let (mut cpu_s, mut frames, start) = (0.0, 0, Instant::now());
        screen.app.shared.give(TimeAction::Seek(time_s));
        while !near(screen) || frames == 0 {
            cpu_s += screen.frame(Vec::new());
            frames += 1;
            if !near(screen) {
                screen.sleep_until_woken();
            }
        }
        self.cpu_s.push(cpu_s);
        self.real_s.push(start.elapsed().as_secs_f64());
        self.frames.push(frames);
    }

    fn report(self, newest_s: f64) {
        report(
            &format!("a jump in a recording of {newest_s:.0} s, all panels open: CPU time"),
            self.cpu_s,
            "50 ms",
        );
        report("  the same in real time, with the thread of the run", self.real_s, "50 ms");
        println!("  frames drawn for a jump: at most {}", self.frames.iter().max().unwrap());
    }
}

/// Runs the small study with 40 encounters, and opens its results.
fn run_study(screen: &mut Screen, folder: &Folder) {
    add_study(folder);
    let file = folder.0.join("studies/small.toml");
    let text = on_disk(folder, "studies/small.toml").replace("encounters = 6", "encounters = 40");
    std::fs::write(&file, text).unwrap();
    let folders = Folders { studies: Some(folder.0.join("results")), ..Folders::default() };
    screen.app.shared.workbench.write_to(folders);
    screen.app.shared.perform(StudyAction::FullSpeed(true));
    screen.app.dock = Layout::Study.dock();
    screen.app.shared.perform(StudyAction::Open(file));
    screen.app.shared.perform(StudyAction::Run);
    let ended = |state: &State| matches!(state, State::Done | State::Failed(_));
    screen.wait(|app| {
        app.shared.workbench.studies().queue.jobs.last().is_none_or(|job| ended(&job.state()))
    });
    let state = screen.app.shared.workbench.studies().queue.jobs.last().map(StudyJob::state);
    assert_eq!(state, Some(State::Done), "{:?}", screen.app.shared.workbench.notice());
    screen.wait(|app| {
        !app.shared.workbench.studies().results.busy()
            && app.shared.workbench.studies().results.shown().is_some_and(|shown| shown.whole)
    });
}
