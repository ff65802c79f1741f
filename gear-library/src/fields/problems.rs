//! Problems collected while files are read.

use std::cell::{Cell, RefCell};

use crate::diagnostic::Diagnostic;
use crate::limits::DIAGNOSTICS;

/// The problems found while reading: the first [`DIAGNOSTICS`] of them, and how many more there are.
#[derive(Debug, Default)]
pub struct Problems {
    kept: RefCell<Vec<Diagnostic>>,
    more: Cell<usize>,
}

impl Problems {
    /// Adds one.
    pub fn push(&self, problem: Diagnostic) {
        let mut kept = self.kept.borrow_mut();
        if kept.len() < DIAGNOSTICS {
            return kept.push(problem);
        }
        self.more.set(self.more.get() + 1);
        // An error is never left out for a warning.
        if problem.is_error()
            && let Some(warning) = kept.iter_mut().find(|known| !known.is_error())
        {
            *warning = problem;
        }
    }

    /// Adds several.
    pub fn extend(&self, problems: impl IntoIterator<Item = Diagnostic>) {
        problems.into_iter().for_each(|problem| self.push(problem));
    }

    /// Counts problems that are like others already kept.
    pub fn count_more(&self, more: usize) {
        self.more.set(self.more.get() + more);
    }

    /// Whether one of them is an error.
    pub fn any_error(&self) -> bool {
        self.kept.borrow().iter().any(Diagnostic::is_error)
    }

    /// All of them, by file and place.
    pub fn into_sorted(self) -> Vec<Diagnostic> {
        let mut all = self.kept.into_inner();
        all.sort_by(|a, b| (&a.file, a.line, a.column).cmp(&(&b.file, b.line, b.column)));
        all.dedup();
        if let (more @ 1.., Some(last)) = (self.more.get(), all.last()) {
            let message = format!("there are {more} more problems, which are not shown");
            let note = Diagnostic::of_file(&last.file, message, "mend these first");
            all.push(note);
        }
        all
    }
}
