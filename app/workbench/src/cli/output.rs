//! Printing that survives a reader who has gone (`endline … | head`), and that no text of a file can turn against the terminal.

use std::io::{self, Write};
use std::process::ExitCode;

use super::Failure;
use super::harmless::harmless;

/// Prints on standard output; a closed pipe is no error.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(harmless(text).as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::failed(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Prints a note on standard error, where anyone still reads it.
pub(super) fn note(text: &str) {
    let _ = writeln!(io::stderr(), "endline: {}", harmless(text));
}

/// Prints help, the version or what is wrong with the command line, and gives its exit code.
pub(super) fn usage(message: &clap::Error) -> ExitCode {
    let _ = message.print();
    ExitCode::from(u8::try_from(message.exit_code()).unwrap_or(2))
}
