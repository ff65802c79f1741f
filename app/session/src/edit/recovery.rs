//! Unsaved edits written to a file every few seconds, and offered back after a crash.
//!
//! Each running program has a file of its own, `recovery-NAME.json`, and holds a lock on `recovery-NAME.lock` beside it for as
//! long as it runs. A file whose lock is free was left by a crash. Numbers of processes would not tell: a container gives
//! the same ones again.

use std::collections::BTreeMap;
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::thread::JoinHandle;

use crate::save::atomically;
use serde::{Deserialize, Serialize};

use super::documents::Documents;

/// Time between two writings of the unsaved edits [s].
pub const EVERY_S: f64 = 5.0;

/// Unsaved texts of a session.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct UnsavedEdits {
    /// Folder of the library.
    pub root: PathBuf,
    /// The scenario's file.
    pub scenario: PathBuf,
    /// The study's file, where one was open.
    #[serde(default)]
    pub study: Option<PathBuf>,
    /// The observation's file, where one was open.
    #[serde(default)]
    pub observation: Option<PathBuf>,
    /// Texts that differ from their files, by path; `None` for a file that was removed.
    pub texts: BTreeMap<String, Option<String>>,
}

/// Writes the unsaved edits of this program to a file in a folder.
#[derive(Debug, Default)]
pub struct Autosave {
    folder: Option<PathBuf>,
    /// What was written last.
    kept: Option<Kept>,
    writing: Option<JoinHandle<()>>,
    /// This program's file, with the lock that says so; taken when there is something to write first.
    own: Option<(PathBuf, File)>,
}

/// What was written of the edits: texts of this version, of these files, at this time [s].
#[derive(Debug)]
struct Kept {
    version: u64,
    unsaved: Vec<String>,
    at_s: f64,
}

impl Kept {
    /// Whether the documents hold no other edits by now. Saving changes no text, but which of them are edits.
    fn is_of(&self, documents: &Documents) -> bool {
        self.version == documents.version() && self.unsaved == documents.unsaved()
    }
}

impl Autosave {
    /// Writes to a folder.
    pub fn in_folder(folder: PathBuf) -> Self {
        Self { folder: Some(folder), ..Self::default() }
    }

    /// This program's file: one that no other program has or has left behind.
    fn file(&mut self) -> Option<PathBuf> {
        if self.own.is_none() {
            let folder = self.folder.as_ref()?;
            // Where the folder cannot be made, saving by hand reports the reason.
            std::fs::create_dir_all(folder).ok()?;
            let pid = std::process::id();
            let names = (0..100).map(|number| match number {
                0 => folder.join(format!("recovery-{pid}.json")),
                number => folder.join(format!("recovery-{pid}-{number}.json")),
            });
            self.own = names
                .filter(|file| !file.exists())
                .find_map(|file| Some((file.clone(), lock(&file, true)?)));
        }
        self.own.as_ref().map(|(file, _)| file.clone())
    }

    /// Writes the edits where they changed and enough time has passed. Returns the time after which
    /// to call again [s]; `None` where nothing is left to write.
    pub fn keep(&mut self, documents: &Documents, now_s: f64) -> Option<f64> {
        self.folder.as_ref()?;
        let at_s = match &self.kept {
            Some(kept) if kept.is_of(documents) => return None,
            Some(kept) => kept.at_s,
            None => f64::NEG_INFINITY,
        };
        let busy = self.writing.as_ref().is_some_and(|writing| !writing.is_finished());
        if busy || now_s - at_s < EVERY_S {
            return Some((EVERY_S - (now_s - at_s)).clamp(0.1, EVERY_S));
        }
        let unsaved = documents.unsaved();
        self.kept =
            Some(Kept { version: documents.version(), unsaved: unsaved.to_vec(), at_s: now_s });
        if unsaved.is_empty() {
            self.clear();
            return None;
        }
        let file = self.file()?;
        let texts = unsaved
            .iter()
            .map(|path| (path.clone(), documents.text(path).map(str::to_owned)))
            .collect();
        let kept = UnsavedEdits {
            root: documents.root().to_owned(),
            scenario: documents.scenario_path().to_owned(),
            study: documents.study_path().map(Path::to_owned),
            observation: documents.observation_path().map(Path::to_owned),
            texts,
        };
        let write = move || {
            // Where this file cannot be written, saving by hand reports the reason.
            let _ = serde_json::to_vec(&kept).map(|bytes| atomically(&file, &bytes));
        };
        self.writing = std::thread::Builder::new().name("endline-keep".into()).spawn(write).ok();
        None
    }

