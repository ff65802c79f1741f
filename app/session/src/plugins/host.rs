//! The plugins of this program run, by id.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use endline_gear::{PLUGIN_FILE, Sources, TextPlugin};
use endline_sdk::{Descriptor, FrictionModel, GearType, WhaleMotion};

use super::choices::Choices;
use super::info::{Hook, Origin, PluginInfo, PluginKind, PluginProblem, Refusal};
use super::library::LoadedLibrary;
use super::{guard, info};

/// All usable plugins; each is guarded, so that bad output ends a run with the plugin's id.
#[derive(Clone, Default)]
pub struct PluginHost {
    hooks: BTreeMap<String, Hook>,
    infos: Vec<PluginInfo>,
    off: Vec<PluginInfo>,
    clips: Sources,
}

impl PluginHost {
    /// A host with no plugins.
    pub fn empty() -> Self {
        Self::default()
    }

    /// Adds a plugin that is linked into the program.
    pub fn add(&mut self, hook: Hook) -> Result<(), PluginProblem> {
        self.insert(hook, None, &Choices::everything()).map_err(|refusal| refusal.at("(linked)"))
    }

    /// Every plugin, in the order found.
    pub fn list(&self) -> &[PluginInfo] {
        &self.infos
    }

    /// Plugins that the user has switched off, in the order found.
    pub fn switched_off(&self) -> &[PluginInfo] {
        &self.off
    }

    /// The whale motion with this id.
    pub fn motion(&self, id: &str) -> Option<Arc<dyn WhaleMotion>> {
        if let Some(Hook::Motion(motion)) = self.hooks.get(id) {
            Some(Arc::clone(motion))
        } else {
            None
        }
    }

    /// The friction model with this id.
    pub fn friction(&self, id: &str) -> Option<Arc<dyn FrictionModel>> {
        if let Some(Hook::Friction(friction)) = self.hooks.get(id) {
            Some(Arc::clone(friction))
        } else {
            None
        }
    }

    /// The gear type with this id.
    pub fn gear(&self, id: &str) -> Option<Arc<dyn GearType>> {
        if let Some(Hook::Gear(gear)) = self.hooks.get(id) { Some(Arc::clone(gear)) } else { None }
    }

    /// Files of a gear library with the acts of plugins; where two files of acts have the same name, the library's own counts.
    pub fn with_clips(&self, library: Sources) -> Sources {
        let paths = self
            .clips
            .iter()
            .map(|(path, _)| path)
            .chain(self.clips.meshes().map(|(path, _)| path));
        let is_own = |path: &str| {
            library.get(&format!("acts/{}", path.rsplit('/').next().unwrap_or(path))).is_some()
        };
        let others: Vec<String> = paths.filter(|path| !is_own(path)).map(str::to_owned).collect();
        self.clips.only(&others).overlay(library)
    }

    /// Ids of all plugins that are called, sorted.
    pub fn ids(&self) -> Vec<String> {
        self.hooks.keys().cloned().collect()
    }

    /// The guarded plugin with this id.
    pub(super) fn hook(&self, id: &str) -> Option<&Hook> {
        self.hooks.get(id)
    }

    pub(super) fn add_loaded(
        &mut self,
        file: &Path,
        hash: &str,
        opened: LoadedLibrary,
        choices: &Choices,
        problems: &mut Vec<PluginProblem>,
    ) {
        for hook in opened.hooks {
            let from = Origin {
                file: file.to_path_buf(),
                hash: hash.to_owned(),
                about: opened.about.clone(),
                out_of_process: opened.out_of_process,
            };
            let added = hook.and_then(|hook| self.insert(hook, Some(from), choices));
            problems.extend(added.err().map(|refusal| refusal.at(file)));
        }
    }

