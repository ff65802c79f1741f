//! A run taken step by step, its states stored and restored.

use std::sync::{Arc, Mutex, PoisonError};

use endline_sdk::{BodyPart, Controls};
use endline_session::{Error, Run as SessionRun};
use endline_sim::Model;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error::failed;
use crate::moments::{self, History, Numbers};
use crate::result::Result;
use crate::signals::Signals;

/// A run with its stored moments.
struct Progress {
    run: SessionRun,
    history: History,
    /// The moment of a restored state, until the next step: contacts are not part of a state.
    restored: Option<moments::Moment>,
}

impl Progress {
    fn moment(&self) -> moments::Moment {
        self.restored.clone().unwrap_or_else(|| moments::Moment::of(&self.run))
    }

    /// A run that continues from the newest moment of this one.
    fn branch(&self) -> PyResult<Self> {
        let run = self.run.branched(&self.run.moment(), self.run.prepared().clone());
        let run = run.map_err(|error| {
            failed(format!(
                "the steps of the run cannot be read from their temporary file: {error}"
            ))
        })?;
        Ok(Self { run, history: self.history.clone(), restored: Some(self.moment()) })
    }
}

/// Position [m], orientation (x, y, z, w), speed through the water [m/s] and mean normal force on each part in the last step [N] of
/// a whale.
type WhaleNow = ([f64; 3], [f64; 4], f64, [f64; BodyPart::ALL.len()]);

/// A run in progress.
#[pyclass(frozen, module = "endline._endline")]
pub struct Run {
    /// In a box, because Python's memory is aligned to 16 bytes and the lanes of a run need more.
    progress: Mutex<Box<Progress>>,
}

impl Run {
    /// A run before its first step.
    pub fn of(run: SessionRun) -> Self {
        let mut history = History::default();
        history.add(&run);
        Self { progress: Mutex::new(Box::new(Progress { run, history, restored: None })) }
    }

    /// Works on the run without the interpreter's lock, which another thread with this run may need.
    fn with<T: Send>(&self, python: Python<'_>, work: impl FnOnce(&mut Progress) -> T + Send) -> T {
        python.detach(|| work(&mut self.progress.lock().unwrap_or_else(PoisonError::into_inner)))
    }
}

#[pymethods]
impl Run {
    /// Takes steps under controls, or under the pilot program where they are `None`; returns how many were taken before the end.
    fn step(
        &self,
        python: Python<'_>,
        controls: Option<[f64; Controls::COUNT]>,
        count: u64,
    ) -> PyResult<u64> {
        self.with(python, |progress| {
            let (mut signals, mut taken) = (Signals::new(), 0);
            while taken < count && !progress.run.finished() && signals.should_continue() {
                let controls = controls.map_or_else(|| progress.run.pilot(), Controls::from_array);
                progress.restored = None;
                if progress.run.step(controls).is_err() {
                    break;
                }
                progress.history.add(&progress.run);
                taken += 1;
            }
            signals.outcome()?;
            Ok(taken)
        })
    }

    /// Simulated time [s] and steps so far.
    fn now(&self, python: Python<'_>) -> (f64, u64) {
        self.with(python, |progress| {
            let state = progress.run.state();
            (state.time_s, state.step)
        })
    }

    /// Length of a step [s], and steps of the whole scenario.
    fn extent(&self, python: Python<'_>) -> (f64, u64) {
        self.with(python, |progress| (progress.run.step_s(), progress.run.steps_in_all()))
    }

    /// Whether the scenario's time is over or the run has stopped.
    fn finished(&self, python: Python<'_>) -> bool {
        self.with(python, |progress| progress.run.finished())
    }

    /// Hash of the state, as in the figures of a run.
    fn state_hash(&self, python: Python<'_>) -> String {
        self.with(python, |progress| progress.run.state_hash().hex())
    }

    /// The pilot program's controls for the next step, in the order of `controls`.
    fn program(&self, python: Python<'_>) -> [f64; Controls::COUNT] {
        self.with(python, |progress| progress.run.pilot().to_array())
    }

    /// Ids of the acts of the whale's motion; `None` without a whale.
    fn acts(&self, python: Python<'_>) -> Option<Vec<String>> {
        self.with(python, |progress| {
            let whale = progress.run.model().spec.whale.as_ref()?;
            Some(whale.motion.descriptor().acts.iter().map(|act| act.id.to_string()).collect())
        })
    }

    /// The whale now; `None` without one.
    fn whale(&self, python: Python<'_>) -> Option<WhaleNow> {
        self.with(python, |progress| {
            let whale = progress.run.state().whale.as_ref()?;
            Some((
                whale.position.to_array(),
                whale.orientation.to_array(),
                whale.speed_m_s,
                whale.contact_force_n,
            ))
        })
    }

    /// The newest moment.
    fn moment(&self, python: Python<'_>) -> Moment {
        self.with(python, |progress| Moment {
            model: Arc::clone(progress.run.model()),
            moments: [progress.moment()],
        })
    }

    /// The state now. An error if the run has stopped, because no run continues from there.
    fn save_state(&self, python: Python<'_>) -> PyResult<RunState> {
        self.with(python, |progress| {
            if let Some(stop) = progress.run.stopped() {
                let stopped = Error::Stopped(stop.clone());
                return Err(failed(format!(
                    "{stopped}; no run continues from there, so that its state is not stored: store states of earlier moments"
                )));
            }
            Ok(RunState { progress: Mutex::new(Box::new(progress.branch()?)) })
        })
    }

    /// Continues from a stored state of a run of the same scenario.
    fn restore(&self, python: Python<'_>, state: &RunState) -> PyResult<()> {
        self.with(python, |progress| {
            let stored = state.progress.lock().unwrap_or_else(PoisonError::into_inner);
            let (here, there) = (&progress.run, &stored.run);
            if !Arc::ptr_eq(here.model(), there.model()) {
                let [here, there] = [here, there].map(|run| run.prepared().source.hash());
                if here != there {
                    return Err(failed(format!(
                        "the state is of a run with the model {}, and this run has the model {}; expected a state of a run of the same scenario, library and options",
                        short(&there),
                        short(&here)
                    )));
                }
            }
            let restored = stored.branch()?;
            *progress = restored;
            Ok(())
        })
    }

    /// The results so far.
    fn result(&self, python: Python<'_>) -> PyResult<Result> {
        self.with(python, |progress| Result::of(&progress.run, &progress.history))
    }
}

/// The start of a hash, enough to distinguish two.
fn short(hash: &str) -> &str {
    hash.get(..12).unwrap_or(hash)
}

/// A state of a run, with everything that was stored of the run until then.
#[pyclass(frozen, module = "endline._endline")]
pub struct RunState {
    /// In a box for the alignment, as in `Run`.
    progress: Mutex<Box<Progress>>,
}

/// A moment of a run in progress.
#[pyclass(frozen, module = "endline._endline")]
pub struct Moment {
    model: Arc<Model>,
    moments: [moments::Moment; 1],
}

#[pymethods]
impl Moment {
    /// A series of this one moment: numbers, shape, and numpy's name of their type. `None` for an unknown name.
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

    /// The outcome so far; `None` without a whale.
    fn outcome(&self) -> Option<&'static str> {
        Some(self.moments[0].encounter.as_ref()?.outcome.name())
    }
}
