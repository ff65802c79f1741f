//! A library is opened from a copy of its own, and the copy is of the bytes that were hashed.
//!
//! The system's loader gives back the library already mapped when it is asked for the same path again, so a library that was built
//! anew could not be taken in; a file that is written over while it is mapped pulls the code away under a run; and a file that is
//! opened a second time may be another one. On Linux the copy lies in sealed memory, which nobody can change or replace. Elsewhere
//! it is a file in a folder of the user's; where the system lets go of an open file, it is removed at once.

use std::path::Path;

use super::info::Refusal;

/// Does something with a copy of a file.
///
/// # Errors
/// Where no copy can be made: the file itself is never opened, for it may have changed.
pub(super) fn with_copy<T>(
    file: &Path,
    bytes: &[u8],
    work: impl FnOnce(&Path) -> T,
) -> Result<T, Refusal> {
    #[cfg(target_os = "linux")]
    if let Ok(copy) = in_memory::write(bytes) {
        return Ok(work(&in_memory::path(copy)));
    }
    on_disk::with_copy(file, bytes, work)
}

#[cfg(target_os = "linux")]
mod in_memory {
    use std::fs::File;
    use std::io::Write;
    use std::os::fd::IntoRawFd;
    use std::path::PathBuf;

    use rustix::fs::{MemfdFlags, SealFlags, fcntl_add_seals, memfd_create};

    /// The bytes in memory that can no longer be written.
    pub(super) fn write(bytes: &[u8]) -> std::io::Result<File> {
        let flags = MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING;
        let mut file = File::from(memfd_create("endline-plugin", flags)?);
        file.write_all(bytes)?;
        fcntl_add_seals(
            &file,
            SealFlags::WRITE | SealFlags::GROW | SealFlags::SHRINK | SealFlags::SEAL,
        )?;
        Ok(file)
    }

    /// The path of such bytes. They stay open, as a library stays mapped: the loader takes the same path for the same library.
    pub(super) fn path(file: File) -> PathBuf {
        PathBuf::from(format!("/proc/self/fd/{}", file.into_raw_fd()))
    }
}

mod on_disk {
    use std::fs::{self, File, OpenOptions};
    use std::io::Write;
    use std::path::{Path, PathBuf};
    use std::sync::atomic::{AtomicU64, Ordering};
    use std::time::Duration;

    use super::super::folders::copies_folder;
    use super::Refusal;

    /// Copies made by this program: each has a name that was never used.
    static COPIES: AtomicU64 = AtomicU64::new(0);

    /// Copies left by programs that ended are removed after this time.
    const LEFT_BEHIND: Duration = Duration::from_secs(24 * 3600);

    pub(super) fn with_copy<T>(
        file: &Path,
        bytes: &[u8],
        work: impl FnOnce(&Path) -> T,
    ) -> Result<T, Refusal> {
        let help =
            "a library is opened from a copy in your cache folder: set HOME, or make it writable";
        let folder = copies_folder().ok_or_else(|| {
            Refusal::new("cannot be copied, because there is no home folder", help)
        })?;
        let copy = write(file, bytes, &folder)
            .map_err(|error| Refusal::new(format!("cannot be copied: {error}"), help))?;
        let done = work(&copy);
        // Where an open file cannot be removed it is left for a later start.
        let _ = fs::remove_file(&copy);
        Ok(done)
    }

    fn write(file: &Path, bytes: &[u8], folder: &Path) -> std::io::Result<PathBuf> {
        let number = COPIES.fetch_add(1, Ordering::Relaxed);
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let copy = folder.join(format!("{}-{number}-{name}", std::process::id()));
        make_own(folder)?;
        clear(folder);
        // A copy of that name was left by a program of the same number, or is a link that somebody put there.
        let _ = fs::remove_file(&copy);
        let mut out = new_file(&copy)?;
        out.write_all(bytes)?;
        Ok(copy)
    }

    /// A folder that only its user may change.
    fn make_own(folder: &Path) -> std::io::Result<()> {
        let mut builder = fs::DirBuilder::new();
        builder.recursive(true);
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.create(folder)
    }

    fn new_file(copy: &Path) -> std::io::Result<File> {
        OpenOptions::new().write(true).create_new(true).open(copy)
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
}
