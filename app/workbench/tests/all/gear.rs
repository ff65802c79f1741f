//! Library tables exported, imported, edited and compared; assemblies edited with their statics.

use egui_kittest::kittest::Queryable;
use endline_gear::Kind;
use endline_session::command::EditAction;
use endline_session::edit::Documents;
use endline_session::edit::library_table::{import, to_csv};
use endline_session::statics::TrialGear;
use endline_workbench::gui::command::action::PanelAction;
use endline_workbench::gui::fields::{edit_id, go_to};
use endline_workbench::gui::panel::PanelId;
use endline_workbench::input::Pilot;

use crate::common::{Folder, Reach as _, Window, give, on_disk, only, real, wait, workbench};

fn paths(documents: &Documents) -> Vec<String> {
    documents.files("ropes").map(str::to_owned).collect()
}

#[test]
fn an_exported_table_imported_again_changes_nothing() {
    let folder = Folder::new("csv-same");
    let mut documents = folder.documents();
    let csv = to_csv(&documents, Kind::Rope, &paths(&documents));
    assert!(csv.lines().count() >= 20 && csv.contains("\"2,700 lbf\""), "{csv}");
    let imported = import(&mut documents, Kind::Rope, &csv).unwrap();
    assert_eq!(
        (imported.changed, imported.added, imported.left_out.len()),
        (0, 0, 0),
        "{imported:?}"
    );
    assert!(documents.unsaved().is_empty());
}

#[test]
fn an_import_changes_adds_and_reports_what_it_omits_and_is_one_undo() {
    let folder = Folder::new("csv-in");
    let mut documents = folder.documents();
    let before = to_csv(&documents, Kind::Rope, &paths(&documents));
    let table = "id,Name,Diameter,Strength,Colour\nsink-3-8,,,\"2,650 lbf\",red\nmill-7,Mill 7,3/8 in,\"1,700 lbf\",\n,,1 in,,\n";
    let imported = import(&mut documents, Kind::Rope, table).unwrap();
    assert_eq!((imported.changed, imported.added), (1, 1));
    assert!(
        imported.left_out[0].contains("Colour") && imported.left_out[1].contains("row 4"),
        "{imported:?}"
    );
    assert_eq!(documents.field("ropes/sink-3-8.toml", "strength").as_deref(), Some("2,650 lbf"));
    assert_eq!(documents.field("ropes/mill-7.toml", "diameter").as_deref(), Some("3/8 in"));
    assert!(
        documents.text("ropes/sink-3-8.toml").unwrap().contains("# Hydrodynamic coefficients"),
        "comments are kept"
    );
    let missing = documents
        .problems()
        .iter()
        .filter(|problem| problem.file == "ropes/mill-7.toml" && problem.is_error())
        .count();
    assert!(missing > 3, "missing figures are not reported: {missing}");
    assert!(documents.undo());
    assert_eq!(to_csv(&documents, Kind::Rope, &paths(&documents)), before);
    assert!(
        import(&mut documents, Kind::Rope, "one,two\n1,2\n").is_err(),
        "a table without a header is refused"
    );
}

#[test]
fn cells_pasted_from_a_spreadsheet_fill_cells_from_the_focus_on() {
    let folder = Folder::new("paste");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    let file =
        |harness: &Window, path: &str, key: &str| harness.documents().field(path, key).unwrap();
    harness.state_mut().panels.library.search = "polypropylene 5/16".into();
    harness.run_steps(2);
    harness.get_all_by_value("5/16 in").next().unwrap().click();
    harness.run_steps(2);
    harness.event(egui::Event::Paste("8 mm\t0.03 kg/m\n".into()));
    harness.run_steps(3);
    assert_eq!(file(&harness, "ropes/pp-5-16.toml", "diameter"), "8 mm");
    assert_eq!(file(&harness, "ropes/pp-5-16.toml", "mass"), "0.03 kg/m");
    harness.perform(EditAction::Undo);
    assert_eq!(file(&harness, "ropes/pp-5-16.toml", "diameter"), "5/16 in");
}

