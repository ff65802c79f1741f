//! A library is opened from a copy of its own name.
//!
//! The system's loader gives back the library already mapped when it is asked for the same path again, so a library that was built
//! anew could not be taken in; and a file that is written over while it is mapped pulls the code away under a run. A copy has
//! neither fault, and what is opened is what was hashed. Where the system lets go of an open file, the copy is removed at once.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// Copies made by this program: each has a name that was never used.
static COPIES: AtomicU64 = AtomicU64::new(0);

/// Copies left by programs that ended are removed after this time.
const LEFT_BEHIND: Duration = Duration::from_secs(24 * 3600);

/// Does something with a copy of a file, and removes it where the system allows; with the file itself where none can be made.
pub(super) fn with_copy<T>(
    file: &Path,
    bytes: &[u8],
    folder: &Path,
    work: impl FnOnce(&Path) -> T,
) -> T {
    let Some(copy) = write(file, bytes, folder) else { return work(file) };
    let done = work(&copy);
    // Where an open file cannot be removed it is left for a later start.
    let _ = fs::remove_file(&copy);
    done
}

fn write(file: &Path, bytes: &[u8], folder: &Path) -> Option<PathBuf> {
    let number = COPIES.fetch_add(1, Ordering::Relaxed);
    let copy = folder.join(format!(
        "{}-{number}-{}",
        std::process::id(),
        file.file_name()?.to_string_lossy()
    ));
    fs::create_dir_all(folder).ok()?;
    clear(folder);
    fs::write(&copy, bytes).ok()?;
    Some(copy)
}

/// Removes what earlier programs could not.
fn clear(folder: &Path) {
    let old = |path: &Path| {
        fs::metadata(path)
            .and_then(|about| about.modified())
            .is_ok_and(|at| at.elapsed().is_ok_and(|age| age > LEFT_BEHIND))
    };
    for path in fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| old(path))
    {
        // One still in use stays.
        let _ = fs::remove_file(path);
    }
}
