//! The one runner of studies and searches: threads take pieces of work until none is left, one fails or the control cancels. The
//! number and priority of these threads, and the part of the work that one of several machines does.

use std::io;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::control::Control;
use crate::error::Error;
use crate::task::lock;

/// Time between two polls of what other processes have done.
pub(crate) const POLL: Duration = Duration::from_millis(500);

/// Work that threads share.
pub(crate) trait Work: Sync {
    /// The work of one thread at a time.
    type Piece;

    /// The next piece to run in this process.
    fn next(&self) -> Result<Next<Self::Piece>, Error>;

    /// Runs a piece and stores its result; false if the control cancelled it.
    fn run(&self, piece: Self::Piece) -> Result<bool, Error>;
}

/// The next action of a thread.
pub(crate) enum Next<P> {
    /// It runs a piece.
    Run(P),
    /// It waits: other processes run all that is left, and one of them may end without a result.
    Wait,
    /// It ends: nothing is left.
    Nothing,
}

/// The first failure of a pool, which ends all its threads.
#[derive(Default)]
pub(crate) struct Failure {
    is_there: AtomicBool,
    error: Mutex<Option<Error>>,
}

impl Failure {
    /// Whether there is one.
    pub(crate) fn is_there(&self) -> bool {
        self.is_there.load(Ordering::Relaxed)
    }

    fn stop(&self) {
        self.is_there.store(true, Ordering::Relaxed);
    }
}

/// Runs work on threads, while `collect` takes in results on this one.
pub(crate) fn run<T>(
    work: &impl Work,
    threads: usize,
    control: &Control,
    collect: impl FnOnce(&Failure) -> Result<T, Error>,
) -> Result<T, Error> {
    let failure = Failure::default();
    let collected = std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(|| on_a_thread(work, control, &failure));
        }
        collect(&failure).inspect_err(|_| failure.stop())
    });
    let error = lock(&failure.error).take();
    error.map_or(collected, Err)
}

fn on_a_thread(work: &impl Work, control: &Control, failure: &Failure) {
    while !failure.is_there() && control.may_continue() {
        let ran = match work.next() {
            Ok(Next::Run(piece)) => work.run(piece),
            Ok(Next::Nothing) => Ok(false),
            Ok(Next::Wait) => {
                std::thread::sleep(POLL);
                Ok(true)
            }
            Err(error) => Err(error),
        };
        match ran {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) => {
                lock(&failure.error).get_or_insert(error);
                failure.stop();
            }
        }
    }
}

/// The part of a campaign that one of several machines runs: blocks whose number divided by `of` leaves `part`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 0.
    pub part: u32,
    /// Of how many.
    pub of: u32,
}

impl Shard {
    /// All of a campaign.
    pub const WHOLE: Self = Self { part: 0, of: 1 };

    /// Whether a block belongs to it.
    pub fn holds(self, block: u32) -> bool {
        block % self.of == self.part
    }
}

/// Gives this thread, and the threads that it starts, the lowest priority. Does nothing on systems other than Unix.
pub fn try_lower_priority() -> io::Result<()> {
    #[cfg(unix)]
    rustix::process::nice(19)?;
    Ok(())
}

/// Lowers the priority of this thread on Linux. Other systems would slow the whole program.
pub(crate) fn lower_priority() {
    #[cfg(target_os = "linux")]
    // A thread whose priority cannot be lowered keeps the normal one.
    let _ = try_lower_priority();
}

/// Threads for encounters: all cores but one, which the window uses.
pub fn default_count() -> usize {
    std::thread::available_parallelism().map_or(1, |cores| cores.get().saturating_sub(1).max(1))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicU32;

    use super::*;

    /// Numbers, of which one fails.
    struct Numbers {
        next: AtomicU32,
        sum: AtomicU32,
        fails: u32,
    }

    impl Work for Numbers {
        type Piece = u32;

        fn next(&self) -> Result<Next<u32>, Error> {
            let number = self.next.fetch_add(1, Ordering::SeqCst);
            Ok(if number <= 100 { Next::Run(number) } else { Next::Nothing })
        }

        fn run(&self, number: u32) -> Result<bool, Error> {
            if number == self.fails {
                return Err(Error::Message(format!("number {number}")));
            }
            self.sum.fetch_add(number, Ordering::SeqCst);
            Ok(true)
        }
    }

    fn sum(threads: usize, fails: u32) -> Result<u32, Error> {
        let numbers = Numbers { next: AtomicU32::new(0), sum: AtomicU32::new(0), fails };
        run(&numbers, threads, &Control::default(), |_| Ok(()))?;
        Ok(numbers.sum.into_inner())
    }

    #[test]
    fn every_piece_runs_once_on_any_number_of_threads() {
        for threads in [0, 1, 3] {
            assert_eq!(sum(threads, u32::MAX).unwrap(), 5050, "{threads} threads");
        }
    }

    #[test]
    fn the_first_failure_ends_the_pool() {
        assert_eq!(sum(3, 7).unwrap_err().to_string(), "number 7");
        let numbers = Numbers { next: AtomicU32::new(0), sum: AtomicU32::new(0), fails: u32::MAX };
        let collect = |_: &Failure| Err::<(), _>(Error::Message("the folder".into()));
        let error = run(&numbers, 2, &Control::default(), collect).unwrap_err();
        assert_eq!(error.to_string(), "the folder");
    }

    #[test]
    fn a_cancelled_control_runs_nothing() {
        let numbers = Numbers { next: AtomicU32::new(0), sum: AtomicU32::new(0), fails: 0 };
        let control = Control::default();
        control.cancel();
        run(&numbers, 2, &control, |_| Ok(())).unwrap();
        assert_eq!(numbers.next.into_inner(), 0);
    }
}
