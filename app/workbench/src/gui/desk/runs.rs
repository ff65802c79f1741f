//! Runs kept by themselves and opened again; edits taken back from a crash.

use std::sync::Arc;

use endline_session::edit::Documents;
use endline_session::edit::recovery::UnsavedEdits;
use endline_session::live::RunCommand;

use super::Desk;

/// Shortest run that is worth keeping [s].
pub(super) const WORTH_KEEPING_S: f64 = 0.5;

impl Desk {
    /// Keeps the run shown in the folder of recordings, once.
    pub(super) fn keep_run(&mut self) {
        let newest_s = self.view.as_ref().map_or(0.0, |view| view.newest_s);
        let Some(folder) =
            self.recordings.clone().filter(|_| !self.run_is_kept && newest_s >= WORTH_KEEPING_S)
        else {
            return;
        };
        self.run_is_kept = true;
        let stem = self
            .documents
            .scenario_path()
            .file_stem()
            .map(|stem| stem.to_string_lossy().into_owned())
            .unwrap_or_default();
        let named = |number: u32| folder.join(format!("{stem} {number:04}.endline"));
        let Some(path) = (1..10_000).map(named).find(|path| !path.exists()) else { return };
        // Where there is no folder, saving says so.
        let _ = std::fs::create_dir_all(&folder);
        if self.send(RunCommand::SaveRecording(path)) {
            self.kept_runs += 1;
        }
    }

    /// Runs kept since the start.
    #[must_use]
    pub fn kept_runs(&self) -> u64 {
        self.kept_runs
    }

    /// Makes the model of a recording; its inputs are run again once it is there.
    pub(super) fn open_recording(&mut self, path: &std::path::Path) {
        let recording = match endline_session::Recording::load(path) {
            Ok(recording) => recording,
            Err(error) => return self.notice = Some((error.to_string(), true)),
        };
        self.making.clear();
        self.inputs_when_made = Some((recording.inputs, recording.header.plugins));
        self.guest_when_made = Some(self.documents.version());
        if let Err(error) =
            self.maker.start(recording.source, Arc::clone(&self.host), Arc::clone(&self.waker))
        {
            self.notice = Some((format!("the model cannot be made: {error}"), true));
        }
    }

    /// Runs an encounter of the study shown again, up to where it ended in the study.
    pub(super) fn replay_encounter(&mut self, option: usize, encounter: u32) {
        let Some(shown) = self.studies.results.shown().cloned() else {
            return self.notice = Some(("no results of a study are shown".into(), true));
        };
        if option >= shown.opened.options.len()
            || u64::from(encounter) >= shown.opened.study.encounters
        {
            return self.notice = Some(("the study shown has no such run".into(), true));
        }
        self.keep_run();
        self.making.clear();
        (self.guest_when_made, self.start_when_made) = (Some(self.documents.version()), true);
        let host = Arc::clone(&self.host);
        let work = move || shown.prepare(option, encounter, &host);
        if let Err(error) = self.maker.start_with(work, Arc::clone(&self.waker)) {
            self.notice = Some((format!("the run cannot be made again: {error}"), true));
        }
    }

    /// Takes edits that a crash left; one undo takes them back.
    pub fn recover(&mut self, kept: &UnsavedEdits) {
        let elsewhere = kept.scenario != self.documents.scenario_path()
            && kept.texts.contains_key(Documents::SCENARIO);
        if elsewhere && let Err(error) = self.documents.open_scenario(&kept.scenario) {
            self.notice = Some((error, true));
            return;
        }
        let study = kept.study.as_deref().filter(|study| {
            kept.texts.contains_key(Documents::STUDY) && Some(*study) != self.documents.study_path()
        });
        if let Some(Err(error)) = study.map(|study| self.documents.open_study(study)) {
            self.notice = Some((error, true));
            return;
        }
        self.documents
            .restore(kept.texts.iter().map(|(path, text)| (path.clone(), text.clone())).collect());
        self.notice = Some(("unsaved edits are back; Save keeps them".into(), false));
    }
}
