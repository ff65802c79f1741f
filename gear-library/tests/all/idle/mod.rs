//! Plugins of tests by id, and the shipped library.

#![allow(
    dead_code,
    clippy::unwrap_used,
    reason = "each test uses a part of this; helpers of tests fail the test"
)]

use std::path::Path;
use std::sync::{Arc, OnceLock};

use endline_fixtures::hooks::NoEffect;
use endline_gear::{Hooks, Library, Sources};
use endline_sdk::{FrictionModel, GearType, WhaleMotion};

/// Returns its motion and its friction law for every id, and no gear type.
#[derive(Default)]
pub struct TestHooks {
    pub motion: Option<Arc<dyn WhaleMotion>>,
    pub friction: Option<Arc<dyn FrictionModel>>,
}

impl TestHooks {
    /// A motion and a friction law without effect.
    pub fn without_effect() -> Self {
        Self { motion: Some(NoEffect::shared()), friction: Some(NoEffect::shared()) }
    }
}

impl Hooks for TestHooks {
    fn motion(&self, _: &str) -> Option<Arc<dyn WhaleMotion>> {
        self.motion.clone()
    }
    fn friction(&self, _: &str) -> Option<Arc<dyn FrictionModel>> {
        self.friction.clone()
    }
    fn gear(&self, _: &str) -> Option<Arc<dyn GearType>> {
        None
    }
    fn ids(&self) -> Vec<String> {
        let motion = self.motion.iter().map(|motion| motion.descriptor().id.to_string());
        motion.chain(self.friction.iter().map(|law| law.descriptor().id.to_string())).collect()
    }
}

/// The shipped library.
pub fn library() -> &'static Library {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        Library::read(&Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()).0
    })
}
