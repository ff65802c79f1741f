//! Searching for the encounters that end like what was seen on a real whale.
//!
//! ```text
//! observation + study's encounters -> net (Sobol points) -> map of elites by kind of story <-> CMA-ES from its best -> stories, jittered
//! ```
//!
//! | file | what |
//! |---|---|
//! | `ending` | where rope is on the whale at the end of a run |
//! | `distance`, `order` | how unlike the observation that is, term by term |
//! | `question` | the observation, and the study whose encounters are searched |
//! | `trial` | a point of the unit cube of encounters, run and held against the observation |
//! | `rounds` | which points come next: the net, then a generation of every local search |
//! | `elites`, `climb` | the best trial of every kind of story; a local search from one of them |
//! | `batch`, `folder` | trials of a round on threads and shards, kept round by round |
//! | `written` | an observation written from an ending, to try a search on an encounter that is known |
//! | `stories`, `jitter` | what was found, and how many neighbours of each story end alike |
//! | `page` | the report |
//! | `open` | a story as a run or a scenario of its own |
//! | `job` | a search on threads of its own, for a window |
//!
//! A round depends on the trials of the rounds before it and on nothing else. A search that was killed reads the rounds that are
//! kept and goes on, and any number of threads and shards finds the same. How to use it: `docs/search.md`.

mod batch;
mod climb;
pub mod distance;
mod elites;
pub mod ending;
mod folder;
mod jitter;
pub mod job;
pub mod open;
mod order;
pub mod page;
mod question;
mod rounds;
pub mod stories;
#[cfg(test)]
mod tests;
mod trial;
pub mod written;

use crate::error::Error;
use crate::study::Shard;
use crate::study::control::{Control, Count};

pub use distance::{Distance, LIKE, Term};
pub use ending::Ending;
pub use folder::Folder;
pub use job::Job;
pub use question::Question;
use rounds::Rounds;
pub use stories::{Stories, Story};
use trial::Trial;

/// How long to search, and with what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Trials at most; the round that reaches them is finished.
    pub trials: usize,
    /// Threads of this process.
    pub threads: usize,
    /// Which part of every round is run here.
    pub shard: Shard,
    /// Neighbours run of every story that is like the observation.
    pub neighbours: usize,
    /// Whether only draws of the priors are tried, without local searches: for comparison.
    pub net_alone: bool,
}

/// How far a search is.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// Trials done.
    pub trials: usize,
    /// Trials at most.
    pub of: usize,
    /// The least distance so far.
    pub best: Option<f64>,
    /// The stories so far, without their neighbours.
    pub stories: Stories,
}

/// Searches until the effort is spent, and jitters the stories that are like the observation. The control pauses and cancels it
/// between two trials; `progress` is told of every round. Of a search that is cancelled, the stories so far.
///
/// # Errors
/// A folder that cannot be written, or holds a round of another search.
pub fn search(
    question: &Question,
    folder: &Folder,
    effort: &Effort,
    control: &Control,
    progress: impl FnMut(Progress),
) -> Result<Stories, Error> {
    let trial = |point: &[f64]| Trial::of(question, point);
    let rounds = rounds_of(question, folder, effort, trial, control, progress)?;
    let stories = stories::of(question, folder, effort, control, &rounds);
    control.end();
    stories
}

/// Round after round until the effort is spent or the control cancels; `trial` runs the encounter at a point.
fn rounds_of<'a>(
    question: &'a Question,
    folder: &Folder,
    effort: &Effort,
    trial: impl Fn(&[f64]) -> Trial + Sync,
    control: &Control,
    mut progress: impl FnMut(Progress),
) -> Result<Rounds<'a>, Error> {
    let mut rounds = Rounds::new(question, effort.net_alone);
    control.begin(Count::of(effort.trials), Count::default());
    while rounds.trials() < effort.trials {
        let points = rounds.next();
        let name = rounds.name();
        let trial = |number: usize| trial(&points[number]);
        let Some(trials) = batch::run(folder, &name, points.len(), effort, control, trial)? else {
            break;
        };
        rounds.take(&points, trials);
        progress(Progress {
            trials: rounds.trials(),
            of: effort.trials,
            best: rounds.best(),
            stories: stories::so_far(question, &rounds),
        });
    }
    Ok(rounds)
}
