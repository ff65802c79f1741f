//! Campaigns: long work that is divided into numbered runs, stored as it advances and resumed after an interruption. Studies and
//! searches are campaigns.
//!
//! | file | content |
//! |---|---|
//! | `control` | pause, cancellation and progress, from any thread |
//! | `pool` | the threads that run the work, their number and priority; the part of the work that one of several machines does |
//! | `leases` | which process runs which block, for processes that share a folder |
//! | `folder` | the folder of results, and the label that says to which campaign it belongs |
//! | `job` | a campaign behind a window |

pub mod control;
pub mod job;
pub(crate) mod leases;
pub mod pool;

pub use control::{ContactTime, Control, Count, Pace, Progress};
pub use job::{Job, State};
pub use leases::{Worker, workers};
pub use pool::Shard;

/// The folder of results of a campaign, with a label in JSON that says to which campaign it belongs.
pub(crate) mod folder {
    use std::fs;
    use std::path::{Path, PathBuf};

    use serde::Serialize;
    use serde::de::DeserializeOwned;

    use crate::error::Error;
    use crate::save;

    /// The folder of a campaign under a root: its id and the head of its hash.
    pub(crate) fn path_under(root: &Path, id: &str, hash: &str) -> PathBuf {
        root.join(format!("{id}-{}", hash.get(..8).unwrap_or(hash)))
    }

    /// Makes a folder unless it exists.
    pub(crate) fn make(path: &Path) -> Result<(), Error> {
        fs::create_dir_all(path).map_err(Error::on(path, "cannot be made"))
    }

    /// The label in a file; `None` if there is no file.
    pub(crate) fn read_label<L: DeserializeOwned>(file: &Path) -> Result<Option<L>, Error> {
        let Some(text) = save::text_if_there(file)? else { return Ok(None) };
        let label = serde_json::from_str(&text);
        label.map(Some).map_err(Error::on(file, "is damaged"))
    }

    /// Writes a label.
    pub(crate) fn write_label(file: &Path, label: &impl Serialize) -> Result<(), Error> {
        let text = serde_json::to_string_pretty(label).unwrap_or_default() + "\n";
        save::atomically(file, text.as_bytes()).map_err(Error::on(file, "cannot be written"))
    }
}
