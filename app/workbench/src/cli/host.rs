//! The plugins of this program and this user, for every command.

use std::path::PathBuf;
use std::time::Duration;

use endline_session::PluginHost;
use endline_session::plugins::{by_child, default_folders, known_file, remembering};

use super::output;

/// A plugin that has not opened after this is taken to hang.
const PATIENCE: Duration = Duration::from_secs(10);

/// Loads the plugins, each first opened by a child process; those that fail are told on standard
/// error and left out.
pub(super) fn load() -> PluginHost {
    let (host, problems) = match std::env::current_exe() {
        Ok(program) => PluginHost::discover_checked(&folders(), &remembering(known_file(), &by_child(program, PATIENCE))),
        Err(error) => {
            output::note(&format!("plugins are opened unchecked, as the program cannot find itself: {error}"));
            PluginHost::discover(&folders())
        }
    };
    problems.iter().for_each(|problem| output::note(&problem.to_string()));
    host
}

/// The folders searched.
pub(super) fn folders() -> Vec<PathBuf> {
    default_folders()
}
