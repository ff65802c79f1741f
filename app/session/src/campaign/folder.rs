//! The folder of results of a campaign, with a label in JSON that says to which campaign it belongs.

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
