//! Descriptions of plugins, of those used by a model, and problems of files that are none.

use std::collections::BTreeSet;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_sdk::{
    Act, Attribute, AttributeKind, Controls, Descriptor, FrictionModel, GearType, WhaleMotion,
};
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

use super::choices::Ask;

/// Accepts a plugin file with bytes of this hash, or returns the reason against it.
pub type Checker<'a> = dyn Fn(&Path, &str) -> Result<(), String> + 'a;

/// Which hook a plugin serves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
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
    /// Its word in ids and folders, such as `motion`.
    pub fn word(self) -> &'static str {
        self.into()
    }

    /// Its name in lists, such as `friction model`.
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
    /// Its id, name and attributes.
    pub fn descriptor(&self) -> &Descriptor {
        match self {
            Self::Motion(motion) => motion.descriptor(),
            Self::Friction(friction) => friction.descriptor(),
            Self::Gear(gear) => gear.descriptor(),
        }
    }

    /// Which hook it serves.
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
    /// The description of its library: its author, the sources of its laws and figures; may be empty.
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
    pub(super) fn of(kind: PluginKind, descriptor: &Descriptor, from: Option<Origin>) -> Self {
        let about = from.as_ref().map(|from| from.about.clone()).unwrap_or_default();
        let out_of_process = from.as_ref().is_some_and(|from| from.out_of_process);
        let (file, hash) = from.map(|Origin { file, hash, .. }| (file, hash)).unzip();
        Self {
            id: descriptor.id.to_string(),
            version: descriptor.version.to_string(),
            kind,
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

/// The standing of a file that is not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It cannot be used.
    Unusable,
    /// It failed the check in a child process: quarantine.
    SetAside,
    /// Its user has not allowed it, or not in its present form.
    Waiting(Box<Ask>),
}

/// Why a file, or one plugin in it, is not used; the program continues without it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PluginProblem {
    /// The file or folder.
    pub file: PathBuf,
    /// Id of the plugin, where the trouble is one plugin's.
    pub id: Option<String>,
    /// The problem.
    pub reason: String,
    /// The remedy.
    pub help: String,
    /// The standing of the file.
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
}

impl Refusal {
    pub(super) fn new(reason: impl Into<String>, help: impl Into<String>) -> Self {
        Self { id: None, reason: reason.into(), help: help.into() }
    }

    pub(super) fn of(id: &str, reason: impl Into<String>, help: impl Into<String>) -> Self {
        Self { id: Some(id.to_owned()), ..Self::new(reason, help) }
    }

    pub(super) fn at(self, file: impl Into<PathBuf>) -> PluginProblem {
        let Self { id, reason, help } = self;
        PluginProblem { file: file.into(), id, reason, help, standing: Standing::Unusable }
    }
}

/// Most attributes, and floats of state, that a plugin may declare; more is taken for a lie.
pub(super) const MOST_ATTRIBUTES: usize = 1000;
pub(super) const MOST_STATE: usize = 1_000_000;

/// Most acts that a motion may declare.
pub(super) const MOST_ACTS: usize = Controls::MOST_ACTS;

const TELL_AUTHOR: &str = "tell the plugin's author";

/// Checks id, attributes, defaults, state length and acts.
pub(super) fn check(descriptor: &Descriptor) -> Result<(), Refusal> {
    let id = descriptor.id.as_ref();
    if !id_is_sound(id) {
        let reason =
            format!("its id `{id}` is not a reverse-domain name such as org.example.friction.wet");
        return Err(Refusal::new(reason, TELL_AUTHOR));
    }
    let wrong = |reason: String| Err(Refusal::of(id, reason, TELL_AUTHOR));
    if descriptor.state_len > MOST_STATE {
        return wrong(format!(
            "it asks for {} floats of state, more than {MOST_STATE}",
            descriptor.state_len
        ));
    }
    let mut keys = BTreeSet::new();
    for attribute in &descriptor.attributes {
        let key = attribute.key.as_ref();
        if key.is_empty() || !keys.insert(key) {
            return wrong(format!("its attribute key `{key}` is empty or used twice"));
        }
        if let Some(reason) = fault(&attribute.kind) {
            return wrong(format!("its attribute `{key}`: {reason}"));
        }
    }
    match act_fault(descriptor) {
        Some(reason) => wrong(reason),
        None => Ok(()),
    }
}

/// Acts are named in scenarios by their id, each once.
fn act_fault(descriptor: &Descriptor) -> Option<String> {
    let is_sound = |id: &str| {
        !id.is_empty()
            && id.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
    };
    let mut ids = BTreeSet::new();
    let wrong =
        descriptor.acts.iter().find(|act| !is_sound(&act.id) || !ids.insert(act.id.as_ref()))?;
    Some(format!(
        "its act `{}` is named twice or not in small letters, digits and hyphens, such as roll-away",
        wrong.id
    ))
}

fn id_is_sound(id: &str) -> bool {
    let part = |part: &str| {
        !part.is_empty() && part.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
    };
    id.contains('.') && id.split('.').all(part)
}

fn fault(kind: &AttributeKind) -> Option<String> {
    match kind {
        AttributeKind::Number { min, max, default } => {
            let sound = [min, max, default].iter().all(|number| number.is_finite())
                && min <= default
                && default <= max;
            (!sound).then(|| format!("its default {default} and range {min} to {max} must be finite, the default within the range"))
        }
        AttributeKind::Count { min, max, default } => (!(min..=max).contains(&default))
            .then(|| format!("its default {default} is not within its range {min} to {max}")),
        AttributeKind::Choice { words, default } => {
            let sound = words.iter().all(|word| !word.is_empty() && !word.contains('|'))
                && words.contains(default);
            (!sound).then(|| format!("its words must not be empty or hold a `|`, and its default `{default}` must be one of them"))
        }
        AttributeKind::Item { .. } => None,
    }
}

/// A plugin a model runs on.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct PluginUsed {
    /// Id, such as `org.endline.friction.coulomb`.
    pub id: String,
    /// Version.
    pub version: String,
    /// BLAKE3 of the file it was loaded from, hexadecimal; empty where it is linked in.
    pub file_hash: String,
}
