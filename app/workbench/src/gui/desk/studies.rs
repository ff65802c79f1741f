//! Studies opened, queued and shown.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_session::edit::Documents;
use endline_session::study::queue::{self, Job, State};
use endline_session::study::{ResultsRequest, StudyResults};

use super::{Desk, Order};
use crate::gui::files;

impl Desk {
    /// Once a frame: begins the next study that waits, and takes in results.
    pub(super) fn tick_studies(&mut self) {
        let (host, _) = self.helpers();
        self.studies.queue.begin_next(&host);
        if let Some(Err(error)) = self.studies.results.take() {
            self.notice = Some((error, true));
        }
        if self.studies.results.follows_next
            && let Some(folder) = self.studies.queue.jobs.last().and_then(Job::folder)
        {
            self.studies.results.follow(folder);
        }
        self.follow_results();
    }

    /// Results of the job shown are read again as it goes on.
    fn follow_results(&mut self) {
        let Some(shown) = self.studies.results.followed() else { return };
        let mut jobs = self.studies.queue.jobs.iter();
        let job = jobs.find(|job| job.folder().as_deref() == Some(shown));
        let Some((opened, blocks, over)) =
            job.and_then(|job| Some((job.opened()?, job.progress().blocks.done, !job.at_work())))
        else {
            return;
        };
        if self.studies.results.is_due(blocks, over) {
            let folder = shown.to_owned();
            let (folder, opened) = (Some(folder), Some(opened));
            self.ask_results(ResultsRequest {
                folder,
                opened,
                blocks,
                ..ResultsRequest::default()
            });
        }
    }

    /// Asks for results to be read in the background.
    pub(super) fn ask_results(&mut self, request: ResultsRequest) {
        let (host, waker) = self.helpers();
        let (library, root) = (self.documents.root().to_owned(), self.studies.root());
        let request = ResultsRequest { library, root, ..request };
        if let Err(error) = self.studies.results.ask(request, host, waker) {
            self.notice = Some((error, true));
        }
    }

    /// Opens a study for editing, and the results it already has.
    pub(super) fn open_study(&mut self, path: &Path) {
        if self.documents.study_path().is_some() && self.documents.is_unsaved(Documents::STUDY) {
            self.notice =
                Some(("the open study has unsaved edits; save or undo them first".into(), true));
            return;
        }
        if let Err(error) = self.documents.open_study(path) {
            self.notice = Some((error, true));
            return;
        }
        let id = |path: &PathBuf| files::stem(path);
        self.studies.scenarios = files::scenarios(self.documents.root())
            .iter()
            .map(|path| (id(path), id(path)))
            .collect();
        self.ask_results(ResultsRequest {
            file: Some(path.to_owned()),
            ..ResultsRequest::default()
        });
    }

    /// Shows the results in a folder.
    pub(super) fn open_results(&mut self, folder: &Path) {
        self.ask_results(ResultsRequest {
            folder: Some(folder.to_owned()),
            ..ResultsRequest::default()
        });
    }

    /// Queues the open study; its text is saved first, for the study is run from its file.
    pub(super) fn queue_study(&mut self) {
        let Some(path) = self.documents.study_path().map(Path::to_owned) else {
            self.notice = Some(("open a study first".into(), true));
            return;
        };
        if self.documents.file_has_error(Documents::STUDY) || self.documents.any_error() {
            self.notice = Some(("study or gear have errors; see Problems".into(), true));
            return;
        }
        if !self.documents.unsaved().is_empty()
            && let Err(error) = self.documents.save()
        {
            self.notice = Some((format!("not saved, so not queued: {error}"), true));
            return;
        }
        if let Some(job) = self.studies.queue.unfinished(&path) {
            job.resume();
            self.notice = Some(("this study is in the queue already".into(), false));
            return;
        }
        let name = self
            .documents
            .field(Documents::STUDY, "name")
            .unwrap_or_else(|| path.display().to_string());
        let (library, root) = (self.documents.root().to_owned(), self.studies.root());
        let (_, waker) = self.helpers();
        self.studies.queue.add(Job::new(path, name, library, root, waker));
        self.studies.results.follows_next = true;
    }

    /// Obeys an order about studies; does nothing of any other.
    pub(super) fn obey_study(&mut self, order: &Order) {
        match order {
            Order::OpenStudy(path) => self.open_study(path),
            Order::DuplicateStudy => self.duplicate_study(),
            Order::QueueStudy => self.queue_study(),
            Order::PauseStudy => self.pause_study(),
            Order::CancelStudy => self.cancel_study(),
            Order::OpenResults(folder) => self.open_results(folder),
            _ => {}
        }
    }

    /// The study at work stands still, or goes on.
    pub(super) fn pause_study(&mut self) {
        match self.studies.queue.current() {
            Some(job) if job.state() == State::Paused => job.resume(),
            Some(job) => job.pause(),
            None => self.notice = Some(("no study is at work".into(), false)),
        }
    }

    /// Takes the study at work out of the queue.
    pub(super) fn cancel_study(&mut self) {
        match self.studies.queue.current() {
            Some(job) => job.cancel(),
            None => self.notice = Some(("no study is at work".into(), false)),
        }
    }

    /// Goes on with a copy of the open study beside those of the library.
    pub(super) fn duplicate_study(&mut self) {
        self.notice = Some(match self.documents.duplicate_study() {
            Ok(copy) => (format!("a copy: {}", copy.display()), false),
            Err(error) => (error, true),
        });
    }

    /// The command lines that run the open study and report it as the window does, and whether files must be saved before.
    #[must_use]
    pub fn study_line(&self) -> Option<(String, bool)> {
        let path = self.documents.study_path()?;
        let job = self.studies.queue.jobs.iter().find(|job| job.file == path).and_then(Job::folder);
        let of_study = |shown: &&Arc<StudyResults>| {
            shown.opened.study.place.source.path == path.display().to_string()
        };
        let shown = self.studies.results.shown().filter(of_study);
        let folder = job.or_else(|| shown.map(|shown| shown.folder.clone()));
        let line = queue::command_line(path, self.documents.root(), folder.as_deref());
        Some((line, !self.documents.unsaved().is_empty()))
    }
}
