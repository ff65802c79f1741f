//! Runs of a round on several threads and shards; those that are kept already are read.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use crate::error::Error;
use crate::study::Shard;

use super::Effort;
use super::ended::Ended;
use super::store::Store;

/// How often a shard looks whether the others have run theirs.
const LOOK: Duration = Duration::from_millis(500);

/// Runs `numbers` of a name, in order: read, run here, or waited for where other shards run them.
///
/// # Errors
/// A folder that cannot be read or written.
pub(super) fn run(
    store: &Store,
    name: &str,
    numbers: Range<u32>,
    effort: &Effort,
    one: impl Fn(u32) -> Ended + Sync,
) -> Result<Vec<Ended>, Error> {
    let kept = store.read(name, &numbers)?;
    let Shard { part, of } = effort.shard;
    let is_own = |number: &u32| number % of == part;
    let missing: Vec<u32> =
        numbers.clone().filter(is_own).filter(|number| !kept.contains_key(number)).collect();
    if !missing.is_empty() {
        let mut own = kept;
        own.extend(on_threads(&missing, effort.threads, one));
        own.retain(|number, _| is_own(number));
        store.write(name, &numbers, effort.shard, own)?;
    }
    loop {
        let runs = store.read(name, &numbers)?;
        if runs.len() == numbers.len() {
            return Ok(runs.into_values().collect());
        }
        std::thread::sleep(LOOK);
    }
}

fn on_threads(
    numbers: &[u32],
    threads: usize,
    one: impl Fn(u32) -> Ended + Sync,
) -> BTreeMap<u32, Ended> {
    let (next, done) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
    let work = || {
        while let Some(number) = numbers.get(next.fetch_add(1, Ordering::Relaxed)) {
            let ended = one(*number);
            done.lock().unwrap_or_else(PoisonError::into_inner).insert(*number, ended);
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
