//! The layout Search: an observation entered on the body map and searched; the search cancelled and continued; stories replayed and kept.

use egui_kittest::kittest::Queryable;
use endline_gear::Site;
use endline_session::campaign::State;
use endline_session::command::{EditAction, SearchAction};
use endline_session::edit::Documents;
use endline_session::live::{Status, engine};
use endline_session::search::SearchJob;
use endline_session::workbench::{Folders, SearchEffort};
use endline_workbench::gui::app::App;
use endline_workbench::gui::command::action::PanelAction;
use endline_workbench::gui::layout::Layout;
use endline_workbench::gui::panel::PanelId;
use endline_workbench::input::Pilot;

use crate::common::{Folder, Reach as _, Window, give, linked, on_disk, opened_with, retype, wait};

/// A short search at normal priority, because other tests run at the same time.
const EFFORT: SearchEffort =
    SearchEffort { trials: 32, threads: 2, neighbours: 0, normal_priority: true };

/// Encounters of a few seconds with coarse rope.
const STUDY: &str = r#"format = 1
kind = "study"
name = "Quick"
scenario = "quick"
encounters = 16
baseline = "one"
[run]
passed = "6 s"
held = "1 s"
[[option]]
id = "one"
[encounter.speed]
uniform = ["1 m/s", "1.6 m/s"]
source = "assumed"
[encounter.answer]
choice = ["none", "bolt"]
source = "assumed"
"#;

const OBSERVATION: &str = r#"format = 1
kind = "observation"
name = "A quick case"
source = "a test"
confidence = "estimate"
encounters = "quick"

# The drawing.
[[site]]
part = "peduncle"
present = 0.9
wraps = [1, 2.5]

# Rope at this flipper is nearer than nothing on the whale, which is no story.
[[site]]
part = "right_flipper"
present = 0.9
"#;

/// Adds the quick case to the library.
pub fn add_observation(folder: &Folder) {
    let scenario = on_disk(folder, "scenarios/hello-endline.toml")
        .replace("duration = \"60 s\"", "duration = \"6 s\"")
        .replace("rope_nodes = 1000", "rope_nodes = 80")
        .replace("near = \"5 cm\"", "near = \"40 cm\"")
        .replace("edges = \"1.25 cm\"", "edges = \"20 cm\"")
        .replace("\"-22 m\"", "\"-8 m\"");
    std::fs::write(folder.0.join("scenarios/quick.toml"), scenario).unwrap();
    for (kind, text) in [("studies", STUDY), ("observations", OBSERVATION)] {
        std::fs::create_dir_all(folder.0.join(kind)).unwrap();
        std::fs::write(folder.0.join(kind).join("quick.toml"), text).unwrap();
    }
}

/// The workbench in the layout Search with the quick case open.
fn searching(folder: &Folder) -> Window {
    add_observation(folder);
    let mut harness = opened_with(folder.documents(), linked(), engine::live(), Pilot::default());
    let searches = Some(folder.0.join("searches"));
    harness.workbench_mut().write_to(Folders { searches, ..Folders::default() });
    harness.perform(SearchAction::Effort(EFFORT));
    give(&mut harness, PanelAction::Arrange(Layout::Search));
    give(&mut harness, SearchAction::Open(folder.0.join("observations/quick.toml")));
    harness
}

fn state(app: &App) -> Option<State> {
    app.shared.workbench.searches().job.as_ref().map(SearchJob::state)
}

/// Clicks on the largest map of the whale from above: x from tail to snout, y from left to right, as shares.
fn click_on_whale(harness: &mut Window, x: f32, y: f32) {
    let pictures = harness.get_all_by_label("from above, left is up");
    let rects = pictures.map(|picture| picture.rect());
    let rect = rects.max_by(|one, other| one.width().total_cmp(&other.width())).unwrap();
    // The name is above the map.
    let below = rect.with_min_y(rect.top() + 16.0);
    let at = below.lerp_inside(egui::vec2(x, y));
    harness.event(egui::Event::PointerMoved(at));
    harness.run_steps(2);
    for pressed in [true, false] {
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        harness.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
    }
    harness.run_steps(2);
}

fn field(harness: &Window, field: &str) -> Option<String> {
    let documents = harness.documents();
    documents.field(Documents::OBSERVATION, field)
}

