//! Studies of a user: the queue of those at work, and the results shown.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Workbench;
use super::model::Then;
use super::notice::Notice;
use super::study_check::StudyCheck;
use crate::campaign::State;
use crate::edit::Documents;
use crate::save::copy_tree;
use crate::study::queue::{self, Part, Queue, StudyJob, StudyRequest};
use crate::study::{ResultsReader, ResultsRequest, StudyResults};

/// Studies in the queue, and results.
#[derive(Default)]
pub struct Studies {
    /// Studies waiting, at work, and done.
    pub queue: Queue,
    /// The results shown.
    pub results: ResultsReader,
    /// Folder that results are kept in; `results` where the program was started, without one.
    pub folder: Option<PathBuf>,
    /// The open study checked as it is edited.
    pub check: StudyCheck,
}

impl Studies {
    /// Folder that results are kept in.
    pub fn root(&self) -> PathBuf {
        self.folder.clone().unwrap_or_else(|| PathBuf::from("results"))
    }
}

impl Workbench {
    /// Begins the next study that waits, and takes in results.
    pub(super) fn refresh_studies(&mut self) {
        let (host, _) = self.helpers();
        let studies = &mut self.studies;
        studies.check.refresh();
        studies.queue.begin_next(&host);
        if let Some(Err(error)) = studies.results.take() {
            self.notice = Some(Notice::fault(error));
        }
        if studies.results.follows_next
            && let Some(folder) = studies.queue.jobs.last().and_then(StudyJob::folder)
        {
            studies.results.follow(folder);
        }
        self.follow_job();
    }

    /// Results of the job shown are read again as it advances.
    fn follow_job(&mut self) {
        let studies = &self.studies;
        let Some(shown) = studies.results.followed() else { return };
        let job = studies.queue.jobs.iter().find(|job| job.folder().as_deref() == Some(shown));
        let Some((job, opened)) = job.and_then(|job| Some((job, job.opened()?))) else { return };
        let blocks = job.progress().blocks.done;
        if studies.results.is_due(blocks, !job.at_work()) {
            let (folder, opened) = (Some(shown.to_owned()), Some(opened));
            let asked = self.ask_for_results(ResultsRequest {
                folder,
                opened,
                blocks,
                ..ResultsRequest::default()
            });
            if let Err(reason) = asked {
                self.notice = Some(Notice::fault(reason));
            }
        }
    }

    /// Asks for results to be read in the background.
    fn ask_for_results(&mut self, request: ResultsRequest) -> Result<(), String> {
        let (host, waker) = self.helpers();
        let library = self.project.documents.root().to_owned();
        let request = ResultsRequest { library, root: self.studies.root(), ..request };
        self.studies.results.ask(request, host, waker)
    }

    /// Opens a study for editing, and the results it already has.
    pub(crate) fn open_study(&mut self, path: &Path) -> Result<(), String> {
        let documents = &mut self.project.documents;
        if documents.study_path().is_some() && documents.is_unsaved(Documents::STUDY) {
            let reason = "the open study has unsaved edits; save or undo them first";
            return Err(reason.to_owned());
        }
        documents.open_study(path)?;
        self.ask_for_results(ResultsRequest {
            file: Some(path.to_owned()),
            ..ResultsRequest::default()
        })
    }

    /// Shows the results in a folder.
    pub(crate) fn show_results(&mut self, folder: &Path) -> Result<(), String> {
        self.ask_for_results(ResultsRequest {
            folder: Some(folder.to_owned()),
            ..ResultsRequest::default()
        })
    }

    /// Whether neither the open study nor the gear has an error.
    pub fn study_is_sound(&self) -> bool {
        let documents = &self.project.documents;
        !documents.file_has_error(Documents::STUDY) && !documents.any_error()
    }

    /// Queues the open study or its forecast, to be run on the texts as they are edited. Nothing is saved.
    pub(crate) fn queue_study(&mut self, part: Part) -> Result<(), String> {
        let documents = &self.project.documents;
        let Some(path) = documents.study_path().map(Path::to_owned) else {
            return Err("open a study first".to_owned());
        };
        let named = documents.field(Documents::STUDY, "name");
        let name = named.unwrap_or_else(|| path.display().to_string());
        let text = documents.text(Documents::STUDY).unwrap_or_default().to_owned();
        let (_, waker) = self.helpers();
        let files = self.project.files();
        let studies = &mut self.studies;
        if let Some(job) = studies.queue.unfinished(&path) {
            job.resume();
            let hint = match (job.request.part, part) {
                (Part::Forecast, Part::Whole) => {
                    "the study's forecast is in the queue; run the study when it is made"
                }
                _ => "this study is in the queue already",
            };
            self.notice = Some(Notice::hint(hint));
            return Ok(());
        }
        let request = StudyRequest { file: path, name, text, files, root: studies.root(), part };
        studies.queue.add(StudyJob::new(request, waker));
        studies.results.follows_next = true;
        self.say_unsaved("the study");
        Ok(())
    }

