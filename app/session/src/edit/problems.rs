//! Located problems of the open texts.

use endline_gear::{Diagnostic, Library, Observation, Scenario, Sources, Study};

/// A problem in one or two lines: what is wrong, then how to fix it.
pub fn message(problem: &Diagnostic) -> String {
    if problem.help.is_empty() {
        problem.message.clone()
    } else {
        format!("{}\n{}", problem.message, problem.help)
    }
}

/// Where a problem is: its file, and line and column where they are known.
pub fn place(problem: &Diagnostic) -> String {
    if problem.line == 0 {
        problem.file.clone()
    } else {
        format!("{}:{}:{}", problem.file, problem.line, problem.column)
    }
}

/// A text outside the library, with the name under which its problems are reported.
pub(super) struct Named<'a> {
    pub(super) name: &'a str,
    pub(super) text: &'a str,
}

/// Every problem of the open texts.
#[derive(Debug, Default)]
pub(super) struct Problems(Vec<Diagnostic>);

impl Problems {
    /// Reads the library, the scenario, the study and the observation; returns the library without the items that
    /// have errors, and all problems.
    pub(super) fn of(
        library: &Sources,
        [scenario, study, observation]: [Option<Named<'_>>; 3],
    ) -> (Library, Self) {
        let (library, mut all) = Library::read(library);
        if let Some(Err(problems)) = scenario.map(|file| Scenario::read(file.name, file.text)) {
            all.extend(problems);
        }
        if let Some(Err(problems)) = study.map(|file| Study::read(file.name, file.text)) {
            all.extend(problems);
        }
        if let Some(Err(problems)) = observation.map(|file| Observation::read(file.name, file.text))
        {
            all.extend(problems);
        }
        (library, Self(all))
    }

    /// All problems, in the order of reading.
    pub(super) fn all(&self) -> &[Diagnostic] {
        &self.0
    }

    /// Whether there is no problem at all.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The worst problem at a field of a file, or at its value.
    pub(super) fn at(&self, file: &str, field: &str) -> Option<&Diagnostic> {
        let value = format!("{field}.value");
        let here = |problem: &&Diagnostic| {
            problem.file == file && (problem.field == field || problem.field == value)
        };
        self.0.iter().filter(here).max_by_key(|problem| problem.severity)
    }

    /// Whether a file has an error.
    pub(super) fn any_error_in(&self, file: &str) -> bool {
        self.0.iter().any(|problem| problem.file == file && problem.is_error())
    }

    /// Whether any file but these has an error.
    pub(super) fn any_error_outside(&self, files: &[String]) -> bool {
        self.0.iter().any(|problem| !files.contains(&problem.file) && problem.is_error())
    }
}
