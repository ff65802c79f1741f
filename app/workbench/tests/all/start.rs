//! Where a user begins, and what is kept: the start page and the list of recordings.

use std::collections::BTreeSet;
use std::fs;

use egui_kittest::kittest::Queryable;
use endline_session::command::RunAction;
use endline_session::live::engine;
use endline_session::recording::kept::Kept;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::pictures;
use endline_workbench::input::Pilot;

use crate::common::{Folder, flown, give, linked, only, opened_with, retype, wait};

#[test]
fn a_door_opens_the_gear_it_names() {
    let folder = Folder::new("doors");
    let documents = folder.book_with("hello-endline");
    let mut harness = opened_with(documents, linked(), engine::live(), Pilot::default());
    only(&mut harness, PanelId::START);
    for title in ["Design gear", "Compare for a rule", "Fly, or explain a case"] {
        harness.get_by_label(title);
    }
    // Gear alone is no check of the physics, which are folded away.
    harness.get_by_label("Ten-trap trawl, nearshore");
    assert!(harness.query_by_label("A line under tow").is_none());

    harness.get_by_label("Trawl of ten").click();
    wait(&mut harness, |app| {
        app.shared.workbench.project.documents.scenario_path().ends_with("trawl-10.toml")
    });
}

#[test]
fn a_recording_tells_how_it_ended_and_takes_a_name_and_a_note() {
    let folder = Folder::new("recordings");
    let mut harness = flown(&folder);
    give(&mut harness, RunAction::Reset);
    let kept = folder.0.join("recordings/hello-endline 0001.endline");
    wait(&mut harness, |_| kept.exists());
    only(&mut harness, PanelId::RECORDINGS);
    harness.get_by_label("No contact");
    // How it ended, drawn meanwhile.
    wait(&mut harness, |_| pictures::of_recording(&kept).is_some());
    let picture = pictures::of_recording(&kept).unwrap();
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
    assert!(!kept.exists() && pictures::of_recording(&renamed).is_some());
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
