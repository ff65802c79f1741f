//! One study at work: its threads, and what they are told and tell.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use endline_session::study::folder::Folder;
use endline_session::study::stats::Findings;
use endline_session::study::{Opened, Table, merge, report};
use endline_session::{Error, PluginHost};

use super::super::engine::Waker;

/// How a study stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// Others come first.
    Waiting,
    /// Options are assembled and checked.
    Opening,
    /// Encounters run.
    Running,
    /// Stands still.
    Paused,
    /// All encounters ran; the report is written.
    Reporting,
    /// Done.
    Done,
    /// Taken out of the queue; what was run stays.
    Cancelled,
    /// Could not go on: why.
    Failed(String),
}

/// How far a study is.
#[derive(Clone, Debug)]
pub struct Progress {
    /// How it stands.
    pub state: State,
    /// Encounters done, those found in its folder among them.
    pub done: u32,
    /// Encounters found in its folder at the start.
    pub found: u32,
    /// Encounters in all.
    pub total: u32,
    /// Blocks in its folder.
    pub blocks: u32,
    worked: Duration,
    since: Option<Instant>,
}

impl Progress {
    /// Time left at the pace so far; `None` before there is one.
    #[must_use]
    pub fn left(&self) -> Option<Duration> {
        let fresh = self.done.saturating_sub(self.found);
        let worked = self.worked + self.since.map_or(Duration::ZERO, |since| since.elapsed());
        (fresh > 0).then(|| {
            worked.mul_f64(f64::from(self.total.saturating_sub(self.done)) / f64::from(fresh))
        })
    }

    /// Share done, 0 to 1.
    #[must_use]
    pub fn share(&self) -> f32 {
        if self.total == 0 { 0.0 } else { self.done as f32 / self.total as f32 }
    }
}

/// What a job is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wish {
    Run,
    Pause,
    Cancel,
}

struct Shared {
    wish: Mutex<Wish>,
    changed: Condvar,
    progress: Mutex<Progress>,
    opened: Mutex<Option<(Arc<Opened>, PathBuf)>>,
}

/// A study in the queue.
pub struct Job {
    /// Its file.
    pub file: PathBuf,
    /// Its name.
    pub name: String,
    library: PathBuf,
    root: PathBuf,
    shared: Arc<Shared>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Job {
    /// A study that waits; its results go to a folder of their own under `root`.
    #[must_use]
    pub fn new(file: PathBuf, name: String, library: PathBuf, root: PathBuf) -> Self {
        let progress = Progress {
            state: State::Waiting,
            done: 0,
            found: 0,
            total: 0,
            blocks: 0,
            worked: Duration::ZERO,
            since: None,
        };
        let shared = Shared {
            wish: Mutex::new(Wish::Run),
            changed: Condvar::new(),
            progress: Mutex::new(progress),
            opened: Mutex::new(None),
        };
        Self { file, name, library, root, shared: Arc::new(shared) }
    }

    /// How far it is.
    #[must_use]
    pub fn progress(&self) -> Progress {
        lock(&self.shared.progress).clone()
    }

    /// The study as it was opened to be run.
    #[must_use]
    pub fn opened(&self) -> Option<Arc<Opened>> {
        lock(&self.shared.opened).as_ref().map(|(opened, _)| Arc::clone(opened))
    }

    /// The folder of its results, once it is opened.
    #[must_use]
    pub fn folder(&self) -> Option<PathBuf> {
        lock(&self.shared.opened).as_ref().map(|(_, folder)| folder.clone())
    }

    /// Whether its turn has not come.
    #[must_use]
    pub fn waits(&self) -> bool {
        self.progress().state == State::Waiting
    }

    /// Whether its threads have work.
    #[must_use]
    pub fn at_work(&self) -> bool {
        matches!(self.progress().state, State::Opening | State::Running | State::Reporting)
    }

    /// Whether there is something left to do that was not given up.
    #[must_use]
    pub fn unfinished(&self) -> bool {
        !matches!(self.progress().state, State::Done | State::Cancelled | State::Failed(_))
    }

    /// Stands still after the encounters under way.
    pub fn pause(&self) {
        self.shared.tell(Wish::Pause);
    }

    /// Goes on.
    pub fn resume(&self) {
        self.shared.tell(Wish::Run);
    }

    /// Gives up after the encounters under way; the blocks that are done stay, and the study goes on from them when queued again.
    pub fn cancel(&self) {
        self.shared.tell(Wish::Cancel);
    }

    /// Begins on a thread of its own, behind everything else on the machine unless it is eager.
    pub fn begin(&mut self, host: &Arc<PluginHost>, waker: &Waker, eager: bool) {
        let shared = Arc::clone(&self.shared);
        let work = Work {
            file: self.file.clone(),
            library: self.library.clone(),
            root: self.root.clone(),
            host: Arc::clone(host),
            waker: Arc::clone(waker),
            eager,
        };
        lock(&shared.progress).state = State::Opening;
        let work = move || {
            let worked = catch_unwind(AssertUnwindSafe(|| run(&shared, &work)));
            let state = match worked {
                Ok(Ok(state)) => state,
                Ok(Err(error)) => State::Failed(error.to_string()),
                Err(_) => State::Failed(
                    "the study ended by a fault inside the program; report what led to it".into(),
                ),
            };
            shared.stand(state);
            (work.waker)();
        };
        if let Err(error) = std::thread::Builder::new().name("endline-study".into()).spawn(work) {
            self.shared.stand(State::Failed(format!("the system gives no thread: {error}")));
        }
    }
}

impl Shared {
    fn tell(&self, wish: Wish) {
        *lock(&self.wish) = wish;
        let mut progress = lock(&self.progress);
        match (wish, &progress.state) {
            (Wish::Pause, State::Running) => progress.stop(State::Paused),
            (Wish::Run, State::Paused) => progress.go(),
            (Wish::Cancel, State::Waiting | State::Running | State::Paused) => {
                progress.stop(State::Cancelled)
            }
            _ => {}
        }
        self.changed.notify_all();
    }

