//! A run behind a user interface: commands go in, views come out, and neither waits for the solver.

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
pub type Launch = Box<dyn Fn(Prepared, Arc<PluginHost>, Waker) -> Result<Box<dyn Engine>, String>>;

/// Starts each run on a thread of its own.
pub fn live() -> Launch {
    Box::new(|prepared, host, waker| {
        let options = RunOptions::default();
        let live = Live::open(prepared, host, options, move || waker());
        let engine: Box<dyn Engine> =
            Box::new(live.map_err(|error| format!("the run's thread cannot be started: {error}"))?);
        Ok(engine)
    })
}
