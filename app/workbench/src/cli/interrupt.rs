//! Interrupts: the first one (Ctrl+C, SIGTERM, SIGHUP) asks a command to end with what it has, the second ends the program at once.

use std::io;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::output;

/// What a user, a terminal or a batch system sends to end a program.
#[cfg(unix)]
const SIGNALS: [i32; 3] = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// How often a command that waits on other threads looks [ms].
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
        for signal in SIGNALS {
            if let Err(error) = interrupt.watch_for(signal) {
                output::note(&format!("an interrupt will end the program at once: {error}"));
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
