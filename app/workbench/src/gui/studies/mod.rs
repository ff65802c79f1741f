//! Studies in the window: their queue, and the results shown.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use endline_session::edit::Documents;
use endline_session::study::queue::{self, Job, Queue, State};
use endline_session::study::{ResultsReader, ResultsRequest, StudyResults};

use super::desk::{Desk, Order};

/// What the panels of studies share.
#[derive(Default)]
pub struct Studies {
    /// Studies waiting, at work, and done, in the order they were queued.
    pub queue: Queue,
    /// The results shown.
    pub results: ResultsReader,
    /// Folder that results are kept in; `results` where the program was started, without one.
    pub folder: Option<PathBuf>,
    /// The library's scenarios when the study was opened: id twice, as choices want it.
    pub scenarios: Vec<(String, String)>,
}

impl Studies {
    /// Folder that results are kept in.
    #[must_use]
    pub fn root(&self) -> PathBuf {
        self.folder.clone().unwrap_or_else(|| PathBuf::from("results"))
    }
}

/// Once a frame: begins the next study that waits, and takes in results.
pub fn tick(desk: &mut Desk) {
    let (host, _) = desk.helpers();
    desk.studies.queue.begin_next(&host);
    if let Some(Err(error)) = desk.studies.results.take() {
        desk.notice = Some((error, true));
    }
    if desk.studies.results.follows_next
        && let Some(folder) = desk.studies.queue.jobs.last().and_then(Job::folder)
    {
        desk.studies.results.follow(folder);
    }
    follow(desk);
}

/// Results of the job shown are read again as it goes on.
fn follow(desk: &mut Desk) {
    let Some(shown) = desk.studies.results.followed() else { return };
    let mut jobs = desk.studies.queue.jobs.iter();
    let job = jobs.find(|job| job.folder().as_deref() == Some(shown));
    let Some((opened, blocks, over)) =
        job.and_then(|job| Some((job.opened()?, job.progress().blocks.done, !job.at_work())))
    else {
        return;
    };
    if desk.studies.results.is_due(blocks, over) {
        let folder = shown.to_owned();
        let (folder, opened) = (Some(folder), Some(opened));
        ask(desk, ResultsRequest { folder, opened, blocks, ..ResultsRequest::default() });
    }
}

/// Asks for results to be read in the background.
pub fn ask(desk: &mut Desk, request: ResultsRequest) {
    let (host, waker) = desk.helpers();
    let (library, root) = (desk.documents.root().to_owned(), desk.studies.root());
    let request = ResultsRequest { library, root, ..request };
    if let Err(error) = desk.studies.results.ask(request, host, waker) {
        desk.notice = Some((error, true));
    }
}

/// Opens a study for editing, and the results it already has.
pub fn open(desk: &mut Desk, path: &Path) {
    if desk.documents.study_path().is_some() && desk.documents.is_unsaved(Documents::STUDY) {
        desk.notice =
            Some(("the open study has unsaved edits; save or undo them first".into(), true));
        return;
    }
    if let Err(error) = desk.documents.open_study(path) {
        desk.notice = Some((error, true));
        return;
    }
    let id = |path: &PathBuf| {
        path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
    };
    desk.studies.scenarios = super::files::scenarios(desk.documents.root())
        .iter()
        .map(|path| (id(path), id(path)))
        .collect();
    ask(desk, ResultsRequest { file: Some(path.to_owned()), ..ResultsRequest::default() });
}

/// Shows the results in a folder.
pub fn open_results(desk: &mut Desk, folder: &Path) {
    ask(desk, ResultsRequest { folder: Some(folder.to_owned()), ..ResultsRequest::default() });
}

/// Queues the open study; its text is saved first, for the study is run from its file.
pub fn queue(desk: &mut Desk) {
    let Some(path) = desk.documents.study_path().map(Path::to_owned) else {
        desk.notice = Some(("open a study first".into(), true));
        return;
    };
    if desk.documents.file_has_error(Documents::STUDY) || desk.documents.any_error() {
        desk.notice = Some(("study or gear have errors; see Problems".into(), true));
        return;
    }
    if !desk.documents.unsaved().is_empty()
        && let Err(error) = desk.documents.save()
    {
        desk.notice = Some((format!("not saved, so not queued: {error}"), true));
        return;
    }
    if let Some(job) = desk.studies.queue.unfinished(&path) {
        job.resume();
        desk.notice = Some(("this study is in the queue already".into(), false));
        return;
    }
    let name = desk
        .documents
        .field(Documents::STUDY, "name")
        .unwrap_or_else(|| path.display().to_string());
    let (library, root) = (desk.documents.root().to_owned(), desk.studies.root());
    let (_, waker) = desk.helpers();
    desk.studies.queue.add(Job::new(path, name, library, root, waker));
    desk.studies.results.follows_next = true;
}

/// Obeys an order about studies; does nothing of any other.
pub fn obey(desk: &mut Desk, order: &Order) {
    match order {
        Order::OpenStudy(path) => open(desk, path),
        Order::DuplicateStudy => duplicate(desk),
        Order::QueueStudy => queue(desk),
        Order::PauseStudy => pause(desk),
        Order::CancelStudy => cancel(desk),
        Order::OpenResults(folder) => open_results(desk, folder),
        _ => {}
    }
}

/// The study at work stands still, or goes on.
pub fn pause(desk: &mut Desk) {
    match desk.studies.queue.current() {
        Some(job) if job.state() == State::Paused => job.resume(),
        Some(job) => job.pause(),
        None => desk.notice = Some(("no study is at work".into(), false)),
    }
}

/// Takes the study at work out of the queue.
pub fn cancel(desk: &mut Desk) {
    match desk.studies.queue.current() {
        Some(job) => job.cancel(),
        None => desk.notice = Some(("no study is at work".into(), false)),
    }
}

/// Goes on with a copy of the open study beside those of the library.
pub fn duplicate(desk: &mut Desk) {
    desk.notice = Some(match desk.documents.duplicate_study() {
        Ok(copy) => (format!("a copy: {}", copy.display()), false),
        Err(error) => (error, true),
    });
}

/// The command lines that run the open study and report it as the window does, and whether files must be saved before.
#[must_use]
pub fn command_line(desk: &Desk) -> Option<(String, bool)> {
    let path = desk.documents.study_path()?;
    let job = desk.studies.queue.jobs.iter().find(|job| job.file == path).and_then(Job::folder);
    let of_study = |shown: &&Arc<StudyResults>| {
        shown.opened.study.place.source.path == path.display().to_string()
    };
    let shown = desk.studies.results.shown().filter(of_study);
    let folder = job.or_else(|| shown.map(|shown| shown.folder.clone()));
    let line = queue::command_line(path, desk.documents.root(), folder.as_deref());
    Some((line, !desk.documents.unsaved().is_empty()))
}
