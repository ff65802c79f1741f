//! Saving a file in one move.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};

/// Saves so far.
static SAVES: AtomicU32 = AtomicU32::new(0);

/// Saves a text in one move: writes beside, syncs, renames.
///
/// # Errors
/// Where the folder or the file cannot be written.
pub fn save_text(path: &Path, text: &str) -> io::Result<()> {
    let name = path
        .file_name()
        .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "not the name of a file"))?;
    // The process id keeps two programs apart, and the number two saves of one program.
    let number = SAVES.fetch_add(1, Ordering::Relaxed);
    let own = format!(".{}.{}-{number}.saving", name.to_string_lossy(), std::process::id());
    let beside = path.with_file_name(own);
    let written = write_synced(&beside, text).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        let _ = fs::remove_file(&beside);
    }
    written
}

fn write_synced(path: &Path, text: &str) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(text.as_bytes())?;
    file.sync_all()
}
