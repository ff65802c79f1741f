//! A shipped scenario as a model, with the plugins that ship linked in.

use std::path::Path;
use std::sync::Arc;

use endline_gear::{Hooks, Library, Options, Scenario, Sources, assemble};
use endline_sdk::{FrictionModel, GearType, WhaleMotion};
use endline_sim::Model;

/// The model of a scenario with pieces of its text replaced.
pub fn model(scenario: &str, changes: &[(&str, &str)]) -> Model {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (library, _) = Library::read(
        &Sources::from_folder(root).unwrap_or_else(|problems| panic!("{problems:?}")),
    );
    let name = format!("scenarios/{scenario}.toml");
    let mut text = std::fs::read_to_string(root.join(&name)).expect("a shipped scenario");
    for (from, to) in changes {
        assert!(text.contains(from), "{name} says {from}");
        text = text.replace(from, to);
    }
    let scenario = Scenario::read(&name, &text).unwrap_or_else(|problems| panic!("{problems:?}"));
    let spec = assemble(&scenario, &library, &Linked, &Options::default())
        .unwrap_or_else(|problems| panic!("{problems:?}"));
    Model::new(spec).unwrap_or_else(|problems| panic!("{problems:?}"))
}

/// The plugins that ship.
struct Linked;

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
        Vec::new()
    }
}
