//! The run behind the workbench: commands in, views out, never waited for.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use endline_session::live::{Live, LiveView, RunCommand};
use endline_session::{Error, PluginHost, Prepared, RunOptions, Source};

/// Speeds offered, simulated over real time; the last is as fast as it goes.
pub const SPEEDS: [(f64, &str); 6] =
    [(0.1, "0.1×"), (0.25, "¼×"), (1.0, "1×"), (2.0, "2×"), (5.0, "5×"), (f64::INFINITY, "max")];

/// A run that takes commands and shows its newest view; neither waits for the solver.
pub trait Engine {
    /// Sends a command; false where the run is gone or cannot take more.
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

/// Called whenever there is something new to draw; may come from any thread.
pub type Waker = Arc<dyn Fn() + Send + Sync>;

/// Starts a run for a model, with these plugins.
pub type Launch = Box<dyn Fn(Prepared, Arc<PluginHost>, Waker) -> Result<Box<dyn Engine>, String>>;

/// Runs on a thread of their own.
#[must_use]
pub fn live() -> Launch {
    Box::new(|prepared, host, waker| {
        let options = RunOptions::default();
        let live = Live::open(prepared, host, options, move || waker());
        let engine: Box<dyn Engine> =
            Box::new(live.map_err(|error| format!("the run's thread cannot be started: {error}"))?);
        Ok(engine)
    })
}

/// Makes models from texts on a thread of its own, one at a time.
#[derive(Default)]
pub struct Maker {
    pending: Option<Receiver<Result<Prepared, Error>>>,
}

impl Maker {
    /// Starts making a model; one still in the making is dropped.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub fn start(
        &mut self,
        source: Source,
        host: Arc<PluginHost>,
        waker: Waker,
    ) -> Result<(), String> {
        self.start_with(move || source.prepare(&host), waker)
    }

    /// The same by any way of making one.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub fn start_with(
        &mut self,
        make: impl FnOnce() -> Result<Prepared, Error> + Send + 'static,
        waker: Waker,
    ) -> Result<(), String> {
        let (sender, receiver) = channel();
        let work = move || {
            // Nobody waits any more where the receiver is gone.
            let _ = sender.send(make());
            waker();
        };
        std::thread::Builder::new()
            .name("endline-assemble".into())
            .spawn(work)
            .map_err(|error| error.to_string())?;
        self.pending = Some(receiver);
        Ok(())
    }

    /// Whether a model is in the making.
    #[must_use]
    pub fn busy(&self) -> bool {
        self.pending.is_some()
    }

    /// The model, once, when it is made.
    pub fn poll(&mut self) -> Option<Result<Prepared, Error>> {
        let answer = match self.pending.as_ref()?.try_recv() {
            Ok(answer) => answer,
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => {
                Err(Error::Replay("making the model ended by a fault inside the program".into()))
            }
        };
        self.pending = None;
        Some(answer)
    }
}
