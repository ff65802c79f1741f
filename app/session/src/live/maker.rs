//! Models assembled on a thread of their own.

use std::sync::Arc;

use crate::error::Error;
use crate::plugins::PluginHost;
use crate::source::{Prepared, Source};
use crate::task::{Fault, Task, Waker};

/// Makes models from texts on a thread of its own, one at a time.
#[derive(Default)]
pub struct Maker {
    task: Task<Result<Prepared, Error>>,
}

impl Maker {
    /// Starts making a model from its source; a model still being made is dropped.
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

    /// Starts making a model by a function; a model still being made is dropped.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub fn start_with(
        &mut self,
        make: impl FnOnce() -> Result<Prepared, Error> + Send + 'static,
        waker: Waker,
    ) -> Result<(), String> {
        self.task.start("endline-assemble", make, waker).map_err(|error| error.to_string())
    }

    /// Whether a model is being made.
    #[must_use]
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
