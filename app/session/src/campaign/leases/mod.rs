//! Leases: which process runs which block, for any number of processes that share a folder.
//!
//! | file in `leases` | what |
//! |---|---|
//! | `process-3f2a…` | a process at work, and where it runs; written every 20 s, locked while the process lives |
//! | `00012-0` | a lease of block 12, with the id of the process that runs it |
//! | `00012-1` | the next lease of block 12, after that process has ended |
//!
//! A lease is a file that a process creates unless it exists, so that one process alone succeeds. The lease of a process that has
//! ended is not removed, since two processes could try that at once; a lease of the next number follows it. A process has ended if it
//! has been silent for three minutes by the clock of the folder's machine; on the same machine, if its lock is free. A process that
//! slept for longer and resumes runs its block a second time, with the same bytes.
//!
//! Reference: Gray and Cheriton 1989, Leases: an efficient fault-tolerant mechanism for distributed file cache consistency.

mod process;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, SystemTime};

use endline_gear::read;

use crate::error::Error;
use crate::task::lock;

use process::{BEAT, Place, Process, ProcessFile, SILENCE};

/// The leases of a folder, as one of several processes takes them.
#[derive(Debug)]
pub(crate) struct Leases {
    folder: PathBuf,
    process: Arc<Process>,
    heartbeat: Option<Heartbeat>,
    /// Held by the thread that takes a lease, so that no other one reads a lease file that is being written.
    taking: Mutex<()>,
}

/// The thread that shows other processes that this one is at work, until the sender is dropped.
#[derive(Debug)]
struct Heartbeat {
    stop: Sender<()>,
    thread: JoinHandle<()>,
}

/// A block that this process alone runs, until this is dropped.
pub(crate) struct Lease<'a> {
    /// The block.
    pub(crate) block: u32,
    number: u32,
    leases: &'a Leases,
}

/// The next action of a process.
pub(crate) enum Next<'a> {
    /// Run a block.
    Run(Lease<'a>),
    /// Wait: this number of blocks is run by other processes, and one of these may end.
    Wait(u32),
    /// Nothing is left but what this process runs already.
    Nothing,
}

/// A process at work on a folder, as other processes see it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Worker {
    /// Name of its machine.
    pub machine: String,
    /// Its number there.
    pub pid: u32,
    /// How long ago it was last seen at work.
    pub silent: Duration,
    /// Whether it has ended without returning its leases, so that others run its blocks.
    pub has_ended: bool,
    /// Blocks that it runs.
    pub blocks: BTreeSet<u32>,
}

impl Leases {
    /// Joins those who work on a folder of results.
    pub(crate) fn join(results: &Path) -> Result<Self, Error> {
        let mut leases = Self::join_from(results, Place::here())?;
        leases.heartbeat = Heartbeat::start(Arc::clone(&leases.process));
        Ok(leases)
    }

    fn join_from(results: &Path, place: Place) -> Result<Self, Error> {
        let folder = folder_of(results);
        let joined = fs::create_dir_all(&folder).and_then(|()| Process::begin(&folder, place));
        let process = joined
            .map_err(|error| Error::at(&folder, format!("cannot be written: {error}; each process on a study notes there which encounters it runs")))?;
        Ok(Self { folder, process: Arc::new(process), heartbeat: None, taking: Mutex::new(()) })
    }

    /// Leases one of the wanted blocks: one without a lease, else one whose process has ended.
    pub(crate) fn next(&self, wanted: &[u32]) -> Result<Next<'_>, Error> {
        let _one_at_a_time = lock(&self.taking);
        self.take(wanted).map_err(Error::on(&self.folder, "cannot be used"))
    }

    fn take(&self, wanted: &[u32]) -> io::Result<Next<'_>> {
        let standing = standing(&self.folder)?;
        let free: Vec<u32> =
            wanted.iter().copied().filter(|block| !standing.contains_key(block)).collect();
        let mut taken = 0;
        for block in spread(&free) {
            if let Some(lease) = self.lease(block, 0)? {
                return Ok(Next::Run(lease));
            }
            taken += 1;
        }
        let mut ended: BTreeMap<String, bool> = BTreeMap::new();
        for block in wanted {
            let Some(number) = standing.get(block) else { continue };
            let holder = self.holder(*block, *number)?;
            if holder.as_ref() == Some(&self.process.id) {
                continue;
            }
            if self.has_ended(holder, &mut ended)?
                && let Some(lease) = self.lease(*block, number + 1)?
            {
                return Ok(Next::Run(lease));
            }
            taken += 1;
        }
        Ok(if taken > 0 { Next::Wait(taken) } else { Next::Nothing })
    }

    /// Whether the holder of a lease has ended; each holder is tested once.
    fn has_ended(
        &self,
        holder: Option<String>,
        known: &mut BTreeMap<String, bool>,
    ) -> io::Result<bool> {
        let Some(holder) = holder else { return Ok(false) };
        if let Some(has_ended) = known.get(&holder) {
            return Ok(*has_ended);
        }
        let has_ended = self.process.has_ended(&holder)?;
        known.insert(holder, has_ended);
        Ok(has_ended)
    }

    /// Makes a lease; `None` if another process has made it.
    fn lease(&self, block: u32, number: u32) -> io::Result<Option<Lease<'_>>> {
        let path = path_of(&self.folder, block, number);
        match File::options().write(true).create_new(true).open(path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(None),
            file => {
                let lease = Lease { block, number, leases: self };
                file?.write_all(self.process.id.as_bytes())?;
                Ok(Some(lease))
            }
        }
    }

    /// The process that holds a lease; `None` if the lease was returned, or is being made.
    fn holder(&self, block: u32, number: u32) -> io::Result<Option<String>> {
        let path = path_of(&self.folder, block, number);
        match read::text(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Ok(holder) if holder.is_empty() && is_fresh(&path) => Ok(None),
            holder => holder.map(Some),
        }
    }
}

