//! What the window costs: CPU time of its own thread for each frame, everything but the rasteriser.
//!
//! `cargo bench -p endline --bench frames` prints a table: middle and 95 % of each, in milliseconds, beside what is allowed.
//! CPU time of the drawing thread is read from `/proc/thread-self/schedstat`, so that other work on the machine does not
//! count; without it (elsewhere than on Linux) real time is taken.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a measurement that cannot go on stops, and prints what it found")]

#[path = "../tests/common/mod.rs"]
mod common;

use std::time::{Duration, Instant};

use common::{Folder, linked};
use eframe::App as _;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect, pos2, vec2};
use egui_dock::{DockState, NodeIndex};
use endline_session::live::Status;
use endline_workbench::gui::app::App;
use endline_workbench::gui::book::Book;
use endline_workbench::gui::desk::{Desk, Order};
use endline_workbench::gui::engine;
use endline_workbench::gui::layout::Panel;
use endline_workbench::input::Pilot;
use endline_workbench::scene::{Scene, Show};

/// A window without a screen.
struct Screen {
    context: egui::Context,
    app: App,
    frame: eframe::Frame,
    time_s: f64,
    size: egui::Vec2,
}

/// CPU time of this thread so far [s]; real time where the system does not tell.
fn thread_cpu_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = stat.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| std::time::SystemTime::UNIX_EPOCH.elapsed().unwrap_or_default().as_secs_f64(), |count| count * 1e-9)
}

impl Screen {
    fn new(book: Book) -> Self {
        let context = egui::Context::default();
        let creation = eframe::CreationContext::_new_kittest(context.clone());
        let desk = Desk::new(book, linked(), engine::live(), std::sync::Arc::new(|| {}), Pilot::default());
        let app = App::new(&creation, desk);
        Self { context, app, frame: eframe::Frame::_new_kittest(), time_s: 0.0, size: vec2(1920.0, 1080.0) }
    }

    /// One frame with these inputs; answers its CPU time [s]: logic, panels, tessellation, and the scene of the 3-D view.
    fn frame(&mut self, events: Vec<Event>) -> f64 {
        self.time_s += 1.0 / 60.0;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, self.size)),
            time: Some(self.time_s),
            events,
            focused: true,
            ..RawInput::default()
        };
        let before = self.app.desk.view.as_ref().map(|view| std::sync::Arc::as_ptr(&view.frame));
        let start = thread_cpu_s();
        let (app, frame) = (&mut self.app, &mut self.frame);
        let output = self.context.run_ui(input, |ui| {
            app.logic(&ui.ctx().clone(), frame);
            app.ui(ui, frame);
        });
        let shapes = self.context.tessellate(output.shapes, output.pixels_per_point);
        // Without OpenGL the view makes no scene; it is made here as there, where the moment is another.
        let scene = self.app.desk.view.as_ref().filter(|view| Some(std::sync::Arc::as_ptr(&view.frame)) != before);
        let scene = scene.map(|view| Scene::of(&view.model, &view.frame, &Show::default()));
        let spent = thread_cpu_s() - start;
        drop((shapes, scene));
        spent
    }

    /// So many frames without any input.
    fn settle(&mut self, frames: u32) {
        for _ in 0..frames {
            self.frame(Vec::new());
        }
    }

    fn wait(&mut self, so: impl Fn(&App) -> bool) {
        let patience = Instant::now() + Duration::from_secs(900);
        while !so(&self.app) {
            assert!(Instant::now() < patience, "waited in vain: {:?} {:?}", self.app.desk.status(), self.app.desk.notice);
            std::thread::sleep(Duration::from_millis(2));
            self.frame(Vec::new());
        }
    }

    /// Every panel in a place of its own, four in a row.
    fn open_all(&mut self) {
        let ids: Vec<Vec<String>> = Panel::ALL.map(|panel| vec![panel.id().to_owned()]).to_vec();
        let rows: Vec<&[Vec<String>]> = ids.chunks(4).collect();
        let mut dock = DockState::new(rows[0][0].clone());
        let tree = dock.main_surface_mut();
        let mut heads = vec![NodeIndex::root()];
        for (index, row) in rows.iter().enumerate().skip(1) {
            let share = 1.0 / (rows.len() - index + 1) as f32;
            let last = heads.len() - 1;
            let [above, below] = tree.split_below(heads[last], share, row[0].clone());
            heads[last] = above;
            heads.push(below);
        }
        for (row, head) in rows.iter().zip(heads) {
            let mut at = head;
            for (index, panel) in row.iter().enumerate().skip(1) {
                [_, at] = tree.split_right(at, 1.0 / (row.len() - index + 1) as f32, panel.clone());
            }
        }
        self.app.dock = dock;
    }
}

