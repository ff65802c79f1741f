//! Running a study: blocks of encounters on several threads, each written as soon as it is done.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::error::Error;

use super::control::{Control, Count, Progress};
use super::folder::Folder;
use super::merge;
use super::open::Opened;
use super::shard::Shard;
use super::table::Table;

/// Runs the missing blocks of a shard; fewer where the study has seen enough. The control pauses
/// it between two encounters, cancels it within one, and receives its progress.
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
    let work = Work {
        opened,
        folder,
        control,
        missing,
        next: AtomicUsize::new(0),
        failure: Mutex::default(),
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.max(1) {
            scope.spawn(|| work.blocks());
        }
        work.blocks();
    });
    control.end();
    match work.failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(error) => Err(error),
        None => Ok(control.progress()),
    }
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
    missing: Vec<u32>,
    /// Place of the next block in the list of missing ones.
    next: AtomicUsize,
    /// The first failure; it ends all threads.
    failure: Mutex<Option<Error>>,
}

impl Work<'_> {
    /// The work of one thread: block after block.
    fn blocks(&self) {
        while let Some(block) = self.next_block() {
            match self.block(block) {
                Ok(true) => self.control.block_done(),
                Ok(false) => break,
                Err(error) => {
                    self.failure().get_or_insert(error);
                }
            }
        }
    }

    fn failure(&self) -> std::sync::MutexGuard<'_, Option<Error>> {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next block to run; none where all are taken, one failed, or the study has seen enough.
    fn next_block(&self) -> Option<u32> {
        if self.failure().is_some() {
            return None;
        }
        let block = *self.missing.get(self.next.fetch_add(1, Ordering::Relaxed))?;
        (!merge::is_enough(self.opened, self.folder)).then_some(block)
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
        self.folder.write(block, &Table::of(rows))?;
        Ok(true)
    }
}
