//! Printing that survives a reader who has gone (`endline … | head`), and that no text of a file can turn against the terminal.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::OnceLock;

use super::Failure;
use super::harmless::harmless;

/// How much is told on standard error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Told {
    /// What went wrong.
    Errors,
    /// Notes and progress too.
    Notes,
    /// Also which files and plugins are used.
    Details,
}

static TOLD: OnceLock<Told> = OnceLock::new();

/// Says once how much is told.
pub(super) fn tell(told: Told) {
    // Said before in this program, it stays as it was.
    let _ = TOLD.set(told);
}

/// Whether so much is told.
pub(super) fn is_told(told: Told) -> bool {
    told <= *TOLD.get().unwrap_or(&Told::Notes)
}

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

/// Refuses to write over the file that is read.
pub(super) fn not_its_own_input(input: &Path, out: &Path) -> Result<(), Failure> {
    let known = |path: &Path| path.canonicalize().ok();
    if known(input).is_none_or(|input| known(out) != Some(input)) {
        return Ok(());
    }
    let file = out.display();
    Err(Failure::usage(format!("--out would write over {file}, which is read; name another")))
}

/// Prints a note on standard error, where anyone still reads it.
pub(super) fn note(text: &str) {
    tell_line(Told::Notes, text);
}

/// Prints what only --verbose asks for on standard error.
pub(super) fn detail(text: &str) {
    tell_line(Told::Details, text);
}

/// Prints what went wrong, though the command goes on.
pub(super) fn warn(text: &str) {
    tell_line(Told::Errors, text);
}

fn tell_line(told: Told, text: &str) {
    if !is_told(told) {
        return;
    }
    let _ = writeln!(io::stderr(), "endline: {}", harmless(text));
}

/// Prints help, the version or what is wrong with the command line, and gives its exit code.
pub(super) fn usage(message: &clap::Error) -> ExitCode {
    let _ = message.print();
    ExitCode::from(u8::try_from(message.exit_code()).unwrap_or(2))
}
