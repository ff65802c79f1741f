//! What the window costs: CPU time of its own thread for each frame, everything but the rasteriser.
//!
//! `cargo bench -p endline --bench frames` prints a table: fastest, middle and 95 % of each, in milliseconds, beside what is
//! allowed; `-- typing` and the like measure one part alone. CPU time is that of the drawing thread, so that other work on
//! the machine counts only by what it takes of caches and clock rate; the middle is the figure, 95 % tells how busy the
//! machine was.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::disallowed_methods,
    reason = "a measurement that cannot go on stops, and prints what it found"
)]

#[path = "../../tests/all/common/mod.rs"]
mod common;
mod screen;
mod study;

use endline_session::command::{EditAction, RunAction, TimeAction};
use std::time::Instant;

use endline_session::live::Status;
use endline_session::scene::Scene;

use common::Folder;
use egui::{Event, Key, Modifiers, PointerButton, pos2};
use endline_workbench::gui::layout::Layout;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::scene::{Drawer, offscreen::Offscreen};
use screen::{Screen, thread_cpu_s};

/// A measurement, in a copy of the library.
type Measure = fn(&Folder);

/// What is measured, by name.
const PARTS: [(&str, Measure); 4] =
    [("start", starting), ("typing", typing), ("playing", playing), ("scrubbing", scrubbing)];

/// Asks this program for one start alone: a process of its own tells what it cost.
const ONE_START: &str = "one-start";

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let told = |word: &str| arguments.iter().any(|argument| argument == word);
    // `cargo test --benches` only wants to know that it builds.
    if told("--test") {
        return;
    }
    if told(ONE_START) {
        return one_start();
    }
    println!(
        "{:<62} {:>8} {:>8} {:>8}      allowed",
        "CPU time of the window's own thread", "fastest", "middle", "95 %"
    );
    let every = PARTS.iter().all(|(name, _)| !told(name));
    for (name, measure) in PARTS.into_iter().filter(|(name, _)| every || told(name)) {
        measure(&Folder::new(&format!("frames-{name}")));
    }
}

/// Prints a measurement: its name, the fastest, the middle and 95 % of its times, and what is allowed.
fn tell(name: &str, mut times_s: Vec<f64>, allowed: &str) {
    times_s.sort_by(f64::total_cmp);
    let at = |share: f64| 1e3 * times_s[((times_s.len() - 1) as f64 * share) as usize];
    println!("{name:<62} {:>8.2} {:>8.2} {:>8.2} ms   {allowed}", at(0.0), at(0.5), at(0.95));
}

/// From the start of the process to a first frame with its panels, beside OpenGL's own start.
fn starting(_: &Folder) {
    let program = std::env::current_exe().unwrap();
    let times = (0..9).map(|_| {
        let told = std::process::Command::new(&program).arg(ONE_START).output().unwrap().stdout;
        String::from_utf8(told).unwrap().trim().parse::<f64>().unwrap()
    });
    tell("from the start of the process to its first frame", times.collect(), "1000 ms");
}

/// One start of the program, told in seconds: the system's loader, library, plugins, fonts, every panel of the layout.
fn one_start() {
    let loaded_s = thread_cpu_s();
    // The copy of the library is the measurement's own.
    let folder = Folder::new("frames-one-start");
    let copied_s = thread_cpu_s();
    let mut screen = Screen::new(folder.book_with("hello-endline"));
    screen.frame(Vec::new());
    println!("{}", thread_cpu_s() - copied_s + loaded_s);
}

