//! What is known of a plugin, and what is wrong with a file that is none.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_gear::TextPlugin;
use endline_sdk::{Act, Attribute, Descriptor, FrictionModel, GearType, WhaleMotion};

use super::choices::Ask;

/// Lets a plugin file with bytes of this hash pass, or says why not.
pub type Checker<'a> = dyn Fn(&Path, &str) -> Result<(), String> + 'a;

/// Which hook a plugin serves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PluginKind {
    /// A whale motion.
    Motion,
    /// A friction model.
    Friction,
    /// A gear type.
    Gear,
    /// Motion clips: acts of whales, as data.
    Clips,
}

impl PluginKind {
    /// Its name in lists, such as `friction model`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Motion => "whale motion",
            Self::Friction => "friction model",
            Self::Gear => "gear type",
            Self::Clips => "motion clips",
        }
    }
}

impl fmt::Display for PluginKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A plugin ready to be called, linked or loaded.
#[derive(Clone)]
pub enum Hook {
    /// A whale motion.
    Motion(Arc<dyn WhaleMotion>),
    /// A friction model.
    Friction(Arc<dyn FrictionModel>),
    /// A gear type.
    Gear(Arc<dyn GearType>),
}

impl Hook {
    /// Who it is and what it takes.
    #[must_use]
    pub fn descriptor(&self) -> &Descriptor {
        match self {
            Self::Motion(motion) => motion.descriptor(),
            Self::Friction(friction) => friction.descriptor(),
            Self::Gear(gear) => gear.descriptor(),
        }
    }

    /// Which hook it serves.
    #[must_use]
    pub fn kind(&self) -> PluginKind {
        match self {
            Self::Motion(_) => PluginKind::Motion,
            Self::Friction(_) => PluginKind::Friction,
            Self::Gear(_) => PluginKind::Gear,
        }
    }
}

/// A usable plugin, as lists and recordings name it.
#[derive(Clone, Debug, PartialEq)]
pub struct PluginInfo {
    /// Reverse-domain id.
    pub id: String,
    /// Version.
    pub version: String,
    /// Which hook it serves.
    pub kind: PluginKind,
    /// Name shown in menus.
    pub name: String,
    /// One sentence of help.
    pub help: String,
    /// Declared attributes.
    pub attributes: Vec<Attribute>,
    /// Acts of a whale motion.
    pub acts: Vec<Act>,
    /// File it was loaded from; none where it is linked into the program.
    pub file: Option<PathBuf>,
    /// BLAKE3 hash of that file, in hexadecimal.
    pub hash: Option<String>,
    /// What its library says of itself: who made it, where its laws and figures come from; may be empty.
    pub about: String,
    /// Whether it runs in a process of its own.
    pub out_of_process: bool,
}

/// Where a plugin was loaded from.
#[derive(Clone)]
pub(super) struct Origin {
    pub file: PathBuf,
    pub hash: String,
    pub about: String,
    pub out_of_process: bool,
}

impl PluginInfo {
    /// Motion clips of a folder, as lists name them.
    pub(super) fn of_clips(plugin: &TextPlugin, from: Origin) -> Self {
        Self {
            id: plugin.id.clone(),
            version: plugin.version.clone(),
            kind: PluginKind::Clips,
            name: plugin.name.clone(),
            help: plugin.help.clone(),
            attributes: Vec::new(),
            acts: plugin.acts.clone(),
            file: Some(from.file),
            hash: Some(from.hash),
            about: from.about,
            out_of_process: false,
        }
    }

    pub(super) fn of(hook: &Hook, from: Option<Origin>) -> Self {
        let descriptor = hook.descriptor();
        let about = from.as_ref().map(|from| from.about.clone()).unwrap_or_default();
        let out_of_process = from.as_ref().is_some_and(|from| from.out_of_process);
        let (file, hash) = from.map(|Origin { file, hash, .. }| (file, hash)).unzip();
        Self {
            id: descriptor.id.to_string(),
            version: descriptor.version.to_string(),
            kind: hook.kind(),
            name: descriptor.name.to_string(),
            help: descriptor.help.to_string(),
            attributes: descriptor.attributes.clone(),
            acts: descriptor.acts.clone(),
            file,
            hash,
            about,
            out_of_process,
        }
    }
}

/// What is to become of a file that is not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It cannot be used.
    Unusable,
    /// It failed the check in a child process: quarantine.
    SetAside,
    /// Its user has not allowed it, or not in its present form.
    Waiting(Box<Ask>),
}

/// Why a file, or one plugin in it, is not used; the program goes on without it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PluginProblem {
    /// The file or folder.
    pub file: PathBuf,
    /// Id of the plugin, where the trouble is one plugin's.
    pub id: Option<String>,
    /// What is wrong.
    pub reason: String,
    /// What can be done.
    pub help: String,
    /// What is to become of the file.
    pub standing: Standing,
}

impl fmt::Display for PluginProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.file.display())?;
        if let Some(id) = &self.id {
            write!(f, "plugin `{id}`: ")?;
        }
        write!(f, "{}; {}", self.reason, self.help)
    }
}

/// A problem before its file is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Refusal {
    pub id: Option<String>,
    pub reason: String,
    pub help: String,
    pub standing: Standing,
}

impl Refusal {
    pub(super) fn new(reason: impl Into<String>, help: impl Into<String>) -> Self {
        Self { id: None, reason: reason.into(), help: help.into(), standing: Standing::Unusable }
    }

    pub(super) fn of(id: &str, reason: impl Into<String>, help: impl Into<String>) -> Self {
        Self { id: Some(id.to_owned()), ..Self::new(reason, help) }
    }

    pub(super) fn at(self, file: impl Into<PathBuf>) -> PluginProblem {
        PluginProblem {
            file: file.into(),
            id: self.id,
            reason: self.reason,
            help: self.help,
            standing: self.standing,
        }
    }
}
