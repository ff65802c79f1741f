//! The results shown: read and counted on a thread of their own, again and again while a study is at work.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::plugins::PluginHost;
use crate::study::{ResultsRequest, StudyResults};
use crate::task::{Fault, Task, Waker};

/// Time between two countings of a study at work.
const AGAIN: Duration = Duration::from_secs(4);

type Answer = Result<Option<Arc<StudyResults>>, String>;

/// The results shown, and those being read.
#[derive(Default)]
pub struct Results {
    shown: Option<Arc<StudyResults>>,
    reading: Task<Answer>,
    /// Folder of the study whose progress is followed.
    folder: Option<PathBuf>,
    /// Blocks when they were last read, and when that was.
    read: Option<(u32, Instant)>,
    /// Whether the study queued last is to be shown once it has a folder.
    pub(super) follows_next: bool,
    /// Why nothing is shown.
    pub problem: Option<String>,
    /// The run replayed last: option's place, encounter.
    pub replayed: Option<(usize, u32)>,
}

impl Results {
    /// The results shown.
    #[must_use]
    pub fn shown(&self) -> Option<&Arc<StudyResults>> {
        self.shown.as_ref()
    }

    /// Whether some are being read.
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
    pub(super) fn follow(&mut self, folder: PathBuf) {
        (self.folder, self.read, self.follows_next) = (Some(folder), None, false);
    }

    /// Whether it is time to read again, with so many blocks there.
    pub(super) fn is_due(&self, blocks: u32, over: bool) -> bool {
        let fresh = self
            .read
            .is_none_or(|(before, at)| before != blocks && (over || at.elapsed() >= AGAIN));
        !self.busy() && blocks > 0 && fresh
    }

    /// Begins to read; what was being read is dropped.
    pub(super) fn ask(
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

    /// Takes in what was read.
    pub(super) fn take(&mut self) -> Option<Result<(), String>> {
        let answer = self.reading.poll()?.unwrap_or_else(|Fault| {
            Err("reading the results ended by a fault inside the program".into())
        });
        self.problem = answer.as_ref().err().cloned();
        Some(answer.map(|shown| shown.into_iter().for_each(|shown| self.show(shown))))
    }

    fn show(&mut self, shown: Arc<StudyResults>) {
        self.folder = Some(shown.folder.clone());
        let hash = |results: &Arc<StudyResults>| results.opened.hash.clone();
        if self.shown.as_ref().map(hash) != Some(hash(&shown)) {
            self.replayed = None;
        }
        self.shown = Some(shown);
    }
}
