//! Running a study: blocks of encounters on several threads of any number of processes, each written as soon as it is done.

use std::collections::BTreeSet;
use std::sync::mpsc::channel;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::error::Error;

use super::folder::{BLOCK, Folder};
use super::merge;
use super::open::Opened;
use crate::campaign::control::{Control, Count, Progress};
use crate::campaign::leases::{Lease, Leases, Next};
use crate::campaign::shard::Shard;

/// How often a process that has nothing left to run looks whether others have run theirs.
const LOOK: Duration = Duration::from_millis(500);

/// Runs the missing blocks of a shard; fewer where the study has seen enough. Other processes on the
/// same folder share the work, and the blocks of one that has ended are run here; at the end, all
/// blocks are there. The control pauses it between two encounters, cancels it within one, and
/// receives its progress.
///
/// A cancelled study is no error: blocks that are written stay, encounters of unfinished blocks are
/// dropped, and a second call continues from the blocks.
///
/// # Errors
/// Where a block cannot be written. The other blocks are finished or dropped, and a second call
/// continues from those that are written.
pub fn run(
    opened: &Opened,
    folder: &Folder,
    shard: Shard,
    threads: usize,
    control: &Control,
) -> Result<Progress, Error> {
    let own: Vec<u32> = (0..folder.blocks()).filter(|block| shard.holds(*block)).collect();
    let missing: Vec<u32> = own.iter().copied().filter(|block| !folder.has(*block)).collect();
    let encounters = |blocks: &[u32]| {
        blocks.iter().map(|block| folder.encounters_of(*block).len()).sum::<usize>()
    };
    control.begin(count(encounters(&own), encounters(&missing)), count(own.len(), missing.len()));
    let failure =
        if missing.is_empty() { None } else { work(opened, folder, control, &missing, threads)? };
    control.end();
    failure.map_or_else(|| Ok(control.progress()), Err)
}

/// Runs blocks on threads, and shows other processes that this one is at work; the first failure.
fn work(
    opened: &Opened,
    folder: &Folder,
    control: &Control,
    missing: &[u32],
    threads: usize,
) -> Result<Option<Error>, Error> {
    let leases = Leases::join(&folder.path)?;
    let left: BTreeSet<u32> = missing.iter().copied().collect();
    let work = Work {
        opened,
        folder,
        control,
        leases: &leases,
        damaged: folder.written()?.intersection(&left).copied().collect(),
        left: Mutex::new(left),
        failure: Mutex::default(),
    };
    std::thread::scope(|scope| {
        let (end, told) = channel::<()>();
        let leases = &leases;
        scope.spawn(move || leases.beat_until_told(&told));
        std::thread::scope(|scope| {
            for _ in 1..threads.max(1) {
                scope.spawn(|| work.blocks());
            }
            work.blocks();
        });
        drop(end);
    });
    Ok(work.failure.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// A count of which all but the missing ones are done.
fn count(total: usize, missing: usize) -> Count {
    let found = u32::try_from(total - missing).unwrap_or(u32::MAX);
    Count { done: found, found, total: u32::try_from(total).unwrap_or(u32::MAX) }
}

/// What the threads of a study share.
struct Work<'a> {
    opened: &'a Opened,
    folder: &'a Folder,
    control: &'a Control,
    leases: &'a Leases,
    /// Blocks whose files are there and cannot be read.
    damaged: BTreeSet<u32>,
    /// Blocks that nobody has run so far, and that no thread here runs.
    left: Mutex<BTreeSet<u32>>,
    /// The first failure; it ends all threads.
    failure: Mutex<Option<Error>>,
}

impl Work<'_> {
    /// The work of one thread: block after block.
    fn blocks(&self) {
        let one = || -> Result<bool, Error> {
            let Some(lease) = self.next()? else { return Ok(false) };
            let done = self.block(lease.block)?;
            if done {
                self.control.block_done();
            }
            Ok(done)
        };
        loop {
            match one() {
                Ok(true) => {}
                Ok(false) => break,
                Err(error) => {
                    lock(&self.failure).get_or_insert(error);
                }
            }
        }
    }

    /// The next block to run; none where all are run, a thread failed, or the study has seen enough.
    fn next(&self) -> Result<Option<Lease<'_>>, Error> {
        loop {
            let over = lock(&self.failure).is_some() || !self.control.goes_on();
            if over || merge::is_enough(self.opened, self.folder) {
                return Ok(None);
            }
            match self.leases.next(&self.left()?)? {
                Next::Run(lease) => {
                    let is_here = lock(&self.left).remove(&lease.block);
                    self.control.waits_for(0);
                    if is_here && !self.folder.has(lease.block) {
                        return Ok(Some(lease));
                    }
                    // Another process, or thread, was faster.
                    self.run_elsewhere(u32::from(is_here));
                }
                Next::Wait(others) => {
                    self.control.waits_for(others);
                    std::thread::sleep(LOOK);
                }
                Next::Nothing => return Ok(None),
            }
        }
    }

    /// Blocks that are not there, now that other processes may have run some.
    fn left(&self) -> Result<Vec<u32>, Error> {
        let written = self.folder.written()?;
        let mut left = lock(&self.left);
        let before = left.len();
        left.retain(|block| !written.contains(block) || self.damaged.contains(block));
        let gone = u32::try_from(before - left.len()).unwrap_or(u32::MAX);
        let all = left.iter().copied().collect();
        drop(left);
        self.run_elsewhere(gone);
        Ok(all)
    }

    /// Counts blocks that other processes have run.
    fn run_elsewhere(&self, blocks: u32) {
        if blocks > 0 {
            self.control.blocks_found(blocks, blocks * BLOCK);
        }
    }

    /// Runs a block and writes it; false where the study was cancelled on the way.
    fn block(&self, block: u32) -> Result<bool, Error> {
        let mut rows = Vec::new();
        for encounter in self.folder.encounters_of(block) {
            if !self.control.goes_on() {
                return Ok(false);
            }
            let Some(own) = self.opened.rows(encounter, &|| !self.control.is_cancelled()) else {
                return Ok(false);
            };
            rows.extend(own);
            self.control.encounter_done();
        }
        self.folder.write(block, rows)?;
        Ok(true)
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