#[test]
fn a_copy_is_compared_with_its_original_and_uses_are_listed() {
    let folder = Folder::new("compare");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    harness.state_mut().panels.library.chosen = Some("ropes/sink-3-8.toml".into());
    harness.run_steps(3);
    assert!(harness.query_by_label("assemblies/single.toml").is_some(), "where it is used");
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::D);
    harness.run_steps(3);
    let copy = harness.state().panels.library.chosen.clone().unwrap();
    assert_eq!(copy, "ropes/sink-3-8-2.toml");
    assert!(harness.query_by_label("no difference").is_some());
    harness.set(&copy, "strength", "1,350 lbf");
    harness.run_steps(3);
    assert!(harness.query_by_label("-50.0 %").is_some());
    assert!(harness.query_by_label("no assembly and no scenario").is_some());
}

/// The workbench with the assembly panel only, after its statics have converged.
fn assembly(folder: &Folder) -> Window {
    let mut harness = real(folder, "hello-endline");
    only(&mut harness, PanelId::Assembly);
    wait(&mut harness, |app| app.panels.assembly.settled());
    harness
}

/// Greatest tension of the gear shown at slack and at running tide [N].
fn tensions(harness: &Window) -> [f64; 2] {
    harness.state().panels.assembly.answers().map(|answer| {
        let rest = answer.unwrap().as_ref().unwrap();
        assert!(rest.shape.converged, "{}", rest.shape.outcome);
        rest.shape.lines.iter().flat_map(|line| &line.tension_N).copied().fold(0.0, f64::max)
    })
}

#[test]
fn the_statics_at_slack_and_running_tide_follow_the_scope() {
    let folder = Folder::new("statics");
    let mut harness = assembly(&folder);
    let [slack, running] = tensions(&harness);
    assert!(running > 2.0 * slack, "the tide pulls: {slack} N, {running} N");
    let length = |harness: &Window| {
        let rest = harness.state().panels.assembly.answers()[0].unwrap().as_ref().unwrap().clone();
        rest.shape.lines.iter().map(|line| line.length_m).sum::<f64>()
    };
    assert!((length(&harness) - 1.3 * 25.0).abs() < 0.1, "{}", length(&harness));
    for scope in ["1.5", "1.8", "2"] {
        harness.state_mut().shared.set_held("assemblies/single.toml", "attributes.scope", scope);
    }
    harness.run_steps(2);
    wait(&mut harness, |app| app.panels.assembly.settled());
    assert!((length(&harness) - 2.0 * 25.0).abs() < 0.1, "{}", length(&harness));
    harness.perform(EditAction::Undo);
    let scope = harness.documents().field("assemblies/single.toml", "attributes.scope");
    assert_eq!(scope.as_deref(), Some("1.3"), "a drag of the slider is one edit");
}

#[test]
fn weak_inserts_every_sixty_feet_are_saved_without_changing_anything_else() {
    let folder = Folder::new("inserts");
    let mut harness = assembly(&folder);
    harness.get_all_by_label("Put in").last().unwrap().click();
    harness.run_steps(2);
    wait(&mut harness, |app| app.panels.assembly.settled());
    let rest = harness.state().panels.assembly.answers()[0].unwrap().as_ref().unwrap().clone();
    let inserts: Vec<&str> = rest
        .shape
        .lines
        .iter()
        .map(|line| line.id.as_str())
        .filter(|id| id.contains(".insert-"))
        .collect();
    assert_eq!(
        inserts.len(),
        1,
        "one insert fits into the top three quarters, 16 m of 21.7 m: {inserts:?}"
    );
    let before = on_disk(&folder, "scenarios/hello-endline.toml");
    harness.perform(EditAction::Save);
    let after = on_disk(&folder, "scenarios/hello-endline.toml");
    assert!(after.contains("every = \"60 ft\"") && after.contains("within = 0.75"), "{after}");
    assert!(after.contains("# The tide runs to the east"), "comments are kept: {after}");
    harness.perform(EditAction::Undo);
    harness.perform(EditAction::Save);
    assert_eq!(on_disk(&folder, "scenarios/hello-endline.toml"), before);
}

