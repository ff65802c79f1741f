//! A run on a thread of its own, paced to real time, for the workbench.
//!
//! The workbench sends [`RunCommand`]s and reads the [`latest`](Live::latest) [`LiveView`]; neither
//! ever waits for the solver.

mod history;
#[cfg(test)]
mod tests;
mod worker;

use std::path::PathBuf;
use std::sync::mpsc::{Sender, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use endline_gear::StrengthBudget;
use endline_sdk::Controls;
use endline_sim::metrics::{Event, Summary};
use endline_sim::{Audit, Cost, Frame, Model};

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::recording::program::Program;
use crate::report::headline::{Headline, Sentence};
use crate::report::validity::reasons;
use crate::run::RunOptions;
use crate::source::{Prepared, Source};
use crate::task::{Fault, Task, Waker};
use crate::units::Units;

pub use engine::{Engine, Launch};
pub use history::{Channel, Envelope, LineEnvelope, Series, Span};

/// Commands that may wait for the thread; more are refused.
const QUEUE: usize = 256;

/// A run made a scenario with a pilot program, or why it cannot be.
pub type Made = Result<Program, String>;

/// How a run stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// Statics at work.
    Settling,
    /// Standing still.
    Paused,
    /// Stepping.
    Running,
    /// The scenario's time is over.
    Finished,
    /// The solver or a plugin failed: why.
    Stopped(String),
    /// It never started: why.
    Failed(String),
}

/// The state of a run at one moment, for the workbench.
#[derive(Clone)]
pub struct LiveView {
    /// The model that runs.
    pub model: Arc<Model>,
    /// Strengths of its lines and weak links.
    pub strengths: Arc<[StrengthBudget]>,
    /// The moment shown: the newest, or the one sought.
    pub frame: Arc<Frame>,
    /// Time of the newest moment [s].
    pub newest_s: f64,
    /// Whether the moment shown is an earlier one.
    pub sought: bool,
    /// Metrics up to the newest moment; `None` before the start.
    pub summary: Option<Summary>,
    /// Greatest tension of each line over time [N].
    pub tension: Series,
    /// The whale's depth, speed, wraps and forces over time, by [`Channel`]; samples are empty without one.
    pub history: Series,
    /// Counters of the solver up to the newest moment.
    pub audit: Audit,
    /// Hash of the newest state, hexadecimal; empty before the start.
    pub state_hash: String,
    /// Events up to the newest moment.
    pub events: Arc<[Event]>,
    /// How the run stands.
    pub status: Status,
    /// Simulated seconds wanted for each real one.
    pub speed: f64,
    /// Simulated seconds the solver makes in a real one when it does not wait.
    pub times_real_time: f64,
    /// The computing time of the run so far, by purpose.
    pub cost: Cost,
    /// Whether a pilot steers and not the scenario's program.
    pub piloted: bool,
    /// The controls of the last step; before the first, those of the pilot program.
    pub controls: Controls,
    /// Answer to the last command that asked for one, such as the file saved.
    pub message: Option<String>,
    /// Least and greatest tension along each line up to the newest moment.
    pub envelope: Arc<Envelope>,
    /// Answer to the last [`RunCommand::Program`].
    pub program: Option<Arc<Made>>,
}

impl LiveView {
    /// The view before statics: the gear as first guessed.
    pub fn before(prepared: &Prepared) -> Self {
        worker::first_view(prepared)
    }

    /// The result up to the newest moment in a few sentences; empty before the start.
    pub fn headline(&self, units: Units) -> Vec<Sentence> {
        let Some(summary) = &self.summary else { return Vec::new() };
        let invalid_because = reasons(None, &self.audit, summary.whale.as_ref());
        let headline = Headline::of(
            &self.model,
            summary,
            &self.strengths,
            &self.audit,
            &invalid_because,
            self.newest_s,
        );
        headline.sentences(|force_n| units.force().text(force_n))
    }
}

/// A run on a thread of its own.
pub struct Live {
    commands: Option<SyncSender<RunCommand>>,
    view: Arc<Mutex<Arc<LiveView>>>,
    thread: Option<JoinHandle<()>>,
}

impl Live {
    /// Settles the model on a new thread and stands ready. `on_view` is called there whenever
    /// there is something new to see; it must not wait.
    pub fn open(
        prepared: Prepared,
        host: Arc<PluginHost>,
        options: RunOptions,
        on_view: impl Fn() + Send + 'static,
    ) -> std::io::Result<Self> {
        let (sender, receiver) = sync_channel(QUEUE);
        let view = Arc::new(Mutex::new(Arc::new(worker::first_view(&prepared))));
        let screen = worker::Screen { view: Arc::clone(&view), on_view: Box::new(on_view) };
        let thread = std::thread::Builder::new()
            .name("endline-run".into())
            .spawn(move || worker::work(prepared, &host, options, &receiver, &screen))?;
        Ok(Self { commands: Some(sender), view, thread: Some(thread) })
    }

    /// Sends a command; false where the thread has ended or its queue is full.
    pub fn send(&self, command: RunCommand) -> bool {
        self.commands.as_ref().is_some_and(|commands| commands.try_send(command).is_ok())
    }

