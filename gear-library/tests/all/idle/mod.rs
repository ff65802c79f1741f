//! Plugins that do nothing, and the shipped library.

#![allow(
    dead_code,
    clippy::unwrap_used,
    reason = "each test uses a part of this; helpers of tests fail the test"
)]

use std::path::Path;
use std::sync::{Arc, OnceLock};

use endline_gear::{Hooks, Library, Sources};
use endline_sdk::{
    Contacts, Descriptor, FrictionModel, FrictionResponse, GearType, HookError, MotionInput,
    MotionOutput, WhaleMotion,
};

/// A motion without movement and a friction model without friction, with the id `test.idle`.
pub struct Idle(Arc<Still>);

/// The instance of both hooks.
pub struct Still(Descriptor);

impl Idle {
    pub fn shared() -> Self {
        Self(Still::shared())
    }
}

impl Still {
    pub fn shared() -> Arc<Self> {
        let (id, name, help) = ("test.idle".into(), "Idle".into(), "Does nothing.".into());
        Arc::new(Self(Descriptor {
            id,
            version: "0.1.0".into(),
            name,
            help,
            attributes: Vec::new(),
            state_len: 0,
            acts: Vec::new(),
        }))
    }
}

impl Hooks for Idle {
    fn motion(&self, _: &str) -> Option<Arc<dyn WhaleMotion>> {
        Some(self.0.clone())
    }
    fn friction(&self, _: &str) -> Option<Arc<dyn FrictionModel>> {
        Some(self.0.clone())
    }
    fn gear(&self, _: &str) -> Option<Arc<dyn GearType>> {
        None
    }
    fn ids(&self) -> Vec<String> {
        vec!["test.idle".into()]
    }
}

impl WhaleMotion for Still {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn step(
        &self,
        _: &[f64],
        _: &MotionInput<'_>,
        _: &mut [f64],
    ) -> Result<MotionOutput, HookError> {
        Ok(MotionOutput::default())
    }
}

impl FrictionModel for Still {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn respond(
        &self,
        _: &[f64],
        _: &Contacts<'_>,
        _: &mut [FrictionResponse],
    ) -> Result<(), HookError> {
        Ok(())
    }
    fn advance(&self, _: &[f64], _: &Contacts<'_>, _: &mut [f64]) -> Result<(), HookError> {
        Ok(())
    }
}

/// The shipped library.
pub fn library() -> &'static Library {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        Library::read(&Sources::from_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()).0
    })
}
