//! The panel of plugins: plugins listed, switched off, reloaded, allowed, used in the scenario.

use endline_session::command::{EditAction, PluginAction};
use endline_workbench::gui::command::action::PanelAction;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui_kittest::kittest::Queryable;
use endline_gear::{Document, Setting};
use endline_session::edit::Documents;
use endline_session::plugins::{Choices, Language, Loader, PluginKind, Standing, write_project};
use endline_session::workbench::plugins::Load;
use endline_workbench::gui::fields;
use endline_workbench::gui::panel::PanelId;

use crate::common::{Folder, Reach as _, Window, real, wait};

/// A folder of plugins, deleted at the end of the test.
struct Place(PathBuf);

impl Place {
    fn new(name: &str) -> Self {
        let folder =
            std::env::temp_dir().join(format!("endline-plugins-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        // A folder that cannot be deleted is no reason to fail a test.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The workbench with the panel in front and a loader for a folder.
fn opened_on(folder: &Folder, place: &Path, scenario: &str) -> Window {
    let mut harness = real(folder, scenario);
    let load: Load = Arc::new(|loader| loader.load(&|_: &Path, _: &str| Ok(())));
    let loader = Loader::new(&[place.to_path_buf()], Choices::kept_in(None, &[]));
    harness.workbench_mut().load_plugins_with(loader, load, Vec::new());
    harness.state_mut().shared.give(PanelAction::Show(PanelId::Plugins));
    harness.run_steps(3);
    harness
}

fn reloaded(harness: &mut Window, times: u64) {
    wait(harness, |app| app.shared.workbench.plugins().reloads == times);
}

#[test]
fn a_plugin_is_listed_reloaded_after_a_change_and_switched_off() {
    let (folder, place) = (Folder::new("plugins"), Place::new("anew"));
    let project =
        write_project(&place.0.join("our-gear"), PluginKind::Gear, Language::Text, None).unwrap();
    let mut harness = opened_on(&folder, &place.0, "reference-a-pendulum");
    harness.get_by_label("Reload").click();
    harness.run_steps(2);
    reloaded(&mut harness, 1);
    harness.get_all_by_label("Our gear").next().unwrap().click();
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("36.576 m").is_some(), "20 fathoms, with their unit");

    let file = project.library.join("gear-types/simple.toml");
    std::fs::write(
        &file,
        std::fs::read_to_string(&file).unwrap().replace("Our gear", "Their gear"),
    )
    .unwrap();
    harness.get_by_label("Reload").click();
    harness.run_steps(2);
    reloaded(&mut harness, 2);
    assert!(harness.query_all_by_label("Their gear").next().is_some(), "the change is shown");

    harness.state_mut().shared.give(PluginAction::Switch { id: project.id.clone(), on: false });
    harness.run_steps(2);
    reloaded(&mut harness, 3);
    assert_eq!(
        harness.workbench().plugins().every().iter().map(|plugin| plugin.on).collect::<Vec<_>>(),
        [false]
    );
    assert!(harness.workbench().gear_types().is_empty());
}

#[test]
fn an_unknown_library_is_opened_only_after_a_question() {
    let (folder, place) = (Folder::new("plugins-asked"), Place::new("asked"));
    let file = place.0.join(format!("lib.{}", std::env::consts::DLL_EXTENSION));
    std::fs::write(&file, "no library at all").unwrap();
    let mut harness = opened_on(&folder, &place.0, "reference-a-pendulum");
    harness.get_by_label("Reload").click();
    harness.run_steps(2);
    reloaded(&mut harness, 1);
    assert!(matches!(harness.workbench().plugins().problems[0].standing, Standing::Waiting(_)));
    assert!(
        harness.query_by_label_contains("with your rights: allow it only if").is_some(),
        "the question is shown"
    );
    harness.get_all_by_label("Allow").last().unwrap().click();
    harness.run_steps(2);
    reloaded(&mut harness, 2);
    let problem = harness.workbench().plugins().problems[0].clone();
    assert!(
        problem.standing == Standing::Unusable && problem.reason.contains("is not a library"),
        "{problem}"
    );
    assert!(harness.query_by_label_contains("with your rights: allow it only if").is_none());

    // After "Not now" another file is not asked about again, and is not loaded.
    std::fs::write(&file, "other content").unwrap();
    harness.get_by_label("Reload").click();
    harness.run_steps(2);
    reloaded(&mut harness, 3);
    harness.get_by_label("Not now").click();
    harness.run_steps(2);
    assert!(harness.query_by_label("Not now").is_none());
    assert!(matches!(harness.workbench().plugins().problems[0].standing, Standing::Waiting(_)));
}

#[test]
fn a_friction_law_is_used_in_the_scenario_and_its_attributes_have_a_form() {
    let (folder, place) = (Folder::new("plugins-used"), Place::new("used"));
    let mut harness = opened_on(&folder, &place.0, "hello-endline");
    let id = "org.endline.friction.coulomb";
    let motion = harness
        .workbench()
        .plugins()
        .every()
        .into_iter()
        .find(|plugin| plugin.info.id == "org.endline.motion.swim")
        .unwrap()
        .info;
    assert!(harness.workbench().uses_plugin(&motion));
    harness.set(Documents::SCENARIO, "friction.model", "org.example.friction.other");
    let other = |scenario: &mut Document| {
        scenario
            .put("friction.attributes.slip", &Setting::text("0.1 m"))
            .map_err(|error| error.to_string())
    };
    harness.alter(Documents::SCENARIO, other);
    harness.state_mut().panels.plugins.chosen = Some(id.to_owned());
    harness.run_steps(2);
    harness.get_by_label("Use in this scenario").click();
    harness.run_steps(3);
    let documents = harness.documents();
    assert_eq!(documents.field(Documents::SCENARIO, "friction.model").as_deref(), Some(id));
    assert_eq!(
        documents.field(Documents::SCENARIO, "friction.attributes.slip"),
        None,
        "attributes of the other law are removed"
    );
    assert!(harness.query_by_label("In this scenario").is_some());

    // A value typed into the form creates the table of attributes.
    let field = fields::edit_id(Documents::SCENARIO, "friction.attributes.coefficient_scale");
    harness.ctx.memory_mut(|memory| memory.request_focus(field));
    harness.run_steps(2);
    harness.event(egui::Event::Text("1.5".to_owned()));
    harness.run_steps(1);
    harness.key_press(egui::Key::Enter);
    harness.run_steps(3);
    let scale =
        harness.documents().field(Documents::SCENARIO, "friction.attributes.coefficient_scale");
    assert_eq!(scale.as_deref(), Some("1.5"));
    harness.perform(EditAction::Undo);
    harness.perform(EditAction::Undo);
    assert_eq!(
        harness.documents().field(Documents::SCENARIO, "friction.model").as_deref(),
        Some("org.example.friction.other")
    );
}
