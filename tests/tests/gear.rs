//! The gear library: shipped files, messages, assembly.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail the test")]

use std::path::{Path, PathBuf};

use std::sync::Arc;

use endline_gear::{Diagnostic, Hooks, Library, Options, Scenario, Sources, assemble};
use endline_sdk::{FrictionModel, GearType, WhaleMotion};
use endline_sim::{Model, ModelSpec};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../gear-library")
}

fn told(problems: &[Diagnostic]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n")
}

fn library() -> Library {
    let sources = Sources::from_folder(&root()).unwrap();
    let (library, problems) = Library::read(&sources);
    assert!(problems.is_empty(), "{}", told(&problems));
    library
}

#[test]
fn every_shipped_file_reads_without_a_word() {
    let library = library();
    assert!(library.ropes.len() >= 20);
    for entry in std::fs::read_dir(root().join("scenarios")).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        if let Err(problems) = Scenario::read(&path.display().to_string(), &text) {
            panic!("{}", told(&problems));
        }
    }
}

/// The first-party plugins, linked.
struct Linked;

impl Hooks for Linked {
    fn motion(&self, id: &str) -> Option<Arc<dyn WhaleMotion>> {
        let motion = endline_whale_motions::Swim::new();
        (motion.descriptor().id == id).then(|| Arc::new(motion) as Arc<dyn WhaleMotion>)
    }
    fn friction(&self, id: &str) -> Option<Arc<dyn FrictionModel>> {
        let model = endline_friction_models::Coulomb::new();
        (model.descriptor().id == id).then(|| Arc::new(model) as Arc<dyn FrictionModel>)
    }
    fn gear(&self, id: &str) -> Option<Arc<dyn GearType>> {
        let gear = endline_gear_types::Single::new();
        (gear.descriptor().id == id).then(|| Arc::new(gear) as Arc<dyn GearType>)
    }
    fn ids(&self) -> Vec<String> {
        ["org.endline.motion.swim", "org.endline.friction.coulomb", "org.endline.gear.single"].map(str::to_owned).to_vec()
    }
}

fn assembled(name: &str, text: &str) -> ModelSpec {
    let told =
        |problems: Vec<endline_gear::Diagnostic>| panic!("{}", problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n"));
    let scenario = Scenario::read(name, text).unwrap_or_else(told);
    let told =
        |problems: Vec<endline_gear::Diagnostic>| panic!("{}", problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n"));
    assemble(&scenario, &library(), &Linked, &Options::default()).unwrap_or_else(told)
}

fn shipped(name: &str) -> ModelSpec {
    assembled(name, &std::fs::read_to_string(root().join("scenarios").join(name)).unwrap())
}

#[test]
fn every_shipped_scenario_makes_a_model_with_the_nodes_it_asks_for() {
    for (name, nodes) in [
        ("hello-endline.toml", 500),
        ("hello-slack-tide.toml", 500),
        ("hello-weak-link.toml", 500),
        ("reference-b-static.toml", 501),
        ("reference-a-pendulum.toml", 101),
    ] {
        let model = Model::new(shipped(name)).unwrap();
        assert_eq!(model.node_count, nodes, "{name}");
    }
}