#[test]
fn weak_places_are_added_listed_and_taken_out_in_the_panel() {
    let folder = Folder::new("weak-places");
    let mut harness = assembly(&folder);
    let click = |harness: &mut Window, label: &str| {
        harness.get_all_by_label(label).last().unwrap().click();
        harness.run_steps(2);
        wait(harness, |app| app.panels.assembly.settled());
        harness.run_steps(2);
    };
    let places = |harness: &Window| {
        let rest = harness.state().panels.assembly.answers()[0].unwrap().as_ref().unwrap().clone();
        rest.model.spec.lines.iter().map(|line| line.weak_places.len()).sum::<usize>()
    };
    assert_eq!(places(&harness), 0);
    click(&mut harness, "Weak places");
    // 30 ft of 21.7 m; the next would be at 27.4 m.
    assert_eq!(places(&harness), 1);
    click(&mut harness, "As a list");
    let field = "gear.0.lines.endline-top.weak_places";
    let at = harness.documents().field(Documents::SCENARIO, &format!("{field}.at"));
    assert_eq!((at.as_deref(), places(&harness)), (Some("[\"9.14 m\"]"), 1));
    click(&mut harness, "At intervals");
    let every = harness.documents().field(Documents::SCENARIO, &format!("{field}.every"));
    assert_eq!((every.as_deref(), places(&harness)), (Some("60 ft"), 1));
    click(&mut harness, "Take out");
    assert!(!harness.documents().has(Documents::SCENARIO, field) && places(&harness) == 0);
}

#[test]
fn inserts_are_spaced_along_the_whole_endline_and_a_wrong_share_keeps_form_and_drawing() {
    let folder = Folder::new("whole-endline");
    let mut harness = assembly(&folder);
    harness.get_by_label("Put in every 60 ft").click();
    harness.run_steps(2);
    wait(&mut harness, |app| app.panels.assembly.settled());
    let inserts = |harness: &Window| {
        let rest = harness.state().panels.assembly.answers()[0].unwrap().as_ref().unwrap().clone();
        rest.shape.lines.iter().filter(|line| line.id.contains(".insert-")).count()
    };
    // The top three quarters are 24.4 m of 32.5 m of rope in two lines: inserts at 12 ft and 72 ft.
    assert_eq!(inserts(&harness), 2);

    let (file, within) = ("assemblies/single.toml", "lines.endline-top.inserts.within");
    let set = |harness: &mut Window, text: &str| {
        harness.set(file, within, text);
        harness.run_steps(2);
        wait(harness, |app| app.panels.assembly.settled());
        harness.run_steps(2);
    };
    set(&mut harness, "75 %");
    assert_eq!(inserts(&harness), 2, "a percentage is a share");
    set(&mut harness, "75 furlong");
    let answer = harness.state().panels.assembly.answers()[0].unwrap().clone();
    assert!(answer.is_err(), "a length is not a share");
    assert!(harness.query_all_by_label("Within top").next().is_some(), "the form is kept");
    assert!(
        harness.query_all_by_label_contains("last result").next().is_some(),
        "the drawing is not marked as outdated"
    );
}

#[test]
fn a_line_is_split_with_a_splice_and_the_statics_converge() {
    let folder = Folder::new("split");
    let mut harness = assembly(&folder);
    give(&mut harness, PanelAction::Assembly("massachusetts-single".to_owned()));
    harness.run_steps(2);
    wait(&mut harness, |app| app.panels.assembly.settled());
    let lines = |harness: &Window| {
        let rest = harness.state().panels.assembly.answers()[0].unwrap().as_ref().unwrap().clone();
        assert!(rest.shape.converged, "{}", rest.shape.outcome);
        rest.shape.lines.len()
    };
    let before = lines(&harness);
    harness.get_all_by_label("Split").last().unwrap().click();
    harness.run_steps(2);
    wait(&mut harness, |app| app.panels.assembly.settled());
    assert_eq!(lines(&harness), before + 1);
    let field = |harness: &Window, field: &str| {
        harness.documents().field("assemblies/massachusetts-single.toml", field).unwrap()
    };
    assert_eq!(
        (field(&harness, "line.0.length"), field(&harness, "line.2.length")),
        ("4.05 m".to_owned(), "4.05 m".to_owned())
    );
}