/// Prints a measurement: its name, the middle and 95 % of its times, and what is allowed.
fn tell(name: &str, mut times_s: Vec<f64>, allowed: &str) {
    times_s.sort_by(f64::total_cmp);
    let at = |share: f64| 1e3 * times_s[((times_s.len() - 1) as f64 * share) as usize];
    println!("{name:<58} {:>8.2} {:>8.2} ms   {allowed}", at(0.5), at(0.95));
}

/// A run of 500 nodes played with every panel open.
fn playing(folder: &Folder) {
    let mut book = folder.book_with("hello-endline");
    for (field, value) in [("duration", "3 s"), ("rope_nodes", "500"), ("whale.position.1", "-7 m")] {
        book.set("scenario", field, value).unwrap();
    }
    let mut screen = Screen::new(book);
    screen.wait(|app| app.desk.status() == Some(&Status::Paused));
    screen.app.desk.obey(&Order::Speed(f64::INFINITY));
    screen.app.desk.obey(&Order::Start);
    screen.wait(|app| app.desk.status() == Some(&Status::Finished));
    screen.open_all();
    screen.wait(|app| app.desk.assembly.settled());
    screen.app.desk.obey(&Order::Speed(1.0));
    screen.app.desk.obey(&Order::Replay);
    let nodes = screen.app.desk.view.as_ref().unwrap().model.node_count;
    screen.settle(20);
    let mut times = Vec::new();
    for _ in 0..150 {
        std::thread::sleep(Duration::from_millis(8));
        times.push(screen.frame(Vec::new()));
    }
    tell(&format!("a frame, {nodes} nodes playing, all {} panels open", Panel::ALL.len()), times, "4 ms");
    for panel in Panel::ALL {
        screen.app.dock = DockState::new(vec![panel.id().to_owned()]);
        screen.app.desk.obey(&Order::Replay);
        screen.app.desk.obey(&Order::Replay);
        screen.settle(3);
        let times = (0..30).map(|_| {
            std::thread::sleep(Duration::from_millis(4));
            screen.frame(Vec::new())
        });
        let times = times.collect();
        tell(&format!("  {} alone", panel.title()), times, "");
    }
}

