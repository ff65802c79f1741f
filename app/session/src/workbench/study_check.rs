//! The open study checked as it is edited: every option assembled, in the background, before anything is run.

use std::path::Path;

use endline_gear::Diagnostic;

use super::Workbench;
use crate::edit::Documents;
use crate::error::Error;
use crate::study::PreparedStudy;
use crate::task::Task;

/// What checking the open study found, for one version of the texts.
#[derive(Default)]
pub struct StudyCheck {
    task: Task<Result<(), Error>>,
    /// Version of the texts that are checked, or were.
    version: Option<u64>,
    problems: Vec<Diagnostic>,
    fault: Option<String>,
}

impl StudyCheck {
    /// Problems of options, found by assembling each.
    pub fn problems(&self) -> &[Diagnostic] {
        &self.problems
    }

    /// Why the study cannot be opened for another reason.
    pub fn fault(&self) -> Option<&str> {
        self.fault.as_deref()
    }

    /// Whether nothing wrong is known.
    pub fn is_clean(&self) -> bool {
        self.problems.is_empty() && self.fault.is_none()
    }

    /// Takes in what was found.
    pub(super) fn refresh(&mut self) {
        let Some(found) = self.task.poll() else { return };
        (self.problems, self.fault) = match found {
            Ok(Ok(())) => (Vec::new(), None),
            Ok(Err(Error::Diagnostics(problems))) => (problems, None),
            Ok(Err(error)) => (Vec::new(), Some(error.to_string())),
            Err(_) => {
                (Vec::new(), Some("the study could not be checked: a fault in the program".into()))
            }
        };
    }
}

impl Workbench {
    /// Checks the open study where it or its gear has changed since.
    pub(super) fn check_study(&mut self) {
        let documents = &self.project.documents;
        let version = documents.version();
        let check = &self.studies.check;
        // Errors of a text are reported without assembling anything.
        if check.task.busy() || check.version == Some(version) || !self.study_is_sound() {
            return;
        }
        let Some(path) = documents.study_path().map(Path::to_owned) else { return };
        let text = documents.text(Documents::STUDY).unwrap_or_default().to_owned();
        let files = self.project.files();
        let (host, waker) = self.helpers();
        let work = move || PreparedStudy::of_sources(text, &path, files, &host).map(drop);
        let check = &mut self.studies.check;
        check.version = Some(version);
        if let Err(error) = check.task.start("endline-study-check", work, waker) {
            check.fault = Some(format!("the study cannot be checked: {error}"));
        }
    }
}