fn gear_shown(harness: &Window) -> Option<TrialGear> {
    let app = harness.state();
    app.panels.assembly.shown(&app.shared)
}

#[test]
fn a_scenario_with_its_own_parts_shows_them_and_accepts_inserts() {
    let folder = Folder::new("own-parts");
    let mut harness = assembly(&folder);
    give(&mut harness, PanelAction::Assembly("massachusetts-single".to_owned()));
    // An opened scenario shows its own gear, whatever was selected before.
    let held = folder.0.join("scenarios/study-endline-held.toml");
    harness.perform(EditAction::OpenScenario(held));
    harness.run_steps(2);
    assert_eq!(gear_shown(&harness), Some(TrialGear::Own));
    wait(&mut harness, |app| app.panels.assembly.settled());
    let lines = |harness: &Window| -> Vec<String> {
        let rest = harness.state().panels.assembly.answers()[1].unwrap().as_ref().unwrap().clone();
        assert!(rest.shape.converged && rest.model.spec.whale.is_none(), "{}", rest.shape.outcome);
        rest.shape.lines.iter().map(|line| line.id.clone()).collect()
    };
    assert_eq!(lines(&harness), ["endline-bottom", "endline-top"]);
    let [slack, running] = tensions(&harness);
    assert!(running > slack, "the tide pulls: {slack} N, {running} N");
    harness.run_steps(1);
    assert!(
        harness.query_all_by_label("600 lbf").next().is_some(),
        "the rating of the link is on screen"
    );

    harness.get_by_label("Put in every 60 ft").click();
    harness.run_steps(2);
    wait(&mut harness, |app| app.panels.assembly.settled());
    let pieces = lines(&harness);
    let inserts = pieces.iter().filter(|id| id.contains(".insert-")).count();
    // The top three quarters of 32.5 m of endline contain 12 ft and 72 ft from the buoy.
    assert_eq!(inserts, 2, "{pieces:?}");
    let documents = harness.documents();
    assert!(documents.has(Documents::SCENARIO, "line.1.inserts"));
    assert!(documents.problems().is_empty(), "{:?}", documents.problems());
    assert_eq!(documents.unsaved(), [Documents::SCENARIO], "only the scenario is edited");
}

#[test]
fn two_assemblies_are_compared_and_a_gear_type_starts_a_new_one() {
    let folder = Folder::new("two-gears");
    let mut harness = assembly(&folder);
    harness.state_mut().panels.assembly.other = Some("single-high-flyer".into());
    harness.run_steps(2);
    wait(&mut harness, |app| app.panels.assembly.settled());
    harness.run_steps(2);
    assert!(
        harness.query_all_by_label("surface-line").next().is_some(),
        "the table has the lines of the other gear"
    );
    harness.get_by_label("New ⏷").click();
    harness.run_steps(3);
    harness.get_all_by_label_contains("Trawl").last().unwrap().click();
    harness.run_steps(2);
    wait(&mut harness, |app| app.panels.assembly.settled());
    let usual = "Weak link, 600 lbf (usual)";
    let shown = harness.query_all_by_value(usual).next().is_some();
    assert!(shown, "{usual}: what a new gear has unless another is chosen");
    let model = folder.0.join("gear.stl");
    give(&mut harness, PanelAction::ExportModel(model.clone()));
    let bytes = std::fs::read(model).unwrap();
    let triangles = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize;
    assert!(triangles > 1000 && bytes.len() == 84 + 50 * triangles, "{triangles} triangles");
    let shared = &harness.state().shared;
    assert!(
        harness.state().panels.assembly.answers()[0].unwrap().is_ok(),
        "{:?}",
        harness.state().panels.assembly.answers()[0].unwrap().as_ref().err()
    );
    assert!(
        shared
            .workbench
            .project()
            .documents
            .unsaved()
            .iter()
            .any(|path| path.starts_with("assemblies/my-")),
        "{:?}",
        shared.workbench.project().documents.unsaved()
    );
}