    /// Says that work runs on unsaved texts, where there are some.
    pub(super) fn say_unsaved(&mut self, what: &str) {
        let files = match self.project.documents.unsaved().len() {
            0 => return,
            1 => "1 file is not saved".to_owned(),
            count => format!("{count} files are not saved"),
        };
        let text = format!("{what} runs on the texts as they stand in the window; {files}");
        self.notice = Some(Notice::done(text));
    }

    /// Pauses the study at work, or continues it.
    pub(crate) fn pause_study(&self) -> Result<(), String> {
        pause_or_resume(self.studies.queue.current().ok_or("no study is at work")?);
        Ok(())
    }

    /// Takes the study at work out of the queue.
    pub(crate) fn cancel_study(&self) -> Result<(), String> {
        self.studies.queue.current().ok_or("no study is at work")?.cancel();
        Ok(())
    }

    /// Pauses a study of the queue, or continues it.
    pub(crate) fn pause_job(&self, file: &Path) -> Result<(), String> {
        pause_or_resume(self.job(file)?);
        Ok(())
    }

    /// Takes a study out of the queue.
    pub(crate) fn cancel_job(&self, file: &Path) -> Result<(), String> {
        self.job(file)?.cancel();
        Ok(())
    }

    /// Removes a study that has ended from the list.
    pub(crate) fn forget_job(&mut self, file: &Path) -> Result<(), String> {
        if self.job(file)?.is_unfinished() {
            return Err("the study has not ended; cancel it first".to_owned());
        }
        self.studies.queue.jobs.retain(|job| job.request.file != file);
        Ok(())
    }

    fn job(&self, file: &Path) -> Result<&StudyJob, String> {
        let mut jobs = self.studies.queue.jobs.iter();
        let job = jobs.find(|job| job.request.file == file);
        job.ok_or_else(|| format!("{} is not in the queue", file.display()))
    }

    /// Opens a copy of the open study beside those of the library.
    pub(crate) fn duplicate_study(&mut self) -> Result<(), String> {
        let copy = self.project.documents.duplicate_study()?;
        self.notice = Some(Notice::done(format!("a copy: {}", copy.display())));
        Ok(())
    }

    /// Adds an option to the open study.
    pub(crate) fn add_option(
        &mut self,
        add: impl FnOnce(&mut Documents) -> Result<String, String>,
    ) -> Result<(), String> {
        let id = add(&mut self.project.documents)?;
        self.notice =
            Some(Notice::done(format!("the study has the option {id}; Undo takes it back")));
        Ok(())
    }

    /// The report of the results shown, where it is written.
    pub fn report_shown(&self) -> Option<PathBuf> {
        let page = self.studies.results.shown()?.folder.join("report.html");
        page.is_file().then_some(page)
    }

    /// Copies the report of the results shown, its numbers and its bundle to a folder of their own in `folder`.
    pub(crate) fn save_bundle(&mut self, folder: &Path) -> Result<(), String> {
        let Some(shown) = self.studies.results.shown().cloned() else {
            return Err("no results of a study are shown".to_owned());
        };
        let own = folder.join(&shown.opened.study.id);
        if own.exists() {
            return Err(format!("{} is there already: choose another folder", own.display()));
        }
        for part in ["report.html", "report.csv", "findings.json", "table.csv", "bundle"] {
            let from = shown.folder.join(part);
            if from.exists() {
                copy_tree(&from, &own.join(part)).map_err(|error| error.to_string())?;
            }
        }
        self.notice = Some(Notice::done(format!("report and bundle: {}", own.display())));
        Ok(())
    }

    /// Runs an encounter of the study shown again, up to where it ended in the study.
    pub(crate) fn replay_encounter(&mut self, option: usize, encounter: u32) -> Result<(), String> {
        let Some(shown) = self.studies.results.shown().cloned() else {
            return Err("no results of a study are shown".to_owned());
        };
        let encounters = shown.opened.study.encounters;
        let plan = shown.opened.options.get(option);
        let Some(plan) = plan.filter(|_| u64::from(encounter) < encounters) else {
            return Err("the study shown has no such run".to_owned());
        };
        let name = format!("{}, encounter {encounter}, {}", shown.opened.study.name, plan.name);
        self.keep_run();
        let host = Arc::clone(&self.plugins.host);
        self.make_guest(name, Then::Start, move || shown.prepare(option, encounter, &host))
    }

    /// The command lines that run the open study and report it; `None` where none is open.
    pub fn study_command_line(&self) -> Option<String> {
        let (documents, studies) = (&self.project.documents, &self.studies);
        let path = documents.study_path()?;
        let mut jobs = studies.queue.jobs.iter();
        let job = jobs.find(|job| job.request.file == path).and_then(StudyJob::folder);
        let of_study = |shown: &&Arc<StudyResults>| {
            shown.opened.study.place.source.path == path.display().to_string()
        };
        let shown = studies.results.shown().filter(of_study);
        let folder = job.or_else(|| shown.map(|shown| shown.folder.clone()));
        Some(queue::command_line(path, documents.root(), folder.as_deref()))
    }
}

fn pause_or_resume(job: &StudyJob) {
    if job.state() == State::Paused {
        job.resume();
    } else {
        job.pause();
    }
}
