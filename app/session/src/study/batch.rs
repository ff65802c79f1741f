//! Running a study: blocks of encounters on several threads, each written as soon as it is done.

use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use crate::error::Error;

use super::folder::Folder;
use super::merge;
use super::open::Opened;
use super::shard::Shard;
use super::table::Table;

/// How far a study is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Blocks of the shard that are done.
    pub done: u32,
    /// Of them, those that were there before.
    pub found: u32,
    /// Blocks of the shard in all.
    pub blocks: u32,
}

/// Runs what is missing of a shard, telling how far it is after each block; fewer blocks where the study has seen enough.
///
/// # Errors
/// Where a block cannot be written: the others that are done stay, and the same call goes on from them.
pub fn run(
    opened: &Opened,
    folder: &Folder,
    shard: Shard,
    threads: usize,
    tell: &(dyn Fn(Progress) + Sync),
) -> Result<Progress, Error> {
    let own: Vec<u32> = (0..folder.blocks()).filter(|block| shard.holds(*block)).collect();
    let missing: Vec<u32> = own.iter().copied().filter(|block| !folder.has(*block)).collect();
    let found = u32::try_from(own.len() - missing.len()).unwrap_or(u32::MAX);
    let progress = Mutex::new(Progress {
        done: found,
        found,
        blocks: u32::try_from(own.len()).unwrap_or(u32::MAX),
    });
    tell(*progress.lock().unwrap_or_else(PoisonError::into_inner));
    let (next, over, failure) = (AtomicU32::new(0), AtomicBool::new(false), Mutex::new(None));
    let work = || {
        while !over.load(Ordering::Relaxed) {
            let Some(block) = missing.get(next.fetch_add(1, Ordering::Relaxed) as usize) else {
                break;
            };
            if merge::is_enough(opened, folder) {
                break;
            }
            if let Err(error) = folder.write(*block, &block_of(opened, folder, *block)) {
                failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                over.store(true, Ordering::Relaxed);
                break;
            }
            let mut progress = progress.lock().unwrap_or_else(PoisonError::into_inner);
            progress.done += 1;
            tell(*progress);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.max(1) {
            scope.spawn(work);
        }
        work();
    });
    match failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(error) => Err(error),
        None => Ok(progress.into_inner().unwrap_or_else(PoisonError::into_inner)),
    }
}

/// The rows of a block.
fn block_of(opened: &Opened, folder: &Folder, block: u32) -> Table {
    Table::of(folder.encounters_of(block).flat_map(|index| opened.rows(index)).collect())
}
