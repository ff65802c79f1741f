//! The results of a study read from its folder, whole or while the study is at work; on a thread of its own for a window.
//!
//! A study of this process is read from its blocks too: they are what other processes have run as well.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use endline_gear::names;

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::Prepared;
use crate::task::{Fault, Task, Waker};

use super::folder::{Folder, Label};
use super::prepared::PreparedStudy;
use super::runs::Runs;
use super::stats::Findings;
use super::{merge, prepare};
use crate::table::Table;

/// Which results are read.
#[derive(Clone, Default)]
pub struct ResultsRequest {
    /// The study's file; found by the label of the folder where `None`.
    pub file: Option<PathBuf>,
    /// The study, where it is open already because it is at work.
    pub opened: Option<Arc<PreparedStudy>>,
    /// Folder of results; the study's own under `root` where `None`.
    pub folder: Option<PathBuf>,
    /// Folder of the gear library.
    pub library: PathBuf,
    /// Folder that holds the folders of results.
    pub root: PathBuf,
    /// Number of blocks known to be written.
    pub blocks: u32,
}

/// The results of a study at the time of reading.
pub struct StudyResults {
    /// The study.
    pub opened: Arc<PreparedStudy>,
    /// Its folder.
    pub folder: PathBuf,
    /// Runs of the blocks before the first missing one.
    pub runs: Runs,
    /// Statistics of these rows.
    pub findings: Findings,
    /// Whether these are all rows of the study.
    pub whole: bool,
}

impl StudyResults {
    /// Reads the results; `None` where the study has none yet.
    /// Errors: a study that cannot be opened, or a folder that is damaged or belongs to another study.
    pub fn read(request: ResultsRequest, host: &PluginHost) -> Result<Option<Self>, Error> {
        let at_work = request.opened.is_some();
        let opened = match (request.opened, &request.file, &request.folder) {
            (Some(opened), _, _) => opened,
            (None, Some(file), _) => {
                Arc::new(PreparedStudy::open(file, Some(&request.library), host)?)
            }
            (None, None, Some(folder)) => Arc::new(study_of(folder, &request.library, host)?),
            (None, None, None) => return Ok(None),
        };
        let path = request.folder.unwrap_or_else(|| Folder::path_under(&request.root, &opened));
        // A study that was never run has no folder, and reading must not make one.
        if !path.join("study.json").is_file() {
            return Ok(None);
        }
        let folder = Folder::open(&path, &opened)?;
        let (runs, whole) = runs(&folder, at_work)?;
        if runs.rows().is_empty() {
            return Ok(None);
        }
        let findings = Findings::of(&opened, &runs, &folder);
        Ok(Some(Self { opened, folder: path, runs, findings, whole }))
    }

    /// The model of one run of the study, with the duration at which the run ended in the study.
    /// Errors: where the scenario cannot be assembled.
    pub fn prepare(
        &self,
        option: usize,
        encounter: u32,
        host: &PluginHost,
    ) -> Result<Prepared, Error> {
        let folder = Folder::open(&self.folder, &self.opened)?;
        let drawn = self.opened.encounter(&folder, encounter)?;
        let prepared = self.opened.prepare(option, &drawn)?;
        let Some(end_s) = self.end_s(option, encounter) else { return Ok(prepared) };
        prepare::until(&prepared, end_s, host)
    }

    /// When a run ended in the study [s].
    fn end_s(&self, option: usize, encounter: u32) -> Option<f64> {
        self.runs.find(&self.opened.options[option].id, encounter)?.simulated_s
    }
}

/// The merged runs, else those of the blocks before the first missing one; and whether they are
/// all runs of the study.
fn runs(folder: &Folder, at_work: bool) -> Result<(Runs, bool), Error> {
    if !at_work && folder.path.join("table.parquet").is_file() {
        return Ok((merge::load(folder)?, true));
    }
    first_runs(folder)
}

/// The runs of the blocks before the first missing one, and whether no block is missing.
/// Errors: a block that is damaged or belongs to another study.
pub(super) fn first_runs(folder: &Folder) -> Result<(Runs, bool), Error> {
    let mut table = Table::default();
    let there = folder.blocks_of(folder.first_stored());
    for block in 0..there {
        folder.append(block, &mut table)?;
    }
    let runs = Runs::read(table).map_err(|wrong| Error::at(&folder.path, wrong.to_string()))?;
    Ok((runs, there == folder.blocks()))
}

