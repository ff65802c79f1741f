//! Basic use of the workbench: edits, errors, saving, runs, panels, pad, palette.

use endline_session::command::{EditAction, RunAction};
use endline_session::workbench::Notice;
use endline_workbench::gui::command::action::{FlightAction, PanelAction};
use std::sync::Arc;

use egui_kittest::kittest::Queryable;
use endline_session::edit::Documents;
use endline_session::live::{LiveView, Status, engine};
use endline_session::units::Units;
use endline_session::{Overrides, Run, RunOptions, prepare};
use endline_workbench::gui::layout;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::panels::view::hud::{readings, waiting};
use endline_workbench::input::{HeldKeys, PadAxis, PadButton, PadEvent, Pilot, ScriptedPad};

use crate::common::{
    Folder, Reach as _, Window, linked, on_disk, only, opened, real, retype, wait, workbench,
};

#[test]
fn a_wrong_unit_is_reported_with_place_and_reason_and_undo_removes_the_error() {
    let folder = Folder::new("bad-unit");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    retype(&mut harness, "2,700 lbf", "2,700 furlong");
    let problems = harness.documents().problems().to_vec();
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
    assert!(harness.documents().problems().is_empty());
    assert_eq!(harness.documents().unsaved().len(), 0);
}

#[test]
fn an_edit_is_saved_without_changing_comments_or_anything_else() {
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
    assert_eq!(
        on_disk(&folder, "ropes/nylon-1-2.toml"),
        after,
        "the source of the old figure is removed"
    );
    let saved = format!("saved {}", folder.0.join("ropes/nylon-1-2.toml").display());
    assert_eq!(harness.notice(), Notice::done(saved));
}

#[test]
fn run_pause_step_reset_and_speed_reach_the_engine() {
    let folder = Folder::new("run");
    let (mut harness, received) = workbench(&folder, Pilot::default());
    for label in ["▶ Run", "⏸ Pause", "Step", "⏮ Reset", "5×"] {
        harness.get_by_label(label).click();
        harness.run_steps(3);
    }
    assert_eq!(*received.borrow(), ["start", "pause", "step", "reset", "speed 5"]);
}

#[test]
fn a_run_after_an_edit_first_applies_the_edit() {
    let folder = Folder::new("stale");
    let (mut harness, received) = workbench(&folder, Pilot::default());
    harness.set(Documents::SCENARIO, "duration", "7 s");
    harness.run_steps(2);
    assert!(harness.workbench().stale());
    harness.get_by_label("▶ Run").click();
    harness.run_steps(2);
    wait(&mut harness, |app| !app.shared.workbench.stale());
    assert_eq!(*received.borrow(), ["load", "start"]);
    let duration_s = harness.view().model.spec.settings.duration_s;
    assert!((duration_s - 7.0).abs() < 1e-12);
}

#[test]
fn every_panel_opens_from_the_window_menu_and_the_layout_resets() {
    let folder = Folder::new("panels");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    for panel in PanelId::ALL.iter().copied() {
        only(&mut harness, PanelId::Run);
        harness.get_by_label("Window").click();
        harness.run_steps(3);
        harness.get_all_by_label_contains(&panel.title()).last().unwrap().click();
        harness.run_steps(3);
        assert!(layout::is_open(&harness.state().dock, panel), "{panel:?}");
    }
    harness.state_mut().shared.give(PanelAction::Arrange(layout::Layout::Design));
    harness.run_steps(2);
    assert!(
        layout::is_open(&harness.state().dock, PanelId::Library)
            && layout::is_open(&harness.state().dock, PanelId::View)
    );
}

#[test]
fn the_unit_switch_changes_the_units_on_screen() {
    let folder = Folder::new("units");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.get_by_label("SI").click();
    harness.run_steps(3);
    assert_eq!(harness.workbench().preferences().units.force().symbol(), "N");
    assert_eq!(harness.workbench().preferences().units.length_symbol(), "m");
    harness.get_by_label("NOAA").click();
    harness.run_steps(3);
    assert_eq!(harness.workbench().preferences().units.speed(1.0), "1.94 kn");
}

#[test]
fn the_pad_steers_only_in_flight() {
    let folder = Folder::new("pad");
    let script = vec![vec![
        PadEvent::Connected("test pad".into()),
        PadEvent::Moved(PadAxis::LeftTrigger, 1.0),
        PadEvent::Moved(PadAxis::RightX, 1.0),
    ]];
    let pilot = Pilot::new(Some(Box::new(ScriptedPad { script: script.into() })));
    let (mut harness, received) = workbench(&folder, pilot);
    harness.run_steps(3);
    assert!(received.borrow().is_empty(), "the pad does not steer: {:?}", received.borrow());
    harness.get_by_label("Fly the whale").click();
    harness.run_steps(3);
    assert!(
        received.borrow().last().unwrap().starts_with("controls 1.00 0.00 0.00 -1.00"),
        "{:?}",
        received.borrow()
    );
    let camera = |harness: &Window| {
        let eye = &harness.state().panels.view.eyes[0];
        (eye.named, eye.follow, eye.frame_again)
    };
    let in_flight = camera(&harness);
    harness.key_press(egui::Key::Escape);
    harness.run_steps(3);
    assert_eq!(received.borrow().last().unwrap(), "autopilot");
    assert_eq!(camera(&harness), in_flight, "the end of a flight does not move the camera");
}

