//! What a user prefers wherever the workbench is used, kept between sessions.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::units::Units;

/// Scenarios kept as opened last.
const RECENT: usize = 8;

/// What a user prefers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Units that values are shown in.
    pub units: Units,
    /// Scenarios opened last, the newest first.
    pub recent: Vec<PathBuf>,
}

impl Preferences {
    /// Puts a scenario first among those opened last.
    pub(super) fn remember(&mut self, path: &Path) {
        self.recent.retain(|known| known != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(RECENT);
    }
}