/// The study of a folder of results: from the bundle in it, else from the library.
fn study_of(folder: &Path, library: &Path, host: &PluginHost) -> Result<PreparedStudy, Error> {
    let file = folder.join("study.json");
    let text = endline_gear::read::text(&file)
        .map_err(Error::on(&file, "no results of a study are here"))?;
    let label: Label = serde_json::from_str(&text).map_err(Error::on(&file, "is damaged"))?;
    let bundle = folder.join("bundle/study.toml");
    if bundle.is_file() {
        return PreparedStudy::open(&bundle, Some(&folder.join("bundle/gear-library")), host);
    }
    if !names::is_id(&label.study) {
        let message = format!("names the study {:?}, which is no id", label.study);
        return Err(Error::at(&file, message));
    }
    let file = library.join("studies").join(format!("{}.toml", label.study));
    PreparedStudy::open(&file, Some(library), host)
}

/// A folder of results of a study.
#[derive(Clone, Debug)]
pub struct ResultsFolder {
    /// Where.
    pub folder: PathBuf,
    /// Which study.
    pub label: Label,
    /// Whether the report is written.
    pub reported: bool,
}

/// The folders of results under a root, by path.
pub fn list(root: &Path) -> Vec<ResultsFolder> {
    let folders = std::fs::read_dir(root).into_iter().flatten().flatten().map(|entry| entry.path());
    let read = |folder: PathBuf| {
        let text = endline_gear::read::text(&folder.join("study.json")).ok()?;
        let label = serde_json::from_str(&text).ok()?;
        let reported = folder.join("report.html").is_file();
        Some(ResultsFolder { folder, label, reported })
    };
    let mut found: Vec<ResultsFolder> = folders.filter_map(read).collect();
    found.sort_by(|one, other| one.folder.cmp(&other.folder));
    found
}

/// Time between two readings of a study at work.
const AGAIN: Duration = Duration::from_secs(4);

type Answer = Result<Option<Arc<StudyResults>>, String>;

/// The results read last, and those being read.
#[derive(Default)]
pub struct ResultsReader {
    shown: Option<Arc<StudyResults>>,
    reading: Task<Answer>,
    /// Folder of the study whose progress is followed.
    folder: Option<PathBuf>,
    /// Number of blocks at the last reading, and its time.
    read: Option<(u32, Instant)>,
    /// Whether the study queued last is shown once it has a folder.
    pub follows_next: bool,
    /// Why nothing is shown.
    pub problem: Option<String>,
}

impl ResultsReader {
    /// The results shown.
    pub fn shown(&self) -> Option<&Arc<StudyResults>> {
        self.shown.as_ref()
    }

    /// Whether results are being read.
    pub fn busy(&self) -> bool {
        self.reading.busy()
    }

    /// The folder whose study is followed while it is at work.
    pub fn followed(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Follows the study of a folder.
    pub fn follow(&mut self, folder: PathBuf) {
        (self.folder, self.read, self.follows_next) = (Some(folder), None, false);
    }

    /// Whether it is time to read again, given the number of blocks and whether the study has ended.
    pub fn is_due(&self, blocks: u32, over: bool) -> bool {
        let fresh = self
            .read
            .is_none_or(|(before, at)| before != blocks && (over || at.elapsed() >= AGAIN));
        !self.busy() && blocks > 0 && fresh
    }

    /// Begins to read; an earlier reading in progress is dropped.
    /// Errors: where the system gives no thread.
    pub fn ask(
        &mut self,
        request: ResultsRequest,
        host: Arc<PluginHost>,
        waker: Waker,
    ) -> Result<(), String> {
        self.read = Some((request.blocks, Instant::now()));
        let work = move || {
            let read = StudyResults::read(request, &host);
            read.map(|results| results.map(Arc::new)).map_err(|error| error.to_string())
        };
        self.reading.start("endline-results", work, waker).map_err(|error| error.to_string())
    }

    /// Takes in the results that were read; called regularly. `None` if there is nothing new.
    pub fn take(&mut self) -> Option<Result<(), String>> {
        let answer = self.reading.poll()?.unwrap_or_else(|Fault| {
            Err("reading the results ended by a fault inside the program".into())
        });
        self.problem = answer.as_ref().err().cloned();
        Some(answer.map(|shown| {
            if let Some(shown) = shown {
                self.folder = Some(shown.folder.clone());
                self.shown = Some(shown);
            }
        }))
    }
}
