//! Input has its effect on screen in the frame that receives it or in the next, counted in frames.

use endline_session::command::RunAction;
use endline_workbench::gui::command::action::FlightAction;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use endline_session::live::Status;
use endline_session::live::engine::{self, Launch};
use endline_session::task::Waker;
use endline_workbench::input::Pilot;

use crate::common::{Folder, Reach as _, Window, linked, opened_with, wait, workbench};

/// Number of frames from an event until its effect is shown; the frame that receives the event is the first.
fn frames(window: &mut Window, event: Event, shown: impl Fn(&Window) -> bool) -> u32 {
    window.event(event);
    let mut frames = 0;
    while frames < 10 {
        window.step();
        frames += 1;
        if shown(window) {
            break;
        }
    }
    frames
}

fn key(key: Key, modifiers: Modifiers) -> Event {
    Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    }
}

/// Moves the mouse to a place and presses it.
fn press(window: &mut Window, at: Pos2) {
    for event in [Event::PointerMoved(at), button(at, true)] {
        window.event(event);
        window.step();
    }
}

#[test]
fn keys_letters_clicks_and_drags_take_effect_within_two_frames() {
    let folder = Folder::new("answers");
    let (mut window, received) = workbench(&folder, Pilot::default());

    let commands = |window: &Window| window.ctx.egui_wants_keyboard_input();
    assert!(!commands(&window), "no text field has the focus");
    assert!(
        frames(&mut window, key(Key::P, Modifiers::COMMAND), commands) <= 2,
        "the list of commands"
    );
    window.event(key(Key::Escape, Modifiers::NONE));
    window.run_steps(2);

    let cell = window.get_all_by_value("2,700 lbf").next().unwrap().rect().center();
    press(&mut window, cell);
    window.event(button(cell, false));
    window.run_steps(2);
    let letter = frames(&mut window, Event::Text("7".to_owned()), |window| {
        window.query_all_by_value("2,700 lbf").next().is_none() && commands(window)
    });
    assert!(letter <= 2, "a letter in a cell: {letter}");
    window.event(key(Key::Escape, Modifiers::NONE));
    window.run_steps(2);

    let pane = window.get_by_label("Pane 1").rect().center();
    let before = window.state().panels.view.eyes[0].camera.clone();
    press(&mut window, pane);
    let orbited = frames(&mut window, Event::PointerMoved(pane + vec2(60.0, 0.0)), |window| {
        window.state().panels.view.eyes[0].camera != before
    });
    assert!(orbited <= 2, "the view orbits with the mouse: {orbited}");
    window.event(button(pane + vec2(60.0, 0.0), false));
    window.step();

    let run = window.get_by_label("▶ Run").rect().center();
    press(&mut window, run);
    let started = frames(&mut window, button(run, false), |window| {
        window.query_by_label("⏸ Pause").is_some() && !received.borrow().is_empty()
    });
    assert!(started <= 2, "a button, its command and its effect: {started}");
    assert_eq!(*received.borrow(), ["start"]);
}

#[test]
fn a_steering_key_reaches_the_run_within_two_frames() {
    let folder = Folder::new("answers-flying");
    let (mut window, received) = workbench(&folder, Pilot::default());
    window.state_mut().shared.give(FlightAction::Toggle);
    window.run_steps(3);
    // The last controls: speed, pitch, roll, yaw.
    let yaw = || {
        received
            .borrow()
            .last()
            .and_then(|words| words.split(' ').nth(4)?.parse::<f64>().ok())
            .unwrap()
    };
    assert!(yaw().abs() < 1e-12, "the whale swims straight: {:?}", received.borrow().last());
    let steered = frames(&mut window, key(Key::A, Modifiers::NONE), |_| yaw().abs() > 0.0);
    assert!(steered <= 2, "{steered}: {:?}", received.borrow());
}

#[test]
fn a_press_on_the_transport_bar_shows_its_moment_in_the_next_frame() {
    let folder = Folder::new("answers-seek");
    let mut documents = folder.documents_of("hello-endline");
    for (field, value) in [("duration", "1 s"), ("rope_nodes", "40")] {
        documents.set("scenario", field, value).unwrap();
    }
    let woken = Arc::new(AtomicBool::new(false));
    let ring = Arc::clone(&woken);
    let launch: Launch = Box::new(move |prepared, host, waker: Waker| {
        let ring = Arc::clone(&ring);
        let both: Waker = Arc::new(move || {
            ring.store(true, Ordering::Release);
            waker();
        });
        engine::live()(prepared, host, both)
    });
    let mut window = opened_with(documents, linked(), launch, Pilot::default());
    wait(&mut window, |app| app.shared.workbench.status() == Some(&Status::Paused));
    window.perform(RunAction::Speed(f64::INFINITY));
    window.perform(RunAction::Start);
    wait(&mut window, |app| app.shared.workbench.status() == Some(&Status::Finished));

    let bar = window.get_by_label("Time").rect();
    let at = bar.left_center() + vec2(0.25 * bar.width(), 0.0);
    window.event(Event::PointerMoved(at));
    window.step();
    woken.store(false, Ordering::Release);
    window.event(button(at, true));
    window.step();
    // The thread of the run responds after some time and then wakes the window.
    let patience = Instant::now() + Duration::from_secs(20);
    while !woken.load(Ordering::Acquire) && Instant::now() < patience {
        std::thread::sleep(Duration::from_millis(1));
    }
    window.step();
    let view = window.view();
    assert!(view.sought && (view.frame.time_s - 0.25).abs() < 0.02, "{} s", view.frame.time_s);
    assert!(
        window.query_all_by_label_contains(&format!("{:.2} s", view.frame.time_s)).next().is_some(),
        "the bar shows the time"
    );
}
