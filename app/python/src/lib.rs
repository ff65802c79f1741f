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

mod error;
mod host;
mod library;
mod moments;
mod result;
mod scenario;
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

/// Asks the interpreter now and then whether the user wants to stop.
struct Signals {
    asked: std::time::Instant,
    raised: Option<PyErr>,
}

impl Signals {
    /// Between two questions; each takes the interpreter's lock.
    const PAUSE: std::time::Duration = std::time::Duration::from_millis(100);

    fn new() -> Self {
        Self { asked: std::time::Instant::now(), raised: None }
    }

    /// Whether work goes on; false once Ctrl+C or another signal has raised an exception, which is kept.
    fn go_on(&mut self) -> bool {
        if self.asked.elapsed() >= Self::PAUSE {
            self.raised = Python::attach(|python| python.check_signals()).err();
            self.asked = std::time::Instant::now();
        }
        self.raised.is_none()
    }

    /// What was raised.
    fn outcome(self) -> PyResult<()> {
        self.raised.map_or(Ok(()), Err)
    }
}