    /// The newest view.
    pub fn latest(&self) -> Arc<LiveView> {
        Arc::clone(&self.view.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        drop(self.commands.take());
        if let Some(thread) = self.thread.take() {
            // The thread reports its own failures in the view.
            let _ = thread.join();
        }
    }
}

/// All that can be asked of a run.
#[derive(Clone)]
pub enum RunCommand {
    /// Run on, from the newest moment.
    Start,
    /// Stand still.
    Pause,
    /// Take one step, then stand still.
    Step,
    /// Back to the settled gear; the run so far is dropped.
    Reset,
    /// Simulated seconds wanted for each real one; infinite for as fast as the solver runs.
    Speed(f64),
    /// The pilot steers: these controls hold until the next.
    Controls(Controls),
    /// The scenario's pilot program steers.
    Autopilot,
    /// Another model, back at the start.
    Load(Box<Prepared>),
    /// Show the moment nearest to a time [s], and stand still; from the newest moment on, that.
    Seek(f64),
    /// Show the moment this many stored frames later, or earlier, and pause.
    Shift(i64),
    /// Back to the settled gear, then these inputs as fast as possible, then pause.
    Inputs(Vec<Controls>),
    /// Run the inputs up to the moment shown again, then pause: the run can continue from there in another way.
    Branch,
    /// Another model, in which the inputs of the run up to the moment shown are run again; then its own pilot program steers.
    Rerun(Box<Prepared>),
    /// Make the run so far a scenario whose pilot program flies it again; controls may be off by this much [1].
    Program(f64),
    /// Save the run so far as a recording.
    SaveRecording(PathBuf),
    /// Hand over the moments that are kept, in order.
    KeptFrames(Sender<Vec<Arc<Frame>>>),
}

/// Makes models from texts on a thread of its own, one at a time.
#[derive(Default)]
pub struct Maker {
    task: Task<Result<Prepared, Error>>,
}

impl Maker {
    /// Starts making a model from its source; a model still being made is dropped.
    pub fn start(
        &mut self,
        source: Source,
        host: Arc<PluginHost>,
        waker: Waker,
    ) -> Result<(), String> {
        self.start_with(move || source.prepare(&host), waker)
    }

    /// Starts making a model by a function; a model still being made is dropped.
    pub fn start_with(
        &mut self,
        make: impl FnOnce() -> Result<Prepared, Error> + Send + 'static,
        waker: Waker,
    ) -> Result<(), String> {
        self.task.start("endline-assemble", make, waker).map_err(|error| error.to_string())
    }

    /// Whether a model is being made.
    pub fn busy(&self) -> bool {
        self.task.busy()
    }

    /// The model, once, when it is made.
    pub fn poll(&mut self) -> Option<Result<Prepared, Error>> {
        Some(self.task.poll()?.unwrap_or_else(|Fault| {
            Err(Error::Message("making the model ended by a fault inside the program".into()))
        }))
    }
}

/// Falling further behind than this is forgotten, so that a slow stretch is not made up in a rush.
const PATIENCE: Duration = Duration::from_millis(250);

/// Which simulated time is due when.
#[derive(Clone, Copy, Debug)]
struct Pace {
    speed: f64,
    wall: Instant,
    simulated_s: f64,
}

impl Pace {
    /// From this moment on at this speed.
    fn new(speed: f64, wall: Instant, simulated_s: f64) -> Self {
        Self { speed, wall, simulated_s }
    }

    /// Simulated seconds wanted for each real one.
    fn speed(&self) -> f64 {
        self.speed
    }

    /// Time until a simulated time is due; `None` where it is due already.
    fn wait(&mut self, now: Instant, simulated_s: f64) -> Duration {
        let due = Duration::try_from_secs_f64((simulated_s - self.simulated_s) / self.speed)
            .unwrap_or_default();
        let gone = now.saturating_duration_since(self.wall);
        if gone > due + PATIENCE {
            *self = Self::new(self.speed, now, simulated_s);
        }
        due.saturating_sub(gone)
    }
}

/// A run behind a user interface: commands go in, views come out, and neither waits for the solver.
pub mod engine {
    use std::sync::Arc;

    use crate::plugins::PluginHost;
    use crate::run::RunOptions;
    use crate::source::Prepared;
    use crate::task::Waker;

    use super::{Live, LiveView, RunCommand};

    /// A run that takes commands and shows its newest view; neither waits for the solver.
    pub trait Engine {
        /// Sends a command; false where the run has ended or cannot take more.
        fn send(&self, command: RunCommand) -> bool;

        /// The newest view.
        fn latest(&self) -> Arc<LiveView>;
    }

    impl Engine for Live {
        fn send(&self, command: RunCommand) -> bool {
            Self::send(self, command)
        }

        fn latest(&self) -> Arc<LiveView> {
            Self::latest(self)
        }
    }

    /// Starts a run for a model, with these plugins.
    pub type Launch =
        Box<dyn Fn(Prepared, Arc<PluginHost>, Waker) -> Result<Box<dyn Engine>, String>>;

    /// Starts each run on a thread of its own.
    pub fn live() -> Launch {
        Box::new(|prepared, host, waker| {
            let options = RunOptions::default();
            let live = Live::open(prepared, host, options, move || waker());
            let engine: Box<dyn Engine> = Box::new(
                live.map_err(|error| format!("the run's thread cannot be started: {error}"))?,
            );
            Ok(engine)
        })
    }
}
