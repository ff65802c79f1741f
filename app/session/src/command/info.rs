//! The declaration of a command: its identity, name, help and keys, the conditions under which it is enabled, and its values.

use std::path::{Path, PathBuf};

use strum::{EnumMessage, IntoDiscriminant, IntoStaticStr, VariantArray};

use crate::workbench::Workbench;

/// When a shortcut holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr, VariantArray)]
pub enum When {
    /// At any time, while text is typed too.
    #[strum(serialize = "At any time")]
    Always,
    /// While no text is typed.
    #[strum(serialize = "While no text is typed")]
    Idle,
    /// While no text is typed and the whale is not steered.
    #[strum(serialize = "While the whale is not steered")]
    NotFlying,
    /// While somebody steers the whale.
    #[strum(serialize = "While steering the whale")]
    Flying,
}

impl When {
    /// All of them, in the order of the list of keys.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// The title of its keys in the list of keys.
    pub fn title(self) -> &'static str {
        self.into()
    }

    /// Whether two may hold at the same time.
    pub fn overlaps(self, other: Self) -> bool {
        !matches!((self, other), (Self::NotFlying, Self::Flying) | (Self::Flying, Self::NotFlying))
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

/// Whether a file is to be read or written, or a folder to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileUse {
    /// An existing file.
    Read,
    /// A file to be written.
    Write,
    /// An existing folder.
    Folder,
}

