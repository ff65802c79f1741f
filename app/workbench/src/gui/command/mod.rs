//! Every command that the window gives: those of the workbench, and those that only a window has.
//!
//! The latter are declared here in the same way as the former in [`endline_session::command`]. Menus, the palette, the list of
//! keys, help texts and `docs/workbench.md` read both.

pub mod action;
mod flight;
pub mod keys;
mod panel;
mod view;
mod window;

use std::path::PathBuf;
use std::sync::LazyLock;

use endline_session::command::{self, About, Choice, CommandInfo, FileQuestion, Info, Make};

use super::shared::Shared;
use action::{WindowAction, WindowCommand};
pub use keys::{spelled, to_egui};

/// Declaration of a command that only a window has.
pub type WindowInfo = CommandInfo<Shared, WindowCommand>;

/// Commands that only a window has, by group.
pub static WINDOW_COMMANDS: LazyLock<[(&str, Vec<WindowInfo>); 4]> = LazyLock::new(|| {
    [
        ("3-D view", view::commands()),
        ("Flight", flight::commands()),
        ("Panels", panel::commands()),
        ("Window", window::commands()),
    ]
});

/// A command of either table.
#[derive(Clone, Copy)]
pub enum Declared {
    /// It needs no screen.
    Workbench(&'static Info),
    /// Only a window has it.
    Window(&'static WindowInfo),
}

/// A command as a user can choose it now.
#[derive(Clone, Debug)]
pub struct Offer {
    /// Its name, with what it is chosen from.
    pub name: String,
    /// What it does, in a sentence.
    pub help: &'static str,
    /// Its keys, as they are spelled on screen; empty without any.
    pub keys: String,
    /// Why it does nothing now, where it does not.
    pub enabled: Result<(), String>,
    /// What is given when it is chosen.
    pub command: WindowCommand,
}

/// Every declared command, with the title of its group.
pub fn groups() -> impl Iterator<Item = (&'static str, Vec<Declared>)> {
    let workbench = command::COMMANDS.iter();
    let workbench = workbench
        .map(|group| (group.title, group.commands.iter().map(Declared::Workbench).collect()));
    let window = WINDOW_COMMANDS.iter();
    workbench.chain(
        window.map(|(title, commands)| (*title, commands.iter().map(Declared::Window).collect())),
    )
}

/// Every declared command.
pub fn declared() -> impl Iterator<Item = Declared> {
    groups().flat_map(|(_, commands)| commands)
}

/// The declaration of an identity such as `view.frame`.
pub fn find(id: &str) -> Option<Declared> {
    let window = || {
        let mut all = WINDOW_COMMANDS.iter().flat_map(|(_, commands)| commands);
        all.find(|info| info.about.id == id).map(Declared::Window)
    };
    command::find(id).map(Declared::Workbench).or_else(window)
}

impl Declared {
    /// Its identity, words and keys.
    pub fn about(self) -> &'static About {
        match self {
            Self::Workbench(info) => &info.about,
            Self::Window(info) => &info.about,
        }
    }

    /// Whether it does something now.
    /// Errors: with the reason why it does not.
    pub fn enabled(self, shared: &Shared) -> Result<(), String> {
        match self {
            Self::Workbench(info) => (info.enabled)(&shared.workbench),
            Self::Window(info) => (info.enabled)(shared),
        }
    }

    /// The command where it needs nothing more.
    pub fn plain(self) -> Option<WindowCommand> {
        match self {
            Self::Workbench(Info { make: Make::Plain(command), .. }) => {
                Some(command.clone().into())
            }
            Self::Window(WindowInfo { make: Make::Plain(command), .. }) => Some(command.clone()),
            Self::Workbench(_) | Self::Window(_) => None,
        }
    }

    /// What to ask for the file that it needs; `None` where it needs none.
    pub fn question(self, shared: &Shared) -> Option<FileQuestion> {
        match self {
            Self::Workbench(Info { make: Make::File { question, .. }, .. }) => {
                Some(question(&shared.workbench))
            }
            Self::Window(WindowInfo { make: Make::File { question, .. }, .. }) => {
                Some(question(shared))
            }
            Self::Workbench(_) | Self::Window(_) => None,
        }
    }

    /// The command for a file; `None` where it needs none.
    pub fn with_file(self, shared: &Shared, file: PathBuf) -> Option<WindowCommand> {
        match self {
            Self::Workbench(Info { make: Make::File { command, .. }, .. }) => {
                Some(command(&shared.workbench, file).into())
            }
            Self::Window(WindowInfo { make: Make::File { command, .. }, .. }) => {
                Some(command(shared, file))
            }
            Self::Workbench(_) | Self::Window(_) => None,
        }
    }

    /// Each way to give it now, with what it is chosen from; none where only a caller has its values.
    pub fn choices(self, shared: &Shared) -> Vec<Choice<WindowCommand>> {
        match self {
            Self::Workbench(Info { make: Make::Choices(choices), .. }) => {
                let choices = choices(&shared.workbench).into_iter();
                choices.map(|choice| Choice::new(choice.name, choice.command.into())).collect()
            }
            Self::Window(WindowInfo { make: Make::Choices(choices), .. }) => choices(shared),
            Self::Workbench(_) | Self::Window(_) => {
                let asked =
                    self.question(shared).map(|_| WindowAction::Ask(self.about().id).into());
                let command = self.plain().or(asked);
                command.map(|command| Choice::new("", command)).into_iter().collect()
            }
        }
    }

    /// Each way to give it now, as menus and palette show it.
    pub fn offers(self, shared: &Shared) -> Vec<Offer> {
        let enabled = self.enabled(shared);
        let About { name, help, keys, .. } = self.about();
        let keys = keys.first().map_or_else(String::new, |shortcut| spelled(shortcut.keys));
        let offer = |choice: Choice<WindowCommand>| Offer {
            name: format!("{name} {}", choice.name).trim_end().to_owned(),
            help,
            keys: keys.clone(),
            enabled: enabled.clone(),
            command: choice.command,
        };
        self.choices(shared).into_iter().map(offer).collect()
    }

    /// Help text for a control that gives it: what it does, its keys, and why it does nothing now.
    pub fn hint(self, shared: &Shared) -> String {
        let About { help, keys, .. } = self.about();
        let keys: Vec<String> = keys.iter().map(|key| spelled(key.keys)).collect();
        let keys = if keys.is_empty() { String::new() } else { format!(" ({})", keys.join(", ")) };
        let reason = self.enabled(shared).err();
        let reason = reason.map_or_else(String::new, |reason| format!("\nNot now: {reason}."));
        format!("{help}{keys}{reason}")
    }
}