impl Heartbeat {
    /// Starts the thread. Without one this process counts as ended after a while, and others run its blocks again.
    fn start(process: Arc<Process>) -> Option<Self> {
        let (stop, stopped) = channel();
        let beat = move || {
            while stopped.recv_timeout(BEAT) == Err(RecvTimeoutError::Timeout) {
                // A process that cannot write counts as ended, and others run its blocks.
                let _ = process.beat();
            }
        };
        let thread = std::thread::Builder::new().name("endline-leases".to_owned());
        Some(Self { stop, thread: thread.spawn(beat).ok()? })
    }
}

impl Drop for Leases {
    fn drop(&mut self) {
        if let Some(Heartbeat { stop, thread }) = self.heartbeat.take() {
            drop(stop);
            // A panic of the thread has been reported already.
            let _ = thread.join();
        }
        self.process.end();
        // Others may be at work, and then it stays.
        let _ = fs::remove_dir(&self.folder);
    }
}

impl Drop for Lease<'_> {
    /// Returns the lease, with those of ended processes before it.
    fn drop(&mut self) {
        for number in 0..=self.number {
            // A file that cannot be removed is the lease of a process that will have ended.
            let _ = fs::remove_file(path_of(&self.leases.folder, self.block, number));
        }
    }
}

/// The processes at work on a folder of results, by machine.
pub fn workers(results: &Path) -> Result<Vec<Worker>, Error> {
    let folder = folder_of(results);
    let read = || -> io::Result<Vec<Worker>> {
        let (here, now) = (Place::here(), SystemTime::now());
        let worker = |file: &ProcessFile| Worker {
            machine: file.place.machine.clone(),
            pid: file.place.pid,
            silent: file.silent(now),
            has_ended: file.silent(now) > SILENCE || file.has_left(&here),
            blocks: BTreeSet::new(),
        };
        let all = ProcessFile::all(&folder)?;
        let mut workers: BTreeMap<String, Worker> =
            all.iter().map(|(id, file)| (id.clone(), worker(file))).collect();
        for (block, number) in standing(&folder)? {
            let holder = read::text(&path_of(&folder, block, number)).unwrap_or_default();
            if let Some(worker) = workers.get_mut(&holder) {
                worker.blocks.insert(block);
            }
        }
        let mut workers: Vec<Worker> = workers.into_values().collect();
        workers.sort_by(|one, other| (&one.machine, one.pid).cmp(&(&other.machine, other.pid)));
        Ok(workers)
    };
    match read() {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
        read => read.map_err(Error::on(&folder, "cannot be read")),
    }
}

/// Removes the files of ended processes, unless others are at work.
pub(crate) fn clear(results: &Path) {
    if workers(results).is_ok_and(|workers| workers.iter().all(|worker| worker.has_ended)) {
        // A folder that is not there, or stays, does no harm.
        let _ = fs::remove_dir_all(folder_of(results));
    }
}

fn folder_of(results: &Path) -> PathBuf {
    results.join("leases")
}

fn path_of(folder: &Path, block: u32, number: u32) -> PathBuf {
    folder.join(format!("{block:05}-{number}"))
}

/// The last lease of every block that has one.
fn standing(folder: &Path) -> io::Result<BTreeMap<u32, u32>> {
    let mut standing = BTreeMap::new();
    for entry in fs::read_dir(folder)? {
        let name = entry?.file_name();
        let numbers = name.to_str().and_then(|name| name.split_once('-'));
        let lease = numbers
            .and_then(|(block, number)| Some((block.parse().ok()?, number.parse::<u32>().ok()?)));
        if let Some((block, number)) = lease {
            standing
                .entry(block)
                .and_modify(|last: &mut u32| *last = number.max(*last))
                .or_insert(number);
        }
    }
    Ok(standing)
}

/// Whether a file was made so lately that its process may still be writing it.
fn is_fresh(path: &Path) -> bool {
    let modified = fs::metadata(path).and_then(|data| data.modified());
    modified.is_ok_and(|modified| modified.elapsed().is_ok_and(|age| age < SILENCE))
}

/// The blocks from the first, in growing strides that depend on the process, so that processes that begin together rarely collide.
fn spread(free: &[u32]) -> impl Iterator<Item = u32> {
    let stride = usize::try_from(std::process::id() % 7).unwrap_or(0) + 1;
    let place = move |tries: usize| tries * (tries + 1) / 2 * stride;
    (0..).map(place).map_while(|place| free.get(place).copied())
}
