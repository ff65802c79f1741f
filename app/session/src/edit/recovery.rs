//! Unsaved edits written to a file every few seconds, and offered back after a crash.
//!
//! Each running program has a file of its own. A file whose program no longer runs was left by a
//! crash.

use std::collections::BTreeMap;
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
    /// Version of the texts written last, and the time of writing [s].
    kept: Option<(u64, f64)>,
    writing: Option<JoinHandle<()>>,
}

impl Autosave {
    /// Writes to a folder.
    #[must_use]
    pub fn in_folder(folder: PathBuf) -> Self {
        Self { folder: Some(folder), ..Self::default() }
    }

    fn file(&self) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(name_of(std::process::id())))
    }

    /// Writes the edits where they changed and enough time has passed. Returns the time after which
    /// to call again [s]; `None` where nothing is left to write.
    pub fn keep(&mut self, documents: &Documents, now_s: f64) -> Option<f64> {
        let file = self.file()?;
        let (version, at_s) = self.kept.unwrap_or((0, f64::NEG_INFINITY));
        if version == documents.version() {
            return None;
        }
        let busy = self.writing.as_ref().is_some_and(|writing| !writing.is_finished());
        if busy || now_s - at_s < EVERY_S {
            return Some((EVERY_S - (now_s - at_s)).clamp(0.1, EVERY_S));
        }
        self.kept = Some((documents.version(), now_s));
        let unsaved = documents.unsaved();
        if unsaved.is_empty() {
            // A file that does not exist needs no removing.
            let _ = std::fs::remove_file(file);
            return None;
        }
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
            let _ = file.parent().map(std::fs::create_dir_all);
            let _ = serde_json::to_vec(&kept).map(|bytes| atomically(&file, &bytes));
        };
        self.writing = std::thread::Builder::new().name("endline-keep".into()).spawn(write).ok();
        None
    }

    /// Removes this program's file: its edits are saved, or given up.
    pub fn clear(&mut self) {
        if let Some(writing) = self.writing.take() {
            // The thread writes one file and ends.
            let _ = writing.join();
        }
        if let Some(file) = self.file() {
            let _ = std::fs::remove_file(file);
        }
    }

    /// Edits that crashed programs left, the newest first, with their files.
    #[must_use]
    pub fn left_behind(&self) -> Vec<(PathBuf, UnsavedEdits)> {
        let Some(folder) = &self.folder else { return Vec::new() };
        let files =
            std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
        let mut left: Vec<PathBuf> =
            files.filter(|file| pid_of(file).is_some_and(|pid| !runs(pid))).collect();
        left.sort_by_key(|file| {
            std::cmp::Reverse(std::fs::metadata(file).and_then(|data| data.modified()).ok())
        });
        let read = |file: PathBuf| {
            let kept = std::fs::read(&file)
                .ok()
                .and_then(|bytes| serde_json::from_slice::<UnsavedEdits>(&bytes).ok())?;
            Some((file, kept))
        };
        left.into_iter().filter_map(read).collect()
    }
}

fn name_of(pid: u32) -> String {
    format!("recovery-{pid}.json")
}

fn pid_of(file: &Path) -> Option<u32> {
    file.file_name()?.to_str()?.strip_prefix("recovery-")?.strip_suffix(".json")?.parse().ok()
}

/// Whether a process of this number runs. Where the system does not say, the answer is no.
fn runs(pid: u32) -> bool {
    pid == std::process::id() || Path::new("/proc").join(pid.to_string()).exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_of_programs_that_run_no_more_were_left_behind() {
        let folder = std::env::temp_dir().join(format!("endline-recovery-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let kept = UnsavedEdits { root: "root".into(), ..UnsavedEdits::default() };
        let bytes = serde_json::to_vec(&kept).unwrap();
        // Process numbers stay below 2^22 on Linux.
        for name in [name_of(std::process::id()), name_of(u32::MAX), "recovery-x.json".to_owned()] {
            std::fs::write(folder.join(name), &bytes).unwrap();
        }
        std::fs::write(folder.join(name_of(u32::MAX - 1)), "half a fi").unwrap();
        let left = Autosave::in_folder(folder.clone()).left_behind();
        assert_eq!(left, [(folder.join(name_of(u32::MAX)), kept)]);
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
