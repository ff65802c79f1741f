//! A search at work behind a window: opened, run and reported on threads of its own, paused, cancelled and gone on with.
//!
//! Its rounds lie in a folder named after the observation and the hash of the search. An edited observation therefore begins a
//! folder of its own, and a search that was cancelled goes on from what its folder holds.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::campaign::Shard;
use crate::campaign::control::{Control, Progress};
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::shell;
use crate::study::Files;
use crate::task::{Waker, run_job};

use super::folder::Folder;
use super::question::Question;
use super::stories::Stories;
use super::{Effort, USUAL_NET, page, search};

/// Folder of the draws that all searches of a root share, so that an edited observation costs local searches only.
const NET: &str = "net";

/// How a search stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// Observation and study are read, and the model is assembled.
    Opening,
    /// Encounters run.
    Running,
    /// Neighbours of the stories found run.
    Neighbours,
    /// It waits to be resumed.
    Paused,
    /// The effort is spent.
    Done,
    /// It stands still before its end; what was run stays.
    Stopped,
    /// Ended by an error, with its message.
    Failed(String),
}

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Request {
    /// The observation's file.
    pub file: PathBuf,
    /// Its text: what is searched for.
    pub text: String,
    /// The library, and the open scenario.
    pub files: Files,
    /// File and text of the open study.
    pub study: Option<(PathBuf, String)>,
    /// Folder that holds the folders of searches.
    pub root: PathBuf,
    /// Runs at most.
    pub trials: usize,
    /// Threads.
    pub threads: usize,
    /// Neighbours of every story that is like the observation.
    pub neighbours: usize,
    /// Whether it runs at ordinary priority rather than the lowest.
    pub eager: bool,
}

/// A search at work, or what an earlier one has found.
pub struct Job {
    /// What was asked for.
    pub request: Request,
    /// Whether only what an earlier search has left is read.
    pub only_reads: bool,
    shared: Arc<Shared>,
}

/// What a job shares with its threads.
struct Shared {
    control: Control,
    state: Mutex<State>,
    found: Mutex<Found>,
}

/// What a search has so far.
#[derive(Clone, Default)]
pub struct Found {
    /// The question, once it is opened.
    pub question: Option<Arc<Question>>,
    /// The folder, once it is opened.
    pub folder: Option<PathBuf>,
    /// Runs of the rounds that are done.
    pub trials: usize,
    /// The least distance so far.
    pub best: Option<f64>,
    /// The stories so far.
    pub stories: Option<Arc<Stories>>,
}

