//! Runs kept as recordings, and recordings run again.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Workbench;
use super::model::Then;
use crate::live::RunCommand;
use crate::recording::Recording;

/// Shortest run that is kept [s].
const WORTH_KEEPING_S: f64 = 0.5;

impl Workbench {
    /// Keeps the run shown in the folder of recordings, once.
    pub(super) fn keep_run(&mut self) {
        let newest_s = self.view().map_or(0.0, |view| view.newest_s);
        let wanted = !self.run.is_kept && newest_s >= WORTH_KEEPING_S;
        let Some(folder) = self.recordings.clone().filter(|_| wanted) else { return };
        self.run.is_kept = true;
        let stem = self.scenario_stem();
        let named = |number: u32| folder.join(format!("{stem} {number:04}.endline"));
        let Some(path) = (1..10_000).map(named).find(|path| !path.exists()) else { return };
        // Where the folder cannot be made, saving reports it.
        let _ = std::fs::create_dir_all(&folder);
        if self.send(RunCommand::SaveRecording(path)).is_ok() {
            self.run.kept += 1;
        }
    }

    /// Keeps a run that is over; one that has begun anew is not kept yet.
    pub(super) fn keep_finished_run(&mut self) {
        if self.view().is_some_and(|view| view.newest_s < WORTH_KEEPING_S) {
            self.run.is_kept = false;
        }
        if self.is_over() {
            self.keep_run();
        }
    }

    /// Runs kept since the start.
    #[must_use]
    pub fn kept_runs(&self) -> u64 {
        self.run.kept
    }

    pub(crate) fn save_recording(&mut self, file: PathBuf) -> Result<(), String> {
        self.send(RunCommand::SaveRecording(file))
    }

    /// Makes the model of a recording; its inputs are run once it is there.
    pub(crate) fn open_recording(&mut self, file: &Path) -> Result<(), String> {
        let recording = Recording::load(file).map_err(|error| error.to_string())?;
        let (source, host) = (recording.source, Arc::clone(&self.plugins.host));
        let then = Then::Inputs(recording.inputs, recording.header.plugins);
        self.make_guest(then, move || source.prepare(&host))
    }
}
