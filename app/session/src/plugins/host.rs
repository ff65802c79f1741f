//! The plugins of this program run, by id.

use std::collections::{BTreeMap, BTreeSet};
use std::env::consts::DLL_EXTENSION;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_sdk::{FrictionModel, GearType, WhaleMotion};

use super::check::Checker;
use super::info::{Hook, PluginInfo, PluginProblem, Refusal};
use super::{cut_short, declared, guard, load};

/// All usable plugins; each is guarded, so that bad output ends a run with the plugin's id.
#[derive(Clone, Default)]
pub struct PluginHost {
    hooks: BTreeMap<String, Hook>,
    infos: Vec<PluginInfo>,
}

impl PluginHost {
    /// A host with no plugins.
    #[must_use]
    pub fn empty() -> Self {
        Self::default()
    }

    /// Loads every library in the folders, trusting them not to crash when opened.
    ///
    /// A folder that does not exist is passed over. Libraries stay mapped for the life of the program.
    #[must_use]
    pub fn discover(folders: &[PathBuf]) -> (Self, Vec<PluginProblem>) {
        Self::discover_checked(folders, &|_: &Path| Ok(()))
    }

    /// Loads every library in the folders that the checker lets pass.
    #[must_use]
    pub fn discover_checked(folders: &[PathBuf], checker: &Checker<'_>) -> (Self, Vec<PluginProblem>) {
        let (mut host, mut problems) = (Self::empty(), Vec::new());
        for file in libraries(folders, &mut problems) {
            match open_checked(&file, checker) {
                Ok((hash, hooks)) => host.add_loaded(&file, &hash, hooks, &mut problems),
                Err(refusal) => problems.push(refusal.at(file)),
            }
        }
        (host, problems)
    }

    /// Adds a plugin that is linked into the program.
    ///
    /// # Errors
    /// When its declaration makes no sense or its id is taken.
    pub fn add(&mut self, hook: Hook) -> Result<(), PluginProblem> {
        self.insert(hook, None).map_err(|refusal| refusal.at("(linked)"))
    }

    /// Every plugin, in the order found.
    #[must_use]
    pub fn list(&self) -> &[PluginInfo] {
        &self.infos
    }

    /// The whale motion with this id.
    #[must_use]
    pub fn motion(&self, id: &str) -> Option<Arc<dyn WhaleMotion>> {
        if let Some(Hook::Motion(motion)) = self.hooks.get(id) { Some(Arc::clone(motion)) } else { None }
    }

    /// The friction model with this id.
    #[must_use]
    pub fn friction(&self, id: &str) -> Option<Arc<dyn FrictionModel>> {
        if let Some(Hook::Friction(friction)) = self.hooks.get(id) { Some(Arc::clone(friction)) } else { None }
    }

    /// The gear type with this id.
    #[must_use]
    pub fn gear(&self, id: &str) -> Option<Arc<dyn GearType>> {
        if let Some(Hook::Gear(gear)) = self.hooks.get(id) { Some(Arc::clone(gear)) } else { None }
    }

    /// Ids of all plugins, sorted.
    #[must_use]
    pub fn ids(&self) -> Vec<String> {
        self.hooks.keys().cloned().collect()
    }

    /// The guarded plugin with this id.
    pub(super) fn hook(&self, id: &str) -> Option<&Hook> {
        self.hooks.get(id)
    }

    pub(super) fn add_loaded(&mut self, file: &Path, hash: &str, hooks: Vec<Result<Hook, Refusal>>, problems: &mut Vec<PluginProblem>) {
        for hook in hooks {
            let added = hook.and_then(|hook| self.insert(hook, Some((file.to_path_buf(), hash.to_owned()))));
            problems.extend(added.err().map(|refusal| refusal.at(file)));
        }
    }

    fn insert(&mut self, hook: Hook, file: Option<(PathBuf, String)>) -> Result<(), Refusal> {
        declared::check(hook.descriptor())?;
        let info = PluginInfo::of(&hook, file);
        if let Some(first) = self.infos.iter().find(|known| known.id == info.id) {
            let place = first.file.as_ref().map_or_else(|| "the program itself".to_owned(), |file| file.display().to_string());
            return Err(Refusal::of(&info.id, format!("{place} already has a plugin with this id"), "remove one of the two"));
        }
        self.hooks.insert(info.id.clone(), guard::guarded(hook));
        self.infos.push(info);
        Ok(())
    }
}

/// Reads, checks and opens one file; gives its hash and its plugins.
pub(super) fn open_checked(file: &Path, checker: &Checker<'_>) -> Result<(String, Vec<Result<Hook, Refusal>>), Refusal> {
    let bytes = fs::read(file).map_err(|error| Refusal::new(format!("cannot be read: {error}"), "check its permissions"))?;
    let hash = blake3::hash(&bytes).to_hex().to_string();
    if let Some(whole) = cut_short::missing_from(&bytes) {
        let reason = format!("is cut short: {} of {whole} bytes", bytes.len());
        return Err(Refusal::new(reason, "copy or build it again"));
    }
    drop(bytes);
    checker(file).map_err(|reason| {
        Refusal::new(format!("set aside, because it failed the check before loading: {reason}"), "remove the file or mend the plugin")
    })?;
    Ok((hash, load::open(file)?))
}

/// Library files of the folders, by folder and then by name; the same file twice counts once.
fn libraries(folders: &[PathBuf], problems: &mut Vec<PluginProblem>) -> Vec<PathBuf> {
    let (mut found, mut seen) = (Vec::new(), BTreeSet::new());
    for folder in folders.iter().filter(|folder| folder.exists()) {
        match libraries_in(folder) {
            Ok(files) => found.extend(files.into_iter().filter(|file| seen.insert(file.clone()))),
            Err(error) => {
                let refusal = Refusal::new(format!("cannot be searched for plugins: {error}"), "name a folder that can be read");
                problems.push(refusal.at(folder));
            }
        }
    }
    found
}

fn libraries_in(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == DLL_EXTENSION) {
            files.push(path.canonicalize().unwrap_or(path));
        }
    }
    files.sort();
    Ok(files)
}
