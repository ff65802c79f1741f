//! Searching for the encounters that end like what was seen on a real whale.
//!
//! ```text
//! observation + study's encounters -> draws (Sobol points) -> map of elites by kind of story <-> CMA-ES from its best -> stories -> neighbours
//! ```
//!
//! | file | content |
//! |---|---|
//! | `question` | the observation, and the study whose encounters are searched; stories as runs and scenarios |
//! | `ending` | where rope is on the whale at the end of a run, and on the way there |
//! | `distance` | distance of an ending from the observation, term by term |
//! | `elites` | a run compared with the observation; the best trial of every kind of story |
//! | `climb` | local searches from elites, and variations of elites with another act |
//! | `rounds` | the points of the next round |
//! | `batch`, `folder` | runs of a round on threads and shards, stored round by round |
//! | `found`, `robust`, `posterior` | the stories found, their neighbours and finer runs, and the draws that end alike |
//! | `stories`, `page`, `body_map` | the results as JSON, in words and as a page with body maps |
//! | `job` | a search behind a window |
//! | `observation_from_run` | an observation written from an ending, to test a search on a known encounter |
//!
//! A round depends on the trials of earlier rounds only. A search that was killed reads the stored rounds and continues, and any
//! number of threads and shards gives the same stories. How to use it: `docs/search.md`.

mod batch;
mod body_map;
mod climb;
pub mod distance;
mod elites;
pub mod ending;
mod folder;
mod found;
pub mod job;
pub mod observation_from_run;
pub mod page;
pub mod posterior;
pub mod question;
mod robust;
mod rounds;
pub mod stories;
#[cfg(test)]
mod tests;

use crate::campaign::{Control, Count, Shard};
use crate::encounters::Encounter;
use crate::error::Error;

pub use distance::{Distance, LIKE, Term};
pub use ending::Ending;
pub use folder::Folder;
pub use job::SearchJob;
pub use question::Question;
pub use stories::{Stories, Story};

use batch::Part;
use ending::RunEnding;
use rounds::{DRAWS_AT_ONCE, Rounds};

/// Default number of draws from the priors before the first local search.
pub const DEFAULT_NET: usize = 128;

/// Number of runs in a search of `trials` runs at least. The first `net` draws are made in whole rounds, so that there may be more.
pub fn whole_rounds(trials: usize, net: usize) -> usize {
    trials.max(net.min(trials.min(net).next_multiple_of(DRAWS_AT_ONCE as usize)))
}

/// The extent of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Greatest number of trials; the round that reaches it is finished.
    pub trials: usize,
    /// Threads of this process.
    pub threads: usize,
    /// The part of every round that this process runs.
    pub shard: Shard,
    /// Neighbours run of every story that is like the observation.
    pub neighbours: usize,
    /// Draws from the priors before the first local search.
    pub net: usize,
}

/// The progress of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// Trials done.
    pub trials: usize,
    /// Trials at the end of the search, or of the present round if that is more.
    pub of: usize,
    /// The least distance so far.
    pub best: Option<f64>,
    /// The stories so far, without their neighbours.
    pub stories: Stories,
}

/// Searches until the effort is spent, then runs neighbours of the stories that are like the observation. The control pauses and cancels
/// it between two trials; `progress` is called after every round. A cancelled search returns the stories so far.
/// Errors: a folder that cannot be written, or holds a round of another search.
pub fn search(
    question: &Question,
    folder: &Folder,
    effort: &Effort,
    control: &Control,
    progress: impl FnMut(Progress),
) -> Result<Stories, Error> {
    let run = |point: &[f64]| {
        RunEnding::of(&question.opened, &Encounter::at_point(&question.opened.study, point))
    };
    let rounds = rounds_of(question, folder, effort, run, control, progress)?;
    let stories = found::stories(question, folder, effort, control, &rounds);
    control.end();
    stories
}

/// All rounds until the effort is spent or the control cancels; `run` runs the encounter at a point.
fn rounds_of<'a>(
    question: &'a Question,
    folder: &Folder,
    effort: &Effort,
    run: impl Fn(&[f64]) -> RunEnding + Sync,
    control: &Control,
    mut progress: impl FnMut(Progress),
) -> Result<Rounds<'a>, Error> {
    let mut rounds = Rounds::new(question, effort.net);
    let mut planned = whole_rounds(effort.trials, effort.net);
    control.begin(Count::of(planned), Count::default());
    let mut report = |rounds: &Rounds<'_>, of: usize| {
        progress(Progress {
            trials: rounds.trials,
            of,
            best: rounds.best(),
            stories: found::so_far(rounds),
        });
    };
    let points = rounds.sobol_points();
    let net = |numbers| Part { store: &folder.net, name: "net", numbers };
    // The draws before the first local search, in parts.
    let parts: Vec<Part<'_>> = rounds.first_draws(effort.trials).map(net).collect();
    let one = |_, number| run(&points.at(number));
    let mut is_complete = batch::run(&parts, effort, control, one, |_, draws| {
        rounds.take_draws(&draws);
        report(&rounds, planned);
    })?;
    // Rounds of local searches, variations and a few more draws.
    while is_complete && rounds.trials < effort.trials {
        let round = rounds.next();
        planned = planned.max(rounds.trials + round.local.len() + round.draws.len());
        control.expect(planned);
        let numbers = 0..u32::try_from(round.local.len()).unwrap_or(u32::MAX);
        let local = Part { store: &folder.rounds, name: &round.name, numbers };
        let one = |place, number: u32| match place {
            0 => run(&round.local[number as usize]),
            _ => run(&points.at(number)),
        };
        let (parts, mut runs) = ([local, net(round.draws.clone())], Vec::new());
        is_complete = batch::run(&parts, effort, control, one, |_, part| runs.push(part))?;
        if let [local, draws] = &runs[..] {
            rounds.take(&round, local, draws);
        }
        if is_complete {
            report(&rounds, planned);
        }
    }
    Ok(rounds)
}
