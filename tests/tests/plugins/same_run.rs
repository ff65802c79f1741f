//! Every bundled scenario that plugins have a part in runs to the same bits with plugins linked in and loaded.

use std::fs;
use std::path::PathBuf;

use endline_gear::{Hooks, Library, Options, Scenario, assemble};
use endline_session::hash::StateHash;
use endline_sim::{Input, Model, State, Workspace, step};
use glam::DVec3;

use crate::linked::{Linked, library, root};
use crate::same_bits::loaded;

/// Steps of each run.
const STEPS: usize = 25;

fn scenarios() -> Vec<PathBuf> {
    let folder = fs::read_dir(root().join("scenarios")).unwrap();
    let mut files: Vec<PathBuf> =
        folder.map(|entry| entry.unwrap().path()).filter(|path| path.is_file()).collect();
    files.sort();
    files
}

/// Runs a number of steps. Returns the state hash of recordings, or the reason of the stop, and whether rope touched the whale. A
/// whale without contact in this time is placed with its snout at the rope.
fn run(
    library: &Library,
    text: &str,
    hooks: &dyn Hooks,
    steps: usize,
) -> (Result<String, String>, bool) {
    let first = match model(library, text, hooks, None) {
        Ok(model) => model,
        Err(stop) => return (Err(stop), false),
    };
    let as_written = walk(&first, steps);
    if as_written.1 || first.spec.whale.is_none() {
        return as_written;
    }
    let rope = State::start(&first).rope.position;
    let near = model(library, text, hooks, Some(&rope)).map(|model| walk(&model, steps));
    near.ok().filter(|(end, _)| end.is_ok()).unwrap_or(as_written)
}

fn walk(model: &Model, steps: usize) -> (Result<String, String>, bool) {
    let (mut state, mut workspace, input) =
        (State::start(model), Workspace::new(model), Input::default());
    let mut touched = false;
    for _ in 0..steps {
        if let Err(stop) = step(model, &input, &mut state, &mut workspace) {
            return (Err(format!("{stop:?} {}", StateHash::of(&input, &state).hex())), touched);
        }
        touched |= !workspace.contacts.is_empty();
    }
    (Ok(StateHash::of(&input, &state).hex()), touched)
}

/// The scenario's model; the whale just short of the rope where that is given.
fn model(
    library: &Library,
    text: &str,
    hooks: &dyn Hooks,
    rope: Option<&[DVec3]>,
) -> Result<Model, String> {
    let scenario = Scenario::read("test.toml", text).map_err(|problems| format!("{problems:?}"))?;
    let options =
        Options { rope_nodes: scenario.rope_nodes.as_ref().map(|_| 80), ..Options::default() };
    let spec = assemble(&scenario, library, hooks, &options)
        .or_else(|_| assemble(&scenario, library, hooks, &Options::default()));
    let mut spec = spec.map_err(|problems| format!("{problems:?}"))?;
    if let (Some(whale), Some(rope)) = (&mut spec.whale, rope) {
        let ahead = whale.orientation * DVec3::X;
        let least = rope.iter().map(|node| node.dot(ahead)).fold(f64::INFINITY, f64::min);
        // The hindmost of the rope on the whale's way, as far from its ends as can be.
        let hindmost = (0..rope.len()).filter(|index| rope[*index].dot(ahead) < least + 0.05);
        let node = hindmost
            .min_by_key(|index| index.abs_diff(rope.len() / 2))
            .map_or(DVec3::ZERO, |index| rope[index]);
        let snout = whale.skin.vertices.iter().copied().max_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
        whale.position_m = node - whale.orientation * snout - 0.08 * ahead;
    }
    Model::new(spec).map_err(|errors| format!("{errors:?}"))
}

#[test]
fn every_bundled_scenario_runs_to_the_same_hash_linked_and_loaded() {
    let (library, loaded) = (library(), loaded());
    let (mut ran, mut met) = (0, 0);
    for path in scenarios() {
        let text = fs::read_to_string(&path).unwrap();
        if !text.contains("[whale]") && !text.contains("[[gear]]") {
            continue;
        }
        let (one, other) =
            (run(&library, &text, &Linked, STEPS), run(&library, &text, &loaded, STEPS));
        assert_eq!(one, other, "{}", path.display());
        ran += usize::from(one.0.is_ok());
        met += usize::from(one.1);
    }
    assert!(ran > 20, "{ran} ran");
    assert!(met >= 12, "rope touched the whale in {met}");
}

/// Four laws of friction at work.
#[test]
fn an_encounter_with_a_law_for_each_surface_runs_to_the_same_hash() {
    let far = fs::read_to_string(root().join("scenarios/hello-friction.toml")).unwrap();
    let text = far.replace("\"-22 m\"", "\"-9 m\"");
    assert_ne!(far, text);
    let (library, loaded) = (library(), loaded());
    let (end, touched) = run(&library, &text, &Linked, 300);
    assert!(touched, "the rope touches the whale");
    assert_eq!(end.unwrap(), run(&library, &text, &loaded, 300).0.unwrap());
}