/// A question to the user for a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileQuestion {
    /// Its purpose.
    pub purpose: FileUse,
    /// The kind of file, in words.
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
    pub fn read(sort: &'static str, extensions: &'static [&'static str]) -> Self {
        let (folder, file_name) = (None, String::new());
        Self { purpose: FileUse::Read, sort, extensions, folder, file_name }
    }

    /// A file to be written, with the name proposed.
    pub fn write(sort: &'static str, extensions: &'static [&'static str], name: String) -> Self {
        Self { purpose: FileUse::Write, file_name: name, ..Self::read(sort, extensions) }
    }

    /// A folder to be read.
    pub fn folder(sort: &'static str) -> Self {
        Self { purpose: FileUse::Folder, ..Self::read(sort, &[]) }
    }

    /// The question, beginning in a folder.
    pub fn within(self, folder: &Path) -> Self {
        Self { folder: Some(folder.to_owned()), ..self }
    }
}

/// A command with the name of the thing chosen.
pub struct Choice<Command> {
    /// The name of the thing chosen, written after the name of the command.
    pub name: String,
    /// The command.
    pub command: Command,
}

impl<Command> Choice<Command> {
    /// A command for the thing chosen, by its name.
    pub fn new(name: impl Into<String>, command: Command) -> Self {
        Self { name: name.into(), command }
    }
}

/// How a declared command is made.
pub enum Make<Context, Command> {
    /// It needs no value.
    Plain(Command),
    /// One is made for each thing that can be chosen.
    Choices(fn(&Context) -> Vec<Choice<Command>>),
    /// It needs a file or folder.
    File {
        /// The question to the user.
        question: fn(&Context) -> FileQuestion,
        /// The command for the answer.
        command: fn(&Context, PathBuf) -> Command,
    },
    /// It needs values that the caller has: a script, or a control of a panel. They are named here.
    Values(&'static str),
}

/// What a user reads of a command, and the keys for it.
pub struct About {
    /// Stable identity: group and verb, such as `run.start`.
    pub id: &'static str,
    /// Name in menus, palette, list of keys and documents.
    pub name: &'static str,
    /// Its effect, in a sentence.
    pub help: &'static str,
    /// Keys that give it.
    pub keys: Vec<Shortcut>,
}

/// The declaration of a command. Its condition is tested on `Context`: the workbench, or the window around it.
pub struct CommandInfo<Context, Command> {
    /// Its identity, words and keys.
    pub about: About,
    /// Whether it does something now; where not, the reason.
    pub enabled: fn(&Context) -> Result<(), String>,
    /// How it is made.
    pub make: Make<Context, Command>,
}

/// A command that can always be given.
pub fn always<Context>(_: &Context) -> Result<(), String> {
    Ok(())
}

impl<Context, Command> CommandInfo<Context, Command> {
    /// A command without keys that is always enabled.
    pub fn new(
        id: &'static str,
        name: &'static str,
        help: &'static str,
        make: Make<Context, Command>,
    ) -> Self {
        let about = About { id, name, help, keys: Vec::new() };
        Self { about, enabled: always::<Context>, make }
    }

    /// The command of a kind of action: its help is the documentation there, its name the message.
    pub fn of(kind: impl EnumMessage + Into<&'static str>, make: Make<Context, Command>) -> Self {
        let name = kind.get_message().unwrap_or_default();
        let help = kind.get_documentation().unwrap_or_default();
        Self::new(kind.into(), name, help, make)
    }

    /// The command of an action that needs no value.
    pub fn plain<Action>(action: Action) -> Self
    where
        Action: IntoDiscriminant<Discriminant: EnumMessage + Into<&'static str>> + Into<Command>,
    {
        Self::of(action.discriminant(), Make::Plain(action.into()))
    }

    /// The command of a kind of action whose values, named here, the caller has.
    pub fn values(kind: impl EnumMessage + Into<&'static str>, values: &'static str) -> Self {
        Self::of(kind, Make::Values(values))
    }

    /// The command with a key, or one more.
    pub fn with_key(self, keys: &'static str, when: When) -> Self {
        self.with_key_and_pad(keys, when, "")
    }

    /// The command with a key that a button of the game controller stands for too.
    pub fn with_key_and_pad(mut self, keys: &'static str, when: When, pad: &'static str) -> Self {
        self.about.keys.push(Shortcut { keys, when, pad });
        self
    }

    /// The command, enabled under a condition.
    pub fn only_if(mut self, enabled: fn(&Context) -> Result<(), String>) -> Self {
        self.enabled = enabled;
        self
    }
}

/// Nothing where a command is enabled, else the reason.
pub type Condition = Result<(), String>;

/// A reason where something is not so.
pub fn require(so: bool, reason: &str) -> Condition {
    if so { Ok(()) } else { Err(reason.to_owned()) }
}

/// A run exists.
pub fn ready(workbench: &Workbench) -> Condition {
    require(workbench.view().is_some(), "no run is there yet")
}

/// The run is running.
pub(super) fn running(workbench: &Workbench) -> Condition {
    require(workbench.running(), "the run is not running")
}

/// The run has taken steps.
pub(super) fn has_moments(workbench: &Workbench) -> Condition {
    let moments = workbench.view().is_some_and(|view| view.newest_s > 0.0);
    require(moments, "nothing was run yet")
}

/// A moment before the newest is shown.
pub(super) fn earlier_moment(workbench: &Workbench) -> Condition {
    has_moments(workbench)?;
    let sought = workbench.view().is_some_and(|view| view.sought);
    require(sought, "the newest moment is shown already")
}

/// No text has an error.
pub(super) fn no_errors(workbench: &Workbench) -> Condition {
    let fine = !workbench.project.documents.any_error();
    require(fine, "the gear has errors; see Problems")
}

/// An assembly was checked under rules.
pub(super) fn has_verdicts(workbench: &Workbench) -> Condition {
    require(workbench.rules.answer.is_some(), "check an assembly in Rules first")?;
    require(!workbench.rules.comparing(), "a study is being made already")?;
    require(!workbench.rules.writing(), "a sheet is being written already")
}

/// The scenario has a whale.
pub(super) fn has_whale(workbench: &Workbench) -> Condition {
    require(workbench.project.has_whale(), "this scenario has no whale to pilot")
}

/// A study is open.
pub fn study_opened(workbench: &Workbench) -> Condition {
    let opened = workbench.project.documents.study_path().is_some();
    require(opened, "open a study first")
}

/// A study is at work or paused.
pub(super) fn study_at_work(workbench: &Workbench) -> Condition {
    require(workbench.studies.queue.current().is_some(), "no study is at work")
}

/// An observation is open.
pub fn observation_opened(workbench: &Workbench) -> Condition {
    let opened = workbench.project.documents.observation_path().is_some();
    require(opened, "open an observation first")
}

/// A search is at work or paused.
pub(super) fn search_at_work(workbench: &Workbench) -> Condition {
    require(workbench.searches.at_work().is_some(), "no search is at work")
}

/// Stories of a search are shown.
pub(super) fn has_stories(workbench: &Workbench) -> Condition {
    let stories = workbench.searches.job.as_ref().and_then(|job| job.found().stories);
    let shown = stories.is_some_and(|found| !found.stories.is_empty());
    require(shown, "no story was found yet")
}

/// Results of a study are shown.
pub(super) fn has_results(workbench: &Workbench) -> Condition {
    let shown = workbench.studies.results.shown().is_some();
    require(shown, "no results of a study are shown")
}

/// Plugins can be loaded again.
pub(super) fn loads_plugins(workbench: &Workbench) -> Condition {
    require(workbench.plugins.has_loader(), "there are no folders of plugins here")
}
