//! A gear library, and one assembly of it at rest.

use std::path::{Path, PathBuf};

use endline_gear::Library as Items;
use endline_session::check::check_path;
use endline_session::source::AssemblyFile;
use endline_session::statics::{TrialGear, TrialSea, alone, settled};
use endline_session::{json, locate};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{as_dict, failed, raised};
use crate::host;
use crate::scenario::text_of;

/// A folder of gear, whales, sites, scenarios and studies.
#[pyclass(frozen, module = "endline._endline")]
pub struct Library {
    /// Its folder.
    #[pyo3(get)]
    path: PathBuf,
}

#[pymethods]
impl Library {
    /// The library of a folder, or that of the command line.
    #[new]
    #[pyo3(signature = (path=None))]
    fn new(path: Option<PathBuf>) -> PyResult<Self> {
        Ok(Self { path: locate::library(None, path.as_deref()).map_err(failed)? })
    }

    /// Ids of the files of one of its folders, such as `scenarios`, `ropes` or `whales`.
    fn ids(&self, folder: &str) -> PyResult<Vec<String>> {
        locate::ids(&self.path, folder).map_err(failed)
    }

    /// Problems of its files.
    fn check<'py>(&self, python: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let checked = python.detach(|| check_path(&self.path, Some(&self.path), host()));
        checked.problems.iter().map(|problem| as_dict(python, problem)).collect()
    }
}

/// One assembly of gear, alone.
#[pyclass(frozen, module = "endline._endline")]
pub struct Assembly {
    file: AssemblyFile,
    items: Items,
}

#[pymethods]
impl Assembly {
    /// An assembly by its id in the library, or by its file.
    #[new]
    #[pyo3(signature = (name, library=None))]
    fn new(name: &str, library: Option<PathBuf>) -> PyResult<Self> {
        let file = AssemblyFile::open(name, library.as_deref()).map_err(raised)?;
        let items = file.library().map_err(raised)?;
        Ok(Self { file, items })
    }

    #[getter]
    fn id(&self) -> &str {
        &self.file.id
    }

    #[getter]
    fn text(&self) -> &str {
        &self.file.text
    }

    #[getter]
    fn library(&self) -> &Path {
        &self.file.root
    }

    /// The assembly at rest in the sea of a scenario, as the JSON of `endline settle`.
    fn settle(
        &self,
        python: Python<'_>,
        scenario: &str,
        depth: Option<String>,
        current_m_s: Option<f64>,
    ) -> PyResult<String> {
        let (_, scenario) = text_of(scenario, Some(&self.file.root))?;
        let sea = TrialSea { depth, current_m_s };
        let rest = python.detach(|| {
            let gear = TrialGear::Assembly(self.file.id.clone());
            let text = alone(&scenario, &gear, &sea, &self.items)?;
            settled(&self.file.id, &text, &self.items, host())
        });
        Ok(json::line(&rest.map_err(raised)?.shape))
    }
}
