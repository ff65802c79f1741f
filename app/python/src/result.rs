//! The results of a run: figures, moments, a recording, pictures.

use std::path::PathBuf;
use std::sync::Arc;

use endline_session::recording::program::program;
use endline_session::scene::Show;
use endline_session::units::Units;
use endline_session::{Recording, Report, Run, json};
use endline_sim::{DVec3, Model};
use endline_workbench::scene::{RenderRequest, render};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error::{failed, raised};
use crate::host;
use crate::moments::{self, History, Moment, Numbers};

/// A run that has ended.
#[pyclass(frozen, module = "endline._endline")]
pub struct Result {
    report: Report,
    model: Arc<Model>,
    moments: Vec<Moment>,
    recording: Recording,
}

impl Result {
    /// The result of a run and of the encounter at its stored frames.
    pub fn of(run: &Run, history: &History) -> PyResult<Self> {
        Ok(Self {
            report: Report::from_run(run),
            model: Arc::clone(run.model()),
            moments: history.moments(run),
            recording: run.recording().map_err(raised)?,
        })
    }

    fn moment(&self, moment: usize) -> PyResult<&Moment> {
        self.moments.get(moment).ok_or_else(|| {
            PyIndexError::new_err(format!(
                "there are {} moments, and no index {moment}",
                self.moments.len()
            ))
        })
    }
}

#[pymethods]
impl Result {
    /// The figures as the JSON of `endline run --json`.
    fn json(&self) -> String {
        json::line(&self.report)
    }

    /// Each line: id, its first node and the one after its last, its first segment and the one after its last.
    fn lines(&self) -> Vec<(String, [usize; 4])> {
        let (nodes, segments) = (&self.model.line_nodes, &self.model.line_segments);
        let lines = self.model.spec.lines.iter().zip(nodes).zip(segments);
        lines
            .map(|((line, nodes), segments)| {
                (line.id.clone(), [nodes.start, nodes.end, segments.start, segments.end])
            })
            .collect()
    }

    /// Ids of the bodies.
    fn bodies(&self) -> Vec<String> {
        self.model.spec.bodies.iter().map(|body| body.id.clone()).collect()
    }

    /// A series of all moments: its numbers, its shape, and numpy's name of their type. `None` for an unknown name.
    fn series<'py>(
        &self,
        python: Python<'py>,
        name: &str,
    ) -> Option<(Bound<'py, PyBytes>, Vec<usize>, &'static str)> {
        let Numbers { bytes, shape, kind } = moments::series(&self.moments, &self.model, name)?;
        Some((PyBytes::new(python, &bytes), shape, kind))
    }

    /// The regions of skin that contacts lie on, by contact.
    fn contact_regions(&self) -> Vec<&'static str> {
        moments::regions(&self.moments)
    }

    /// The outcome so far at each moment; empty without a whale.
    fn outcomes(&self) -> Vec<&'static str> {
        let encounters = self.moments.iter().filter_map(|moment| moment.encounter.as_ref());
        encounters.map(|encounter| encounter.outcome.name()).collect()
    }

    /// The scenario with the inputs of the run as its pilot program.
    fn pilot_program(&self) -> PyResult<String> {
        Ok(program(&self.recording, host(), 0.0).map_err(raised)?.scenario)
    }

    /// Saves the recording.
    fn save(&self, path: PathBuf) -> PyResult<()> {
        self.recording.save(&path).map_err(raised)
    }

    /// The pixels of a picture of a moment, row by row from the top: red, green, blue, opacity.
    fn render<'py>(
        &self,
        python: Python<'py>,
        moment: usize,
        view: &str,
        size: [u32; 2],
        caption: &str,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let frame = &self.moment(moment)?.frame;
        let out = PathBuf::new();
        let fit: &[DVec3] = &[];
        let pixels = python.detach(|| {
            render(&RenderRequest {
                model: &self.model,
                frame,
                size,
                view,
                show: Show::default(),
                fit,
                caption,
                out: &out,
                units: Units::Mixed,
            })
        });
        Ok(PyBytes::new(python, pixels.map_err(failed)?.as_flattened()))
    }
}
