//! The scenario edited in the window: start of the whale dragged in the view, fields and choices of the panel, questions before edits
//! are lost; wraps of a whale.

use egui_kittest::kittest::Queryable;
use endline_sdk::BodyPart;
use endline_session::command::{EditAction, RunAction};
use endline_session::edit::Documents;
use endline_session::encounters::meet::{Meeting, USUAL_GAP_M, meet};
use endline_session::live::Status;
use endline_session::units::Units;
use endline_workbench::gui::command::action::ViewAction;
use endline_workbench::gui::inspector::wraps;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::gui::panels::view::pose::Start;
use endline_workbench::scene::View;

use crate::common::{Folder, Reach as _, Window, drag, give, only, real, retype, wait};

/// The workbench with one panel, after the statics of a scenario.
fn settled(folder: &Folder, scenario: &str, panel: PanelId) -> Window {
    let mut harness = real(folder, scenario);
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Paused));
    only(&mut harness, panel);
    harness
}

#[test]
fn the_start_of_the_whale_is_dragged_in_the_view_and_each_drag_is_one_undo() {
    let folder = Folder::new("pose");
    let mut harness = settled(&folder, "hello-endline", PanelId::View);
    let start = |harness: &Window| Start::of(harness.documents()).unwrap();
    let before = start(&harness);
    harness.get_by_label("Start pose").click();
    harness.run_steps(3);
    give(&mut harness, ViewAction::Look(View::Top));
    harness.run_steps(3);
    let middle = harness.get_by_label("Start place").rect().center();
    drag(&mut harness, middle, middle + egui::vec2(40.0, -25.0));
    let moved = start(&harness);
    let metres =
        f64::from(40.0_f32) * harness.state().panels.view.eyes[0].camera.metres_a_point(800.0);
    assert!(
        moved.place.x - before.place.x > 0.3 * metres && moved.place.y > before.place.y,
        "east and north: {moved:?}"
    );
    assert!(
        (moved.place.z - before.place.z).abs() < 1e-9
            && (moved.heading - before.heading).abs() < 1e-9,
        "{moved:?}"
    );
    wait(&mut harness, |app| {
        app.shared
            .workbench
            .view()
            .and_then(|view| view.model.spec.whale.as_ref())
            .is_some_and(|whale| (whale.position_m - moved.place).length() < 1e-6)
    });

    let snout = harness.get_by_label("Start heading").rect().center();
    let middle = harness.get_by_label("Start place").rect().center();
    // North is up in the top view, so a snout to the right of the middle points east.
    drag(&mut harness, snout, middle + egui::vec2((snout - middle).length(), 0.0));
    let rotated = start(&harness);
    assert!((rotated.heading.to_degrees() - 90.0).abs() < 3.0, "{rotated:?}");
    for _ in 0..2 {
        harness.perform(EditAction::Undo);
    }
    assert_eq!(start(&harness), before);
    assert!(harness.documents().unsaved().is_empty());
}

#[test]
fn fields_choices_and_flags_of_the_panel_change_the_scenario() {
    let folder = Folder::new("scenario-fields");
    let mut harness = settled(&folder, "hello-endline", PanelId::Scenario);
    retype(&mut harness, "12 m", "9 m");
    let field =
        |harness: &Window, field: &str| harness.documents().field(Documents::SCENARIO, field);
    assert_eq!(field(&harness, "whale.depth").as_deref(), Some("9 m"));
    harness.get_by_label("Ropes touch each other").scroll_to_me();
    harness.run_steps(3);
    harness.get_by_label("Ropes touch each other").click();
    harness.run_steps(3);
    assert_eq!(field(&harness, "rope_on_rope").as_deref(), Some("false"));
    harness.perform(EditAction::Undo);
    assert_eq!(field(&harness, "rope_on_rope"), None);
    assert!(!harness.documents().any_error(), "{:?}", harness.documents().problems());
    for head in ["SEA", "TIDE THAT TURNS", "WAVES", "WHALE", "FRICTION OF ROPE ON WHALE", "RUN"] {
        assert!(harness.query_by_label(head).is_some(), "{head} is on screen");
    }
    harness.get_by_label("Pilot program …").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("Timeline").is_some());
}

