//! The workbench clicked through as a user does, without a display: edits, errors, save, run, panels.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use endline_session::command::{EditAction, RunAction};
use endline_session::workbench::Notice;
use endline_workbench::gui::command::action::{FlightAction, PanelAction};
use std::sync::Arc;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use endline_session::edit::Documents;
use endline_session::live::engine;
use endline_session::live::{LiveView, Status};
use endline_session::units::Units;
use endline_session::{Overrides, Run, RunOptions, prepare};
use endline_workbench::gui::app::App;
use endline_workbench::gui::layout;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::panels::view::hud::{readings, waiting};
use endline_workbench::input::{HeldKeys, PadAxis, PadButton, PadEvent, Pilot, ScriptedPad};

use crate::common::{Folder, linked, on_disk, opened, opened_with, retype, wait, workbench};

#[test]
fn a_bad_unit_is_red_with_its_place_and_reason_and_undo_mends_it() {
    let folder = Folder::new("bad-unit");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    retype(&mut harness, "2,700 lbf", "2,700 furlong");
    let problems = harness.state().shared.workbench.project.documents.problems().to_vec();
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert!(
        problems[0].file.starts_with("ropes/")
            && problems[0].line > 0
            && problems[0].field.starts_with("strength"),
        "{problems:?}"
    );
    let place = format!("{}:{}:{}", problems[0].file, problems[0].line, problems[0].column);
    assert!(
        harness.query_all_by_label_contains("furlong").next().is_some(),
        "the reason is on screen"
    );
    assert!(harness.query_all_by_label(&place).next().is_some(), "its place is on screen: {place}");
    harness.get_by_label("Undo").click();
    harness.run_steps(3);
    assert!(harness.state().shared.workbench.project.documents.problems().is_empty());
    assert_eq!(harness.state().shared.workbench.project.documents.unsaved().len(), 0);
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
    let typed = format!(
        "strength = {{ value = \"25 kN\", source = \"{}\", confidence = \"estimate\" }}",
        endline_gear::UNSOURCED
    );
    let after = before.replace("strength = \"5,750 lbf\"", &typed);
    assert_eq!(on_disk(&folder, "ropes/nylon-1-2.toml"), after, "the old figure's source is gone");
    assert_eq!(harness.state().shared.workbench.notice, Some(Notice::done("saved 1 file")));
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
    harness.state_mut().shared.workbench.set(Documents::SCENARIO, "duration", "7 s");
    harness.run_steps(2);
    assert!(harness.state().shared.workbench.stale());
    harness.get_by_label("▶ Run").click();
    harness.run_steps(2);
    wait(&mut harness, |app| !app.shared.workbench.stale());
    assert_eq!(*told.borrow(), ["load", "start"]);
    let duration_s =
        harness.state().shared.workbench.view().unwrap().model.spec.settings.duration_s;
    assert!((duration_s - 7.0).abs() < 1e-12);
}

#[test]
fn every_panel_opens_from_the_window_menu_and_the_layout_resets() {
    let folder = Folder::new("panels");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    for panel in PanelId::ALL {
        harness.state_mut().dock = egui_dock::DockState::new(vec![PanelId::RUN.id().to_owned()]);
        harness.run_steps(2);
        harness.get_by_label("Window").click();
        harness.run_steps(3);
        harness.get_all_by_label_contains(panel.title()).last().unwrap().click();
        harness.run_steps(3);
        assert!(layout::is_open(&harness.state().dock, panel), "{panel:?}");
    }
    harness.state_mut().shared.give(PanelAction::Arrange(layout::Layout::Design));
    harness.run_steps(2);
    assert!(
        layout::is_open(&harness.state().dock, PanelId::LIBRARY)
            && layout::is_open(&harness.state().dock, PanelId::VIEW)
    );
}

#[test]
fn the_unit_switch_changes_what_the_plot_is_labelled_in() {
    let folder = Folder::new("units");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.get_by_label("SI").click();
    harness.run_steps(3);
    assert_eq!(harness.state().shared.workbench.preferences.units.force().symbol(), "N");
    assert_eq!(harness.state().shared.workbench.preferences.units.length_symbol(), "m");
    harness.get_by_label("NOAA").click();
    harness.run_steps(3);
    assert_eq!(harness.state().shared.workbench.preferences.units.speed(1.0), "1.94 kn");
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
    assert!(
        told.borrow().last().unwrap().starts_with("controls 1.00 0.00 0.00 -1.00"),
        "{:?}",
        told.borrow()
    );
    harness.key_press(egui::Key::Escape);
    harness.run_steps(3);
    assert_eq!(told.borrow().last().unwrap(), "autopilot");
}

#[test]
fn a_hand_steers_in_real_time_whatever_the_speed_was_and_is_told_that_time_stands_still() {
    let folder = Folder::new("fly-speed");
    let mut harness =
        opened_with(folder.book_with("hello-endline"), linked(), engine::live(), Pilot::default());
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness.state_mut().shared.perform(RunAction::Speed(f64::INFINITY));
    wait(&mut harness, |app| app.shared.workbench.view().is_some_and(|view| view.speed > 100.0));
    harness.state_mut().shared.give(FlightAction::Toggle);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| (view.speed - 1.0).abs() < 1e-9)
    });
    let view = harness.state().shared.workbench.view().cloned().unwrap();
    assert!(waiting(&view).contains("Space"), "{:?}", view.status);
    let told: Vec<String> = readings(&view, Units::Si).into_iter().map(|(name, _)| name).collect();
    assert!(["ROLL", "PITCH", "THROTTLE"].iter().all(|name| told.contains(&(*name).to_owned())));
    // Taken over before the first step, the whale keeps the speed that the program asks for.
    let whole = |view: &LiveView| (view.controls.speed - 1.0).abs() < 1e-12;
    assert!(whole(&view), "{:?}", view.controls);
    harness.state_mut().shared.perform(RunAction::Step);
    wait(&mut harness, |app| app.shared.workbench.view().is_some_and(|view| view.frame.step > 0));
    let view = harness.state().shared.workbench.view().cloned().unwrap();
    assert!(view.piloted && whole(&view), "{:?}", view.controls);
}

