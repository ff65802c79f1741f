//! The plugin host as the program loads it and the gear library sees it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use endline_gear::Hooks;
use endline_sdk::{FrictionModel, GearType, WhaleMotion};

use crate::plugins::{PluginHost, PluginProblem, by_child, known_file, remembering};

/// A plugin that has not opened after this is taken to hang.
const PATIENCE: Duration = Duration::from_secs(10);

/// Loads the plugins of these folders for the program `endline`, which opens each new file first
/// in a child of its own (`endline plugins check`): one that crashes, hangs or lies is set aside.
#[must_use]
pub fn load_plugins(folders: &[PathBuf]) -> (PluginHost, Vec<PluginProblem>) {
    match std::env::current_exe() {
        Ok(program) => PluginHost::discover_checked(folders, &remembering(known_file(), &by_child(program, PATIENCE))),
        Err(error) => {
            let reason = format!("the program cannot find itself to check it: {error}");
            PluginHost::discover_checked(folders, &|_: &Path| Err(reason.clone()))
        }
    }
}

impl Hooks for PluginHost {
    fn motion(&self, id: &str) -> Option<Arc<dyn WhaleMotion>> {
        self.motion(id)
    }

    fn friction(&self, id: &str) -> Option<Arc<dyn FrictionModel>> {
        self.friction(id)
    }

    fn gear(&self, id: &str) -> Option<Arc<dyn GearType>> {
        self.gear(id)
    }

    fn ids(&self) -> Vec<String> {
        self.ids()
    }
}
