//! Commands that search for encounters that end like an observation.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use super::edit::stem;
use super::info::{Choice, FileQuestion, Make};
use super::info::{has_stories, observation_opened, search_at_work, search_runs};
use super::{Command, Info};
use crate::locate;
use crate::search::question::Length;
use crate::workbench::{SearchEffort, Workbench};

/// An action on searches. A story is named by its place, 0 for the nearest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SearchAction {
    /// Open an observation and the stories found for it.
    Open(PathBuf),
    /// Begin a new observation.
    New,
    /// Open a copy of the open observation.
    Duplicate,
    /// How long to search, and with what.
    Effort(SearchEffort),
    /// Search for the open observation, or continue its search.
    Run,
    /// Pause the running search, or resume it.
    Pause,
    /// End the search at work.
    Cancel,
    /// Run a story up to its ending.
    Replay(usize),
    /// Run a story to the end of its scenario.
    FlyOn(usize),
    /// Write a story as a scenario of the library.
    Keep(usize),
}

impl SearchAction {
    /// The identity it is declared by.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Open(_) => "search.open",
            Self::New => "search.new",
            Self::Duplicate => "search.duplicate",
            Self::Effort(_) => "search.effort",
            Self::Run => "search.run",
            Self::Pause => "search.pause",
            Self::Cancel => "search.cancel",
            Self::Replay(_) => "search.replay",
            Self::FlyOn(_) => "search.fly-on",
            Self::Keep(_) => "search.keep",
        }
    }
}

/// The actions on searches, declared.
pub static COMMANDS: &[Info] = &[
    Info::new(
        "search.open",
        "Open observation",
        "Opens an observation of the library for editing, and the stories found for it.",
        Make::Choices(|workbench| {
            locate::observations(workbench.project.documents.root())
                .into_iter()
                .map(|path| Choice::new(stem(&path), open(path)))
                .collect()
        }),
    ),
    Info::new(
        "search.open-file",
        "Open an observation's file",
        "Opens an observation from any folder.",
        Make::File {
            question: |workbench| {
                let folder = workbench.project.documents.root().join("observations");
                FileQuestion::read("observation", &["toml"]).within(&folder)
            },
            command: |_, file| open(file),
        },
    ),
    Info::new(
        "search.new",
        "New observation",
        "Begins an observation in a file of its own, with nothing described yet.",
        Make::Plain(|| Command::Search(SearchAction::New)),
    ),
    Info::new(
        "search.duplicate",
        "Duplicate the observation",
        "Copies the open observation to a file of its own and opens the copy.",
        Make::Plain(|| Command::Search(SearchAction::Duplicate)),
    )
    .only_if(observation_opened),
    Info::new(
        "search.run",
        "Run the search",
        "Searches for encounters that end like the open observation as it stands in the window, from where an earlier search stopped. Saves nothing.",
        Make::Plain(|| Command::Search(SearchAction::Run)),
    )
    .only_if(search_runs),
    Info::new(
        "search.pause",
        "Pause or resume the search",
        "Pauses the search after the runs in progress, or resumes it.",
        Make::Plain(|| Command::Search(SearchAction::Pause)),
    )
    .only_if(search_at_work),
    Info::new(
        "search.cancel",
        "Cancel the search",
        "Ends the search after the runs in progress. Completed runs stay, and a later search continues from them.",
        Make::Plain(|| Command::Search(SearchAction::Cancel)),
    )
    .only_if(search_at_work),
    Info::new(
        "search.effort",
        "Effort of the search",
        "Sets how many runs the search makes at most, on how many threads, with how many neighbours, and at which priority.",
        Make::Values("runs, threads, neighbours, priority"),
    ),
    Info::new(
        "search.replay",
        "Run a story",
        "Runs a story again, up to the moment at which the search held it against the observation.",
        Make::Values("its place"),
    )
    .only_if(has_stories),
    Info::new(
        "search.fly-on",
        "Run a story on",
        "Runs a story to the end of its scenario, to be followed further or flown by hand.",
        Make::Values("its place"),
    )
    .only_if(has_stories),
    Info::new(
        "search.keep",
        "Keep a story as a scenario",
        "Writes a story as a scenario of the library.",
        Make::Values("its place"),
    )
    .only_if(has_stories),
];

fn open(path: PathBuf) -> Command {
    Command::Search(SearchAction::Open(path))
}

/// Dispatches an action.
pub(super) fn perform(workbench: &mut Workbench, action: SearchAction) -> Result<(), String> {
    match action {
        SearchAction::Open(path) => workbench.open_observation(&path),
        SearchAction::New => workbench.new_observation(),
        SearchAction::Duplicate => workbench.duplicate_observation(),
        SearchAction::Effort(effort) => {
            workbench.searches.effort = effort;
            Ok(())
        }
        SearchAction::Run => workbench.run_search(),
        SearchAction::Pause => workbench.pause_search(),
        SearchAction::Cancel => workbench.cancel_search(),
        SearchAction::Replay(story) => workbench.run_story(story, Length::Ended),
        SearchAction::FlyOn(story) => workbench.run_story(story, Length::Whole),
        SearchAction::Keep(story) => workbench.keep_story(story),
    }
}
