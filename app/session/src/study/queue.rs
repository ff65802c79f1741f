//! A queue of studies: each is opened, run, merged and reported on threads of its own, one after
//! the other.
//!
//! Blocks of encounters are stored in a folder named after the study and the hash of what defines its
//! runs. An edited study therefore begins a folder of its own, and an unfinished one is continued.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::campaign::job::{AtWork, Job, State};
use crate::campaign::pool::{self, Shard};
use crate::error::Error;
use crate::plugins::PluginHost;
use crate::shell;

use super::folder::Folder;
use super::forecast::{self, Forecast};
use super::prepared::{Files, PreparedStudy};
use super::stats::Findings;
use super::{batch, merge, report};

/// A study to be run.
#[derive(Clone, Debug)]
pub struct StudyRequest {
    /// The study's file.
    pub file: PathBuf,
    /// The study's name.
    pub name: String,
    /// The text that is run, which may differ from the file.
    pub text: String,
    /// The library and the open scenario.
    pub files: Files,
    /// Folder that holds the folders of results.
    pub root: PathBuf,
    /// How much of it is run.
    pub part: Part,
}

/// How much of a study is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All encounters that are missing.
    Whole,
    /// The next [`FORECAST_ENCOUNTERS`], from which the cost of the others is forecast.
    Forecast,
}

/// Encounters that are run for a forecast.
pub const FORECAST_ENCOUNTERS: u32 = 12;

/// What is known of a study at work.
#[derive(Clone, Default)]
pub struct StudyFound {
    /// The study once it is opened, and the folder of its results.
    opened: Option<(Arc<PreparedStudy>, PathBuf)>,
    /// The forecast, once it is made.
    forecast: Option<Forecast>,
}

/// A study of the queue.
pub type StudyJob = Job<StudyRequest, StudyFound>;

/// The studies waiting, at work and done, in the order they were queued.
#[derive(Default)]
pub struct Queue {
    /// The studies.
    pub jobs: Vec<StudyJob>,
    /// Whether studies run at normal priority rather than the lowest.
    pub normal_priority: bool,
}

impl Queue {
    /// Adds a study; a finished job of the same file is removed.
    pub fn add(&mut self, job: StudyJob) {
        self.jobs.retain(|other| other.request.file != job.request.file);
        self.jobs.push(job);
    }

    /// The study at work, else the first that is paused or waits.
    pub fn current(&self) -> Option<&StudyJob> {
        let wanted = || self.jobs.iter().filter(|job| job.is_wanted());
        wanted().find(|job| job.at_work()).or_else(|| wanted().next())
    }

    /// The unfinished job of a study's file, unless it was cancelled.
    pub fn unfinished(&self, file: &Path) -> Option<&StudyJob> {
        self.jobs.iter().find(|job| job.request.file == file && job.is_wanted())
    }

    /// Begins the next study that waits, unless one is at work.
    pub fn begin_next(&mut self, host: &Arc<PluginHost>) {
        if !self.jobs.iter().any(Job::at_work)
            && let Some(next) = self.jobs.iter().find(|job| job.state() == State::Waiting)
        {
            let (request, host) = (next.request.clone(), Arc::clone(host));
            next.begin("study", self.normal_priority, move |job| run(job, &request, &host));
        }
    }
}

impl StudyJob {
    /// The study as it was opened to be run.
    pub fn opened(&self) -> Option<Arc<PreparedStudy>> {
        self.found().opened.map(|(opened, _)| opened)
    }

    /// The folder of its results, once it is opened.
    pub fn folder(&self) -> Option<PathBuf> {
        self.found().opened.map(|(_, folder)| folder)
    }

    /// The forecast, if it was asked for and is made.
    pub fn forecast(&self) -> Option<Forecast> {
        self.found().forecast
    }
}

/// Opens a study and runs the part of it that was asked for; the whole has a table and a report.
fn run(
    job: &AtWork<StudyFound>,
    request: &StudyRequest,
    host: &PluginHost,
) -> Result<State, Error> {
    let StudyRequest { file, text, files, root, part, .. } = request;
    let opened = Arc::new(PreparedStudy::of_sources(text.clone(), file, files.clone(), host)?);
    let folder = Folder::open(&Folder::path_under(root, &opened), &opened)?;
    job.found(|found| found.opened = Some((Arc::clone(&opened), folder.path.clone())));
    job.enter(State::Running);
    let threads = pool::default_count();
    if *part == Part::Forecast {
        let count = folder.first_stored().saturating_add(FORECAST_ENCOUNTERS);
        let forecast = forecast::of_first(&opened, &folder, count, threads, &job.control)?;
        job.found(|found| found.forecast = Some(forecast));
    } else {
        batch::run(&opened, &folder, Shard::WHOLE, threads, &job.control)?;
    }
    if !job.control.may_continue() {
        return Ok(State::Cancelled);
    }
    if *part == Part::Forecast {
        return Ok(State::Done);
    }
    job.enter(State::Finishing);
    let table = merge::merge(&opened, &folder)?;
    merge::save(&opened, &folder, &table)?;
    report::write(&opened, &folder, &Findings::of(&opened, &table, &folder), &[])?;
    Ok(State::Done)
}

/// The command lines that run, merge and report a study as the queue does.
pub fn command_line(study: &Path, library: &Path, results: Option<&Path>) -> String {
    let out = results.map_or_else(String::new, |folder| format!(" --out {}", shell::path(folder)));
    let (study, library) = (shell::path(study), shell::path(library));
    let line = |verb: &str| format!("endline study {verb} {study} --library {library}{out}");
    ["run", "merge", "report"].map(line).join(" && ")
}
