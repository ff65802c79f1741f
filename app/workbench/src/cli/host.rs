//! The plugins of this program and this user, for every command.

use std::path::PathBuf;
use std::sync::OnceLock;

use endline_session::plugins::{Loader, PluginProblem, Standing, default_folders};
use endline_session::{PluginHost, load_with};

use super::output;
use crate::embedded;

/// Whether the command line allows new and changed plugins.
static ALLOW: OnceLock<bool> = OnceLock::new();

/// Says once, before anything is loaded, whether libraries that are new or have changed are allowed.
pub(super) fn allow(allowed: bool) {
    // Said before in this program, it stays as it was.
    let _ = ALLOW.set(allowed);
}

/// Loads the plugins; those that fail or were not allowed are reported on standard error and left out.
pub(super) fn load() -> PluginHost {
    load_reported().0
}

/// Loads the plugins, and returns the problems too.
pub(super) fn load_reported() -> (PluginHost, Vec<PluginProblem>) {
    let mut loader = loader();
    let (mut host, mut problems) = load_with(&mut loader);
    if ALLOW.get() == Some(&true) && allow_waiting(&mut loader, &problems) {
        (host, problems) = load_with(&mut loader);
    }
    problems.iter().for_each(|problem| output::warn(&problem.to_string()));
    for plugin in host.list() {
        output::detail(&format!("plugin: {} {}", plugin.id, plugin.version));
    }
    (host, problems)
}

/// Allows every library that waits; false where none does.
fn allow_waiting(loader: &mut Loader, problems: &[PluginProblem]) -> bool {
    let mut any = false;
    for problem in problems {
        if let Standing::Waiting(ask) = &problem.standing {
            any = true;
            match loader.choices.allow(&problem.file, &ask.hash) {
                Ok(()) => {
                    output::note(&format!("{}: allowed, hash {}", problem.file.display(), ask.hash))
                }
                Err(error) => output::warn(&error),
            }
        }
    }
    any
}

/// A loader of the folders searched.
pub(super) fn loader() -> Loader {
    embedded::plugin_loader(&folders())
}

/// The folders searched.
pub(super) fn folders() -> Vec<PathBuf> {
    default_folders()
}
