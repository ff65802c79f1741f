//! Saving a file so that a crash or a full disk leaves the old one whole.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use crate::error::Error;

/// Writes beside the file, syncs, then renames over it.
///
/// # Errors
/// Where the folder cannot be written; the old file is then untouched.
pub fn atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let beside = beside(path);
    let written = write_synced(&beside, bytes).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        // The error that matters is the first one; a leftover we could not write is no worse.
        let _ = fs::remove_file(&beside);
    }
    written
}

/// The text of a file; none where there is no such file.
///
/// # Errors
/// A file that is there and cannot be read: whoever took it for missing would write over it.
pub fn text_if_there(path: &Path) -> Result<Option<String>, Error> {
    match fs::read_to_string(path) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Error::at(path, format!("cannot be read: {error}"))),
    }
}

/// Copies a file, or a folder with all that is in it.
///
/// # Errors
/// What cannot be read or written, by its path.
pub(crate) fn copy_tree(from: &Path, to: &Path) -> Result<(), Error> {
    let failed = |error: io::Error| Error::at(from, format!("cannot be copied: {error}"));
    if !from.is_dir() {
        let folder = to.parent().unwrap_or(to);
        fs::create_dir_all(folder).map_err(failed)?;
        return fs::copy(from, to).map(drop).map_err(failed);
    }
    fs::create_dir_all(to).map_err(failed)?;
    for entry in fs::read_dir(from).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        copy_tree(&entry.path(), &to.join(entry.file_name()))?;
    }
    Ok(())
}

fn write_synced(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// A name in the same folder, so that the rename stays on one disk. The process id keeps two programs apart, and the number two
/// saves of one program.
fn beside(path: &Path) -> PathBuf {
    static SAVES: AtomicU32 = AtomicU32::new(0);
    let number = SAVES.fetch_add(1, Ordering::Relaxed);
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!(".{name}.{}-{number}.part", std::process::id()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_save_replaces_the_file_and_leaves_nothing_beside_it() {
        let folder = std::env::temp_dir().join(format!("endline-save-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("run.endline");
        atomically(&path, b"first").unwrap();
        atomically(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_failed_save_says_so() {
        let path = std::env::temp_dir().join("endline-no-such-folder/deeper/run.endline");
        assert!(atomically(&path, b"bytes").is_err());
    }
}
