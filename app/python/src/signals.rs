//! Ctrl+C while Endline works: an exception of Python, and the end of the work.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::error::failed;

/// Asks the interpreter now and then whether the user wants to stop.
pub struct Signals {
    asked: Instant,
    raised: Option<PyErr>,
}

impl Signals {
    /// Between two questions; each takes the interpreter's lock.
    const PAUSE: Duration = Duration::from_millis(100);

    pub fn new() -> Self {
        Self { asked: Instant::now(), raised: None }
    }

    /// Whether work goes on; false once Ctrl+C or another signal has raised an exception, which is kept.
    pub fn go_on(&mut self) -> bool {
        if self.asked.elapsed() >= Self::PAUSE {
            self.raised = Python::attach(|python| python.check_signals()).err();
            self.asked = Instant::now();
        }
        self.raised.is_none()
    }

    /// What was raised.
    pub fn outcome(self) -> PyResult<()> {
        self.raised.map_or(Ok(()), Err)
    }
}

/// Does work on a thread of its own, without the interpreter's lock. Ctrl+C raises at once and clears the flag by which the
/// work knows that it goes on; what cannot ask, such as statics, ends by itself, unheard.
pub fn interruptible<T: Send + 'static>(
    python: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> PyResult<T> + Send + 'static,
) -> PyResult<T> {
    let goes_on = Arc::new(AtomicBool::new(true));
    let (done, waited) = channel();
    let its = Arc::clone(&goes_on);
    // The thread's result goes unheard where nobody waits for it any more.
    std::thread::spawn(move || drop(done.send(work(&its))));
    python.detach(move || {
        let mut signals = Signals::new();
        while signals.go_on() {
            match waited.recv_timeout(Signals::PAUSE) {
                Ok(result) => return result,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(failed("the thread of the run has panicked".into()));
                }
            }
        }
        goes_on.store(false, Ordering::Relaxed);
        signals.outcome()?;
        Err(failed("the run was interrupted".into()))
    })
}