#[test]
fn the_start_is_placed_for_a_flipper_to_meet_the_endline() {
    let folder = Folder::new("aim");
    let mut harness = settled(&folder, "hello-endline", PanelId::Scenario);
    let before = Start::of(harness.documents()).unwrap();
    let view = harness.view();
    harness.get_by_label("Aim at a line").scroll_to_me();
    harness.run_steps(3);
    harness.get_by_label("Aim at a line").click();
    harness.run_steps(12);
    harness.get_by_label("Place the start").scroll_to_me();
    harness.run_steps(3);
    harness.get_by_label("Place the start").click();
    harness.run_steps(3);
    let meeting = Meeting {
        line: "endline-top".to_owned(),
        depth_m: 10.0,
        part: BodyPart::LeftFlipper,
        gap_m: USUAL_GAP_M,
    };
    let wanted = meet(&view.model, &view.frame, &meeting).unwrap();
    let placed = Start::of(harness.documents()).unwrap();
    assert!((placed.place - wanted.start_m).length() < 0.02, "{placed:?}, {wanted:?}");
    assert!((placed.heading - before.heading).abs() < 1e-9, "the heading is kept");
    // The view with the path came to the front.
    only(&mut harness, PanelId::Scenario);
    assert!(harness.query_by_label_contains("The left flipper meets endline-top").is_some());
    harness.perform(EditAction::Undo);
    assert_eq!(Start::of(harness.documents()).unwrap(), before, "one undo takes it back");
}

#[test]
fn wraps_on_screen_equal_those_of_the_summary() {
    let folder = Folder::new("wraps");
    let mut harness = settled(&folder, "dead-whale-wraps", PanelId::Entanglement);
    for step in 1..=3_u64 {
        harness.perform(RunAction::Step);
        wait(&mut harness, |app| {
            app.shared.workbench.view().is_some_and(|view| view.frame.step >= step)
        });
    }
    let view = harness.view();
    let found = wraps(&view);
    let whale = view.summary.as_ref().unwrap().whale.as_ref().unwrap();
    let wound: Vec<_> = whale.regions.iter().filter(|region| region.wraps >= 0.25).collect();
    assert!(!wound.is_empty() && wound.len() == found.len(), "{found:?}");
    for region in wound {
        let wrap = found.iter().find(|wrap| wrap.part == region.part).unwrap();
        assert!((wrap.turns - region.wraps).abs() < 1e-12, "{wrap:?}");
        assert!(
            (wrap.touching_m - region.contact_length_m).abs() < 1e-9,
            "{wrap:?}, {} m",
            region.contact_length_m
        );
        if region.wraps >= 0.5 {
            assert!(wrap.since_s.is_some(), "its start is missing: {wrap:?}");
        }
    }
    assert!(found.windows(2).all(|pair| pair[0].turns >= pair[1].turns), "most turns first");
    assert!(harness.query_by_label("WRAPS AT THIS MOMENT").is_some());
}

#[test]
fn save_as_does_not_change_the_first_file() {
    let folder = Folder::new("save-as");
    let mut harness = settled(&folder, "reference-a-pendulum", PanelId::Scenario);
    let first = harness.documents().scenario_path().to_owned();
    let before = std::fs::read_to_string(&first).unwrap();
    harness.set(Documents::SCENARIO, "duration", "7 s");
    let other = folder.0.join("scenarios/my-pendulum.toml");
    harness.perform(EditAction::SaveScenarioAs(other.clone()));
    assert_eq!(std::fs::read_to_string(&first).unwrap(), before);
    assert!(std::fs::read_to_string(&other).unwrap().contains("7 s"));
    let shared = &harness.state().shared;
    assert!(
        shared.workbench.project().documents.scenario_path() == other
            && shared.workbench.project().documents.unsaved().is_empty()
    );
    assert_eq!(shared.workbench.preferences().recent.first(), Some(&other));
}

#[test]
fn weak_links_and_friction_are_edited_without_loss_of_comments_and_undone() {
    let folder = Folder::new("links-friction");
    let mut harness = settled(&folder, "hello-weak-link", PanelId::Scenario);
    let before = harness.documents().text(Documents::SCENARIO).unwrap().to_owned();
    let field =
        |harness: &Window, field: &str| harness.documents().field(Documents::SCENARIO, field);
    click(&mut harness, "Add a weak link ⏷");
    click(&mut harness, "at the foot of endline");
    assert_eq!(
        ["line", "end", "rating"].map(|key| field(&harness, &format!("link.1.{key}")).unwrap()),
        ["endline", "from", "600 lbf"]
    );
    retype(&mut harness, "600 lbf", "1,700 furlong");
    assert!(harness.query_by_label_contains("furlong").is_some(), "the reason is beside the field");
    retype(&mut harness, "1,700 furlong", "1,700 lbf");
    assert!(!harness.documents().any_error(), "{:?}", harness.documents().problems());
    click(&mut harness, "Another law for … ⏷");
    click(&mut harness, "baleen");
    assert_eq!(field(&harness, "friction.on.0.surfaces.0").as_deref(), Some("baleen"));

    harness.alter(Documents::SCENARIO, |text| {
        let value = endline_gear::Setting::plain("1.25");
        text.put("friction.attributes.coefficient_scale", &value).map_err(|error| error.to_string())
    });
    harness.run_steps(3);
    retype(&mut harness, "1.25", "-3");
    harness.perform(RunAction::Apply);
    wait(&mut harness, |app| {
        !app.shared.workbench.making()
            && !app.shared.workbench.project().model_problems().is_empty()
    });
    let wrong = harness
        .workbench()
        .project()
        .problem_at(Documents::SCENARIO, "friction.attributes.coefficient_scale")
        .unwrap();
    assert!(wrong.line > 0, "{wrong}");
    retype(&mut harness, "-3", "1.5");
    harness.perform(RunAction::Apply);
    wait(&mut harness, |app| {
        let made = app.shared.workbench.view().map_or(0, |view| view.model.spec.links.len());
        !app.shared.workbench.making() && !app.shared.workbench.stale() && made > 1
    });
    let view = harness.view();
    let ratings: Vec<f64> = view.model.spec.links.iter().map(|link| link.rating_n).collect();
    assert!((ratings[1] - 1700.0 * endline_session::units::N_PER_LBF).abs() < 1e-6, "{ratings:?}");
    let text = harness.documents().text(Documents::SCENARIO).unwrap();
    assert!(text.contains("# The snagged trap.") && text.contains("# A poly ball A-5."), "{text}");
    while harness.documents().can_undo_redo().0 {
        harness.perform(EditAction::Undo);
    }
    assert_eq!(harness.documents().text(Documents::SCENARIO), Some(before.as_str()));
}