/// Typing in a table of a thousand ropes, and the edit when it is committed.
fn typing(folder: &Folder) {
    let shipped = std::fs::read_to_string(folder.0.join("ropes/sink-3-8.toml")).unwrap();
    for index in 0..1000 {
        let text = shipped.replacen("name = \"", &format!("name = \"{index:04} "), 1);
        std::fs::write(folder.0.join(format!("ropes/many-{index:04}.toml")), text).unwrap();
    }
    let mut screen = Screen::new(folder.book());
    screen.wait(|app| app.desk.view.is_some());
    screen.app.dock = DockState::new(vec![Panel::Library.id().to_owned()]);
    screen.settle(5);
    let at = pos2(420.0, 300.0);
    let button = |pressed| Event::PointerButton { pos: at, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
    screen.frame(vec![Event::PointerMoved(at)]);
    screen.frame(vec![button(true)]);
    screen.frame(vec![button(false)]);
    assert!(screen.context.egui_wants_keyboard_input(), "a cell is being typed in");
    let times = (0..60).map(|index| screen.frame(vec![Event::Text(if index % 2 == 0 { "1" } else { "2" }.to_owned())])).collect();
    tell("a letter typed in a table of 1,000 ropes", times, "16 ms");
    let enter = |pressed| Event::Key { key: Key::Enter, physical_key: None, pressed, repeat: false, modifiers: Modifiers::NONE };
    let version = screen.app.desk.book.version();
    let committed = vec![screen.frame(vec![enter(true)])];
    assert!(screen.app.desk.book.version() > version, "the edit is made");
    tell("  the edit committed: 1,000 files read anew", committed, "");
}

/// Ten minutes of a run, any moment of it.
fn scrubbing(folder: &Folder) {
    let mut book = folder.book_with("hello-endline");
    for (field, value) in [("duration", "600 s"), ("rope_nodes", "20"), ("whale.position.0", "400 m")] {
        book.set("scenario", field, value).unwrap();
    }
    let mut screen = Screen::new(book);
    screen.wait(|app| app.desk.status() == Some(&Status::Paused));
    screen.app.desk.obey(&Order::Speed(f64::INFINITY));
    screen.app.desk.obey(&Order::Start);
    // A slow machine records for as long as it is given.
    let patience = Instant::now() + Duration::from_secs(180);
    screen.wait(|app| matches!(app.desk.status(), Some(Status::Finished | Status::Stopped(_))) || Instant::now() > patience);
    screen.app.desk.obey(&Order::Pause);
    screen.settle(5);
    let newest_s = screen.app.desk.view.as_ref().unwrap().newest_s;
    let mut times = Vec::new();
    for jump in 0..60 {
        let time_s = newest_s * (f64::from(jump) * 0.618_034).fract();
        let start = Instant::now();
        screen.app.desk.obey(&Order::Seek(time_s));
        let near = |app: &App| app.desk.view.as_ref().is_some_and(|view| (view.frame.time_s - time_s).abs() < 1.0);
        while !near(&screen.app) {
            screen.frame(Vec::new());
        }
        times.push(start.elapsed().as_secs_f64());
    }
    tell(&format!("a jump in a recording of {newest_s:.0} s, in real time"), times, "50 ms");
}

/// From the library on disk to a first frame with its panels, beside the rasteriser's own start.
fn starting(folder: &Folder) {
    let times = (0..5).map(|_| {
        let start = thread_cpu_s();
        let mut screen = Screen::new(folder.book_with("hello-endline"));
        screen.frame(Vec::new());
        thread_cpu_s() - start
    });
    tell("from start to the first frame", times.collect(), "1000 ms");
}

/// Frames from an input to a picture that shows it.
fn answering(folder: &Folder) {
    let mut screen = Screen::new(folder.book());
    screen.wait(|app| app.desk.view.is_some());
    let key = |key| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::COMMAND };
    screen.app.desk.view3d.look(endline_workbench::scene::View::Orbit);
    screen.settle(3);
    let mut frames = 1;
    screen.frame(vec![key(Key::P)]);
    // The list of commands takes the keyboard as soon as it is drawn.
    while !screen.context.egui_wants_keyboard_input() && frames < 10 {
        screen.frame(Vec::new());
        frames += 1;
    }
    println!("{:<58} {frames:>8} frames        2 frames", "from a key to the frame that shows what it does");
}

fn main() {
    // `cargo test --benches` only wants to know that it builds.
    if std::env::args().any(|argument| argument == "--test") {
        return;
    }
    println!("{:<58} {:>8} {:>8}      allowed", "CPU time of the window's own thread", "middle", "95 %");
    starting(&Folder::new("frames-start"));
    answering(&Folder::new("frames-answer"));
    typing(&Folder::new("frames-typing"));
    playing(&Folder::new("frames-playing"));
    scrubbing(&Folder::new("frames-scrubbing"));
}
