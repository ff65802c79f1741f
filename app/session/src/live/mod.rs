//! A run on a thread of its own, paced to real time, for the workbench.
//!
//! The workbench sends [`RunCommand`]s and reads the [`latest`](Live::latest) [`LiveView`]; neither
//! ever waits for the solver.

mod command;
pub mod engine;
mod envelope;
mod frame_history;
mod history;
mod maker;
mod pace;
mod series;
#[cfg(test)]
mod tests;
mod worker;

use std::sync::mpsc::{SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

use endline_sdk::Controls;
use endline_sim::metrics::{Event, Summary};
use endline_sim::{Audit, Cost, Frame, Model};

pub use command::RunCommand;
pub use engine::{Engine, Launch};
pub use envelope::{Envelope, LineEnvelope};
pub use history::Channel;
pub use maker::Maker;
pub use series::{Series, Span};

use crate::plugins::PluginHost;
use crate::recording::program::Program;
use crate::run::RunOptions;
use crate::source::Prepared;

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
    /// The solver or a plugin could not go on: why.
    Stopped(String),
    /// It never started: why.
    Failed(String),
}

/// What the workbench shows: all of one moment.
#[derive(Clone)]
pub struct LiveView {
    /// The model that runs.
    pub model: Arc<Model>,
    /// The moment shown: the newest, or the one sought.
    pub frame: Arc<Frame>,
    /// Time of the newest moment [s].
    pub newest_s: f64,
    /// Whether the moment shown is an earlier one.
    pub sought: bool,
    /// What was measured up to the newest moment; `None` before the start.
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
    /// What the computing time of the run so far went to.
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
    /// What is to see before anything is settled: the gear as first guessed.
    #[must_use]
    pub fn before(prepared: &Prepared) -> Self {
        worker::first_view(prepared)
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
    ///
    /// # Errors
    /// Where the system gives no thread.
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

    /// Sends a command; false where the thread is gone or its queue is full.
    pub fn send(&self, command: RunCommand) -> bool {
        self.commands.as_ref().is_some_and(|commands| commands.try_send(command).is_ok())
    }

    /// The newest view.
    #[must_use]
    pub fn latest(&self) -> Arc<LiveView> {
        Arc::clone(&self.view.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        drop(self.commands.take());
        if let Some(thread) = self.thread.take() {
            // The thread reports its own failures in the view; there is nothing left to tell.
            let _ = thread.join();
        }
    }
}
