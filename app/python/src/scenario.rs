//! Statics and run of a scenario; replay of a recording.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering::Relaxed;
use std::time::Instant;

use endline_gear::Setting;
use endline_session::recording::replay::{self as again, ReplayOptions, Verdict};
use endline_session::settled::SettledShape;
use endline_session::{Overrides, Prepared, Recording, Run, RunOptions, Source, json, locate};
use endline_sim::settle;
use pyo3::prelude::*;

use crate::error::{failed, raised};
use crate::host;
use crate::moments::History;
use crate::result::Result;
use crate::signals::interruptible;
use crate::stepping;

/// A scenario with its gear library, ready to run.
#[pyclass(frozen, module = "endline._endline")]
pub struct Scenario {
    prepared: Prepared,
}

/// Settings that override a scenario: a dictionary with these keys.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Over {
    seed: Option<u64>,
    step_s: Option<f64>,
    weak_links: Option<bool>,
    rating_n: Option<f64>,
    kinetic: Option<bool>,
    set: Vec<(String, Value)>,
}

/// A value that replaces a field.
#[derive(FromPyObject)]
enum Value {
    Flag(bool),
    Integer(i64),
    Number(f64),
    Text(String),
    Texts(Vec<String>),
}

impl Value {
    fn setting(&self) -> Setting {
        match self {
            Self::Flag(flag) => Setting::plain(&flag.to_string()),
            Self::Integer(integer) => Setting::plain(&integer.to_string()),
            Self::Number(number) => Setting::number(*number),
            Self::Text(text) => Setting::text(text),
            Self::Texts(texts) => Setting::texts(texts),
        }
    }
}

#[pymethods]
impl Scenario {
    /// A scenario by its id in the library, or by its file, with overrides.
    #[new]
    fn new(python: Python<'_>, name: &str, library: Option<PathBuf>, over: Over) -> PyResult<Self> {
        let library = library.as_deref();
        let file = locate::named(name, "scenarios", library).map_err(failed)?;
        let Over { seed, step_s, weak_links, rating_n, kinetic, set } = over;
        let over = Overrides { seed, step_s, weak_links, rating_n, kinetic };
        let set: Vec<(String, Setting)> =
            set.into_iter().map(|(field, value)| (field, value.setting())).collect();
        let prepared = python.detach(|| {
            let mut source = Source::read(&file, library, over)?;
            source.set(&set)?;
            source.prepare_with_clips(host())
        });
        Ok(Self { prepared: prepared.map_err(raised)? })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.prepared.source.scenario_name
    }

    #[getter]
    fn text(&self) -> &str {
        &self.prepared.source.scenario
    }

    #[getter]
    fn model_hash(&self) -> String {
        self.prepared.source.hash()
    }

    #[getter]
    fn duration_s(&self) -> f64 {
        self.prepared.model.spec.settings.duration_s
    }

    /// The gear at rest, as the JSON of `endline settle`.
    fn settle(&self, python: Python<'_>) -> PyResult<String> {
        let prepared = self.prepared.clone();
        interruptible(python, move |_| {
            let start = Instant::now();
            let settled = settle(&prepared.model);
            let wall_s = start.elapsed().as_secs_f64();
            Ok(json::line(&SettledShape::of(&prepared, &settled, wall_s)))
        })
    }

    /// Settles the gear and runs to the end, with stored moments at a rate.
    fn run(&self, python: Python<'_>, frames_hz: f64, unsettled: bool) -> PyResult<Result> {
        let options = RunOptions { unsettled, frames_hz };
        let prepared = self.prepared.clone();
        interruptible(python, move |running| {
            let mut run = Run::new(prepared, options).map_err(raised)?;
            let mut history = History::default();
            history.add(&run);
            run.to_end_until(|run| {
                history.add(run);
                !running.load(Relaxed)
            });
            Result::of(&run, &history)
        })
    }

    /// Settles the gear; the run stands ready for its first step.
    fn start(
        &self,
        python: Python<'_>,
        frames_hz: f64,
        unsettled: bool,
    ) -> PyResult<stepping::Run> {
        let options = RunOptions { unsettled, frames_hz };
        let prepared = self.prepared.clone();
        interruptible(python, move |_| {
            Ok(stepping::Run::of(Run::new(prepared, options).map_err(raised)?))
        })
    }
}

/// The file and the text of a scenario by its id in a library, or by its file.
pub fn text_of(name: &str, library: Option<&Path>) -> PyResult<(PathBuf, String)> {
    let file = locate::named(name, "scenarios", library).map_err(failed)?;
    let text = endline_gear::read::text(&file)
        .map_err(|error| failed(format!("{}: cannot be read: {error}", file.display())))?;
    Ok((file, text))
}

/// First difference of a run from its recording: step, time [s] and part of the state.
type Difference = (u64, f64, &'static str);

/// A replayed recording with its first difference; `None` if all steps have the recorded bits.
#[pyfunction]
pub fn replay(
    python: Python<'_>,
    recording: PathBuf,
    frames_hz: f64,
    other_plugins: bool,
) -> PyResult<(Result, Option<Difference>)> {
    let options = ReplayOptions { other_plugins, frames_hz };
    interruptible(python, move |running| {
        let recording = Recording::load(&recording).map_err(raised)?;
        let mut run = again::start(&recording, host(), options).map_err(raised)?;
        let mut history = History::default();
        history.add(&run);
        let verdict =
            again::compare(&recording, &mut run, recording.inputs.len(), &mut |run, _| {
                history.add(run);
                running.load(Relaxed)
            });
        let differs = match verdict {
            Verdict::Same { .. } => None,
            Verdict::Differs { step, time_s, part } => Some((step, time_s, part)),
        };
        Ok((Result::of(&run, &history)?, differs))
    })
}