#[cfg(test)]
mod tests;

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Job {
    /// Begins a search on a thread of its own; the waker is called whenever there is progress.
    #[must_use]
    pub fn begin(request: Request, host: &Arc<PluginHost>, waker: &Waker) -> Self {
        Self::start(request, false, host, waker)
    }

    /// Reads what an earlier search of the same observation has left, and runs nothing.
    #[must_use]
    pub fn read(request: Request, host: &Arc<PluginHost>, waker: &Waker) -> Self {
        Self::start(request, true, host, waker)
    }

    fn start(request: Request, only_reads: bool, host: &Arc<PluginHost>, waker: &Waker) -> Self {
        let progressed = Arc::clone(waker);
        let shared = Arc::new(Shared {
            control: Control::new(move |_| progressed()),
            state: Mutex::new(State::Opening),
            found: Mutex::default(),
        });
        if only_reads {
            shared.control.cancel();
        }
        let job = Self { request, only_reads, shared };
        job.spawn(Arc::clone(host), Arc::clone(waker));
        job
    }

    fn spawn(&self, host: Arc<PluginHost>, waker: Waker) {
        let (shared, request) = (Arc::clone(&self.shared), self.request.clone());
        let (ending, woken) = (Arc::clone(&shared), Arc::clone(&waker));
        let eager = request.eager;
        let work = move || run(&shared, &request, &host, &waker);
        run_job("search", eager, work, move |state| {
            *lock(&ending.state) = state.unwrap_or_else(State::Failed);
            woken();
        });
    }

    /// How it stands.
    #[must_use]
    pub fn state(&self) -> State {
        let state = lock(&self.shared.state).clone();
        let paused = self.shared.control.is_paused();
        match state {
            State::Opening | State::Running | State::Neighbours if paused => State::Paused,
            other => other,
        }
    }

    /// How many runs are done, of the neighbours once these run.
    #[must_use]
    pub fn progress(&self) -> Progress {
        self.shared.control.progress()
    }

    /// What it has so far.
    #[must_use]
    pub fn found(&self) -> Found {
        lock(&self.shared.found).clone()
    }

    /// Whether there is something left to do that was not given up.
    #[must_use]
    pub fn unfinished(&self) -> bool {
        !matches!(self.state(), State::Done | State::Stopped | State::Failed(_))
    }

    /// Whether it was cancelled and its runs under way come to their end.
    #[must_use]
    pub fn is_ending(&self) -> bool {
        self.unfinished() && !self.only_reads && self.shared.control.is_cancelled()
    }

    /// Holds the search after the runs under way.
    pub fn pause(&self) {
        self.shared.control.pause();
    }

    /// Continues a search that is held.
    pub fn resume(&self) {
        self.shared.control.resume();
    }

    /// Ends the search after the runs under way. Runs that are done stay.
    pub fn cancel(&self) {
        self.shared.control.cancel();
    }

    /// The report, where it is written.
    #[must_use]
    pub fn report(&self) -> Option<PathBuf> {
        let folder = lock(&self.shared.found).folder.clone()?;
        Some(folder.join("report.html")).filter(|file| file.is_file())
    }
}

impl Drop for Job {
    /// Nobody follows it any more.
    fn drop(&mut self) {
        self.cancel();
    }
}

/// Opens the question, runs what is missing and writes the report.
fn run(
    shared: &Shared,
    request: &Request,
    host: &PluginHost,
    waker: &Waker,
) -> Result<State, Error> {
    let Request { file, text, files, study, .. } = request;
    let question = Question::of_sources((file, text), None, files.clone(), study.as_ref(), host)?;
    let question = Arc::new(question);
    let path = Folder::path_under(&request.root, &question);
    let reads = shared.control.is_cancelled();
    lock(&shared.found).question = Some(Arc::clone(&question));
    // A search that was never run has no folder, and reading must not make one.
    if reads && !Folder::is_there(&path) {
        return Ok(State::Stopped);
    }
    let folder = Folder::open(&path, Some(&request.root.join(NET)), &question)?;
    lock(&shared.found).folder = Some(folder.path.clone());
    *lock(&shared.state) = State::Running;
    let stories = search(&question, &folder, &effort(request, reads), &shared.control, |round| {
        let mut found = lock(&shared.found);
        (found.trials, found.best) = (round.trials, round.best);
        found.stories = Some(Arc::new(round.stories));
        drop(found);
        if round.trials >= round.of {
            *lock(&shared.state) = State::Neighbours;
        }
        waker();
    })?;
    page::write(&question, &folder, &stories)?;
    lock(&shared.found).stories = Some(Arc::new(stories));
    Ok(if shared.control.is_cancelled() { State::Stopped } else { State::Done })
}

/// The effort asked for; where nothing is run, all rounds that are there are read.
fn effort(request: &Request, reads: bool) -> Effort {
    Effort {
        trials: if reads { usize::MAX } else { request.trials },
        threads: request.threads,
        shard: Shard::WHOLE,
        neighbours: request.neighbours,
        net: USUAL_NET,
    }
}

/// The command line that searches as asked for, in a folder.
#[must_use]
pub fn command_line(request: &Request, folder: &Path) -> String {
    let Request { file, files, root, trials, neighbours, .. } = request;
    let [file, library, folder, net] =
        [file, &files.root, folder, &root.join(NET)].map(shell::path);
    format!(
        "endline search {file} --library {library} --trials {trials} --neighbours {neighbours} --out {folder} --net-folder {net}"
    )
}
