//! A study or search behind a window: begun on a thread of its own, paused, cancelled and observed from any other.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex};

use super::control::{Control, Progress};
use super::pool::lower_priority;
use crate::error::Error;
use crate::task::{Waker, lock};

/// The state of a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// Not begun.
    Waiting,
    /// Files are read, and models are assembled.
    Opening,
    /// Encounters run.
    Running,
    /// The encounters wait to be resumed.
    Paused,
    /// All encounters are done; what follows from them is computed and written.
    Finishing,
    /// Cancelled by the user; encounters in progress end.
    Cancelling,
    /// Complete.
    Done,
    /// Cancelled by the user, and all threads have ended; stored runs stay.
    Cancelled,
    /// Ended by an error, with its message.
    Failed(String),
}

/// A study or search with its request `R` and its results so far `F`.
pub struct Job<R, F> {
    /// The request.
    pub request: R,
    shared: Arc<AtWork<F>>,
}

/// State that a job shares with its threads.
pub(crate) struct AtWork<F> {
    pub(crate) control: Control,
    state: Mutex<State>,
    found: Mutex<F>,
    waker: Waker,
}

impl<F> AtWork<F> {
    /// Enters a state, and calls the waker.
    pub(crate) fn enter(&self, state: State) {
        *lock(&self.state) = state;
        (self.waker)();
    }

    /// Changes the results so far, and calls the waker.
    pub(crate) fn found(&self, change: impl FnOnce(&mut F)) {
        change(&mut lock(&self.found));
        (self.waker)();
    }
}

impl<R, F: Clone + Default + Send + 'static> Job<R, F> {
    /// A job that waits. The waker is called at every change.
    pub fn new(request: R, waker: Waker) -> Self {
        let progressed = Arc::clone(&waker);
        let shared = AtWork {
            control: Control::new(move |_| progressed()),
            state: Mutex::new(State::Waiting),
            found: Mutex::default(),
            waker,
        };
        Self { request, shared: Arc::new(shared) }
    }

    /// Begins the work on a thread of its own, which is named after `noun`, such as `study`. The thread has the lowest priority
    /// unless `normal_priority` is set. An error, a panic or a missing thread ends the job as failed.
    pub(crate) fn begin(
        &self,
        noun: &'static str,
        normal_priority: bool,
        work: impl FnOnce(&AtWork<F>) -> Result<State, Error> + Send + 'static,
    ) {
        let shared = Arc::clone(&self.shared);
        self.shared.enter(State::Opening);
        let on_thread = move || {
            if !normal_priority {
                lower_priority();
            }
            let end = match catch_unwind(AssertUnwindSafe(|| work(&shared))) {
                Ok(end) => end.unwrap_or_else(|error| State::Failed(error.to_string())),
                Err(_) => State::Failed(format!(
                    "the {noun} ended by a fault inside the program; report what led to it"
                )),
            };
            shared.enter(end);
        };
        let thread = std::thread::Builder::new().name(format!("endline-{noun}"));
        if let Err(error) = thread.spawn(on_thread) {
            self.shared.enter(State::Failed(format!("the system gives no thread: {error}")));
        }
    }

    /// Its state.
    pub fn state(&self) -> State {
        let (state, control) = (lock(&self.shared.state).clone(), &self.shared.control);
        match state {
            State::Waiting if control.is_cancelled() => State::Cancelled,
            State::Opening | State::Running | State::Finishing if control.is_cancelled() => {
                State::Cancelling
            }
            // A job that is paused while it opens stops before its first encounter.
            State::Opening | State::Running | State::Finishing if control.is_paused() => {
                State::Paused
            }
            other => other,
        }
    }

    /// Its progress.
    pub fn progress(&self) -> Progress {
        self.shared.control.progress()
    }

    /// The results so far.
    pub fn found(&self) -> F {
        lock(&self.shared.found).clone()
    }

    /// Whether its threads are at work.
    pub fn at_work(&self) -> bool {
        matches!(
            self.state(),
            State::Opening | State::Running | State::Finishing | State::Cancelling
        )
    }

    /// Whether it is unfinished and was not cancelled.
    pub fn is_wanted(&self) -> bool {
        self.is_unfinished() && self.state() != State::Cancelling
    }

    /// Whether it waits, is at work or is paused.
    pub fn is_unfinished(&self) -> bool {
        !matches!(self.state(), State::Done | State::Cancelled | State::Failed(_))
    }
}

impl<R, F> Job<R, F> {
    /// Pauses the job after the encounters in progress.
    pub fn pause(&self) {
        self.shared.control.pause();
    }

    /// Resumes a paused job.
    pub fn resume(&self) {
        self.shared.control.resume();
    }

    /// Ends the job. Stored runs stay, and a later job continues from them.
    pub fn cancel(&self) {
        self.shared.control.cancel();
        (self.shared.waker)();
    }
}

impl<R, F> Drop for Job<R, F> {
    /// A job that nothing refers to ends.
    fn drop(&mut self) {
        self.shared.control.cancel();
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::*;

    fn end(work: impl FnOnce(&AtWork<u32>) -> Result<State, Error> + Send + 'static) -> State {
        let job: Job<(), u32> = Job::new((), Arc::new(|| {}));
        assert_eq!((job.state(), job.at_work()), (State::Waiting, false));
        job.begin("test", true, work);
        let start = Instant::now();
        while job.is_unfinished() {
            assert!(start.elapsed() < Duration::from_secs(20), "{:?}", job.state());
            std::thread::sleep(Duration::from_millis(1));
        }
        job.state()
    }

    #[test]
    fn a_job_ends_as_its_work_does_and_a_panic_is_a_failure() {
        assert_eq!(end(|_| Ok(State::Done)), State::Done);
        let failed = end(|_| Err(Error::Message("no such file".into())));
        assert_eq!(failed, State::Failed("no such file".into()));
        let State::Failed(why) = end(|_| panic!("on purpose")) else { panic!() };
        assert!(why.starts_with("the test ended by a fault inside the program"), "{why}");
    }

    #[test]
    fn a_job_cancelled_before_its_begin_is_cancelled_and_one_at_work_is_cancelling() {
        let job: Job<(), u32> = Job::new((), Arc::new(|| {}));
        job.cancel();
        assert_eq!(job.state(), State::Cancelled);
        let job: Job<(), u32> = Job::new((), Arc::new(|| {}));
        job.shared.enter(State::Running);
        job.pause();
        assert_eq!(job.state(), State::Paused);
        job.cancel();
        assert_eq!(job.state(), State::Cancelling);
        assert!(job.at_work() && job.is_unfinished() && !job.is_wanted());
    }
}
