//! Studies in the window: their queue, and the results shown.

use std::path::PathBuf;

use endline_session::study::ResultsReader;
use endline_session::study::queue::Queue;

/// What the panels of studies share.
#[derive(Default)]
pub struct Studies {
    /// Studies waiting, at work, and done, in the order they were queued.
    pub queue: Queue,
    /// The results shown.
    pub results: ResultsReader,
    /// Folder that results are kept in; `results` where the program was started, without one.
    pub folder: Option<PathBuf>,
    /// The library's scenarios when the study was opened: id twice, as choices want it.
    pub scenarios: Vec<(String, String)>,
}

impl Studies {
    /// Folder that results are kept in.
    #[must_use]
    pub fn root(&self) -> PathBuf {
        self.folder.clone().unwrap_or_else(|| PathBuf::from("results"))
    }
}
