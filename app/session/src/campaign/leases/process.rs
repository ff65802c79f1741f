//! A process at work, as other processes on the same folder see it: a file that it locks, and writes repeatedly while it works.

use std::fs::{self, File, TryLockError};
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, SystemTime};

use endline_gear::read;
use serde::{Deserialize, Serialize};

/// Prefix of the names of these files.
const PREFIX: &str = "process-";

/// Interval of a working process's beats.
pub(super) const BEAT: Duration = Duration::from_secs(20);

/// Silence after which a process counts as ended. Clients of a network file system may see times that are a minute old.
pub(super) const SILENCE: Duration = Duration::from_secs(180);

/// Where a process runs.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Place {
    /// Name of the machine.
    pub(super) machine: String,
    /// The kernel's id of this start of the machine, empty if unknown. Locks are visible to processes of the same start.
    pub(super) boot: String,
    /// The machine's number of the process.
    pub(super) pid: u32,
}

impl Place {
    /// Where this process runs.
    pub(super) fn here() -> Self {
        let boot = read::text(Path::new("/proc/sys/kernel/random/boot_id")).unwrap_or_default();
        Self { machine: machine(), boot: boot.trim().to_owned(), pid: std::process::id() }
    }
}

#[cfg(unix)]
fn machine() -> String {
    rustix::system::uname().nodename().to_string_lossy().into_owned()
}

#[cfg(not(unix))]
fn machine() -> String {
    std::env::var("COMPUTERNAME").unwrap_or_default()
}

/// A process at work.
#[derive(Debug)]
pub(super) struct Process {
    /// A unique id, since process numbers are reused.
    pub(super) id: String,
    place: Place,
    pub(super) path: PathBuf,
    /// Locked as long as it is open.
    pub(super) file: Mutex<File>,
}

impl Process {
    /// Makes the file of a process in a folder.
    pub(super) fn begin(folder: &Path, place: Place) -> io::Result<Self> {
        let id = format!("{:016x}", RandomState::new().build_hasher().finish());
        let path = path_of(folder, &id);
        let mut file = File::options().write(true).create_new(true).open(&path)?;
        // On a file system without locks, only silence shows that a process has ended.
        let _ = file.try_lock();
        file.write_all(serde_json::to_string(&place)?.as_bytes())?;
        file.write_all(b"\n")?;
        Ok(Self { id, place, path, file: Mutex::new(file) })
    }

    /// Shows that it works. The last byte is written again, so that the time is that of the file's own machine.
    pub(super) fn beat(&self) -> io::Result<()> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::End(-1))?;
        file.write_all(b"\n")?;
        file.sync_all()
    }

    /// Whether another process has ended: its file is removed, its lock is free, or it has been silent for too long.
    /// Errors: a file that cannot be read.
    pub(super) fn has_ended(&self, other: &str) -> io::Result<bool> {
        let path = path_of(self.path.parent().unwrap_or(Path::new(".")), other);
        let file = match ProcessFile::of(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(true),
            file => file?,
        };
        let now = fs::metadata(&self.path)?.modified()?;
        Ok(file.silent(now) > SILENCE || file.has_left(&self.place))
    }

    /// Removes its file.
    pub(super) fn end(&self) {
        // One that cannot be removed falls silent.
        let _ = fs::remove_file(&self.path);
    }
}

fn path_of(folder: &Path, id: &str) -> PathBuf {
    folder.join(format!("{PREFIX}{id}"))
}

/// The file of a process.
pub(super) struct ProcessFile {
    pub(super) place: Place,
    modified: SystemTime,
    file: File,
}

impl ProcessFile {
    /// Reads the file of a process.
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        let file = read::open(path)?;
        let modified = file.metadata()?.modified()?;
        // One that is being written is that of a process at work; so is one that cannot be read, as some systems lock files against
        // readers too.
        let text = io::read_to_string(&file).unwrap_or_default();
        let place = serde_json::from_str(&text).unwrap_or_default();
        Ok(Self { place, modified, file })
    }

    /// All of a folder, by the ids of their processes.
    pub(super) fn all(folder: &Path) -> io::Result<Vec<(String, Self)>> {
        let mut all = Vec::new();
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            if let Some(id) = entry.file_name().to_string_lossy().strip_prefix(PREFIX)
                && let Ok(file) = Self::of(&entry.path())
            {
                all.push((id.to_owned(), file));
            }
        }
        Ok(all)
    }

    /// How long it has been silent at a moment.
    pub(super) fn silent(&self, now: SystemTime) -> Duration {
        now.duration_since(self.modified).unwrap_or_default()
    }

    /// Whether it ran on this start of this machine, and runs no more.
    pub(super) fn has_left(&self, here: &Place) -> bool {
        let same_machine = !here.boot.is_empty() && here.boot == self.place.boot;
        same_machine && !matches!(self.file.try_lock_shared(), Err(TryLockError::WouldBlock))
    }
}