#[test]
fn flight_sets_real_time_and_shows_that_the_run_is_paused() {
    let folder = Folder::new("fly-speed");
    let mut harness = real(&folder, "hello-endline");
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness.perform(RunAction::Speed(f64::INFINITY));
    wait(&mut harness, |app| app.shared.workbench.view().is_some_and(|view| view.speed > 100.0));
    harness.state_mut().shared.give(FlightAction::Toggle);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| (view.speed - 1.0).abs() < 1e-9)
    });
    let view = harness.view();
    assert!(waiting(&view).contains("Space"), "{:?}", view.status);
    let names: Vec<String> = readings(&view, Units::Si).into_iter().map(|(name, _)| name).collect();
    assert!(["ROLL", "PITCH", "THROTTLE"].iter().all(|name| names.contains(&(*name).to_owned())));
    // In flight before the first step, the whale keeps the speed of the program.
    let has_program_speed = |view: &LiveView| (view.controls.speed - 1.0).abs() < 1e-12;
    assert!(has_program_speed(&view), "{:?}", view.controls);
    harness.perform(RunAction::Step);
    wait(&mut harness, |app| app.shared.workbench.view().is_some_and(|view| view.frame.step > 0));
    let view = harness.view();
    assert!(view.piloted && has_program_speed(&view), "{:?}", view.controls);
}

#[test]
fn start_on_the_pad_restarts_the_run_in_flight() {
    let folder = Folder::new("pad-start");
    let pilot = Pilot::new(Some(Box::new(LateStart(0))));
    let (mut harness, received) = workbench(&folder, pilot);
    harness.state_mut().shared.give(FlightAction::Toggle);
    harness.run_steps(30);
    let received = received.borrow();
    let reset = received.iter().position(|words| words == "reset").expect("reset");
    assert_eq!(received[reset + 1], "start");
}

/// A pad on which Start is pressed every tenth poll.
struct LateStart(u32);

impl endline_workbench::input::PadSource for LateStart {
    fn poll(&mut self, out: &mut Vec<PadEvent>) {
        self.0 += 1;
        if self.0.is_multiple_of(10) {
            out.push(PadEvent::Pressed(PadButton::Start));
        }
    }
}

/// State hash after 14 s of `hello-endline`, steered by a pad that is read at each step.
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
fn the_same_pad_script_gives_the_same_state() {
    let mut script = vec![vec![]; 800];
    script[0] = vec![PadEvent::Connected("pad".into()), PadEvent::Moved(PadAxis::LeftTrigger, 0.9)];
    script[300] =
        vec![PadEvent::Moved(PadAxis::LeftX, -0.8), PadEvent::Moved(PadAxis::RightX, 0.3)];
    script[350] = vec![PadEvent::Moved(PadAxis::LeftX, 0.0), PadEvent::Moved(PadAxis::RightX, 0.0)];
    let flown = flight(&script);
    assert_eq!(flown, flight(&script));
    script[300].pop();
    assert_ne!(flown, flight(&script), "the stick changes the state");
}

#[test]
fn a_real_run_advances_on_its_own_thread() {
    let folder = Folder::new("real");
    let mut harness = opened(folder.documents(), engine::live(), Pilot::default());
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    harness.perform(RunAction::Speed(f64::INFINITY));
    harness.get_by_label("▶ Run").click();
    harness.run_steps(2);
    wait(&mut harness, |app| {
        app.shared.workbench.view().is_some_and(|view| view.frame.time_s > 0.2)
    });
    let view = harness.view();
    assert!(view.audit.solver_steps > 0 && view.audit.non_finite == 0);
    assert_eq!(view.state_hash.len(), 16, "{}", view.state_hash);
}

#[test]
fn an_edited_rope_changes_the_statics_after_apply() {
    let folder = Folder::new("answer");
    let mut harness = real(&folder, "hello-endline");
    let settled_n = |harness: &Window| {
        let view = harness.view();
        view.frame.tension_n.iter().copied().fold(0.0, f64::max)
    };
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    let (before_n, earlier) = (settled_n(&harness), harness.view());
    let rope = "ropes/sink-3-8.toml";
    assert!(harness.documents().in_use(rope), "the endline of the single uses it");
    let diameter = harness.documents().field(rope, "diameter").unwrap();
    harness.set(rope, "diameter", "7/16 in");
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
fn a_duplicated_rope_is_a_separate_file_after_saving() {
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
fn the_reason_why_a_model_cannot_be_assembled_is_a_problem() {
    let folder = Folder::new("unmade");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.perform(EditAction::OpenScenario(folder.0.join("scenarios/hello-endline.toml")));
    wait(&mut harness, |app| !app.shared.workbench.making());
    let problems: Vec<String> =
        harness.workbench().project().problems().map(|problem| problem.message.clone()).collect();
    assert!(
        problems.iter().any(|message| message.contains("org.endline.")),
        "the missing plugin is not reported: {problems:?}"
    );
}

#[test]
fn the_command_palette_gives_a_command_by_its_name() {
    let folder = Folder::new("palette");
    let (mut harness, received) = workbench(&folder, Pilot::default());
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::P);
    harness.run_steps(3);
    harness.event(egui::Event::Text("speed 0.25".to_owned()));
    harness.run_steps(2);
    harness.key_press(egui::Key::Enter);
    harness.run_steps(3);
    assert_eq!(*received.borrow(), ["speed 0.25"]);
}