    /// Waits until what is being written is on the disk.
    pub fn finish(&mut self) {
        if let Some(writing) = self.writing.take() {
            // The thread writes one file and ends.
            let _ = writing.join();
        }
    }

    /// Removes this program's file: its edits are saved, or given up.
    pub fn clear(&mut self) {
        self.finish();
        if let Some((file, _)) = self.own.take() {
            forget(&file);
        }
    }

    /// Edits that crashed programs left, the newest first, with their files.
    pub fn left_behind(&self) -> Vec<(PathBuf, UnsavedEdits)> {
        let Some(folder) = &self.folder else { return Vec::new() };
        let files =
            std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
        let mut left: Vec<PathBuf> = files.filter(|file| is_one(file) && !is_held(file)).collect();
        left.sort_by_key(|file| {
            std::cmp::Reverse(std::fs::metadata(file).and_then(|data| data.modified()).ok())
        });
        let read = |file: PathBuf| {
            let kept = endline_gear::read::bytes(&file)
                .ok()
                .and_then(|bytes| serde_json::from_slice::<UnsavedEdits>(&bytes).ok())?;
            Some((file, kept))
        };
        left.into_iter().filter_map(read).collect()
    }
}

/// Removes a file of unsaved edits, with its lock.
pub fn forget(file: &Path) {
    // A file that is gone already needs no removing.
    let _ = std::fs::remove_file(file);
    let _ = std::fs::remove_file(file.with_extension("lock"));
}

fn is_one(file: &Path) -> bool {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with("recovery-") && name.ends_with(".json")
}

/// The lock of a file of unsaved edits; `None` where another program holds it, or where it is not there and is not wanted.
fn lock(file: &Path, wanted: bool) -> Option<File> {
    let lock = File::options().write(true).create(wanted).open(file.with_extension("lock")).ok()?;
    // A file system without locks cannot tell; then the file is this program's.
    (!matches!(lock.try_lock(), Err(TryLockError::WouldBlock))).then_some(lock)
}

/// Whether a program that runs holds the lock of a file.
fn is_held(file: &Path) -> bool {
    file.with_extension("lock").exists() && lock(file, false).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_with_a_free_lock_were_left_behind() {
        let folder = std::env::temp_dir().join(format!("endline-recovery-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let kept = UnsavedEdits { root: "root".into(), ..UnsavedEdits::default() };
        let bytes = serde_json::to_vec(&kept).unwrap();
        let autosave = || Autosave::in_folder(folder.clone());

        // Two windows of one program, or of two with one number, have a file each; neither is offered to the other.
        let (mut one, mut other) = (autosave(), autosave());
        let files = [one.file().unwrap(), other.file().unwrap()];
        assert_ne!(files[0], files[1]);
        for file in &files {
            std::fs::write(file, &bytes).unwrap();
        }
        assert_eq!(autosave().left_behind(), []);

        // One ends as by a crash; a program of the same number offers its file, and takes another for its own.
        drop(one);
        std::fs::write(folder.join("recovery-9.json"), "half a fi").unwrap();
        let mut next = autosave();
        assert_eq!(next.left_behind(), [(files[0].clone(), kept)]);
        let own = next.file().unwrap();
        assert!(!files.contains(&own), "{own:?}");

        forget(&files[0]);
        other.clear();
        next.clear();
        assert_eq!(autosave().left_behind(), []);
        let rest: Vec<_> = std::fs::read_dir(&folder).unwrap().flatten().collect();
        assert_eq!(rest.len(), 1, "only what is no file of edits stays: {rest:?}");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn edits_that_were_saved_are_kept_no_longer() {
        let root = std::env::temp_dir().join(format!("endline-saved-{}", std::process::id()));
        std::fs::create_dir_all(root.join("ropes")).unwrap();
        let [rope, scenario] = ["ropes/rope.toml", "one.toml"].map(|name| root.join(name));
        std::fs::write(rope, "name = \"rope\"\n").unwrap();
        std::fs::write(&scenario, "name = \"one\"\n").unwrap();
        let mut documents = Documents::open(&root, &scenario).unwrap();
        let mut autosave = Autosave::in_folder(root.join("data"));
        let left = || Autosave::in_folder(root.join("data")).left_behind().len();
        documents.set("ropes/rope.toml", "name", "another").unwrap();
        autosave.keep(&documents, 0.0);
        autosave.finish();
        let is_kept = || root.join("data").read_dir().unwrap().count();
        assert_eq!((is_kept(), left()), (2, 0), "a file and its lock, which this program holds");
        documents.save().unwrap();
        autosave.keep(&documents, EVERY_S);
        assert_eq!(is_kept(), 0, "a crash now would offer what is on the disk already");
        std::fs::remove_dir_all(&root).unwrap();
    }
}
