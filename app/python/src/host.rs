//! The plugins of this program and this user, loaded once.

use std::path::PathBuf;
use std::sync::OnceLock;

use endline_session::plugins::{self, default_folders};
use endline_session::{PluginHost, load_plugins};
use pyo3::prelude::*;

static LOADED: OnceLock<(PluginHost, Vec<String>)> = OnceLock::new();

fn loaded() -> &'static (PluginHost, Vec<String>) {
    LOADED.get_or_init(|| {
        let (host, problems) = load_plugins(&default_folders());
        (host, problems.iter().map(ToString::to_string).collect())
    })
}

/// The plugins.
pub fn host() -> &'static PluginHost {
    &loaded().0
}

/// Problems of omitted plugins, as the command line reports them.
#[pyfunction]
pub fn problems(python: Python<'_>) -> Vec<String> {
    python.detach(|| loaded().1.clone())
}

/// Sets the path of the program, which locates plugins and library. Called once, at the import of the package.
#[pyfunction]
pub fn stands_for(program: PathBuf) {
    plugins::stands_for(program);
}

/// Version of Endline with the mark of the code that determines a run.
#[pyfunction]
pub fn version() -> &'static str {
    endline_session::VERSION
}