/// Typing in a table of a thousand ropes: in a cell and in the search; and an edit when it is committed.
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
    screen.open_alone(PanelId::LIBRARY);
    screen.settle(5);
    let letter = |index: usize| {
        vec![Event::Text(if index.is_multiple_of(2) { "1" } else { "2" }.to_owned())]
    };
    click(&mut screen, pos2(420.0, 300.0));
    tell(
        "a letter typed in a cell of a table of 1,000 ropes",
        (0..60).map(|index| screen.frame(letter(index))).collect(),
        "16 ms",
    );
    screen.frame(vec![key(Key::Escape)]);
    let mut committed = Vec::new();
    for _ in 0..5 {
        click(&mut screen, pos2(420.0, 300.0));
        screen.frame(letter(0));
        let version = screen.app.shared.workbench.project.documents.version();
        committed.push(screen.frame(vec![key(Key::Enter)]));
        assert!(
            screen.app.shared.workbench.project.documents.version() > version,
            "the edit is made"
        );
        screen.app.shared.perform(EditAction::Undo);
        screen.settle(3);
    }
    tell("  the edit committed: all files read and compared anew", committed, "");
    let mut found = Vec::new();
    for _ in 0..10 {
        screen.app.panels.library.search.clear();
        screen.frame(Vec::new());
        for _ in 0..4 {
            screen.app.panels.library.search.push('0');
            found.push(screen.frame(Vec::new()));
        }
    }
    tell("  a letter typed in its search", found, "16 ms");
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
    assert!(screen.context.egui_wants_keyboard_input(), "a field is being typed in");
}

/// A run of 500 nodes as it is made and as it is played again, with every panel open and something in each.
fn playing(folder: &Folder) {
    let mut documents = folder.book_with("hello-endline");
    for (field, value) in [("rope_nodes", "500"), ("whale.position.1", "-7 m")] {
        documents.set("scenario", field, value).unwrap();
    }
    let mut screen = Screen::new(documents);
    screen.app.shared.workbench.recordings = Some(folder.0.join("recordings"));
    study::run(&mut screen, folder);
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
    tell(
        &format!("a frame, {nodes} nodes being run, all {panels} panels open"),
        screen.moments(60),
        "4 ms",
    );
    screen.app.shared.perform(RunAction::Pause);
    screen.wait(|app| app.shared.workbench.status() == Some(&Status::Paused));
    tell(
        &format!("a frame, {nodes} nodes played again, all {panels} panels open"),
        played(&mut screen, 100),
        "4 ms",
    );
    uploaded(&screen);
    for panel in PanelId::ALL {
        screen.open_alone(panel);
        screen.settle(3);
        tell(&format!("  {} alone", panel.title()), played(&mut screen, 20), "");
    }
}

/// Times of so many frames of the run played again, each of another moment [s].
fn played(screen: &mut Screen, count: usize) -> Vec<f64> {
    let newest_s = screen.app.shared.workbench.view().unwrap().newest_s;
    let times = (1..=count).map(|index| {
        screen.app.shared.perform(TimeAction::Seek((index as f64 / 30.0) % newest_s));
        screen.sleep_until_woken();
        screen.frame(Vec::new())
    });
    times.collect()
}

/// The scene's triangles handed to OpenGL, where there is one without a display.
fn uploaded(screen: &Screen) {
    let Ok(offscreen) = Offscreen::new([64, 64]) else {
        return println!("no OpenGL here: what it takes to hand it a scene is not measured");
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
    tell("  of it the triangles of the scene", made, "");
    tell("  beside it their way to OpenGL", handed, "");
}

/// Ten minutes of a run, any moment of it, with every panel open.
fn scrubbing(folder: &Folder) {
    let mut documents = folder.book_with("hello-endline");
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
    jumps.tell(newest_s);
}

/// What jumps cost until everything of their moment is drawn.
#[derive(Default)]
struct Jumps {
    cpu_s: Vec<f64>,
    real_s: Vec<f64>,
    frames: Vec<u32>,
}

impl Jumps {
    /// Asks for a moment as the transport bar does, and draws until it is shown.
    fn to(&mut self, screen: &mut Screen, time_s: f64) {
        // Of ten minutes every eighth of thirty moments a second is kept.
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

    fn tell(self, newest_s: f64) {
        tell(
            &format!("a jump in a recording of {newest_s:.0} s, all panels open: CPU time"),
            self.cpu_s,
            "50 ms",
        );
        tell("  the same in real time, the run's thread included", self.real_s, "50 ms");
        println!("  frames drawn for a jump: {} at most", self.frames.iter().max().unwrap());
    }
}
