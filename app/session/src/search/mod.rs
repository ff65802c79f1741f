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
//! | `ended` | what the run of an encounter came to, whatever observation it is held against |
//! | `trial` | a run held against the observation |
//! | `rounds` | which points come next: the net, then a generation of every local search |
//! | `elites`, `climb`, `variation` | the best trial of every kind of story; a local search from one of them; one with another act |
//! | `batch`, `store`, `folder` | runs of a round on threads and shards, kept round by round; those of the net are shared |
//! | `written` | an observation written from an ending, to try a search on an encounter that is known |
//! | `stories`, `robust`, `jitter` | what was found; the most robust run of a kind, by its neighbours and on a finer resolution |
//! | `posterior` | what the draws that end alike tell of an encounter, beside all draws |
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
mod ended;
pub mod ending;
mod folder;
mod jitter;
pub mod job;
pub mod open;
mod order;
pub mod page;
pub mod posterior;
mod question;
mod robust;
mod rounds;
mod store;
pub mod stories;
#[cfg(test)]
mod tests;
mod trial;
mod variation;
pub mod written;

use crate::campaign::Shard;
use crate::campaign::control::{Control, Count};
use crate::encounters::Encounter;
use crate::error::Error;

pub use distance::{Distance, LIKE, Term};
pub use ending::Ending;
pub use folder::Folder;
pub use job::SearchJob;
pub use question::Question;
pub use stories::{Stories, Story};

use batch::Part;
use ended::Ended;
use rounds::Rounds;

/// Draws from the priors before the first local search, where nobody asks for another number.
pub const USUAL_NET: usize = 128;

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
    /// Draws from the priors before the first local search; as many as trials, and there is none.
    pub net: usize,
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
    let run = |point: &[f64]| {
        Ended::of(&question.opened, &Encounter::at_point(&question.opened.study, point))
    };
    let rounds = rounds_of(question, folder, effort, run, control, progress)?;
    let stories = stories::of(question, folder, effort, control, &rounds);
    control.end();
    stories
}

/// Round after round until the effort is spent or the control cancels; `run` runs the encounter at a point.
fn rounds_of<'a>(
    question: &'a Question,
    folder: &Folder,
    effort: &Effort,
    run: impl Fn(&[f64]) -> Ended + Sync,
    control: &Control,
    mut progress: impl FnMut(Progress),
) -> Result<Rounds<'a>, Error> {
    let mut rounds = Rounds::new(question, effort.net);
    control.begin(Count::of(effort.trials), Count::default());
    let mut told = |rounds: &Rounds<'_>| {
        progress(Progress {
            trials: rounds.trials(),
            of: effort.trials,
            best: rounds.best(),
            stories: stories::so_far(rounds),
        });
    };
    let mut goes_on = net_of(&mut rounds, folder, effort, &run, control, &mut told)?;
    while goes_on && rounds.trials() < effort.trials {
        goes_on = round_of(&mut rounds, folder, effort, &run, control)?;
        if goes_on {
            told(&rounds);
        }
    }
    Ok(rounds)
}

/// The net before the first local search, told of in parts; false where the control cancelled it.
fn net_of(
    rounds: &mut Rounds<'_>,
    folder: &Folder,
    effort: &Effort,
    run: &(impl Fn(&[f64]) -> Ended + Sync),
    control: &Control,
    told: &mut impl FnMut(&Rounds<'_>),
) -> Result<bool, Error> {
    let part = |numbers| Part { store: &folder.net, name: "net", numbers };
    let parts: Vec<Part<'_>> = rounds.parts_of_net(effort.trials).map(part).collect();
    let points = rounds.net_points();
    let one = |_, number| run(&points.at(number));
    batch::run(&parts, effort, control, one, |_, net| {
        rounds.take_net(&net);
        told(rounds);
    })
}

/// A round of local searches, variations and a few more points of the net; false where the control cancelled it.
fn round_of(
    rounds: &mut Rounds<'_>,
    folder: &Folder,
    effort: &Effort,
    run: &(impl Fn(&[f64]) -> Ended + Sync),
    control: &Control,
) -> Result<bool, Error> {
    let round = rounds.next();
    let count = u32::try_from(round.local.len()).unwrap_or(u32::MAX);
    let parts = [
        Part { store: &folder.rounds, name: &round.name, numbers: 0..count },
        Part { store: &folder.net, name: "net", numbers: round.net.clone() },
    ];
    let points = rounds.net_points();
    let one = |place, number: u32| match place {
        0 => run(&round.local[number as usize]),
        _ => run(&points.at(number)),
    };
    let mut runs = Vec::new();
    let all = batch::run(&parts, effort, control, one, |_, part| runs.push(part))?;
    if let [local, net] = &runs[..] {
        rounds.take(&round, local, net);
    }
    Ok(all)
}
