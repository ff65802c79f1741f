//! Plan, run in parts, merge and report of a study.

use std::path::{Path, PathBuf};

use endline_session::campaign::{Control, Progress, Shard};
use endline_session::study::folder::Folder;
use endline_session::study::stats::Findings;
use endline_session::study::{PreparedStudy, batch, merge, report};
use endline_session::{json, locate};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::{failed, raised};
use crate::host;
use crate::signals::Signals;

/// A study, opened and checked.
#[pyclass(frozen, module = "endline._endline")]
pub struct Study {
    opened: PreparedStudy,
}

#[pymethods]
impl Study {
    /// A study by its id in the library, or by its file.
    #[new]
    #[pyo3(signature = (name, library=None))]
    fn new(python: Python<'_>, name: &str, library: Option<PathBuf>) -> PyResult<Self> {
        let library = library.as_deref();
        let file = locate::named(name, "studies", library).map_err(failed)?;
        let opened = python.detach(|| PreparedStudy::open(&file, library, host()));
        Ok(Self { opened: opened.map_err(raised)? })
    }

    #[getter]
    fn id(&self) -> &str {
        &self.opened.study.id
    }

    #[getter]
    fn hash(&self) -> &str {
        &self.opened.hash
    }

    #[getter]
    fn encounters(&self) -> u64 {
        self.opened.study.encounters
    }

    #[getter]
    fn options(&self) -> Vec<&str> {
        self.opened.options.iter().map(|option| option.id.as_str()).collect()
    }

    /// Its plan, as the JSON of `endline study plan`.
    fn plan(&self) -> String {
        self.opened.plan_json(None)
    }

    /// Files of the blocks of a part in a folder of results.
    fn blocks(&self, out: PathBuf, part: u32, of: u32) -> PyResult<Vec<PathBuf>> {
        let (folder, shard) = (self.folder(&out)?, shard(part, of)?);
        let own = (0..folder.blocks()).filter(|block| shard.holds(*block));
        Ok(own.map(|block| folder.file_of(block)).collect())
    }

    /// Runs the missing blocks of a part; returns the number of done and of all encounters.
    /// `progress` is called with these numbers whenever they have changed.
    #[pyo3(signature = (out, part, of, threads, progress=None))]
    fn run(
        &self,
        python: Python<'_>,
        out: PathBuf,
        part: u32,
        of: u32,
        threads: usize,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(u32, u32)> {
        let (folder, shard) = (self.folder(&out)?, shard(part, of)?);
        python.detach(|| {
            let control = Control::default();
            let work = || batch::run(&self.opened, &folder, shard, threads, &control);
            let mut reported = (0, 0);
            let report = |now: Progress| {
                let now = (now.encounters.done, now.encounters.total);
                if now == std::mem::replace(&mut reported, now) {
                    return Ok(());
                }
                let Some(call) = &progress else { return Ok(()) };
                Python::attach(|python| call.call1(python, now).map(drop))
            };
            let progress = watched(&control, report, work)?;
            Ok((progress.encounters.done, progress.encounters.total))
        })
    }

    /// Joins the blocks of a folder; returns the file of the table.
    fn merge(&self, python: Python<'_>, out: PathBuf) -> PyResult<PathBuf> {
        let folder = self.folder(&out)?;
        let merged = python.detach(|| {
            let table = merge::merge(&self.opened, &folder)?;
            merge::save(&self.opened, &folder, &table)
        });
        merged.map_err(raised)?;
        Ok(folder.path.join("table.parquet"))
    }

    /// Writes the report of a merged study; returns its page, and the findings as the JSON of `endline study report`.
    fn report(&self, python: Python<'_>, out: PathBuf) -> PyResult<(PathBuf, String)> {
        let folder = self.folder(&out)?;
        let written = python.detach(|| {
            let table = merge::load(&folder)?;
            let findings = Findings::of(&self.opened, &table, &folder);
            let page = report::write(&self.opened, &folder, &findings, &[])?;
            Ok((page, json::line(&findings)))
        });
        written.map_err(raised)
    }
}

impl Study {
    fn folder(&self, out: &Path) -> PyResult<Folder> {
        Folder::open(out, &self.opened).map_err(raised)
    }
}

/// A part by its number, from 1.
fn shard(part: u32, of: u32) -> PyResult<Shard> {
    if (1..=of).contains(&part) {
        return Ok(Shard { part: part - 1, of });
    }
    Err(PyValueError::new_err(format!(
        "part={part}, of={of}: expected a part from 1 to the number of parts, such as part=1, of=1 for the whole"
    )))
}

/// Does work on another thread and reports its progress; Ctrl+C, or an exception of `report`, cancels it after the encounters in
/// progress.
fn watched<T: Send>(
    control: &Control,
    mut report: impl FnMut(Progress) -> PyResult<()>,
    work: impl FnOnce() -> Result<T, endline_session::Error> + Send,
) -> PyResult<T> {
    std::thread::scope(|scope| {
        let worker = scope.spawn(work);
        let (mut signals, mut reported) = (Signals::new(), Ok(()));
        while !worker.is_finished() {
            std::thread::sleep(std::time::Duration::from_millis(20));
            reported = report(control.progress());
            if reported.is_err() || !signals.should_continue() {
                control.cancel();
                break;
            }
        }
        let done = worker.join();
        signals.outcome()?;
        reported?;
        match done {
            Ok(done) => {
                let done = done.map_err(raised)?;
                report(control.progress())?;
                Ok(done)
            }
            Err(_) => Err(failed("a thread of the study has panicked".into())),
        }
    })
}