#[test]
fn unsaved_edits_are_asked_about_before_another_scenario_is_opened() {
    let folder = Folder::new("opened-over");
    let mut harness = settled(&folder, "reference-a-pendulum", PanelId::Scenario);
    let first = harness.documents().scenario_path().to_owned();
    let other = folder.0.join("scenarios/hello-endline.toml");
    harness.set(Documents::SCENARIO, "duration", "7 s");
    for (answer, opened, on_disk) in [("Stay", &first, false), ("Save and open", &other, true)] {
        harness.state_mut().shared.give(EditAction::OpenScenario(other.clone()));
        harness.run_steps(3);
        assert_eq!(harness.documents().scenario_path(), first, "it asks first");
        click(&mut harness, answer);
        assert_eq!(harness.documents().scenario_path(), opened, "{answer}");
        assert_eq!(std::fs::read_to_string(&first).unwrap().contains("7 s"), on_disk, "{answer}");
    }
    harness.set(Documents::SCENARIO, "duration", "9 s");
    harness.state_mut().shared.give(EditAction::OpenScenario(first.clone()));
    harness.run_steps(3);
    click(&mut harness, "Open without saving");
    assert_eq!(harness.documents().scenario_path(), first);
    assert!(!std::fs::read_to_string(&other).unwrap().contains("9 s"));
    // Without unsaved edits there is no question.
    harness.state_mut().shared.give(EditAction::OpenScenario(other.clone()));
    harness.run_steps(3);
    assert_eq!(harness.documents().scenario_path(), other);
}

#[test]
fn a_file_changed_on_disk_is_asked_about_before_it_is_overwritten() {
    let folder = Folder::new("changed-on-disk");
    let mut harness = settled(&folder, "reference-a-pendulum", PanelId::Scenario);
    let file = harness.documents().scenario_path().to_owned();
    let on_disk = || std::fs::read_to_string(&file).unwrap();
    let first = on_disk();
    for (answer, mine, theirs, kept) in [
        ("Not now", "7 s", "# A colleague's note.\n", false),
        ("Keep both", "8 s", "# Another note.\n", false),
        ("Keep mine", "9 s", "# A third note.\n", true),
    ] {
        harness.set(Documents::SCENARIO, "duration", mine);
        std::fs::write(&file, first.clone() + theirs).unwrap();
        harness.state_mut().shared.give(EditAction::Save);
        harness.run_steps(3);
        assert!(!on_disk().contains(mine), "it asks first");
        harness.get_by_label_contains(theirs.trim());
        click(&mut harness, answer);
        assert_eq!(on_disk().contains(mine), kept, "{answer}");
        assert_eq!(on_disk().contains(theirs), !kept, "{answer}");
    }
    let beside = file.with_file_name("reference-a-pendulum-mine.toml");
    assert!(std::fs::read_to_string(beside).unwrap().contains("8 s"));
}

/// Scrolls to a label and clicks it.
fn click(harness: &mut Window, label: &str) {
    harness.get_by_label(label).scroll_to_me();
    harness.run_steps(3);
    harness.get_by_label(label).click();
    harness.run_steps(3);
}

#[test]
fn a_field_shows_its_value_in_the_selected_units_and_keeps_its_own() {
    let folder = Folder::new("field-units");
    let mut harness = real(&folder, "hello-endline");
    harness.workbench_mut().set_units(Units::Noaa);
    only(&mut harness, PanelId::Scenario);
    harness.get_all_by_value("0.25 m/s").next().unwrap().hover();
    harness.run_steps(60);
    harness.get_by_label_contains("0.25 m/s is 0.49 kn");
    let documents = harness.documents();
    assert_eq!(documents.field(Documents::SCENARIO, "current.speed").as_deref(), Some("0.25 m/s"));
}