#[test]
fn start_on_the_pad_restarts_the_run_while_flying() {
    let folder = Folder::new("pad-start");
    let pilot = Pilot::new(Some(Box::new(LateStart(0))));
    let (mut harness, told) = workbench(&folder, pilot);
    harness.state_mut().shared.give(FlightAction::Toggle);
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

/// The state after 14 s of `hello-endline` flown by a pad that is read at each step.
fn flight(script: &[Vec<PadEvent>]) -> String {
    let scenario = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../gear-library/scenarios/hello-endline.toml");
    let mut run = Run::new(
        prepare(&scenario, None, &linked(), Overrides::default()).unwrap(),
        RunOptions::default(),
    )
    .unwrap();
    let mut pilot = Pilot::new(Some(Box::new(ScriptedPad { script: script.to_vec().into() })));
    while run.state().time_s < 14.0 {
        pilot.poll_pad();
        let step_s = run.step_s();
        run.step(pilot.controls(&HeldKeys::default(), 0, step_s)).unwrap();
    }
    run.state_hash().hex()
}

#[test]
fn a_pad_flies_the_encounter_to_the_same_state_each_time() {
    let mut script = vec![vec![]; 800];
    script[0] = vec![PadEvent::Connected("pad".into()), PadEvent::Moved(PadAxis::LeftTrigger, 0.9)];
    script[300] =
        vec![PadEvent::Moved(PadAxis::LeftX, -0.8), PadEvent::Moved(PadAxis::RightX, 0.3)];
    script[350] = vec![PadEvent::Moved(PadAxis::LeftX, 0.0), PadEvent::Moved(PadAxis::RightX, 0.0)];
    let flown = flight(&script);
    assert_eq!(flown, flight(&script));
    script[300].pop();
    assert_ne!(flown, flight(&script), "what the stick does is part of the flight");
}

#[test]
fn a_real_run_swings_the_pendulum_on_a_thread_of_its_own() {
    let folder = Folder::new("real");
    let mut harness = opened(folder.documents(), engine::live(), Pilot::default());
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness.state_mut().shared.perform(RunAction::Speed(f64::INFINITY));
    harness.get_by_label("▶ Run").click();
    harness.run_steps(2);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| view.frame.time_s > 0.2)
    });
    let view = harness.state().shared.workbench.view().cloned().unwrap();
    assert!(view.audit.solver_steps > 0 && view.audit.non_finite == 0);
    assert_eq!(view.state_hash.len(), 16, "{}", view.state_hash);
}

#[test]
fn editing_the_endline_in_its_table_and_applying_changes_the_answer() {
    let folder = Folder::new("answer");
    let mut harness =
        opened_with(folder.book_with("hello-endline"), linked(), engine::live(), Pilot::default());
    let settled_n = |harness: &Harness<'static, App>| {
        let view = harness.state().shared.workbench.view().cloned().unwrap();
        view.frame.tension_n.iter().copied().fold(0.0, f64::max)
    };
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    let (before_n, earlier) =
        (settled_n(&harness), harness.state().shared.workbench.view().cloned().unwrap());
    let rope = "ropes/sink-3-8.toml";
    assert!(
        harness.state().shared.workbench.project.documents.in_use(rope),
        "the single's endline is made of it"
    );
    let diameter =
        harness.state().shared.workbench.project.documents.field(rope, "diameter").unwrap();
    harness.state_mut().shared.workbench.set(rope, "diameter", "7/16 in");
    harness.run_steps(2);
    harness.get_all_by_label("Apply").next().unwrap().click();
    harness.run_steps(2);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| {
            !Arc::ptr_eq(&view.model, &earlier.model) && view.status == Status::Paused
        })
    });
    let after_n = settled_n(&harness);
    assert!(
        before_n > 1.0 && (after_n / before_n - 1.0).abs() > 0.02,
        "{diameter}: {before_n} N; 7/16 in: {after_n} N"
    );
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
    let (original, copy) =
        (on_disk(&folder, "ropes/nylon-1-2.toml"), on_disk(&folder, "ropes/nylon-1-2-2.toml"));
    assert!(copy.contains("copied from nylon-1-2, not verified") && !copy.contains("\"measured\""));
    assert_eq!(copy.lines().count(), original.lines().count());
}

#[test]
fn a_model_that_cannot_be_made_says_why_in_problems() {
    let folder = Folder::new("unmade");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness
        .state_mut()
        .shared
        .perform(EditAction::OpenScenario(folder.0.join("scenarios/hello-endline.toml")));
    wait(&mut harness, |app| !app.shared.workbench.making());
    let problems: Vec<String> = harness
        .state()
        .shared
        .workbench
        .project
        .problems()
        .map(|problem| problem.message.clone())
        .collect();
    assert!(
        problems.iter().any(|message| message.contains("org.endline.")),
        "no plugin is there, and that is told: {problems:?}"
    );
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
