//! Saving a file so that a crash or a full disk leaves the old one whole.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, SystemTime};

use endline_gear::read;

use crate::error::Error;

/// Writes beside the file, syncs, then renames over it.
pub fn atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    atomically_with(path, |file| file.write_all(bytes))
}

/// Writes piece by piece, beside the file, then renames over it.
pub fn atomically_with(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        sweep_once(folder);
    }
    let beside = beside(path);
    let written = write_synced(&beside, write).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        // The error that matters is the first one; a leftover we could not write is no worse.
        let _ = fs::remove_file(&beside);
    }
    written
}

/// The text of a file; none where there is no such file.
pub fn text_if_there(path: &Path) -> Result<Option<String>, Error> {
    match read::text(path) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Error::at(path, format!("cannot be read: {error}"))),
    }
}

/// Copies a file, or a folder with all that is in it.
pub(crate) fn copy_tree(from: &Path, to: &Path) -> Result<(), Error> {
    let failed = |error: io::Error| Error::at(from, format!("cannot be copied: {error}"));
    if !from.is_dir() {
        let folder = to.parent().unwrap_or(to);
        fs::create_dir_all(folder).map_err(failed)?;
        // A pipe is refused here: copying it would wait for its other end.
        read::open(from).map_err(failed)?;
        return fs::copy(from, to).map(drop).map_err(failed);
    }
    fs::create_dir_all(to).map_err(failed)?;
    for entry in fs::read_dir(from).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        copy_tree(&entry.path(), &to.join(entry.file_name()))?;
    }
    Ok(())
}

fn write_synced(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    write(&mut file)?;
    file.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()
}

/// How old a file of a save must be to have been left by a program that was killed: a save takes seconds.
const LEFT_BEHIND: Duration = Duration::from_secs(3600);

/// Removes incomplete saves of killed programs from a folder, the first time that this program saves there.
fn sweep_once(folder: &Path) {
    static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    if SWEPT.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_owned()) {
        sweep(folder, SystemTime::now());
    }
}

fn sweep(folder: &Path, now: SystemTime) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let modified = entry.metadata().and_then(|data| data.modified());
        let age = modified.ok().and_then(|modified| now.duration_since(modified).ok());
        let old = age.is_some_and(|age| age > LEFT_BEHIND);
        if old && is_part(&entry.file_name().to_string_lossy()) {
            // Another program may have removed it just now.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether a file has a name that [`beside`] gives: `.NAME.PID-NUMBER.part`.
fn is_part(name: &str) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let own = name.strip_prefix('.').and_then(|name| name.strip_suffix(".part"));
    let numbers = own.and_then(|name| name.rsplit_once('.')).map(|(_, numbers)| numbers);
    numbers
        .and_then(|numbers| numbers.split_once('-'))
        .is_some_and(|(pid, number)| digits(pid) && digits(number))
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
    use endline_gear::Document;

    use super::*;

    #[test]
    fn what_killed_programs_left_is_removed_and_nothing_else() {
        let folder = std::env::temp_dir().join(format!("endline-sweep-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let left = beside(&folder.join("block-00001.parquet"));
        let others = [".a.part", "b.1-2.part", ".c.1-x.part", ".d.1-2.parts", "block.parquet"];
        for file in others.map(|name| folder.join(name)).iter().chain([&left]) {
            fs::write(file, "half a save").unwrap();
        }
        sweep(&folder, SystemTime::now());
        assert!(left.exists(), "another program may be saving");
        sweep(&folder, SystemTime::now() + 2 * LEFT_BEHIND);
        assert!(!left.exists());
        assert!(others.iter().all(|name| folder.join(name).exists()));
        fs::remove_dir_all(&folder).unwrap();
    }

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
    fn a_save_leaves_the_whole_text_and_nothing_beside_it() {
        let folder = std::env::temp_dir().join(format!("endline-text-save-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("test.toml");
        atomically(&path, b"old").unwrap();
        let text = Document::parse("format = 1 # of the mill\n").unwrap().text();
        atomically(&path, text.as_bytes()).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        assert!(atomically(&folder.join("no/such/folder.toml"), b"x").is_err());
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_failed_save_says_so() {
        let path = std::env::temp_dir().join("endline-no-such-folder/deeper/run.endline");
        assert!(atomically(&path, b"bytes").is_err());
    }
}
