//! What the workbench says of itself: the last notice, and events that a window answers by showing something.

/// How a notice is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoticeKind {
    /// Something was done.
    Done,
    /// Nothing was done, and why.
    Hint,
    /// Something failed, and why.
    Fault,
}

/// A sentence for the status bar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// What it says.
    pub text: String,
    /// How it is meant.
    pub kind: NoticeKind,
}

impl Notice {
    /// Something was done.
    pub fn done(text: impl Into<String>) -> Self {
        Self { text: text.into(), kind: NoticeKind::Done }
    }

    /// Nothing was done: why.
    pub fn hint(text: impl Into<String>) -> Self {
        Self { text: text.into(), kind: NoticeKind::Hint }
    }

    /// Something failed: why.
    pub fn fault(text: impl Into<String>) -> Self {
        Self { text: text.into(), kind: NoticeKind::Fault }
    }
}

/// What came about and a window may want to show.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// The inputs of a run are the pilot program now.
    ProgramWritten,
    /// The pilot program has a new entry at this place.
    EntryAdded(usize),
    /// The run shown is kept as this recording.
    RunKept(std::path::PathBuf),
    /// This assembly was added to the library.
    AssemblyAdded(String),
    /// An entry of the library was copied.
    Duplicated {
        /// The entry.
        from: String,
        /// Its copy.
        to: String,
    },
}
