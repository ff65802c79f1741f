//! The plugins of this program and this user, for every command.

use std::path::PathBuf;

use endline_session::plugins::default_folders;
use endline_session::{PluginHost, load_plugins};

use super::output;

/// Loads the plugins; those that fail are told on standard error and left out.
pub(super) fn load() -> PluginHost {
    let (host, problems) = load_plugins(&folders());
    problems.iter().for_each(|problem| output::note(&problem.to_string()));
    host
}

/// The folders searched.
pub(super) fn folders() -> Vec<PathBuf> {
    default_folders()
}
