//! Results of a study read on a thread of their own, and read again while the study is at work.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::plugins::PluginHost;
use crate::task::{Fault, Task, Waker};

use super::results::{ResultsRequest, StudyResults};

/// Time between two readings of a study at work.
const AGAIN: Duration = Duration::from_secs(4);

type Answer = Result<Option<Arc<StudyResults>>, String>;

/// The results read last, and those being read.
#[derive(Default)]
pub struct ResultsReader {
    shown: Option<Arc<StudyResults>>,
    reading: Task<Answer>,
    /// Folder of the study whose progress is followed.
    folder: Option<PathBuf>,
    /// Number of blocks at the last reading, and its time.
    read: Option<(u32, Instant)>,
    /// Whether the study queued last is to be shown once it has a folder.
    pub follows_next: bool,
    /// Why nothing is shown.
    pub problem: Option<String>,
}

impl ResultsReader {
    /// The results shown.
    #[must_use]
    pub fn shown(&self) -> Option<&Arc<StudyResults>> {
        self.shown.as_ref()
    }

    /// Whether results are being read.
    #[must_use]
    pub fn busy(&self) -> bool {
        self.reading.busy()
    }

    /// The folder whose study is followed while it is at work.
    #[must_use]
    pub fn followed(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Follows the study of a folder.
    pub fn follow(&mut self, folder: PathBuf) {
        (self.folder, self.read, self.follows_next) = (Some(folder), None, false);
    }

    /// Whether it is time to read again, given the number of blocks and whether the study has ended.
    #[must_use]
    pub fn is_due(&self, blocks: u32, over: bool) -> bool {
        let fresh = self
            .read
            .is_none_or(|(before, at)| before != blocks && (over || at.elapsed() >= AGAIN));
        !self.busy() && blocks > 0 && fresh
    }

    /// Begins to read; what was being read is dropped.
    ///
    /// # Errors
    /// Where the system gives no thread.
    pub fn ask(
        &mut self,
        request: ResultsRequest,
        host: Arc<PluginHost>,
        waker: Waker,
    ) -> Result<(), String> {
        self.read = Some((request.blocks, Instant::now()));
        let work = move || {
            let read = StudyResults::read(request, &host);
            read.map(|results| results.map(Arc::new)).map_err(|error| error.to_string())
        };
        self.reading.start("endline-results", work, waker).map_err(|error| error.to_string())
    }

    /// Takes in what was read; called regularly. `None` where nothing new is there.
    pub fn take(&mut self) -> Option<Result<(), String>> {
        let answer = self.reading.poll()?.unwrap_or_else(|Fault| {
            Err("reading the results ended by a fault inside the program".into())
        });
        Some(
            answer
                .map(|shown| {
                    if let Some(shown) = shown {
                        self.folder = Some(shown.folder.clone());
                        self.shown = Some(shown);
                    }
                    self.problem = None;
                })
                .inspect_err(|error| self.problem = Some(error.clone())),
        )
    }
}
