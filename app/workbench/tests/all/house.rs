//! Parts of the whole window: menus, layouts, start page, recovery after a crash, recordings, plots, pad, glyphs.

use endline_session::command::{EditAction, RunAction, TimeAction};
use endline_session::workbench::Folders;
use endline_workbench::gui::command::action::PanelAction;
use std::collections::BTreeSet;
use std::fs;
use std::sync::Arc;

use egui_kittest::kittest::Queryable;
use endline_session::edit::recovery::{Autosave, EVERY_S};
use endline_session::export::chart::{Chart, Kind};
use endline_session::live::{Channel, Status};
use endline_session::recording::kept::Kept;
use endline_session::units::Units;
use endline_workbench::gui::layout::{self, Layout};
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::pictures;
use endline_workbench::input::{PadButton, PadEvent, Pilot, Pressed, ScriptedPad};

use crate::common::{Folder, Reach as _, Window, flown, give, only, real, retype, wait, workbench};

#[test]
fn the_window_menu_ticks_open_panels_and_closes_them() {
    let folder = Folder::new("ticks");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    assert!(layout::is_open(&harness.state().dock, PanelId::Tension));
    harness.get_by_label("Window").click();
    harness.run_steps(3);
    harness.get_all_by_label("Tension").last().unwrap().click();
    harness.run_steps(3);
    assert!(!layout::is_open(&harness.state().dock, PanelId::Tension));
}

#[test]
fn edits_of_a_killed_program_are_recovered_and_undone_in_one_step() {
    let folder = Folder::new("killed");
    let data = folder.0.join("data");
    fs::create_dir_all(&data).unwrap();
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.workbench_mut().write_to(Folders { unsaved: Some(data.clone()), ..Folders::default() });
    harness.set("ropes/sink-3-8.toml", "strength", "2,600 lbf");
    harness.set("ropes/nylon-1-2.toml", "strength", "25 kN");
    let kept = data.join(format!("recovery-{}.json", std::process::id()));
    // The clock of the harness advances by a quarter of a second each step.
    for _ in 0..(8.0 * EVERY_S) as usize {
        harness.step();
    }
    wait(&mut harness, |_| kept.exists());
    drop(harness);
    // No process has this id, as if this one had ended.
    fs::rename(kept, data.join("recovery-4294967295.json")).unwrap();

    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.workbench_mut().write_to(Folders { unsaved: Some(data.clone()), ..Folders::default() });
    harness.state_mut().questions.left_behind = Autosave::in_folder(data.clone()).left_behind();
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("Unsaved edits of 2 files").is_some());
    harness.get_by_label("Recover").click();
    harness.run_steps(3);
    let strength =
        |harness: &Window, path: &str| harness.documents().field(path, "strength").unwrap();
    assert_eq!(strength(&harness, "ropes/sink-3-8.toml"), "2,600 lbf");
    assert_eq!(strength(&harness, "ropes/nylon-1-2.toml"), "25 kN");
    assert!(
        harness.query_by_label("Recover").is_none()
            && !data.join("recovery-4294967295.json").exists()
    );
    harness.perform(EditAction::Undo);
    assert!(harness.documents().unsaved().is_empty(), "one undo reverts all recovered edits");
}