    fn stand(&self, state: State) {
        lock(&self.progress).stop(state);
    }

    /// Waits while the job is paused; false where it was given up.
    fn goes_on(&self) -> bool {
        let mut wish = lock(&self.wish);
        while *wish == Wish::Pause {
            wish = self.changed.wait(wish).unwrap_or_else(PoisonError::into_inner);
        }
        *wish == Wish::Run
    }
}

impl Progress {
    fn go(&mut self) {
        (self.state, self.since) = (State::Running, Some(Instant::now()));
    }

    fn stop(&mut self, state: State) {
        self.worked += self.since.take().map_or(Duration::ZERO, |since| since.elapsed());
        self.state = state;
    }
}

/// What the threads of a job need.
struct Work {
    file: PathBuf,
    library: PathBuf,
    root: PathBuf,
    host: Arc<PluginHost>,
    waker: Waker,
    eager: bool,
}

/// Opens a study, runs what is missing, and writes its table and report.
fn run(shared: &Shared, work: &Work) -> Result<State, Error> {
    work.step_back();
    let opened = Arc::new(Opened::open(&work.file, Some(&work.library), &work.host)?);
    let folder = Folder::open(&super::folder_of(&work.root, &opened), &opened)?;
    *lock(&shared.opened) = Some((Arc::clone(&opened), folder.path.clone()));
    encounters(shared, &opened, &folder, work)?;
    if !shared.goes_on() {
        return Ok(State::Cancelled);
    }
    shared.stand(State::Reporting);
    let table = merge::merge(&opened, &folder)?;
    merge::save(&opened, &folder, &table)?;
    report::write(&opened, &folder, &Findings::of(&opened, &table))?;
    Ok(State::Done)
}

/// Runs the encounters that are missing, a block at a time on each thread.
fn encounters(shared: &Shared, opened: &Opened, folder: &Folder, work: &Work) -> Result<(), Error> {
    let missing: Vec<u32> = (0..folder.blocks()).filter(|block| !folder.has(*block)).collect();
    let size = |block: &u32| u32::try_from(folder.encounters_of(*block).len()).unwrap_or_default();
    {
        let mut progress = lock(&shared.progress);
        progress.total = (0..folder.blocks()).map(|block| size(&block)).sum();
        progress.found = progress.total - missing.iter().map(size).sum::<u32>();
        (progress.done, progress.blocks) =
            (progress.found, folder.blocks() - u32::try_from(missing.len()).unwrap_or_default());
        if *lock(&shared.wish) == Wish::Pause {
            progress.stop(State::Paused)
        } else {
            progress.go()
        }
    }
    let (next, failure) = (AtomicU32::new(0), Mutex::new(None));
    let turn = || {
        work.step_back();
        while lock(&failure).is_none() {
            let Some(block) = missing.get(next.fetch_add(1, Ordering::Relaxed) as usize) else {
                break;
            };
            if merge::is_enough(opened, folder) {
                break;
            }
            match one_block(shared, opened, folder, *block, &work.waker) {
                Ok(true) => lock(&shared.progress).blocks += 1,
                Ok(false) => break,
                Err(error) => *lock(&failure) = Some(error),
            }
        }
    };
    std::thread::scope(|scope| (0..threads()).for_each(|_| drop(scope.spawn(turn))));
    failure.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
}

/// Runs a block and writes it; false where the job was given up on the way.
fn one_block(
    shared: &Shared,
    opened: &Opened,
    folder: &Folder,
    block: u32,
    waker: &Waker,
) -> Result<bool, Error> {
    let mut rows = Vec::new();
    for encounter in folder.encounters_of(block) {
        if !shared.goes_on() {
            return Ok(false);
        }
        rows.extend(opened.rows(encounter));
        lock(&shared.progress).done += 1;
        waker();
    }
    folder.write(block, &Table::of(rows))?;
    Ok(true)
}

/// Threads for encounters: one core is left to the window.
fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, |cores| cores.get().saturating_sub(1).max(1))
}

impl Work {
    /// Lets everything else on the machine go before this thread. Elsewhere than on Linux that would slow the window too.
    fn step_back(&self) {
        #[cfg(target_os = "linux")]
        if !self.eager {
            // A thread that may not step back runs as others do.
            let _ = rustix::process::nice(19);
        }
    }
}