#[test]
fn an_impossible_fraction_is_reported_at_its_place_with_the_nearest_size() {
    let folder = Folder::new("fraction");
    let mut documents = folder.documents();
    // A size in the report of 2012 that does not exist.
    documents.set("ropes/sink-3-8.toml", "diameter", "5/17 in").unwrap();
    let problem = documents.problem_at("ropes/sink-3-8.toml", "diameter").unwrap();
    assert!(
        problem.is_error() && problem.line > 0 && problem.message.contains("5/17 in"),
        "{problem}"
    );
    assert!(problem.help.contains("the nearest is 5/16 in"), "{problem}");
    for size in ["5/16 in", "1 1/2 in", "11/64 in", "0.3 in", "8 mm"] {
        documents.set("ropes/sink-3-8.toml", "diameter", size).unwrap();
        assert!(
            documents
                .problem_at("ropes/sink-3-8.toml", "diameter")
                .is_none_or(|problem| !problem.message.contains("no size")),
            "{size}"
        );
    }
}

#[test]
fn the_table_of_whales_shows_source_and_confidence_of_every_figure() {
    let folder = Folder::new("whales");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    only(&mut harness, PanelId::Library);
    harness.get_by_label("Whales").click();
    harness.run_steps(2);
    let whale = harness.documents().files("whales").next().unwrap().to_owned();
    harness.state_mut().panels.library.chosen = Some(whale.clone());
    harness.run_steps(3);
    let library = harness.documents().library().clone();
    let entry = library
        .entry(Kind::Whale, whale.trim_start_matches("whales/").trim_end_matches(".toml"))
        .unwrap();
    let documents = harness.documents();
    let own = |key: &str| documents.field(&whale, &format!("{key}.source"));
    let sourced = entry.figures.iter().filter(|(field, _)| own(field.key).is_some()).take(3);
    let mut seen = 0;
    for (_, figure) in sourced {
        for text in [figure.source.as_str(), figure.confidence.word()] {
            assert!(harness.query_all_by_value(text).next().is_some(), "{text}");
        }
        seen += 1;
    }
    assert_eq!(seen, 3);
}

#[test]
fn gear_is_selected_by_its_picture() {
    let folder = Folder::new("pictures");
    let mut harness = real(&folder, "hello-endline");
    only(&mut harness, PanelId::Assembly);
    harness.get_by_label("Pictures").click();
    harness.run_steps(3);
    let name = harness.documents().field("assemblies/single.toml", "name").unwrap();
    harness.get_all_by_label(&name).last().unwrap().click();
    harness.run_steps(3);
    assert_eq!(gear_shown(&harness), Some(TrialGear::Assembly("single".to_owned())));
    assert!(!harness.state().panels.assembly.selecting, "the selection by picture is closed");
}

/// File of the library whose field has the focus.
fn focused(harness: &Window, kind: Kind, key: &str) -> Option<String> {
    let focused = harness.ctx.memory(|memory| memory.focused())?;
    let documents = harness.documents();
    documents.files(kind.folder()).find(|path| edit_id(path, key) == focused).map(str::to_owned)
}