#[test]
fn a_button_is_reassigned_by_pressing_it() {
    let folder = Folder::new("mapping");
    let pad = |events: Vec<PadEvent>| {
        Pilot::new(Some(Box::new(ScriptedPad { script: vec![vec![], events].into() })))
    };
    let (mut harness, _) = workbench(&folder, Pilot::default());
    only(&mut harness, PanelId::Pad);
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
fn a_run_is_recorded_automatically_replayed_to_the_bit_and_branched() {
    let folder = Folder::new("kept-run");
    let mut harness = flown(&folder);
    let end = harness.view();
    let kept = folder.0.join("recordings/hello-endline 0001.endline");
    wait(&mut harness, |_| kept.exists());

    harness.perform(RunAction::OpenRecording(kept));
    wait(&mut harness, |app| {
        let view = app.shared.workbench.view().unwrap();
        !Arc::ptr_eq(&view.model, &end.model)
            && view.frame.step == end.frame.step
            && view.status != Status::Running
    });
    assert_eq!(harness.view().state_hash, end.state_hash, "the recording replays to the same bits");

    harness.perform(TimeAction::Seek(1.0));
    wait(&mut harness, |app| app.shared.workbench.view().is_some_and(|view| view.sought));
    let step = harness.view().frame.step;
    harness.perform(RunAction::Branch);
    wait(&mut harness, |app| {
        let view = app.shared.workbench.view().unwrap();
        view.status == Status::Paused && !view.sought && view.frame.step == step
    });
    let again = harness.view();
    assert!((again.newest_s - again.frame.time_s).abs() < 1e-9, "later moments are discarded");
}

#[test]
fn plots_of_an_encounter_agree_with_its_summary_and_every_panel_can_draw_it() {
    let folder = Folder::new("plots");
    let mut harness = flown(&folder);
    for layout in Layout::ALL.iter().copied() {
        harness.state_mut().shared.give(PanelAction::Arrange(layout));
        harness.run_steps(3);
    }
    for panel in PanelId::ALL.iter().copied() {
        only(&mut harness, panel);
    }
    let view = harness.view();
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
    assert!(
        (depth.curves[0].points[0][1] + 12.0).abs() < 0.05,
        "the whale starts at a depth of 12 m"
    );
    let along = Chart::of(Kind::Along, &view, Units::Si);
    let rope_m: f64 = view.frame.segment_length_m.iter().sum();
    assert!(
        (along.end_x - rope_m).abs() < 1e-6,
        "one endline of two ropes: {} m of {rope_m} m",
        along.end_x
    );
    let svg = folder.0.join("plots.svg");
    give(&mut harness, PanelAction::ExportPlots(svg.clone()));
    assert!(fs::read_to_string(svg).unwrap().contains("Tension of each line"));
    let csv = folder.0.join("plots.csv");
    give(&mut harness, PanelAction::ExportPlots(csv.clone()));
    assert!(fs::read_to_string(csv).unwrap().lines().count() > 100);
}

/// Collects the Rust files under a folder.
fn sources(folder: &std::path::Path, found: &mut Vec<std::path::PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn the_fonts_have_every_letter_of_the_sources() {
    let folder = Folder::new("glyphs");
    let (harness, _) = workbench(&folder, Pilot::default());
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for part in ["src/gui", "src/input", "src/scene", "../session/src"] {
        sources(&root.join(part), &mut files);
    }
    assert!(files.len() > 200, "{}", files.len());
    // All letters that no font has are drawn by the same glyph.
    const UNKNOWN: char = '\u{10fffd}';
    let drawn = |letter: char| {
        let (font, ink) = (egui::FontId::proportional(13.0), egui::Color32::WHITE);
        let galley =
            harness.ctx.fonts_mut(|fonts| fonts.layout_no_wrap(letter.to_string(), font, ink));
        let picture = galley.rows[0].glyphs[0].uv_rect;
        (picture.min, picture.max)
    };
    let mut missing = BTreeSet::new();
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let code = text.lines().map(str::trim).filter(|line| !line.starts_with("//"));
        for letter in code.flat_map(str::chars).filter(|letter| !letter.is_ascii()) {
            if drawn(letter) == drawn(UNKNOWN) {
                missing.insert((letter, file.clone()));
            }
        }
    }
    assert!(missing.is_empty(), "missing in the fonts: {missing:?}");
}

#[test]
fn a_button_of_the_start_page_opens_the_gear_it_names() {
    let folder = Folder::new("doors");
    let mut harness = real(&folder, "hello-endline");
    only(&mut harness, PanelId::Start);
    for title in ["Design gear", "Compare for a rule", "Fly, or explain a case"] {
        harness.get_by_label(title);
    }
    // Gear is listed; checks of the physics are folded.
    harness.get_by_label("Gillnet string");
    assert!(harness.query_by_label("A line under tow").is_none());

    harness.get_by_label("Trawl of ten").click();
    wait(&mut harness, |app| {
        app.shared.workbench.project().documents.scenario_path().ends_with("trawl-10.toml")
    });
}

#[test]
fn a_recording_shows_its_outcome_and_can_be_renamed_annotated_and_deleted() {
    let folder = Folder::new("recordings");
    let mut harness = flown(&folder);
    give(&mut harness, RunAction::Reset);
    let kept = folder.0.join("recordings/hello-endline 0001.endline");
    wait(&mut harness, |_| kept.exists());
    only(&mut harness, PanelId::Recordings);
    harness.get_by_label("No contact");
    // The thumbnail is drawn in the background.
    wait(&mut harness, |_| pictures::thumbnail(&kept).is_some());
    let picture = pictures::thumbnail(&kept).unwrap();
    let colours: BTreeSet<[u8; 4]> = picture.pixels.iter().map(|pixel| pixel.to_array()).collect();
    assert!(
        picture.size == [256, 144] && colours.len() > 100,
        "{:?} {}",
        picture.size,
        colours.len()
    );
    let known = Kept::beside(&kept).unwrap();
    assert!((known.simulated_s - 2.0).abs() < 1e-9 && known.of == "hello-endline", "{known:?}");

    retype(&mut harness, "hello-endline 0001", "first flight");
    let renamed = kept.with_file_name("first flight.endline");
    wait(&mut harness, |_| renamed.exists());
    assert!(!kept.exists() && pictures::thumbnail(&renamed).is_some());
    harness.run_steps(2);
    retype(&mut harness, "", "too far to starboard");
    wait(&mut harness, |_| Kept::beside(&renamed).unwrap().note == "too far to starboard");
    assert_eq!(Kept::beside(&renamed).unwrap().of, known.of);

    harness.get_by_label("Delete").click();
    wait(&mut harness, |_| !renamed.exists());
    assert!(fs::exists(folder.0.join("recordings/deleted/first flight.endline")).unwrap());
    harness.run_steps(2);
    harness.get_by_label("No runs yet.");
}
