//! What is known of a plugin, and what is wrong with a file that is none.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use endline_sdk::{Act, Attribute, Descriptor, FrictionModel, GearType, WhaleMotion};

/// Which hook a plugin serves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PluginKind {
    /// A whale motion.
    Motion,
    /// A friction model.
    Friction,
    /// A gear type.
    Gear,
}

impl PluginKind {
    /// Its name in lists, such as `friction model`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Motion => "whale motion",
            Self::Friction => "friction model",
            Self::Gear => "gear type",
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
}

impl PluginInfo {
    pub(super) fn of(hook: &Hook, file: Option<(PathBuf, String)>) -> Self {
        let descriptor = hook.descriptor();
        let (file, hash) = file.unzip();
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
        }
    }
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
}

impl Refusal {
    pub(super) fn new(reason: impl Into<String>, help: impl Into<String>) -> Self {
        Self { id: None, reason: reason.into(), help: help.into() }
    }

    pub(super) fn of(id: &str, reason: impl Into<String>, help: impl Into<String>) -> Self {
        Self { id: Some(id.to_owned()), reason: reason.into(), help: help.into() }
    }

    pub(super) fn at(self, file: impl Into<PathBuf>) -> PluginProblem {
        PluginProblem { file: file.into(), id: self.id, reason: self.reason, help: self.help }
    }
}
