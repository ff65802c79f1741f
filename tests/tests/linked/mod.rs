//! The first-party plugins linked into a test, and the shipped gear library.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_gear::{Diagnostic, Hooks, Library, Sources};
use endline_sdk::{FrictionModel, GearType, WhaleMotion};

/// Folder of the shipped gear library.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../gear-library")
}

/// Diagnostics as a user reads them.
pub fn told(problems: &[Diagnostic]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n")
}

/// The shipped gear library.
pub fn library() -> Library {
    let sources = Sources::from_folder(&root()).unwrap();
    let (library, problems) = Library::read(&sources);
    assert!(problems.is_empty(), "{}", told(&problems));
    library
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
