//! What a user prefers, kept between sessions.

use std::path::PathBuf;

use endline_session::units::Units;
use serde::{Deserialize, Serialize};

use super::theme::Theme;
use crate::input::Mapping;

/// What a user prefers; kept between sessions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Dark or light.
    pub theme: Theme,
    /// Units on screen.
    pub units: Units,
    /// Whether pushing the stick puts the nose down.
    pub invert_pitch: bool,
    /// What the pad does.
    pub mapping: Mapping,
    /// Size of everything on screen, 1 for usual; larger for a projector.
    pub scale: Scale,
    /// Scenarios open last, the newest first.
    pub recent: Vec<PathBuf>,
}

/// Size of everything on screen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scale(pub f32);

impl Default for Scale {
    fn default() -> Self {
        Self(1.0)
    }
}
