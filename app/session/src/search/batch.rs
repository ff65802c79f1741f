//! Runs of a round on several threads and shards; those that are kept already are read.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use crate::error::Error;
use crate::study::{Control, Shard};

use super::Effort;
use super::ended::Ended;
use super::store::Store;

/// How often a shard looks whether the others have run theirs.
const LOOK: Duration = Duration::from_millis(500);

/// Runs `numbers` of a name, in order: read, run here, or waited for where other shards run them. `None` where the control ended the
/// search before all of them were there; those that were run are kept.
///
/// # Errors
/// A folder that cannot be read or written.
pub(super) fn run(
    store: &Store,
    name: &str,
    numbers: Range<u32>,
    effort: &Effort,
    control: &Control,
    one: impl Fn(u32) -> Ended + Sync,
) -> Result<Option<Vec<Ended>>, Error> {
    let kept = store.read(name, &numbers)?;
    control.encounters_found(kept.len());
    let Shard { part, of } = effort.shard;
    let is_own = |number: &u32| number % of == part;
    let missing: Vec<u32> =
        numbers.clone().filter(is_own).filter(|number| !kept.contains_key(number)).collect();
    let fresh = on_threads(&missing, effort.threads, control, one);
    if !fresh.is_empty() {
        let mut own = kept;
        own.extend(fresh);
        own.retain(|number, _| is_own(number));
        store.write(name, &numbers, effort.shard, own)?;
    }
    loop {
        let runs = store.read(name, &numbers)?;
        if runs.len() == numbers.len() {
            return Ok(Some(runs.into_values().collect()));
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
    one: impl Fn(u32) -> Ended + Sync,
) -> BTreeMap<u32, Ended> {
    let (next, done) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
    let work = || {
        while control.goes_on()
            && let Some(number) = numbers.get(next.fetch_add(1, Ordering::Relaxed))
        {
            let ended = one(*number);
            control.encounter_done();
            done.lock().unwrap_or_else(PoisonError::into_inner).insert(*number, ended);
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