#[test]
fn keys_move_between_cells_as_in_a_spreadsheet_and_a_plain_number_gets_the_unit_of_its_cell() {
    let folder = Folder::new("table-keys");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    only(&mut harness, PanelId::Library);
    let first = "ropes/sink-3-8.toml";
    let documents = harness.documents();
    go_to(&harness.ctx, documents, first, "strength");
    harness.run_steps(2);
    // The content is selected, so that typing replaces it.
    harness.event(egui::Event::Text("2345".to_owned()));
    harness.run_steps(1);
    harness.key_press(egui::Key::Enter);
    harness.run_steps(3);
    let documents = harness.documents();
    assert_eq!(documents.field(first, "strength").as_deref(), Some("2345 lbf"));
    let below = focused(&harness, Kind::Rope, "strength").expect("no cell has the focus");
    assert_ne!(below, first);
    harness.key_press(egui::Key::ArrowUp);
    harness.run_steps(3);
    assert_eq!(focused(&harness, Kind::Rope, "strength").as_deref(), Some(first));
    harness.key_press(egui::Key::Tab);
    harness.run_steps(3);
    assert_eq!(focused(&harness, Kind::Rope, "strength"), None, "Tab moves to the next cell");

    // Ctrl+Z undoes the last edit in a cell without typed text; in a cell with typed text it undoes typing.
    let strength = |harness: &Window| harness.documents().field(first, "strength");
    let undo = |harness: &mut Window| {
        harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
        harness.run_steps(2);
    };
    harness.event(egui::Event::Text("9".to_owned()));
    harness.run_steps(1);
    undo(&mut harness);
    assert_eq!(strength(&harness).as_deref(), Some("2345 lbf"));
    harness.key_press(egui::Key::Escape);
    harness.run_steps(2);
    let documents = harness.documents();
    go_to(&harness.ctx, documents, first, "diameter");
    harness.run_steps(2);
    undo(&mut harness);
    assert_eq!(strength(&harness).as_deref(), Some("2,700 lbf"));

    // Three presses in one slow frame are three undos.
    let before = harness.documents().texts().clone();
    for number in 1..=3 {
        harness.set(first, "strength", &format!("{number}000 lbf"));
    }
    let press = egui::Event::Key {
        key: egui::Key::Z,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: egui::Modifiers::COMMAND,
    };
    harness.input_mut().events.extend(std::iter::repeat_n(press, 3));
    harness.step();
    harness.run_steps(2);
    assert_eq!(harness.documents().texts(), &before);
}

#[test]
fn an_entry_is_deleted_unless_the_scenario_uses_it_and_undo_restores_it() {
    let folder = Folder::new("delete-entry");
    let mut harness = real(&folder, "hello-endline");
    let remove = |harness: &mut Window, path: &str| {
        harness.state_mut().dock =
            egui_dock::DockState::new(vec![PanelId::Library.id().to_owned()]);
        harness.state_mut().shared.give(PanelAction::Entry(path.to_owned()));
        harness.run_steps(3);
        harness.get_by_label("Delete").click();
        harness.run_steps(3);
    };
    let documents = harness.documents();
    let (used, unused): (Vec<_>, Vec<_>) =
        documents.files("ropes").map(str::to_owned).partition(|path| documents.in_use(path));
    let count = used.len() + unused.len();
    remove(&mut harness, &used[0]);
    let notice = harness.notice();
    assert!(notice.text.contains("in use by the open scenario"), "{}", notice.text);
    remove(&mut harness, &unused[0]);
    let documents = harness.documents();
    assert_eq!(documents.files("ropes").count(), count - 1);
    assert!(folder.0.join(&unused[0]).exists(), "its file is deleted at the next save");
    harness.perform(EditAction::Save);
    harness.run_steps(2);
    assert!(!folder.0.join(&unused[0]).exists());
    harness.perform(EditAction::Undo);
    harness.run_steps(2);
    let documents = harness.documents();
    assert_eq!(documents.files("ropes").count(), count);
}

#[test]
fn a_right_click_on_a_row_offers_its_actions() {
    let folder = Folder::new("row-menu");
    let (mut harness, _) = workbench(&folder, Pilot::default());
    only(&mut harness, PanelId::Library);
    let path = "ropes/sink-3-8.toml";
    let name = harness.documents().field(path, "name").unwrap();
    harness.get_by_label(&name).click_secondary();
    harness.run_steps(4);
    harness.get_by_label("Copy id");
    harness.get_all_by_label("Duplicate").last().unwrap().click();
    harness.run_steps(3);
    let documents = harness.documents();
    assert_eq!(documents.field("ropes/sink-3-8-2.toml", "name"), Some(format!("{name} (copy)")));
}
