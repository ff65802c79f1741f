//! The first-party plugins linked into a test or bench, the shipped gear library, and models of its scenarios.
#![allow(
    dead_code,
    clippy::panic,
    clippy::unwrap_used,
    reason = "each test uses a part of this and fails by panicking"
)]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_gear::{Diagnostic, Hooks, Library, Options, Scenario, Sources, assemble};
use endline_sdk::{FrictionModel, GearType, WhaleMotion};
use endline_sim::{Model, ModelSpec};

/// Folder of the shipped gear library.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../gear-library")
}

/// Returns the text of diagnostics as a user reads them.
pub fn report(problems: &[Diagnostic]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n")
}

/// The shipped gear library.
pub fn library() -> Library {
    let sources = Sources::from_folder(&root()).unwrap();
    let (library, problems) = Library::read(&sources);
    assert!(problems.is_empty(), "{}", report(&problems));
    library
}

/// Text of a shipped scenario, by its file's name with or without `.toml`.
pub fn scenario_text(name: &str) -> String {
    let path = root().join("scenarios").join(name).with_extension("toml");
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A scenario's text, assembled with the shipped library and plugins.
pub fn spec_of(name: &str, text: &str) -> ModelSpec {
    let scenario =
        Scenario::read(name, text).unwrap_or_else(|problems| panic!("{}", report(&problems)));
    assemble(&scenario, &library(), &Linked, &Options::default())
        .unwrap_or_else(|problems| panic!("{}", report(&problems)))
}

/// A shipped scenario with parts of its text replaced, assembled.
pub fn spec(name: &str, changes: &[(&str, &str)]) -> ModelSpec {
    let mut text = scenario_text(name);
    for (from, to) in changes {
        assert!(text.contains(from), "{name} says {from}");
        text = text.replace(from, to);
    }
    spec_of(name, &text)
}

/// The model of a specification.
pub fn built(spec: ModelSpec) -> Model {
    Model::new(spec).unwrap_or_else(|errors| panic!("{errors:?}"))
}

/// The model of a shipped scenario with parts of its text replaced.
pub fn model(name: &str, changes: &[(&str, &str)]) -> Model {
    built(spec(name, changes))
}

/// The first-party plugins, linked.
pub struct Linked;

impl Hooks for Linked {
    fn motion(&self, id: &str) -> Option<Arc<dyn WhaleMotion>> {
        let motion = endline_whale_motions::Swim::new();
        (motion.descriptor().id == id).then(|| Arc::new(motion) as Arc<dyn WhaleMotion>)
    }
    fn friction(&self, id: &str) -> Option<Arc<dyn FrictionModel>> {
        endline_friction_models::all().into_iter().find(|model| model.descriptor().id == id)
    }
    fn gear(&self, id: &str) -> Option<Arc<dyn GearType>> {
        endline_gear_types::all().into_iter().find(|gear| gear.descriptor().id == id)
    }
    fn ids(&self) -> Vec<String> {
        let gear =
            endline_gear_types::all().into_iter().map(|gear| gear.descriptor().id.to_string());
        let friction = endline_friction_models::all()
            .into_iter()
            .map(|model| model.descriptor().id.to_string());
        std::iter::once("org.endline.motion.swim".to_owned()).chain(friction).chain(gear).collect()
    }
}
