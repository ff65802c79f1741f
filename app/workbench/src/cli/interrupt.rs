//! Interrupts: the first one (Ctrl+C, SIGTERM, SIGHUP) asks a command to end with what it has, the second ends the program at once.

use std::io;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use endline_session::shell;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::output;

/// Signals by which a user, a terminal or a batch system ends a program.
#[cfg(unix)]
const SIGNALS: [i32; 3] = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// The number of SIGHUP on every Unix: `nohup` has a program ignore it, and it then stays ignored.
const HANGUP: i32 = 1;

/// Interval at which a command that waits for other threads polls [ms].
const LOOK_MS: u64 = 50;

/// A watch for interrupts.
#[derive(Clone, Default)]
pub(super) struct Interrupt {
    asked: Arc<AtomicBool>,
    signal: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Watches from here on.
    pub(super) fn watch() -> Self {
        let interrupt = Self::default();
        for signal in
            SIGNALS.into_iter().filter(|signal| !(*signal == HANGUP && is_ignored(HANGUP)))
        {
            if let Err(error) = interrupt.watch_for(signal) {
                output::warn(&format!("an interrupt will end the program at once: {error}"));
            }
        }
        interrupt
    }

    fn watch_for(&self, signal: i32) -> io::Result<()> {
        // The second signal finds the flag set and ends the program with the usual status.
        flag::register_conditional_shutdown(
            signal,
            status(signal).into(),
            Arc::clone(&self.asked),
        )?;
        flag::register(signal, Arc::clone(&self.asked))?;
        let number = usize::try_from(signal).unwrap_or_default();
        flag::register_usize(signal, Arc::clone(&self.signal), number)?;
        Ok(())
    }

    /// Whether the command is asked to end.
    pub(super) fn is_asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }

    /// The exit code of an interrupted command; none of one that was not.
    pub(super) fn exit_code(&self) -> Option<ExitCode> {
        let signal = i32::try_from(self.signal.load(Ordering::Relaxed)).unwrap_or_default();
        self.is_asked().then(|| ExitCode::from(status(signal)))
    }

    /// Calls `act` from a thread of its own once the command is asked to end. The thread ends with the program.
    pub(super) fn on_asked(&self, act: impl FnOnce() + Send + 'static) {
        let interrupt = self.clone();
        std::thread::spawn(move || {
            while !interrupt.is_asked() {
                std::thread::sleep(Duration::from_millis(LOOK_MS));
            }
            act();
        });
    }
}

/// The status that shells give a program ended by a signal.
fn status(signal: i32) -> u8 {
    u8::try_from(128 + signal).unwrap_or(1)
}

/// Whether whoever started the program had it ignore a signal.
fn is_ignored(signal: i32) -> bool {
    let status = endline_gear::read::text(Path::new("/proc/self/status")).unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// The command line of this program, quoted for a shell, with other values of some options.
pub(super) fn command_line(options: &[(&str, &str)]) -> String {
    with_options(std::env::args(), options)
}

fn with_options(arguments: impl Iterator<Item = String>, options: &[(&str, &str)]) -> String {
    let mut words = vec!["endline".to_owned()];
    let mut arguments = arguments.skip(1);
    while let Some(argument) = arguments.next() {
        let is_new = |(name, _): &(&str, &str)| {
            argument.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('='))
        };
        if !options.iter().any(is_new) {
            words.push(shell::word(&argument));
        } else if !argument.contains('=') {
            arguments.next();
        }
    }
    words.extend(options.iter().flat_map(|(name, value)| [(*name).to_owned(), shell::word(value)]));
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_continues_from_another_recording_and_is_otherwise_the_same() {
        let line = |words: &[&str], options: &[(&str, &str)]| {
            with_options(words.iter().map(|word| (*word).to_owned()), options)
        };
        let from = [("--from", "b/r.endline"), ("--at", "2.5s")];
        assert_eq!(
            line(&["/bin/endline", "run", "a b.toml", "--from", "a", "--at=1s", "--json"], &from),
            "endline run 'a b.toml' --json --from b/r.endline --at 2.5s"
        );
        assert_eq!(line(&["x", "study", "run", "it's"], &[]), "endline study run 'it'\\''s'");
    }
}
