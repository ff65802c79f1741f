//! Running a study: blocks of encounters on the threads of any number of processes, each block written as soon as it is complete.

use std::collections::BTreeSet;
use std::sync::Mutex;
use std::time::Instant;

use crate::campaign::control::{ContactTime, Control, Count, Progress};
use crate::campaign::leases::{self, Lease, Leases};
use crate::campaign::pool::Shard;
use crate::campaign::pool::{self, Next, Work};
use crate::error::Error;
use crate::table::{Cell, Row};
use crate::task::lock;

use super::folder::{BLOCK, Folder};
use super::prepared::PreparedStudy;
use super::{adapt, merge};

/// Runs the missing blocks of a shard, or fewer if the study reaches the interval that it asks for. Other processes on the same
/// folder share the work, and the blocks of a process that has ended are run here; at the end, all blocks are stored. The control
/// pauses the study between two encounters, cancels it within one, and receives its progress.
///
/// A cancelled study is no error: stored blocks stay, encounters of unfinished blocks are dropped, and a second call continues
/// from the blocks.
/// Errors: a shard of a study that adapts; where a block cannot be written. The other blocks are finished or dropped, and a second call
/// continues from those that are written.
pub fn run(
    opened: &PreparedStudy,
    folder: &Folder,
    shard: Shard,
    threads: usize,
    control: &Control,
) -> Result<Progress, Error> {
    if opened.study.adapt.is_some() && shard != Shard::WHOLE {
        let message = "a study that adapts cannot be divided into shards, because each stage needs all encounters of the earlier ones; run it without --shard, on several machines in one shared folder";
        return Err(Error::Message(format!("{}: {message}", opened.study.place.source.path)));
    }
    folder.check_merged()?;
    let own: Vec<u32> = (0..folder.blocks()).filter(|block| shard.holds(*block)).collect();
    let missing: Vec<u32> = own.iter().copied().filter(|block| !folder.has(*block)).collect();
    let encounters = |blocks: &[u32]| {
        blocks.iter().map(|block| folder.encounters_of(*block).len()).sum::<usize>()
    };
    control.begin(count(encounters(&own), encounters(&missing)), count(own.len(), missing.len()));
    let ran = if missing.is_empty() {
        Ok(())
    } else {
        run_missing(opened, folder, control, &missing, threads)
    };
    control.end();
    ran.map(|()| control.progress())
}

fn run_missing(
    opened: &PreparedStudy,
    folder: &Folder,
    control: &Control,
    missing: &[u32],
    threads: usize,
) -> Result<(), Error> {
    let leases = Leases::join(&folder.path)?;
    let left: BTreeSet<u32> = missing.iter().copied().collect();
    let blocks = Blocks {
        opened,
        folder,
        control,
        leases: &leases,
        damaged: folder.written()?.intersection(&left).copied().collect(),
        left: Mutex::new(left),
    };
    pool::run(&blocks, threads, control, |_| Ok(()))
}

/// A count of which all but the missing ones are done.
fn count(total: usize, missing: usize) -> Count {
    let found = u32::try_from(total - missing).unwrap_or(u32::MAX);
    Count { done: found, found, total: u32::try_from(total).unwrap_or(u32::MAX) }
}

/// Time in contact in the run of an encounter that has the longest [s].
fn longest_contact_s(rows: &[Row]) -> f64 {
    let contact = |row: &Row| match row.iter().find(|(name, _)| name == "contact_time_s")?.1 {
        Cell::Real(contact_s) => contact_s,
        _ => None,
    };
    rows.iter().filter_map(contact).fold(0.0, f64::max)
}

/// The missing blocks of a study.
struct Blocks<'a> {
    opened: &'a PreparedStudy,
    folder: &'a Folder,
    control: &'a Control,
    leases: &'a Leases,
    /// Blocks whose files exist and cannot be read.
    damaged: BTreeSet<u32>,
    /// Blocks that no process has run so far and no thread of this one runs.
    left: Mutex<BTreeSet<u32>>,
}

impl<'a> Work for Blocks<'a> {
    type Piece = Lease<'a>;

    fn next(&self) -> Result<Next<Lease<'a>>, Error> {
        while !merge::is_enough(self.opened, self.folder) {
            let left = self.left()?;
            let open = self.open(&left)?;
            if open.is_empty() && !left.is_empty() {
                // Other threads run the last encounters of a stage, to which the next one is fitted.
                return Ok(Next::Wait);
            }
            match self.leases.next(&open)? {
                leases::Next::Run(lease) => {
                    let is_here = lock(&self.left).remove(&lease.block);
                    self.control.waits_for(0);
                    if is_here && !self.folder.has(lease.block) {
                        return Ok(Next::Run(lease));
                    }
                    // Another process, or thread, was faster.
                    self.run_elsewhere(u32::from(is_here));
                }
                leases::Next::Wait(others) => {
                    self.control.waits_for(others);
                    return Ok(Next::Wait);
                }
                leases::Next::Nothing if open.len() < left.len() => return Ok(Next::Wait),
                leases::Next::Nothing => return Ok(Next::Nothing),
            }
        }
        Ok(Next::Nothing)
    }

    fn run(&self, lease: Lease<'a>) -> Result<bool, Error> {
        let mut rows = Vec::new();
        for encounter in self.folder.encounters_of(lease.block) {
            if !self.control.may_continue() {
                return Ok(false);
            }
            let start = Instant::now();
            let drawn = self.opened.encounter(self.folder, encounter)?;
            let Some(own) = self.opened.rows(drawn, &|| !self.control.is_cancelled()) else {
                return Ok(false);
            };
            let longest_s = self.opened.study.run.held_s;
            let contact = ContactTime { spent_s: longest_contact_s(&own), longest_s };
            self.control.encounter_done(start.elapsed(), contact);
            rows.extend(own);
        }
        self.folder.write(lease.block, rows)?;
        self.control.block_done();
        Ok(true)
    }
}

impl Blocks<'_> {
    /// Those of the blocks left whose stage has begun.
    fn open(&self, left: &[u32]) -> Result<Vec<u32>, Error> {
        let study = &self.opened.study;
        if study.adapt.is_none() {
            return Ok(left.to_vec());
        }
        let written = self.folder.written()?;
        let is_stored = |encounter: u32| {
            let block = encounter / BLOCK;
            // A damaged block is run again.
            let is_whole = !self.damaged.contains(&block) || self.folder.has(block);
            written.contains(&block) && is_whole
        };
        let end = self.folder.blocks_of(adapt::open_until(study, is_stored));
        Ok(left.iter().copied().filter(|block| *block < end).collect())
    }

    /// Blocks without a file, now that other processes may have run some.
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
}
