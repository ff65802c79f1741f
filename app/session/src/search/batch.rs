//! Trials of a round on several threads and shards; those that are kept already are read.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use crate::error::Error;
use crate::study::{Control, Shard};

use super::Effort;
use super::folder::Folder;
use super::trial::Trial;

/// How often a shard looks whether the others have run theirs.
const LOOK: Duration = Duration::from_millis(500);

/// The trials of a round, in order: read, run here, or waited for where other shards run them. `None` where the control ended
/// the search before all of them were there; those that were run are kept.
///
/// # Errors
/// A folder that cannot be read or written.
pub(super) fn run(
    folder: &Folder,
    round: &str,
    count: usize,
    effort: &Effort,
    control: &Control,
    trial: impl Fn(usize) -> Trial + Sync,
) -> Result<Option<Vec<Trial>>, Error> {
    let kept = folder.read(round)?;
    control.encounters_found(kept.len());
    let Shard { part, of } = effort.shard;
    let numbers =
        (0..u32::try_from(count).unwrap_or(u32::MAX)).filter(|number| number % of == part);
    let missing: Vec<u32> = numbers.filter(|number| !kept.contains_key(number)).collect();
    let fresh = on_threads(&missing, effort.threads, control, trial);
    if !fresh.is_empty() {
        let mut own = kept;
        own.extend(fresh);
        own.retain(|number, _| number % of == part);
        folder.write(round, effort.shard, own)?;
    }
    loop {
        let trials = folder.read(round)?;
        if trials.len() >= count {
            return Ok(Some(trials.into_values().take(count).collect()));
        }
        if !control.goes_on() {
            return Ok(None);
        }
        std::thread::sleep(LOOK);
    }
}

fn on_threads(
    numbers: &[u32],
    threads: usize,
    control: &Control,
    trial: impl Fn(usize) -> Trial + Sync,
) -> BTreeMap<u32, Trial> {
    let (next, done) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
    let work = || {
        while control.goes_on()
            && let Some(number) = numbers.get(next.fetch_add(1, Ordering::Relaxed))
        {
            let found = trial(*number as usize);
            control.encounter_done();
            done.lock().unwrap_or_else(PoisonError::into_inner).insert(*number, found);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.clamp(1, numbers.len().max(1)) {
            scope.spawn(work);
        }
        work();
    });
    done.into_inner().unwrap_or_else(PoisonError::into_inner)
}
