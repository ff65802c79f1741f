//! Work on a thread of its own whose result is taken in later, without waiting.

use std::io;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Called when there is something new to show; may be called from any thread.
pub type Waker = Arc<dyn Fn() + Send + Sync>;

/// The work ended without a result: its thread panicked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault;

/// One piece of work in the background, or none.
#[derive(Debug)]
pub struct Task<T> {
    pending: Option<Receiver<T>>,
}

impl<T> Default for Task<T> {
    fn default() -> Self {
        Self { pending: None }
    }
}

impl<T: Send + 'static> Task<T> {
    /// Starts the work on a thread of this name; the result of work still in progress is dropped.
    /// The waker is called when the result is ready.
    pub fn start(
        &mut self,
        name: &str,
        work: impl FnOnce() -> T + Send + 'static,
        waker: Waker,
    ) -> io::Result<()> {
        let (sender, receiver) = channel();
        let work = move || {
            // Sending fails where the result is no longer wanted.
            let _ = sender.send(work());
            waker();
        };
        std::thread::Builder::new().name(name.to_owned()).spawn(work)?;
        self.pending = Some(receiver);
        Ok(())
    }

    /// Whether work is in progress, or its result not yet taken.
    pub fn busy(&self) -> bool {
        self.pending.is_some()
    }

    /// The result, once, when it is ready.
    pub fn poll(&mut self) -> Option<Result<T, Fault>> {
        let result = match self.pending.as_ref()?.try_recv() {
            Ok(result) => Ok(result),
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Err(Fault),
        };
        self.pending = None;
        Some(result)
    }
}

/// Locks a mutex, also after a thread that held it has panicked.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};
    use std::time::{Duration, Instant};

    use super::*;

    fn result<T: Send + 'static>(task: &mut Task<T>) -> Result<T, Fault> {
        let start = Instant::now();
        loop {
            if let Some(result) = task.poll() {
                return result;
            }
            assert!(start.elapsed() < Duration::from_secs(20), "the task gives no result");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn a_result_is_taken_once_and_the_waker_is_called() {
        let woken = Arc::new(AtomicU32::new(0));
        let counter = Arc::clone(&woken);
        let waker: Waker = Arc::new(move || {
            counter.fetch_add(1, Ordering::SeqCst);
        });
        let mut task = Task::default();
        assert!(!task.busy() && task.poll().is_none());
        task.start("test-task", || 6 * 7, waker).unwrap();
        assert!(task.busy());
        assert_eq!(result(&mut task), Ok(42));
        assert!(!task.busy() && task.poll().is_none());
        let start = Instant::now();
        while woken.load(Ordering::SeqCst) == 0 {
            assert!(start.elapsed() < Duration::from_secs(20), "the waker is not called");
            std::thread::yield_now();
        }
    }

    #[test]
    fn work_that_panics_ends_with_a_fault() {
        let mut task = Task::<()>::default();
        task.start("test-panic", || panic!("on purpose"), Arc::new(|| {})).unwrap();
        assert_eq!(result(&mut task), Err(Fault));
    }
}
