//! Printing: a closed pipe is no error (`endline … | head`), control characters are escaped, progress, failures.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::io::{self, IsTerminal, Write as _};
use std::path::Path;
use std::process::ExitCode;
use std::sync::OnceLock;

use indicatif::{ProgressBar, ProgressStyle};

/// What is printed on standard error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Verbosity {
    /// Errors and warnings.
    Errors,
    /// Notes and progress too.
    Notes,
    /// Also which files and plugins are used.
    Details,
}

static VERBOSITY: OnceLock<Verbosity> = OnceLock::new();

/// Sets once what is printed on standard error.
pub(super) fn set_verbosity(verbosity: Verbosity) {
    // A second call has no effect.
    let _ = VERBOSITY.set(verbosity);
}

/// Whether messages of a level are printed.
pub(super) fn is_shown(level: Verbosity) -> bool {
    level <= *VERBOSITY.get().unwrap_or(&Verbosity::Notes)
}

/// Prints on standard output; a closed pipe is no error.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(sanitized(text).as_bytes()).and_then(|()| out.flush()) {
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

/// Prints a note on standard error.
pub(super) fn note(text: &str) {
    line(Verbosity::Notes, text);
}

/// Prints details, for --verbose, on standard error.
pub(super) fn detail(text: &str) {
    line(Verbosity::Details, text);
}

/// Prints a warning; the command continues.
pub(super) fn warn(text: &str) {
    line(Verbosity::Errors, text);
}

fn line(level: Verbosity, text: &str) {
    if !is_shown(level) {
        return;
    }
    let _ = writeln!(io::stderr(), "endline: {}", sanitized(text));
}

/// Prints help, the version or a mistake in the command line, and returns the exit code.
pub(super) fn usage(message: &clap::Error) -> ExitCode {
    let _ = message.print();
    ExitCode::from(u8::try_from(message.exit_code()).unwrap_or(2))
}

/// A message to the user, and the exit code.
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

    /// Prints it on standard error and returns the exit code.
    pub fn print(&self) -> ExitCode {
        // Where standard error is closed, the exit code remains.
        let _ = writeln!(io::stderr(), "endline: {}", sanitized(&self.message));
        ExitCode::from(self.code)
    }
}

impl From<endline_session::Error> for Failure {
    fn from(error: endline_session::Error) -> Self {
        Self::failed(error)
    }
}

/// A text with control characters escaped, but for line breaks and tabs, and those that change the order of writing
/// as well: `\u001b`. In JSON this is the same text.
pub(super) fn sanitized(text: &str) -> Cow<'_, str> {
    if !text.contains(is_obeyed) {
        return Cow::Borrowed(text);
    }
    let mut plain = String::with_capacity(text.len() + 64);
    for letter in text.chars() {
        if is_obeyed(letter) {
            // Writing to a text cannot fail.
            let _ = write!(plain, "\\u{:04x}", u32::from(letter));
        } else {
            plain.push(letter);
        }
    }
    Cow::Owned(plain)
}

fn is_obeyed(letter: char) -> bool {
    let turns = matches!(letter, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || (letter.is_control() && !matches!(letter, '\n' | '\t'))
}

/// How often the bar is touched [steps]; drawing is limited further by its own clock.
const STRIDE: u64 = 16;

/// Shows steps taken of steps in all.
pub(super) struct Progress(Option<ProgressBar>);

impl Progress {
    pub(super) fn new(label: &'static str) -> Self {
        if !io::stderr().is_terminal() || !is_shown(Verbosity::Notes) {
            return Self(None);
        }
        let bar = ProgressBar::new(0).with_message(label);
        if let Ok(style) =
            ProgressStyle::with_template("{msg} {wide_bar} {percent:>3}%  {eta_precise}")
        {
            bar.set_style(style);
        }
        Self(Some(bar))
    }

    pub(super) fn at(&self, step: u64, steps: u64) {
        let Some(bar) = &self.0 else { return };
        if step.is_multiple_of(STRIDE) || step >= steps {
            bar.set_length(steps);
            bar.set_position(step);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neither_a_terminal_nor_a_reader_of_json_gets_progress() {
        let clipboard = "name\u{1b}]52;c;cm0gLXJm\u{7}\u{9b}2J\u{202e}gpj";
        let plain = sanitized(clipboard);
        assert!(!plain.contains(is_obeyed), "{plain}");
        let read: String = serde_json::from_str(&format!("\"{plain}\"")).unwrap();
        assert_eq!(read, clipboard);
        let usual = "3/8 in\t\u{b5}m, \u{20ac} and \u{9be8}\n";
        assert!(matches!(sanitized(usual), Cow::Borrowed(same) if same == usual));
    }
}
