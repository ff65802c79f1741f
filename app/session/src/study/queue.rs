//! A queue of studies: each is opened, run, merged and reported on threads of its own, one after
//! the other.
//!
//! Blocks of encounters lie in a folder named after the study and the hash of what defines its
//! runs. An edited study therefore begins a folder of its own, and an unfinished one is continued.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::shell;
use crate::task::{Waker, run_job};

use super::batch;
use super::folder::Folder;
use super::merge;
use super::open::{Files, Opened};
use super::report;
use super::stats::Findings;
use crate::campaign::control::{Control, Progress};
use crate::campaign::priority;
use crate::campaign::shard::Shard;

/// How a study of the queue stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// Other studies come first.
    Waiting,
    /// Options are assembled and checked.
    Opening,
    /// Encounters run.
    Running,
    /// The encounters wait to be resumed.
    Paused,
    /// All encounters are done; the report is written.
    Reporting,
    /// The report is there.
    Done,
    /// Ended by the user; blocks that were run stay.
    Cancelled,
    /// Ended by an error, with its message.
    Failed(String),
}

/// The studies waiting, at work and done, in the order they were queued.
#[derive(Default)]
pub struct Queue {
    /// The studies.
    pub jobs: Vec<Job>,
    /// Whether studies run at ordinary priority rather than the lowest.
    pub eager: bool,
}

impl Queue {
    /// Adds a study; a finished job of the same file is removed.
    pub fn add(&mut self, job: Job) {
        self.jobs.retain(|other| other.file != job.file);
        self.jobs.push(job);
    }

    /// The study at work, else the first that is paused or waits.
    #[must_use]
    pub fn current(&self) -> Option<&Job> {
        let at_work = self.jobs.iter().find(|job| job.at_work());
        at_work.or_else(|| self.jobs.iter().find(|job| job.unfinished()))
    }

    /// The unfinished job of a study's file.
    #[must_use]
    pub fn unfinished(&self, file: &Path) -> Option<&Job> {
        self.jobs.iter().find(|job| job.file == file && job.unfinished())
    }

    /// Begins the next study that waits, unless one is at work.
    pub fn begin_next(&mut self, host: &Arc<PluginHost>) {
        if !self.jobs.iter().any(Job::at_work)
            && let Some(next) = self.jobs.iter().find(|job| job.state() == State::Waiting)
        {
            next.begin(host, self.eager);
        }
    }
}

/// A study of the queue.
pub struct Job {
    /// The study's file.
    pub file: PathBuf,
    /// The study's name.
    pub name: String,
    text: String,
    files: Files,
    root: PathBuf,
    waker: Waker,
    shared: Arc<Shared>,
}

/// What a job shares with its threads.
struct Shared {
    control: Control,
    state: Mutex<State>,
    /// The study once it is opened, and the folder of its results.
    opened: Mutex<Option<(Arc<Opened>, PathBuf)>>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Job {
    /// A study that waits: its file and name, and the texts that it is run on, whatever their files hold. Its results are
    /// written to a folder of their own under `root`. The waker is called whenever there is progress.
    #[must_use]
    pub fn new(
        (file, name): (PathBuf, String),
        (text, files): (String, Files),
        root: PathBuf,
        waker: Waker,
    ) -> Self {
        let progressed = Arc::clone(&waker);
        let shared = Shared {
            control: Control::new(move |_| progressed()),
            state: Mutex::new(State::Waiting),
            opened: Mutex::new(None),
        };
        Self { file, name, text, files, root, waker, shared: Arc::new(shared) }
    }

    /// How it stands.
    #[must_use]
    pub fn state(&self) -> State {
        let state = lock(&self.shared.state).clone();
        let control = &self.shared.control;
        match state {
            State::Waiting | State::Running if control.is_cancelled() => State::Cancelled,
            // A study that is paused while it is opened stands still before its first encounter.
            State::Opening | State::Running if control.is_paused() => State::Paused,
            other => other,
        }
    }

    /// How far it is.
    #[must_use]
    pub fn progress(&self) -> Progress {
        self.shared.control.progress()
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

    /// Whether its threads have work.
    #[must_use]
    pub fn at_work(&self) -> bool {
        matches!(self.state(), State::Opening | State::Running | State::Reporting)
    }

    /// Whether there is something left to do that was not given up.
    #[must_use]
    pub fn unfinished(&self) -> bool {
        !matches!(self.state(), State::Done | State::Cancelled | State::Failed(_))
    }

    /// Whether nothing of it goes on any more: of a cancelled study, the encounters that were under way have ended too.
    #[must_use]
    pub fn ended(&self) -> bool {
        match *lock(&self.shared.state) {
            State::Waiting => self.shared.control.is_cancelled(),
            State::Opening | State::Running | State::Paused | State::Reporting => false,
            State::Done | State::Cancelled | State::Failed(_) => true,
        }
    }

    /// Holds the study after the encounters under way.
    pub fn pause(&self) {
        self.shared.control.pause();
    }

    /// Continues a paused study.
    pub fn resume(&self) {
        self.shared.control.resume();
    }

    /// Ends the study after the encounters under way. Blocks that are done stay, and the study
    /// continues from them when it is queued again.
    pub fn cancel(&self) {
        self.shared.control.cancel();
    }

    /// Begins on a thread of its own, at the lowest priority unless it is eager.
    fn begin(&self, host: &Arc<PluginHost>, eager: bool) {
        let (shared, host) = (Arc::clone(&self.shared), Arc::clone(host));
        let (file, root) = (self.file.clone(), self.root.clone());
        let texts = (self.text.clone(), self.files.clone());
        let (ending, waker) = (Arc::clone(&shared), Arc::clone(&self.waker));
        *lock(&shared.state) = State::Opening;
        let work = move || run(&shared, &file, texts, &root, &host);
        run_job("study", eager, work, move |state| {
            *lock(&ending.state) = state.unwrap_or_else(State::Failed);
            waker();
        });
    }
}

/// Opens a study, runs the missing encounters, and writes its table and report.
fn run(
    shared: &Shared,
    file: &Path,
    (text, files): (String, Files),
    root: &Path,
    host: &PluginHost,
) -> Result<State, Error> {
    let opened = Arc::new(Opened::of_sources(text, file, files, host)?);
    let folder = Folder::open(&Folder::path_under(root, &opened), &opened)?;
    *lock(&shared.opened) = Some((Arc::clone(&opened), folder.path.clone()));
    *lock(&shared.state) = State::Running;
    batch::run(&opened, &folder, Shard::WHOLE, priority::threads(), &shared.control)?;
    if !shared.control.goes_on() {
        return Ok(State::Cancelled);
    }
    *lock(&shared.state) = State::Reporting;
    let table = merge::merge(&opened, &folder)?;
    merge::save(&opened, &folder, &table)?;
    report::write(&opened, &folder, &Findings::of(&opened, &table, &folder.registration), &[])?;
    Ok(State::Done)
}

/// The command lines that run, merge and report a study as the queue does.
#[must_use]
pub fn command_line(study: &Path, library: &Path, results: Option<&Path>) -> String {
    let out = results.map_or_else(String::new, |folder| format!(" --out {}", shell::path(folder)));
    let (study, library) = (shell::path(study), shell::path(library));
    let line = |verb: &str| format!("endline study {verb} {study} --library {library}{out}");
    ["run", "merge", "report"].map(line).join(" && ")
}
