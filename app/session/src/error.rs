//! Errors of a session.

use std::fmt;
use std::path::Path;

use endline_gear::{Diagnostic, EditError};
use endline_sim::Stop;

/// Why a session could not do a request.
#[derive(Clone, Debug)]
pub enum Error {
    /// A file, and what is wrong with it.
    File {
        /// The file as the user named it.
        file: String,
        /// What is wrong, as the rest of a sentence that begins with the file's name.
        message: String,
    },
    /// Files of the gear library, a scenario or a project with located errors.
    Diagnostics(Vec<Diagnostic>),
    /// Statics found no rest, and the run was not allowed to start without it.
    Unsettled {
        /// The part and the force out of balance.
        why: String,
        /// Passes made.
        passes: usize,
    },
    /// The run cannot continue.
    Stopped(Stop),
    /// Anything else, in words.
    Message(String),
}

impl Error {
    /// The error of an attempt at a file, such as `cannot be read`, with its cause.
    pub fn on<E: fmt::Display>(file: &Path, failed: &str) -> impl Fn(E) -> Self {
        move |cause| Self::at(file, format!("{failed}: {cause}"))
    }

    /// An error about a file.
    pub fn at(file: &Path, message: impl Into<String>) -> Self {
        Self::File { file: file.display().to_string(), message: message.into() }
    }

    /// The error with each located problem replaced, such as by one at the place that caused it.
    pub(crate) fn for_each_problem(self, replace: impl Fn(Diagnostic) -> Diagnostic) -> Self {
        match self {
            Self::Diagnostics(problems) => {
                Self::Diagnostics(problems.into_iter().map(replace).collect())
            }
            error => error,
        }
    }
}

impl From<Vec<Diagnostic>> for Error {
    fn from(problems: Vec<Diagnostic>) -> Self {
        Self::Diagnostics(problems)
    }
}

impl From<Diagnostic> for Error {
    fn from(problem: Diagnostic) -> Self {
        vec![problem].into()
    }
}

impl From<Box<Diagnostic>> for Error {
    fn from(problem: Box<Diagnostic>) -> Self {
        (*problem).into()
    }
}

impl From<EditError> for Error {
    fn from(error: EditError) -> Self {
        Self::Message(error.message)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { file, message } => write!(f, "{file} {message}"),
            Self::Diagnostics(diagnostics) => {
                let all: Vec<String> = diagnostics.iter().map(ToString::to_string).collect();
                f.write_str(&all.join("\n"))
            }
            Self::Unsettled { why, passes } => write!(
                f,
                "statics found no rest of the gear in {passes} passes: {why}\n\
                 see `endline settle` for the trace; --allow-unsettled starts the run regardless"
            ),
            Self::Stopped(stop) => {
                write!(f, "stopped at {:.3} s: {}: {}", stop.time_s, stop.part, stop.reason)
            }
            Self::Message(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for Error {}