#[test]
fn an_observation_is_entered_on_the_body_map_and_its_stories_are_replayed_to_the_bit() {
    let folder = Folder::new("search");
    let mut harness = searching(&folder);
    wait(&mut harness, |app| state(app) == Some(State::Cancelled));
    let chosen = harness.state().panels.search.chosen;
    assert_eq!(chosen, Site::RightFlipper, "the first part with rope");
    harness.state_mut().panels.search.chosen = Site::Peduncle;
    harness.run_steps(3);
    retype(&mut harness, "2.5", "3");
    assert_eq!(field(&harness, "site.0.wraps.1").as_deref(), Some("3"));
    click_on_whale(&mut harness, 0.5, 0.5);
    assert_eq!(harness.state().panels.search.chosen, Site::Body);
    harness.get_by_label("No rope").click();
    harness.run_steps(3);
    assert_eq!(field(&harness, "site.2.part").as_deref(), Some("body"));
    assert_eq!(field(&harness, "site.2.present").as_deref(), Some("0.05"));
    give(&mut harness, EditAction::Undo);
    assert_eq!(field(&harness, "site.2.part"), None, "one edit, undone");
    assert!(harness.workbench().stories_are_of_another());

    let before = on_disk(&folder, "observations/quick.toml");
    give(&mut harness, SearchAction::Run);
    let documents = harness.documents();
    assert!(documents.is_unsaved(Documents::OBSERVATION));
    assert_eq!(on_disk(&folder, "observations/quick.toml"), before, "nothing is saved");
    wait(&mut harness, |app| state(app) == Some(State::Done));
    let found = harness.workbench().searches().job.as_ref().unwrap().found();
    let stories = found.stories.unwrap();
    assert!(!stories.stories.is_empty() && stories.trials == 32, "{stories:?}");
    let says = stories.answer();
    assert!(harness.query_all_by_label_contains(&says).next().is_some(), "{says}");
    let term = &stories.stories[0].terms[0].1;
    assert!(harness.query_all_by_label_contains(term).next().is_some(), "{term}");

    let story = stories.stories.len() - 1;
    give(&mut harness, SearchAction::Replay(story));
    wait(&mut harness, |app| app.shared.workbench.status() == Some(&Status::Finished));
    let view = harness.view();
    assert_eq!(view.state_hash, stories.stories[story].state_hash);
    give(&mut harness, SearchAction::Keep(story));
    let kept = folder.0.join("scenarios/quick-story-1.toml");
    wait(&mut harness, |_| kept.exists());
    give(&mut harness, EditAction::OpenScenario(kept));
    wait(&mut harness, |app| !app.shared.workbench.making());
    let workbench = harness.workbench();
    assert!(!workbench.project().documents.any_error());
    let name = workbench.project().documents.field(Documents::SCENARIO, "name").unwrap();
    assert!(name.starts_with("A quick case: first the"), "{name}");
}

#[test]
fn a_search_is_cancelled_and_continued_and_found_again_with_its_observation() {
    let folder = Folder::new("search-on");
    let mut harness = searching(&folder);
    wait(&mut harness, |app| state(app) == Some(State::Cancelled));
    harness.perform(SearchAction::Effort(SearchEffort { trials: 256, ..EFFORT }));
    give(&mut harness, SearchAction::Run);
    wait(&mut harness, |app| {
        app.shared.workbench.searches().job.as_ref().unwrap().progress().encounters.done > 2
    });
    give(&mut harness, SearchAction::Pause);
    assert_eq!(state(harness.state()), Some(State::Paused));
    give(&mut harness, SearchAction::Cancel);
    wait(&mut harness, |app| state(app) == Some(State::Cancelled));
    harness.perform(SearchAction::Effort(SearchEffort { trials: 64, ..EFFORT }));
    give(&mut harness, SearchAction::Run);
    wait(&mut harness, |app| state(app) == Some(State::Done));
    let stories =
        |harness: &Window| harness.workbench().searches().job.as_ref().unwrap().found().stories;
    let found = stories(&harness);
    give(&mut harness, SearchAction::New);
    assert!(stories_are_gone(&harness), "a new observation has no stories");
    assert!(harness.state().shared.selection.open.contains(&PanelId::Search));
    let file = harness.documents().observation_path().unwrap();
    assert!(file.ends_with("observations/observation.toml"), "{}", file.display());
    give(&mut harness, SearchAction::Open(folder.0.join("observations/quick.toml")));
    wait(&mut harness, |app| state(app) == Some(State::Cancelled));
    assert_eq!(stories(&harness), found);
}

fn stories_are_gone(harness: &Window) -> bool {
    harness.workbench().searches().job.is_none()
}
