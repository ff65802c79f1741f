//! Trials of a round on several threads and shards; those that are kept already are read.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use crate::error::Error;
use crate::study::Shard;

use super::Effort;
use super::folder::Folder;
use super::trial::Trial;

/// How often a shard looks whether the others have run theirs.
const LOOK: Duration = Duration::from_millis(500);

/// The trials of a round, in order: read, run here, or waited for where other shards run them.
///
/// # Errors
/// A folder that cannot be read or written.
pub(super) fn run(
    folder: &Folder,
    round: &str,
    count: usize,
    effort: &Effort,
    trial: impl Fn(usize) -> Trial + Sync,
) -> Result<Vec<Trial>, Error> {
    let kept = folder.read(round)?;
    let Shard { part, of } = effort.shard;
    let numbers =
        (0..u32::try_from(count).unwrap_or(u32::MAX)).filter(|number| number % of == part);
    let missing: Vec<u32> = numbers.filter(|number| !kept.contains_key(number)).collect();
    if !missing.is_empty() {
        let mut own = kept;
        own.extend(on_threads(&missing, effort.threads, trial));
        own.retain(|number, _| number % of == part);
        folder.write(round, effort.shard, own)?;
    }
    loop {
        let trials = folder.read(round)?;
        if trials.len() >= count {
            return Ok(trials.into_values().take(count).collect());
        }
        std::thread::sleep(LOOK);
    }
}

fn on_threads(
    numbers: &[u32],
    threads: usize,
    trial: impl Fn(usize) -> Trial + Sync,
) -> BTreeMap<u32, Trial> {
    let (next, done) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
    let work = || {
        while let Some(number) = numbers.get(next.fetch_add(1, Ordering::Relaxed)) {
            let found = trial(*number as usize);
            done.lock().unwrap_or_else(PoisonError::into_inner).insert(*number, found);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.max(1) {
            scope.spawn(work);
        }
        work();
    });
    done.into_inner().unwrap_or_else(PoisonError::into_inner)
}
