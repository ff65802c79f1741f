//! The program's file alone: no gear library and no plugins beside it, an empty home.

use crate::common::{Called, Place, edit, text};

#[test]
fn the_program_alone_runs_the_same_encounter_and_keeps_what_was_edited() {
    let place = Place::new("alone");
    let first = place.alone(&["settle", "hello-endline"]).done();
    assert!(
        first.stderr.contains("gear-library (") && first.stderr.contains("yours to edit"),
        "{first}"
    );
    let scenario = place.path("data/endline/gear-library/scenarios/hello-endline.toml");
    edit(&scenario, "duration", "duration = \"1 s\"");

    // Plugins inside the program and plugins from files are the same code: the state at the end has the same bits.
    let run = place.alone(&["run", "hello-endline", "--json"]).done();
    assert!(run.stderr.lines().all(|line| !line.contains("gear-library (")), "written once; {run}");
    let hash = |called: &Called| called.json()["state_hash"].clone();
    assert!(hash(&run).is_string() && run.json()["simulated_s"] == 1.0, "{run}");
    let beside = place.endline(&["run", &text(&scenario), "--json"]).done();
    assert_eq!(hash(&run), hash(&beside));

    let listed = place.alone(&["plugins", "list"]).done();
    for id in ["motion.swim", "friction.baleen", "gear.trawl"] {
        assert!(listed.stdout.contains(id), "{id}; {listed}");
    }
    assert!(listed.stdout.contains("linked in") && listed.stderr.is_empty(), "{listed}");
}
