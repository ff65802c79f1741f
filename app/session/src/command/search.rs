//! Commands that search for encounters that end like an observation.

#![deny(clippy::wildcard_enum_match_arm, reason = "each action is dispatched")]

use std::path::PathBuf;

use strum::{EnumDiscriminants, EnumMessage, IntoStaticStr};

use super::edit::stem;
use super::info::{
    Choice, FileQuestion, Make, has_stories, observation_opened, require, search_at_work,
};
use super::{Command, Info};
use crate::locate;
use crate::search::question::Length;
use crate::workbench::{SearchEffort, Workbench};

/// An action on searches. A story is named by its place, 0 for the nearest.
#[derive(Clone, Debug, PartialEq, Eq, EnumDiscriminants)]
#[strum_discriminants(name(SearchVerb), derive(EnumMessage, IntoStaticStr))]
#[strum_discriminants(strum(prefix = "search.", serialize_all = "kebab-case"))]
pub enum SearchAction {
    /// Opens an observation of the library for editing, and the stories found for it.
    #[strum_discriminants(strum(message = "Open observation"))]
    Open(PathBuf),
    /// Begins an observation in a file of its own, with nothing described yet.
    #[strum_discriminants(strum(message = "New observation"))]
    New,
    /// Copies the open observation to a file of its own and opens the copy.
    #[strum_discriminants(strum(message = "Duplicate the observation"))]
    Duplicate,
    /// Sets how many runs the search makes at most, on how many threads, with how many neighbours, and at which priority.
    #[strum_discriminants(strum(message = "Effort of the search"))]
    Effort(SearchEffort),
    /// Searches for encounters that end like the open observation as it stands in the window, from where an earlier search stopped. Saves nothing.
    #[strum_discriminants(strum(message = "Run the search"))]
    Run,
    /// Pauses the search after the runs in progress, or resumes it.
    #[strum_discriminants(strum(message = "Pause or resume the search"))]
    Pause,
    /// Ends the search after the runs in progress. Completed runs stay, and a later search continues from them.
    #[strum_discriminants(strum(message = "Cancel the search"))]
    Cancel,
    /// Runs a story again, up to the moment at which the search held it against the observation.
    #[strum_discriminants(strum(message = "Run a story"))]
    Replay(usize),
    /// Runs a story to the end of its scenario, to be followed further or flown by hand.
    #[strum_discriminants(strum(message = "Run a story on"))]
    FlyOn(usize),
    /// Writes a story as a scenario of the library.
    #[strum_discriminants(strum(message = "Keep a story as a scenario"))]
    Keep(usize),
}

/// The actions on searches, declared.
pub(super) fn commands() -> Vec<Info> {
    vec![
        Info::of(
            SearchVerb::Open,
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
        Info::plain(SearchAction::New),
        Info::plain(SearchAction::Duplicate).only_if(observation_opened),
        Info::plain(SearchAction::Run).only_if(|workbench| {
            observation_opened(workbench)?;
            require(
                workbench.observation_is_sound(),
                "observation or gear have errors; see Problems",
            )?;
            require(
                workbench.searches.at_work().is_none(),
                "a search is at work; pause or cancel it",
            )
        }),
        Info::plain(SearchAction::Pause).only_if(search_at_work),
        Info::plain(SearchAction::Cancel).only_if(search_at_work),
        Info::values(SearchVerb::Effort, "runs, threads, neighbours, priority"),
        Info::values(SearchVerb::Replay, "its place").only_if(has_stories),
        Info::values(SearchVerb::FlyOn, "its place").only_if(has_stories),
        Info::values(SearchVerb::Keep, "its place").only_if(has_stories),
    ]
}

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
