//! How a command is declared: its identity, name, help and keys, when it is enabled, and how it is made.

use std::path::{Path, PathBuf};

/// When a shortcut holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// At any time, while text is typed too.
    Always,
    /// While no text is typed.
    Idle,
    /// While no text is typed and nobody steers the whale.
    Looking,
    /// While somebody steers the whale.
    Flying,
}

impl When {
    /// All of them, in the order of the list of keys.
    pub const ALL: [Self; 4] = [Self::Always, Self::Idle, Self::Looking, Self::Flying];

    /// The title of its keys in the list of keys.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Always => "At any time",
            Self::Idle => "While no text is typed",
            Self::Looking => "While nobody steers",
            Self::Flying => "While steering the whale",
        }
    }

    /// Whether two may hold at the same time.
    #[must_use]
    pub fn overlaps(self, other: Self) -> bool {
        !matches!((self, other), (Self::Looking, Self::Flying) | (Self::Flying, Self::Looking))
    }
}

/// A key, or several pressed together, that gives a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shortcut {
    /// The keys joined by `+`, such as `Ctrl+Shift+Z`. The last one is the key, those before it are held.
    pub keys: &'static str,
    /// When it holds.
    pub when: When,
    /// The button of a game controller that gives the same command; empty where none does.
    pub pad: &'static str,
}

impl Shortcut {
    /// Keys without a button of the game controller.
    #[must_use]
    pub const fn new(keys: &'static str, when: When) -> Self {
        Self { keys, when, pad: "" }
    }

    /// Keys that a button of the game controller stands for too.
    #[must_use]
    pub const fn with_pad(keys: &'static str, when: When, pad: &'static str) -> Self {
        Self { keys, when, pad }
    }
}

/// Whether a file is to be read or written, or a folder to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileUse {
    /// A file that is there.
    Read,
    /// A file to be written.
    Write,
    /// A folder that is there.
    Folder,
}

/// What to ask a user for a file with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileQuestion {
    /// What it is for.
    pub purpose: FileUse,
    /// What sort of file it is, in words.
    pub sort: &'static str,
    /// File name extensions, the usual one first; empty for any.
    pub extensions: &'static [&'static str],
    /// The folder to begin in, where one is nearer than others.
    pub folder: Option<PathBuf>,
    /// The file name proposed; empty for none.
    pub file_name: String,
}

impl FileQuestion {
    /// A file to be read.
    #[must_use]
    pub fn read(sort: &'static str, extensions: &'static [&'static str]) -> Self {
        let (folder, file_name) = (None, String::new());
        Self { purpose: FileUse::Read, sort, extensions, folder, file_name }
    }

    /// A file to be written, with the name proposed.
    #[must_use]
    pub fn write(sort: &'static str, extensions: &'static [&'static str], name: String) -> Self {
        Self { purpose: FileUse::Write, file_name: name, ..Self::read(sort, extensions) }
    }

    /// A folder to be read.
    #[must_use]
    pub fn folder(sort: &'static str) -> Self {
        Self { purpose: FileUse::Folder, ..Self::read(sort, &[]) }
    }

    /// The same question, beginning in a folder.
    #[must_use]
    pub fn within(self, folder: &Path) -> Self {
        Self { folder: Some(folder.to_owned()), ..self }
    }
}

/// A command with the name of what it was chosen from.
pub struct Choice<Command> {
    /// What is chosen, as it follows the name of the command.
    pub name: String,
    /// The command.
    pub command: Command,
}

impl<Command> Choice<Command> {
    /// A command under the name of what is chosen.
    pub fn new(name: impl Into<String>, command: Command) -> Self {
        Self { name: name.into(), command }
    }
}

/// How a declared command is made.
pub enum Make<Context, Command> {
    /// It needs nothing more.
    Plain(fn() -> Command),
    /// One is made for each of what there is to choose from.
    Choices(fn(&Context) -> Vec<Choice<Command>>),
    /// It needs a file or folder.
    File {
        /// What to ask the user.
        question: fn(&Context) -> FileQuestion,
        /// The command for the answer.
        command: fn(&Context, PathBuf) -> Command,
    },
    /// It needs values that the caller has: a script, or a control of a panel. They are named here.
    Values(&'static str),
}

/// A command as it is declared. `Context` is what it is judged on: the workbench, or the window around it.
pub struct CommandInfo<Context, Command> {
    /// Stable identity: group and verb, such as `run.start`.
    pub id: &'static str,
    /// Name in menus, palette, list of keys and documents.
    pub name: &'static str,
    /// What it does, in a sentence.
    pub help: &'static str,
    /// Keys that give it.
    pub keys: &'static [Shortcut],
    /// Whether it does something now; where not, the reason.
    pub enabled: fn(&Context) -> Result<(), String>,
    /// How it is made.
    pub make: Make<Context, Command>,
}

/// A command that can always be given.
///
/// # Errors
/// Never.
pub fn always<Context>(_: &Context) -> Result<(), String> {
    Ok(())
}

impl<Context, Command> CommandInfo<Context, Command> {
    /// A command without keys that is always enabled.
    #[must_use]
    pub const fn new(
        id: &'static str,
        name: &'static str,
        help: &'static str,
        make: Make<Context, Command>,
    ) -> Self {
        Self { id, name, help, keys: &[], enabled: always::<Context>, make }
    }

    /// The same command, given by keys.
    #[must_use]
    pub const fn with_keys(mut self, keys: &'static [Shortcut]) -> Self {
        self.keys = keys;
        self
    }

    /// The same command, enabled under a condition.
    #[must_use]
    pub const fn only_if(mut self, enabled: fn(&Context) -> Result<(), String>) -> Self {
        self.enabled = enabled;
        self
    }
}
