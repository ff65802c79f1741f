//! The module `endline._endline`: the session, as the Python package `endline` calls it.
//!
//! Numbers are passed as bytes with a shape, figures as the JSON of the command line; the package converts them to arrays and
//! dictionaries. Each function calls the function of the session that the command line calls. This file loads the plugins once and
//! reads quantities.
//!
//! | module | content |
//! |---|---|
//! | `error` | errors as exceptions |
//! | `library` | a gear library and its assemblies |
//! | `scenario` | statics and run of a scenario; replay of a recording |
//! | `stepping` | a run taken step by step, its states stored and restored |
//! | `result` | results of a run: figures, moments, a recording, pictures |
//! | `moments` | the moments of a run as arrays |
//! | `study` | run, merge and report of a study |
//! | `signals` | Ctrl+C during work of Endline |

mod error;
mod library;
mod moments;
mod result;
mod scenario;
mod signals;
mod stepping;
mod study;

use std::path::PathBuf;
use std::sync::OnceLock;

use endline_gear::units::{self, Quantity};
use endline_session::plugins::{self, default_folders};
use endline_session::{PluginHost, load_plugins};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The compiled part of the package `endline`.
#[pymodule]
mod _endline {
    #[pymodule_export]
    use crate::error::EndlineError;
    #[pymodule_export]
    use crate::library::{Assembly, Library};
    #[pymodule_export]
    use crate::moments::parts;
    #[pymodule_export]
    use crate::result::Result;
    #[pymodule_export]
    use crate::scenario::{Scenario, replay};
    #[pymodule_export]
    use crate::stepping::{Moment, Run, RunState};
    #[pymodule_export]
    use crate::study::Study;
    #[pymodule_export]
    use crate::{problems, si, stands_for, version};
}

static LOADED: OnceLock<(PluginHost, Vec<String>)> = OnceLock::new();

fn loaded() -> &'static (PluginHost, Vec<String>) {
    LOADED.get_or_init(|| {
        let (host, problems) = load_plugins(&default_folders());
        (host, problems.iter().map(ToString::to_string).collect())
    })
}

/// The plugins of this program and this user.
fn host() -> &'static PluginHost {
    &loaded().0
}

/// Problems of omitted plugins, as the command line reports them.
#[pyfunction]
fn problems(python: Python<'_>) -> Vec<String> {
    python.detach(|| loaded().1.clone())
}

/// Sets the path of the program, which locates plugins and library. Called once, at the import of the package.
#[pyfunction]
fn stands_for(program: PathBuf) {
    plugins::stands_for(program);
}

/// Version of Endline with the mark of the code that determines a run.
#[pyfunction]
fn version() -> &'static str {
    endline_session::VERSION
}

/// Reads a text with a unit, such as `40 fathom`, into an SI unit, such as `m`; `argument` is its name in messages.
#[pyfunction]
fn si(text: &str, unit: &str, argument: &str) -> PyResult<f64> {
    let quantity = Quantity::from_si_unit(unit).ok_or_else(|| {
        PyValueError::new_err(format!("{unit} is no SI unit of a quantity; expected one such as m"))
    })?;
    units::parse(text, quantity).map_err(|error| {
        PyValueError::new_err(format!("{argument}: {error}; a plain number is in {unit}"))
    })
}
