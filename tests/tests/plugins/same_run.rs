//! Every bundled scenario that plugins have a part in runs to the same bits with plugins linked in and loaded.

use std::fs;
use std::path::PathBuf;

use endline_gear::{Hooks, Library, Options, Scenario, assemble};
use endline_session::hash::StateHash;
use endline_sim::{Input, Model, State, Workspace, step};

use crate::linked::{Linked, library, root};
use crate::same_bits::loaded;

/// Steps of each run.
const STEPS: usize = 25;

fn scenarios() -> Vec<PathBuf> {
    let folder = fs::read_dir(root().join("scenarios")).unwrap();
    let mut files: Vec<PathBuf> = folder.map(|entry| entry.unwrap().path()).filter(|path| path.is_file()).collect();
    files.sort();
    files
}

/// The end of a run, as the hash that recordings keep, or what stopped it.
fn run(library: &Library, text: &str, hooks: &dyn Hooks, steps: usize) -> Result<String, String> {
    let scenario = Scenario::read("test.toml", text).map_err(|problems| format!("{problems:?}"))?;
    let options = Options { rope_nodes: scenario.rope_nodes.as_ref().map(|_| 80), ..Options::default() };
    let spec = assemble(&scenario, library, hooks, &options).or_else(|_| assemble(&scenario, library, hooks, &Options::default()));
    let model = Model::new(spec.map_err(|problems| format!("{problems:?}"))?).map_err(|errors| format!("{errors:?}"))?;
    let (mut state, mut workspace, input) = (State::start(&model), Workspace::new(&model), Input::default());
    for _ in 0..steps {
        if let Err(stop) = step(&model, &input, &mut state, &mut workspace) {
            return Err(format!("{stop:?} {}", StateHash::of(&input, &state).hex()));
        }
    }
    Ok(StateHash::of(&input, &state).hex())
}

#[test]
fn every_bundled_scenario_runs_to_the_same_hash_linked_and_loaded() {
    let (library, loaded) = (library(), loaded());
    let mut ran = 0;
    for path in scenarios() {
        let text = fs::read_to_string(&path).unwrap();
        if !text.contains("[whale]") && !text.contains("[[gear]]") {
            continue;
        }
        let (one, other) = (run(&library, &text, &Linked, STEPS), run(&library, &text, &loaded, STEPS));
        assert_eq!(one, other, "{}", path.display());
        ran += usize::from(one.is_ok());
    }
    assert!(ran > 20, "{ran} ran");
}

/// The whale set beside the endline, so that rope touches: four laws of friction at work.
#[test]
fn an_encounter_with_a_law_for_each_surface_runs_to_the_same_hash() {
    let text = fs::read_to_string(root().join("scenarios/hello-friction.toml")).unwrap();
    let near = text.replace("\"-22 m\"", "\"-9 m\"");
    assert_ne!(near, text);
    let (library, loaded) = (library(), loaded());
    assert_eq!(run(&library, &near, &Linked, 300).unwrap(), run(&library, &near, &loaded, 300).unwrap());
}
