//! The module `endline._endline`: the session, as the Python package `endline` calls it.
//!
//! Numbers are passed as bytes with a shape, figures as the JSON of the command line; the package converts them to arrays and
//! dictionaries. Each function calls the same function of the session as the command line.
//!
//! | module | content |
//! |---|---|
//! | `host` | the plugins, loaded once |
//! | `error` | errors as exceptions |
//! | `library` | a gear library and its assemblies |
//! | `scenario` | statics and run of a scenario; replay of a recording |
//! | `result` | results of a run: figures, moments, a recording, pictures |
//! | `moments` | the moments of a run as arrays |
//! | `study` | run, merge and report of a study |
//! | `signals` | Ctrl+C during work of Endline |

mod error;
mod host;
mod library;
mod moments;
mod result;
mod scenario;
mod signals;
mod study;

use pyo3::prelude::*;

/// The compiled part of the package `endline`.
#[pymodule]
mod _endline {
    #[pymodule_export]
    use crate::error::EndlineError;
    #[pymodule_export]
    use crate::host::{problems, stands_for, version};
    #[pymodule_export]
    use crate::library::{Assembly, Library};
    #[pymodule_export]
    use crate::result::Result;
    #[pymodule_export]
    use crate::scenario::{Scenario, replay};
    #[pymodule_export]
    use crate::study::Study;
}
