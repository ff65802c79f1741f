//! All that a user can ask of the workbench and that needs no screen, declared once.
//!
//! A window, a script and a test give the same [`Command`]s to [`Workbench::perform`]. Menus, the command palette, the
//! list of keys and `docs/workbench.md` read [`COMMANDS`]. Commands that only a window has are declared in the same way,
//! as [`CommandInfo`], by the window itself.
//!
//! Each group has a file with its actions, their declarations, and the dispatch to the workbench.

#![deny(clippy::wildcard_enum_match_arm, reason = "each group is dispatched")]

pub mod edit;
pub mod export;
pub mod info;
pub mod plugin;
pub mod rules;
pub mod run;
pub mod search;
pub mod study;
pub mod time;

use std::sync::LazyLock;

use strum::IntoDiscriminant;

use crate::workbench::{Notice, Workbench};
pub use edit::EditAction;
pub use export::ExportAction;
pub use info::{About, Choice, CommandInfo, FileQuestion, FileUse, Make, Shortcut, When};
pub use plugin::PluginAction;
pub use rules::RuleAction;
pub use run::RunAction;
pub use search::SearchAction;
pub use study::StudyAction;
pub use time::TimeAction;

/// A request of the user.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Make, start, pause and compare runs.
    Run(RunAction),
    /// Show another moment of the run.
    Time(TimeAction),
    /// Change, open and save texts.
    Edit(EditAction),
    /// Open and run studies.
    Study(StudyAction),
    /// Search for encounters that end like an observation.
    Search(SearchAction),
    /// Bring an assembly to comply with rules.
    Rules(RuleAction),
    /// Write files that others read.
    Export(ExportAction),
    /// Load and use plugins.
    Plugin(PluginAction),
}

macro_rules! into_command {
    ($($action:ident => $group:ident),*) => {$(
        impl From<$action> for Command {
            fn from(action: $action) -> Self {
                Self::$group(action)
            }
        }
    )*};
}

into_command!(
    RunAction => Run,
    TimeAction => Time,
    EditAction => Edit,
    StudyAction => Study,
    SearchAction => Search,
    RuleAction => Rules,
    ExportAction => Export,
    PluginAction => Plugin
);

/// Declaration of a command of the workbench.
pub type Info = CommandInfo<Workbench, Command>;

/// A group of commands, in the order of the documents.
pub struct Group {
    /// Its title.
    pub title: &'static str,
    /// Its commands.
    pub commands: Vec<Info>,
}

/// Every command, by group.
pub static COMMANDS: LazyLock<[Group; 8]> = LazyLock::new(|| {
    [
        Group { title: "Run", commands: run::commands() },
        Group { title: "Time", commands: time::commands() },
        Group { title: "Edit", commands: edit::commands() },
        Group { title: "Study", commands: study::commands() },
        Group { title: "Search", commands: search::commands() },
        Group { title: "Rules", commands: rules::commands() },
        Group { title: "Export", commands: export::commands() },
        Group { title: "Plugins", commands: plugin::commands() },
    ]
});

/// Every declared command.
pub fn declared() -> impl Iterator<Item = &'static Info> {
    COMMANDS.iter().flat_map(|group| &group.commands)
}

/// The declaration of an identity such as `run.start`.
pub fn find(id: &str) -> Option<&'static Info> {
    declared().find(|info| info.about.id == id)
}

impl Command {
    /// The identity it is declared by, such as `run.start`.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Run(action) => action.discriminant().into(),
            Self::Time(action) => action.discriminant().into(),
            Self::Edit(action) => action.discriminant().into(),
            Self::Study(action) => action.discriminant().into(),
            Self::Search(action) => action.discriminant().into(),
            Self::Rules(action) => action.discriminant().into(),
            Self::Export(action) => action.discriminant().into(),
            Self::Plugin(action) => action.discriminant().into(),
        }
    }

    /// Whether a user gives it on its own. Steering is given in every frame, and the end of a drag follows its edits.
    fn is_an_action(&self) -> bool {
        !matches!(self, Self::Run(RunAction::Steer(_)) | Self::Edit(EditAction::LetGo))
    }
}

impl Workbench {
    /// Performs the command. Its results are in the workbench, at once or later; the notice describes them. A command that
    /// succeeds without a notice of its own withdraws the notice of an earlier one.
    pub fn perform(&mut self, command: Command) -> Result<(), String> {
        // A failure has a notice of its own.
        if command.is_an_action() {
            self.notice = None;
        }
        if let Err(reason) = find(command.id()).map_or(Ok(()), |info| (info.enabled)(self)) {
            self.notice = Some(Notice::hint(&reason));
            return Err(reason);
        }
        let done = match command {
            Command::Run(action) => run::perform(self, action),
            Command::Time(action) => time::perform(self, action),
            Command::Edit(action) => edit::perform(self, action),
            Command::Study(action) => study::perform(self, action),
            Command::Search(action) => search::perform(self, action),
            Command::Rules(action) => rules::perform(self, action),
            Command::Export(action) => export::perform(self, action),
            Command::Plugin(action) => plugin::perform(self, action),
        };
        done.inspect_err(|reason| self.notice = Some(Notice::fault(reason)))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_command_is_declared_once_under_a_name_of_its_own() {
        let [mut ids, mut names] = [BTreeSet::new(), BTreeSet::new()];
        for info in declared() {
            assert!(ids.insert(info.about.id), "{} is declared twice", info.about.id);
            assert!(names.insert(info.about.name), "two commands are called {}", info.about.name);
            assert!(info.about.help.ends_with('.'), "{}: {}", info.about.id, info.about.help);
            if let Make::Plain(command) = &info.make {
                assert_eq!(command.id(), info.about.id, "the command made is the one declared");
            }
        }
    }
}
