//! Validation cases: run, compared with expected values, and studied for convergence.
//!
//! A case ([`endline_gear::Case`]) names a scenario of the same library. It is run at the scenario's own step and
//! segments, and where it says so at a half and a quarter of each, one at a time; the order of convergence is
//! `p = log₂(|r₁ - r½| / |r½ - r¼|)` of its readings `r`, which needs no exact answer.
//! Reference: Roache 1998, Verification of codes and calculations (doi:10.2514/2.457).

mod judge;
pub mod outcome;
mod rows;
mod setup;

use std::path::{Path, PathBuf};

use endline_gear::{Case, Diagnostic, Samples, Sources, Table};

use crate::error::Error;
use crate::locate;
use crate::plugins::PluginHost;

pub use outcome::{Convergence, Curve, Outcome, Point, Verdict};

use outcome::{Observed, failed};
use setup::Setup;

/// The cases of a gear library.
#[derive(Clone, Debug)]
pub struct Cases {
    root: PathBuf,
    sources: Sources,
}

/// A case with its table.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The case.
    pub case: Case,
    table: Option<Table>,
}

/// How much of a case is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// At its own step and segments only.
    Plain,
    /// At a half and a quarter of them too, where the case says so.
    Halved,
}

impl Cases {
    /// The cases of a library folder, found as [`locate::library`] says where `library` is `None`.
    pub fn open(library: Option<&Path>) -> Result<Self, Error> {
        let root = locate::library(None, library).map_err(Error::Message)?;
        let sources = Sources::from_folder(&root)?;
        Ok(Self { root, sources })
    }

    /// Ids of all cases, in order.
    pub fn ids(&self) -> Result<Vec<String>, Error> {
        let folder = self.root.join("cases");
        let entries = std::fs::read_dir(&folder).map_err(Error::on(&folder, "cannot be read"))?;
        let files = entries
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| path.extension().is_some_and(|end| end == "toml"));
        let mut ids: Vec<String> = files
            .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
            .collect();
        ids.sort();
        Ok(ids)
    }

    /// Reads a case and its table.
    pub fn load(&self, id: &str) -> Result<Loaded, Error> {
        let path = self.root.join("cases").join(format!("{id}.toml"));
        let case = Case::read(&path.display().to_string(), &self.text(&path, || self.known(id))?)?;
        let table = match &case.table {
            Some(name) => {
                let path = self.root.join("cases/tables").join(format!("{}.csv", name.value));
                let text = self.text(&path, String::new)?;
                Some(Table::read(&path.display().to_string(), &text).map_err(Error::from)?)
            }
            None => None,
        };
        Ok(Loaded { case, table })
    }

    /// Checks a case with its table and its scenario, without running it.
    pub fn check(&self, id: &str, host: &PluginHost) -> Result<(), Error> {
        let Loaded { case, table } = self.load(id)?;
        match (&case.samples, &table) {
            (Samples::Rows(rows), Some(table)) => rows::check(self, &case, rows, table, host),
            (Samples::Rows(_), None) => Err(no_table(&case)),
            _ => {
                let model = Setup::new(self, &case, &[], host)?.model;
                setup::check(&case, &model)?;
                judge::check_names(&case, &model, table.as_ref())
            }
        }
    }

    /// Runs a case. What stops its run is in the outcome; it then has not passed.
    pub fn run(
        &self,
        loaded: &Loaded,
        effort: Effort,
        host: &PluginHost,
    ) -> Result<Outcome, Error> {
        let Loaded { case, table } = loaded;
        if let Samples::Rows(rows) = &case.samples {
            let table = table.as_ref().ok_or_else(|| no_table(case))?;
            return rows::run(self, case, rows, table, host);
        }
        let setup = Setup::new(self, case, &[], host)?;
        setup::check(case, &setup.model)?;
        judge::check_names(case, &setup.model, table.as_ref())?;
        let base = match judge::observe(&setup, case, table.as_ref(), [1, 1])? {
            Ok(base) => base,
            Err(reason) => return Ok(failed(case, &setup, reason)),
        };
        let finer = match effort {
            Effort::Plain => Finer::default(),
            Effort::Halved => Finer::observe(&setup, case, table.as_ref())?,
        };
        judge::outcome(case, &setup, table.as_ref(), &base, &finer)
    }

    fn text(&self, path: &Path, more: impl Fn() -> String) -> Result<String, Error> {
        endline_gear::read::text(path)
            .map_err(|error| Error::at(path, format!("cannot be read: {error}{}", more())))
    }

    fn known(&self, id: &str) -> String {
        let ids = self.ids().unwrap_or_default();
        if ids.iter().any(|known| known == id) {
            String::new()
        } else {
            format!("\nknown cases are {}", ids.join(", "))
        }
    }
}

/// A case's readings at a half and a quarter of the step, and of the segments.
#[derive(Debug, Default)]
struct Finer {
    step: Option<[Observed; 2]>,
    segment: Option<[Observed; 2]>,
}

impl Finer {
    /// A finer run that stops leaves its parameter without an order of convergence; the base run is judged.
    fn observe(setup: &Setup, case: &Case, table: Option<&Table>) -> Result<Self, Error> {
        let pair = |half: [u32; 2], quarter: [u32; 2]| -> Result<Option<[Observed; 2]>, Error> {
            let half = judge::observe(setup, case, table, half)?;
            let quarter = judge::observe(setup, case, table, quarter)?;
            Ok(half.ok().zip(quarter.ok()).map(|(half, quarter)| [half, quarter]))
        };
        let step = if case.halve_step { pair([2, 1], [4, 1])? } else { None };
        let segment = if case.halve_segment { pair([1, 2], [1, 4])? } else { None };
        Ok(Self { step, segment })
    }
}

fn no_table(case: &Case) -> Error {
    let help = "write table = \"name\" for the file cases/tables/name.csv";
    let path = case.place.source.path.clone();
    Diagnostic::of_file(path, "there are [rows] without a `table`", help).into()
}
