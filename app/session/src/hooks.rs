//! The plugin host as the program loads it and the gear library sees it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use endline_gear::Hooks;
use endline_sdk::{FrictionModel, GearType, WhaleMotion};

use crate::plugins::{
    Choices, Loader, PluginHost, PluginProblem, by_child, chosen_file, known_file, program,
    program_folder, remembering,
};

/// A plugin that has not opened after this is taken to hang.
const PATIENCE: Duration = Duration::from_secs(10);

/// A loader of these folders that asks about libraries that the user has not allowed; those that ship with the program need no permission. What was allowed
/// and is not trusted runs in processes of its own.
pub fn plugin_loader(folders: &[PathBuf]) -> Loader {
    let own: Vec<PathBuf> = program_folder().into_iter().collect();
    let loader = Loader::new(folders, Choices::kept_in(chosen_file(), &own));
    match program() {
        Ok(program) => loader.out_of_process(program),
        // Without the program nothing can be checked, and so nothing is opened.
        Err(_) => loader,
    }
}

/// Loads the plugins of these folders for the program `endline`, which opens each new file first
/// in a child of its own (`endline plugins check`): one that crashes, hangs or lies is set aside.
pub fn load_plugins(folders: &[PathBuf]) -> (PluginHost, Vec<PluginProblem>) {
    load_with(&mut plugin_loader(folders))
}

/// Loads with a loader that was used before: unchanged files are not opened again.
pub fn load_with(loader: &mut Loader) -> (PluginHost, Vec<PluginProblem>) {
    match program() {
        Ok(program) => loader.load(&remembering(known_file(), &by_child(program, PATIENCE))),
        Err(error) => {
            let reason = format!("the program cannot find itself to check it: {error}");
            loader.load(&|_: &Path, _: &str| Err(reason.clone()))
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
