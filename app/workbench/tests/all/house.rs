//! What holds all over the window: every command, layouts, edits kept over a crash, runs kept, the pad's mapping.
#![cfg(feature = "gui")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use endline_session::command::{EditAction, RunAction, TimeAction};
use endline_workbench::gui::command::action::PanelAction;
use std::sync::Arc;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use endline_session::edit::recovery::{Autosave, EVERY_S};
use endline_session::export::chart::{Chart, Kind};
use endline_session::live::{Channel, Status};
use endline_session::units::Units;
use endline_workbench::gui::app::App;
use endline_workbench::gui::layout::{self, Layout};
use endline_workbench::gui::panel::PanelId;
use endline_workbench::input::{PadButton, PadEvent, Pilot, Pressed, ScriptedPad};

use crate::common::{Folder, flown, give, wait, workbench};

#[test]
fn the_window_menu_ticks_open_panels_and_takes_them_away() {
    let folder = Folder::new("ticks");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    assert!(layout::is_open(&harness.state().dock, PanelId::TENSION));
    harness.get_by_label("Window").click();
    harness.run_steps(3);
    harness.get_all_by_label("Tension").last().unwrap().click();
    harness.run_steps(3);
    assert!(!layout::is_open(&harness.state().dock, PanelId::TENSION));
}

#[test]
fn edits_of_a_program_that_was_killed_are_offered_back_and_undone_as_one() {
    let folder = Folder::new("killed");
    let data = folder.0.join("data");
    std::fs::create_dir_all(&data).unwrap();
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.state_mut().shared.workbench.project.autosave = Autosave::in_folder(data.clone());
    harness.state_mut().shared.workbench.set("ropes/sink-3-8.toml", "strength", "2,600 lbf");
    harness.state_mut().shared.workbench.set("ropes/nylon-1-2.toml", "strength", "25 kN");
    let kept = data.join(format!("recovery-{}.json", std::process::id()));
    // The harness's own clock goes on a quarter of a second a step.
    for _ in 0..(8.0 * EVERY_S) as usize {
        harness.step();
    }
    wait(&mut harness, |_| kept.exists());
    drop(harness);
    // No program has this number, as if this one ran no more.
    std::fs::rename(kept, data.join("recovery-4294967295.json")).unwrap();

    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.state_mut().shared.workbench.project.autosave = Autosave::in_folder(data.clone());
    harness.state_mut().questions.left_behind = Autosave::in_folder(data.clone()).left_behind();
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("Unsaved edits of 2 files").is_some());
    harness.get_by_label("Recover").click();
    harness.run_steps(3);
    let strength = |harness: &Harness<'static, App>, path: &str| {
        harness.state().shared.workbench.project.documents.field(path, "strength").unwrap()
    };
    assert_eq!(strength(&harness, "ropes/sink-3-8.toml"), "2,600 lbf");
    assert_eq!(strength(&harness, "ropes/nylon-1-2.toml"), "25 kN");
    assert!(
        harness.query_by_label("Recover").is_none()
            && !data.join("recovery-4294967295.json").exists()
    );
    harness.state_mut().shared.perform(EditAction::Undo);
    assert!(
        harness.state().shared.workbench.project.documents.unsaved().is_empty(),
        "one undo takes all of it back"
    );
}

#[test]
fn a_button_is_given_to_something_else_by_pressing_it() {
    let folder = Folder::new("mapping");
    let pad = |events: Vec<PadEvent>| {
        Pilot::new(Some(Box::new(ScriptedPad { script: vec![vec![], events].into() })))
    };
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.state_mut().dock = egui_dock::DockState::new(vec![PanelId::PAD.id().to_owned()]);
    harness.run_steps(2);
    harness.get_by_label("right shoulder").click();
    harness.run_steps(2);
    harness.get_by_label("press it …");
    harness.state_mut().shared.pilot = pad(vec![PadEvent::Pressed(PadButton::West)]);
    harness.run_steps(5);
    assert_eq!(
        harness.state().shared.pilot.mapping.of_button(PadButton::West),
        Some(Pressed::Burst)
    );
    harness.get_by_label("X");
    harness.get_by_label("VWES 2012").click();
    harness.run_steps(2);
    assert_eq!(
        harness.state().shared.pilot.mapping.of_button(PadButton::RightShoulder),
        Some(Pressed::Burst)
    );
}

