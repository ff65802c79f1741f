//! Why a command failed, told to the user once.

use std::io::Write;
use std::process::ExitCode;

use super::harmless::harmless;

/// What to tell the user, and the exit code.
#[derive(Debug)]
pub struct Failure {
    message: String,
    code: u8,
}

impl Failure {
    /// The run or check failed: exit code 1.
    pub fn failed(message: impl ToString) -> Self {
        Self { message: message.to_string(), code: 1 }
    }

    /// Wrong use of the command line: exit code 2.
    pub fn usage(message: impl ToString) -> Self {
        Self { message: message.to_string(), code: 2 }
    }

    /// Says it on standard error and gives the exit code.
    #[must_use]
    pub fn tell(&self) -> ExitCode {
        // Nobody is left to tell where standard error is closed; the exit code still says it.
        let _ = writeln!(std::io::stderr(), "endline: {}", harmless(&self.message));
        ExitCode::from(self.code)
    }
}

impl From<endline_session::Error> for Failure {
    fn from(error: endline_session::Error) -> Self {
        Self::failed(error)
    }
}