    /// Adds plugins that are linked into the program, where no file serves their ids.
    pub(super) fn add_linked(
        &mut self,
        linked: &[Hook],
        choices: &Choices,
        problems: &mut Vec<PluginProblem>,
    ) {
        for hook in linked {
            if self.knows(&hook.descriptor().id).is_none() {
                let added = self.insert(hook.clone(), None, choices);
                problems.extend(added.err().map(|refusal| refusal.at("(linked)")));
            }
        }
    }

    /// Adds a plugin without code: its gear types, and its acts to those of the gear library.
    pub(super) fn add_text(
        &mut self,
        folder: &Path,
        plugin: &TextPlugin,
        choices: &Choices,
        problems: &mut Vec<PluginProblem>,
    ) {
        let hash = blake3::hash(&plugin.bytes).to_hex().to_string();
        let from = Origin {
            file: folder.join(PLUGIN_FILE),
            hash,
            about: plugin.about.clone(),
            out_of_process: false,
        };
        let gear = plugin
            .gear
            .iter()
            .map(|gear| self.insert(Hook::Gear(Arc::clone(gear)), Some(from.clone()), choices));
        let mut refused: Vec<Refusal> = gear.filter_map(Result::err).collect();
        if !plugin.acts.is_empty() {
            refused.extend(self.add_clips(plugin, from, choices).err());
        }
        problems.extend(refused.into_iter().map(|refusal| refusal.at(folder)));
    }

    fn add_clips(
        &mut self,
        plugin: &TextPlugin,
        from: Origin,
        choices: &Choices,
    ) -> Result<(), Refusal> {
        let text = |text: &String| text.clone().into();
        let clips = Descriptor {
            id: text(&plugin.id),
            version: text(&plugin.version),
            name: text(&plugin.name),
            help: text(&plugin.help),
            attributes: Vec::new(),
            state_len: 0,
            acts: plugin.acts.clone(),
        };
        info::check(&clips)?;
        let taken = |id: &str| {
            self.infos.iter().find(|info| {
                info.kind == PluginKind::Clips && info.acts.iter().any(|act| act.id == id)
            })
        };
        if let Some((act, first)) = plugin.acts.iter().find_map(|act| Some((act, taken(&act.id)?)))
        {
            let reason = format!("`{}` already has an act `{}`", first.id, act.id);
            return Err(Refusal::of(
                &plugin.id,
                reason,
                "name the act otherwise, or switch one of the two off",
            ));
        }
        if self.admit(PluginInfo::of(PluginKind::Clips, &clips, Some(from)), choices)? {
            self.clips = std::mem::take(&mut self.clips)
                .overlay(plugin.clips.under(&format!("plugins/{}", plugin.id)));
        }
        Ok(())
    }

    fn insert(
        &mut self,
        hook: Hook,
        from: Option<Origin>,
        choices: &Choices,
    ) -> Result<(), Refusal> {
        info::check(hook.descriptor())?;
        let id = hook.descriptor().id.to_string();
        if self.admit(PluginInfo::of(hook.kind(), hook.descriptor(), from), choices)? {
            self.hooks.insert(id, guard::guarded(hook));
        }
        Ok(())
    }

    /// Lists a plugin whose id is free; false where its user has switched it off.
    fn admit(&mut self, info: PluginInfo, choices: &Choices) -> Result<bool, Refusal> {
        if let Some(first) = self.knows(&info.id) {
            let place = first
                .file
                .as_ref()
                .map_or_else(|| "the program itself".to_owned(), |file| file.display().to_string());
            return Err(Refusal::of(
                &info.id,
                format!("{place} already has a plugin with this id"),
                "remove one of the two",
            ));
        }
        let on = !choices.is_off(&info.id);
        if on {
            self.infos.push(info)
        } else {
            self.off.push(info)
        }
        Ok(on)
    }

    /// The plugin listed under an id, on or off.
    fn knows(&self, id: &str) -> Option<&PluginInfo> {
        self.infos.iter().chain(&self.off).find(|known| known.id == id)
    }
}