#[test]
fn a_run_is_kept_by_itself_opened_again_to_the_bit_and_branched() {
    let folder = Folder::new("kept-run");
    let mut harness = flown(&folder);
    let end = harness.state().shared.workbench.view().cloned().unwrap();
    let kept = folder.0.join("recordings/hello-endline 0001.endline");
    wait(&mut harness, |_| kept.exists());

    harness.state_mut().shared.perform(RunAction::OpenRecording(kept));
    wait(&mut harness, |app| {
        let view = app.shared.workbench.view().unwrap();
        !Arc::ptr_eq(&view.model, &end.model)
            && view.frame.step == end.frame.step
            && view.status != Status::Running
    });
    assert_eq!(
        harness.state().shared.workbench.view().unwrap().state_hash,
        end.state_hash,
        "the recording runs to the same bits"
    );

    harness.state_mut().shared.perform(TimeAction::Seek(1.0));
    wait(&mut harness, |app| app.shared.workbench.view().is_some_and(|view| view.sought));
    let step = harness.state().shared.workbench.view().unwrap().frame.step;
    harness.state_mut().shared.perform(RunAction::Branch);
    wait(&mut harness, |app| {
        let view = app.shared.workbench.view().unwrap();
        view.status == Status::Paused && !view.sought && view.frame.step == step
    });
    let again = harness.state().shared.workbench.view().cloned().unwrap();
    assert!((again.newest_s - again.frame.time_s).abs() < 1e-9, "what came after is gone");
}

#[test]
fn plots_of_an_encounter_agree_with_its_summary_and_every_panel_draws_it() {
    let folder = Folder::new("plots");
    let mut harness = flown(&folder);
    for layout in Layout::ALL {
        harness.state_mut().shared.give(PanelAction::Arrange(layout));
        harness.run_steps(3);
    }
    for panel in PanelId::ALL {
        harness.state_mut().dock = egui_dock::DockState::new(vec![panel.id().to_owned()]);
        harness.run_steps(2);
    }
    let view = harness.state().shared.workbench.view().cloned().unwrap();
    let summary = view.summary.as_ref().unwrap();
    let tension = Chart::of(Kind::Tension, &view, Units::Si);
    for (curve, line) in tension.curves.iter().zip(&summary.lines) {
        let top = curve.points.iter().map(|[_, y]| *y).fold(0.0, f64::max);
        assert!(
            (top - line.peak_tension_n).abs() < 1e-6 * line.peak_tension_n.max(1.0),
            "{}: {top}, {}",
            curve.name,
            line.peak_tension_n
        );
    }
    let whale = summary.whale.as_ref().unwrap();
    for region in &whale.regions {
        let force = view
            .history
            .samples(Channel::Force(region.part).index())
            .map(|(_, value)| value)
            .fold(0.0, f64::max);
        assert!(
            force <= region.peak_normal_n * (1.0 + 1e-9),
            "{:?}: {force}, {}",
            region.part,
            region.peak_normal_n
        );
    }
    let depth = Chart::of(Kind::Depth, &view, Units::Si);
    assert!((depth.curves[0].points[0][1] + 12.0).abs() < 0.05, "the whale begins at 12 m");
    let along = Chart::of(Kind::Along, &view, Units::Si);
    let rope_m: f64 = view.frame.segment_length_m.iter().sum();
    assert!(
        (along.end_x - rope_m).abs() < 1e-6,
        "one endline of two ropes: {} m of {rope_m} m",
        along.end_x
    );
    let svg = folder.0.join("plots.svg");
    give(&mut harness, PanelAction::ExportPlots(svg.clone()));
    assert!(std::fs::read_to_string(svg).unwrap().contains("Tension of each line"));
    let csv = folder.0.join("plots.csv");
    give(&mut harness, PanelAction::ExportPlots(csv.clone()));
    assert!(std::fs::read_to_string(csv).unwrap().lines().count() > 100);
}

/// Sources of the window: every file under `app/workbench/src/gui` and the session's texts for it.
fn sources(folder: &std::path::Path, found: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn every_letter_of_a_text_on_screen_can_be_drawn() {
    let folder = Folder::new("glyphs");
    let (harness, _) = workbench(&folder, Pilot::default());
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for part in ["src/gui", "src/input", "src/scene", "../session/src"] {
        sources(&root.join(part), &mut files);
    }
    assert!(files.len() > 200, "{}", files.len());
    // What no font has is drawn by one picture, the same for all.
    const UNKNOWN: char = '\u{10fffd}';
    let drawn = |letter: char| {
        let (font, ink) = (egui::FontId::proportional(13.0), egui::Color32::WHITE);
        let galley =
            harness.ctx.fonts_mut(|fonts| fonts.layout_no_wrap(letter.to_string(), font, ink));
        let picture = galley.rows[0].glyphs[0].uv_rect;
        (picture.min, picture.max)
    };
    let mut missing = std::collections::BTreeSet::new();
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let code = text.lines().map(str::trim).filter(|line| !line.starts_with("//"));
        for letter in code.flat_map(str::chars).filter(|letter| !letter.is_ascii()) {
            if drawn(letter) == drawn(UNKNOWN) {
                missing.insert((letter, file.clone()));
            }
        }
    }
    assert!(missing.is_empty(), "drawn as empty boxes: {missing:?}");
}
