//! The descriptor of a plugin: id, version, attributes, floats of state.

use std::borrow::Cow;
use std::fmt;

/// Identity and attributes of a plugin.
#[derive(Clone, Debug, PartialEq)]
pub struct Descriptor {
    /// Reverse-domain id, such as `org.endline.friction.coulomb`.
    pub id: Cow<'static, str>,
    /// Version of the plugin, such as `0.1.0`.
    pub version: Cow<'static, str>,
    /// Name shown in menus.
    pub name: Cow<'static, str>,
    /// One sentence of help.
    pub help: Cow<'static, str>,
    /// Declared attributes, in the order of their values.
    pub attributes: Vec<Attribute>,
    /// Floats of state, stored by the engine: in total for a motion and a gear
    /// type, for each contact for a friction model.
    pub state_len: usize,
    /// Acts a pilot may ask of a whale motion, in the order of [`Controls::act`](crate::Controls::act);
    /// empty for other kinds.
    pub acts: Vec<Act>,
}

impl Descriptor {
    /// A plugin of version 0.1.0 with its id, its name and one sentence of help; without attributes, floats and acts.
    #[must_use]
    pub fn new(id: &'static str, name: &'static str, help: &'static str) -> Self {
        let (attributes, acts) = (Vec::new(), Vec::new());
        Self {
            id: id.into(),
            version: "0.1.0".into(),
            name: name.into(),
            help: help.into(),
            attributes,
            state_len: 0,
            acts,
        }
    }

    /// This descriptor with other attributes.
    #[must_use]
    pub fn with_attributes(self, attributes: Vec<Attribute>) -> Self {
        Self { attributes, ..self }
    }

    /// This descriptor with a count of floats of state.
    #[must_use]
    pub fn with_state(self, state_len: usize) -> Self {
        Self { state_len, ..self }
    }
}

/// An action of a whale motion on request, such as rolling away.
#[derive(Clone, Debug, PartialEq)]
pub struct Act {
    /// Id in files, such as `roll-away`.
    pub id: Cow<'static, str>,
    /// Name shown in menus.
    pub name: Cow<'static, str>,
    /// Help shown beside it.
    pub help: Cow<'static, str>,
}

/// One setting of a plugin.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Key in files, such as `beat_frequency`.
    pub key: Cow<'static, str>,
    /// SI unit such as `m/s`, `rad`, `N`, or `1` for a pure number or a count; empty for a word or a library item.
    pub unit: Cow<'static, str>,
    /// Help shown beside the field.
    pub help: Cow<'static, str>,
    /// Its kind of values.
    pub kind: AttributeKind,
}

/// The kinds of attributes.
#[derive(Clone, Debug, PartialEq)]
pub enum AttributeKind {
    /// A number in the attribute's SI unit.
    Number {
        /// Least allowed value.
        min: f64,
        /// Greatest allowed value.
        max: f64,
        /// Default value.
        default: f64,
    },
    /// A whole number.
    Count {
        /// Least allowed value.
        min: u32,
        /// Greatest allowed value.
        max: u32,
        /// Default value.
        default: u32,
    },
    /// One of several words.
    Choice {
        /// The words; none is empty or contains a `|`.
        words: Vec<Cow<'static, str>>,
        /// Default word.
        default: Cow<'static, str>,
    },
    /// The id of an item of the gear library.
    Item {
        /// Folder of the library: `ropes`, `traps`, `buoys`, `weak-links`, `anchors`.
        library: Cow<'static, str>,
        /// Default item; empty for no item.
        default: Cow<'static, str>,
    },
}

/// A value of an attribute, of its [`AttributeKind`].
#[derive(Clone, Debug, PartialEq)]
pub enum AttributeValue {
    /// Number in the attribute's SI unit; whole for a count.
    Number(f64),
    /// The word chosen.
    Choice(String),
    /// Id of a library item.
    Item(String),
}

impl Attribute {
    /// A numeric attribute.
    #[must_use]
    pub fn number(
        key: &'static str,
        unit: &'static str,
        range: [f64; 2],
        default: f64,
        help: &'static str,
    ) -> Self {
        let [min, max] = range;
        Self {
            key: key.into(),
            unit: unit.into(),
            help: help.into(),
            kind: AttributeKind::Number { min, max, default },
        }
    }

    /// An attribute that counts.
    #[must_use]
    pub fn count(
        key: &'static str,
        [min, max]: [u32; 2],
        default: u32,
        help: &'static str,
    ) -> Self {
        Self {
            key: key.into(),
            unit: "1".into(),
            help: help.into(),
            kind: AttributeKind::Count { min, max, default },
        }
    }

    /// An attribute that is one of several words; the first is the default.
    #[must_use]
    pub fn choice(key: &'static str, words: &[&'static str], help: &'static str) -> Self {
        let default = words.first().copied().unwrap_or_default().into();
        let words = words.iter().map(|word| Cow::Borrowed(*word)).collect();
        Self {
            key: key.into(),
            unit: "".into(),
            help: help.into(),
            kind: AttributeKind::Choice { words, default },
        }
    }

    /// An attribute that names an item of the gear library.
    #[must_use]
    pub fn item(
        key: &'static str,
        library: &'static str,
        default: &'static str,
        help: &'static str,
    ) -> Self {
        let kind = AttributeKind::Item { library: library.into(), default: default.into() };
        Self { key: key.into(), unit: "".into(), help: help.into(), kind }
    }

    /// The default value.
    #[must_use]
    pub fn default_value(&self) -> AttributeValue {
        match &self.kind {
            AttributeKind::Number { default, .. } => AttributeValue::Number(*default),
            AttributeKind::Count { default, .. } => AttributeValue::Number(f64::from(*default)),
            AttributeKind::Choice { default, .. } => AttributeValue::Choice(default.to_string()),
            AttributeKind::Item { default, .. } => AttributeValue::Item(default.to_string()),
        }
    }
}

impl AttributeValue {
    /// The number, if it is one.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(value) => Some(*value),
            Self::Choice(_) | Self::Item(_) => None,
        }
    }

    /// The word, if it is one.
    #[must_use]
    pub fn choice(&self) -> Option<&str> {
        match self {
            Self::Choice(word) => Some(word),
            Self::Number(_) | Self::Item(_) => None,
        }
    }

    /// The item id, if it is one.
    #[must_use]
    pub fn item(&self) -> Option<&str> {
        match self {
            Self::Item(id) => Some(id),
            Self::Number(_) | Self::Choice(_) => None,
        }
    }
}

impl Act {
    /// An act with its id, its name and one sentence of help.
    #[must_use]
    pub fn new(id: &'static str, name: &'static str, help: &'static str) -> Self {
        Self { id: id.into(), name: name.into(), help: help.into() }
    }
}

/// The error of a hook; the run ends with it and the plugin's id.
#[derive(Clone, Debug, PartialEq)]
pub struct HookError {
    /// The message for the user.
    pub message: String,
}

impl HookError {
    /// An error with a message for the user.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into() }
    }
}

impl fmt::Display for HookError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for HookError {}
