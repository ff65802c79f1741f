//! Ctrl+C during work of Endline: a Python exception that ends the work.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::error::failed;

/// Checks the interpreter for signals at intervals.
pub struct Signals {
    checked: Instant,
    raised: Option<PyErr>,
}

impl Signals {
    /// Interval of the checks, which need the interpreter's lock.
    const PAUSE: Duration = Duration::from_millis(100);

    pub fn new() -> Self {
        Self { checked: Instant::now(), raised: None }
    }

    /// Whether to continue; false after Ctrl+C or another signal, whose exception is stored.
    pub fn should_continue(&mut self) -> bool {
        if self.checked.elapsed() >= Self::PAUSE {
            self.raised = Python::attach(|python| python.check_signals()).err();
            self.checked = Instant::now();
        }
        self.raised.is_none()
    }

    /// The stored exception.
    pub fn outcome(self) -> PyResult<()> {
        self.raised.map_or(Ok(()), Err)
    }
}

/// Does work on another thread, without the interpreter's lock. Ctrl+C raises an exception at once and clears the flag that
/// stops the work; work without this check, such as statics, ends by itself and its result is dropped.
pub fn interruptible<T: Send + 'static>(
    python: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> PyResult<T> + Send + 'static,
) -> PyResult<T> {
    let running = Arc::new(AtomicBool::new(true));
    let (done, waited) = channel();
    let its = Arc::clone(&running);
    // The result of the thread is dropped if there is no receiver.
    std::thread::spawn(move || drop(done.send(work(&its))));
    python.detach(move || {
        let mut signals = Signals::new();
        while signals.should_continue() {
            match waited.recv_timeout(Signals::PAUSE) {
                Ok(result) => return result,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(failed("the thread of the run has panicked".into()));
                }
            }
        }
        running.store(false, Ordering::Relaxed);
        signals.outcome()?;
        Err(failed("the run was interrupted".into()))
    })
}
