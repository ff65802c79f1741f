//! Runs kept as recordings, and recordings run again.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

use endline_sim::Frame;

use super::Workbench;
use super::model::Then;
use super::notice::{Event, Notice};
use crate::error::Error;
use crate::live::RunCommand;
use crate::recording::Recording;
use crate::recording::kept::{self, Kept};

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
        let Some(view) = self.view() else { return };
        let of = self.guest().map_or(stem, str::to_owned);
        let known = Kept::of_run(of, view.newest_s, view.summary.as_ref());
        if self.send(RunCommand::SaveRecording(path.clone())).is_ok() {
            self.run.kept_changes += 1;
            if let Err(error) = known.save(&path) {
                self.notice = Some(Notice::fault(error.to_string()));
            }
            self.events.push(Event::RunKept(path));
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

    /// Asks for the moments of the run that are kept, which come without waiting for them here.
    /// Errors: where there is no run.
    pub fn kept_frames(&self) -> Result<Receiver<Vec<Arc<Frame>>>, String> {
        let (sender, receiver) = channel();
        self.send(RunCommand::KeptFrames(sender))?;
        Ok(receiver)
    }

    /// Times that kept runs came, went or changed since the start: what lists them reads them again.
    pub fn recordings_version(&self) -> u64 {
        self.run.kept_changes
    }

    /// Tells whoever lists kept runs that something about them has changed.
    pub fn recordings_changed(&mut self) {
        self.run.kept_changes += 1;
    }

    pub(crate) fn rename_recording(&mut self, file: &Path, name: &str) -> Result<(), String> {
        self.change_kept(kept::rename(file, name).map(drop))
    }

    pub(crate) fn note_recording(&mut self, file: &Path, note: String) -> Result<(), String> {
        let known = Kept::beside(file).unwrap_or_default();
        self.change_kept(Kept { note, ..known }.save(file))
    }

    pub(crate) fn delete_recording(&mut self, file: &Path) -> Result<(), String> {
        let moved = kept::delete(file);
        if let Ok(to) = &moved {
            self.notice = Some(Notice::done(format!("moved to {}", to.display())));
        }
        self.change_kept(moved.map(drop))
    }

    fn change_kept(&mut self, changed: Result<(), Error>) -> Result<(), String> {
        self.run.kept_changes += 1;
        changed.map_err(|error| error.to_string())
    }

    pub(crate) fn save_recording(&mut self, file: PathBuf) -> Result<(), String> {
        self.send(RunCommand::SaveRecording(file))
    }

    /// Makes the model of a recording; its inputs are run once it is there.
    pub(crate) fn open_recording(&mut self, file: &Path) -> Result<(), String> {
        let recording = Recording::load(file).map_err(|error| error.to_string())?;
        let (source, host) = (recording.source, Arc::clone(&self.plugins.host));
        let then = Then::Inputs(recording.inputs, recording.header.plugins);
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        self.make_guest(format!("recording {name}"), then, move || source.prepare(&host))
    }
}
