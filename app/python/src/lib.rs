//! The module `endline._endline`: the session, as the Python package `endline` calls it.
//!
//! Numbers cross as bytes with a shape, figures as the JSON of the command line; the package makes arrays and dictionaries
//! of them. No rule of Endline stands here: each function calls the piece of the session that the command line calls.
//!
//! | module | what |
//! |---|---|
//! | `host` | the plugins, loaded once |
//! | `error` | errors as exceptions |
//! | `library` | a gear library and its assemblies |
//! | `scenario` | a scenario settled and run; a recording run again |
//! | `result` | what a run leaves: figures, moments, a recording, pictures |
//! | `moments` | the moments of a run as arrays |
//! | `study` | a study run, merged, reported |
//! | `signals` | Ctrl+C while Endline works |

mod error;
mod host;
mod library;
mod moments;
mod result;
mod scenario;
mod signals;
mod study;

use pyo3::prelude::*;

/// The compiled half of the package `endline`.
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
