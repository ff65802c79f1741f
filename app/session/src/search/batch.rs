//! Runs of a search on several threads and shards; those that are kept already are read.
//!
//! Runs come in parts, each kept by one file of every shard. Threads go from part to part without waiting for the others, so that a
//! long run holds up nobody; parts are handed on in their order, as soon as all shards have run theirs.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::campaign::{Control, Shard};
use crate::error::Error;

use super::Effort;
use super::ended::Ended;
use super::store::Store;

/// How often a shard looks whether the others have run theirs.
const LOOK: Duration = Duration::from_millis(500);

/// Runs that are kept together.
pub(super) struct Part<'a> {
    /// Where.
    pub(super) store: &'a Store,
    /// Under which name.
    pub(super) name: &'a str,
    /// Which numbers of that name.
    pub(super) numbers: Range<u32>,
}

/// Runs the numbers of all parts by `one(part, number)`: read, run here, or waited for where other shards run them. Each part is
/// `take`n with its place, in order. False where the control ended the search before all of them were there; those that were run are
/// kept.
///
/// # Errors
/// A folder that cannot be read or written.
pub(super) fn run(
    parts: &[Part<'_>],
    effort: &Effort,
    control: &Control,
    one: impl Fn(usize, u32) -> Ended + Sync,
    mut take: impl FnMut(usize, Vec<Ended>),
) -> Result<bool, Error> {
    let work = Work::find(parts, effort.shard, control)?;
    let (written, news) = channel();
    let all = std::thread::scope(|scope| {
        for _ in 0..effort.threads.clamp(1, work.missing.len().max(1)) {
            let (work, one, written) = (&work, &one, written.clone());
            scope.spawn(move || work.on_a_thread(control, one, &written));
        }
        let all = hand_on(parts, control, &news, &mut take);
        work.stopped.store(all.is_err(), Ordering::Relaxed);
        all
    });
    work.keep_unfinished()?;
    all
}

/// Runs the numbers of one part; `None` where the control ended the search before.
///
/// # Errors
/// As [`run`].
pub(super) fn run_one(
    part: Part<'_>,
    effort: &Effort,
    control: &Control,
    one: impl Fn(u32) -> Ended + Sync,
) -> Result<Option<Vec<Ended>>, Error> {
    let mut runs = None;
    run(&[part], effort, control, |_, number| one(number), |_, all| runs = Some(all))?;
    Ok(runs)
}

/// Waits for each part in order and hands it on.
fn hand_on(
    parts: &[Part<'_>],
    control: &Control,
    news: &Receiver<Result<(), Error>>,
    take: &mut impl FnMut(usize, Vec<Ended>),
) -> Result<bool, Error> {
    for (place, part) in parts.iter().enumerate() {
        loop {
            let runs = part.store.read(part.name, &part.numbers)?;
            if runs.len() == part.numbers.len() {
                take(place, runs.into_values().collect());
                break;
            }
            if !control.goes_on() {
                return Ok(false);
            }
            if let Ok(failed @ Err(_)) = news.recv_timeout(LOOK) {
                failed?;
            }
        }
    }
    Ok(true)
}

/// What the threads share.
struct Work<'a> {
    parts: &'a [Part<'a>],
    shard: Shard,
    /// Part and number of the runs to be done here, in order.
    missing: Vec<(usize, u32)>,
    /// Place of the next one.
    next: AtomicUsize,
    /// What this shard has of each part.
    own: Vec<Mutex<Own>>,
    /// Whether another thread failed.
    stopped: AtomicBool,
}

/// What this shard has of a part.
struct Own {
    runs: BTreeMap<u32, Ended>,
    /// How many it has still to run.
    missing: usize,
    /// Whether some of the runs are not kept yet.
    is_fresh: bool,
}

impl<'a> Work<'a> {
    /// Reads what is kept, and finds what is missing.
    fn find(parts: &'a [Part<'a>], shard: Shard, control: &Control) -> Result<Self, Error> {
        let (mut missing, mut own) = (Vec::new(), Vec::new());
        for (place, part) in parts.iter().enumerate() {
            let mut runs = part.store.read(part.name, &part.numbers)?;
            control.encounters_found(runs.len());
            let is_own = |number: &u32| number % shard.of == shard.part;
            let is_missing = |number: &u32| is_own(number) && !runs.contains_key(number);
            let here: Vec<u32> = part.numbers.clone().filter(is_missing).collect();
            runs.retain(|number, _| is_own(number));
            own.push(Mutex::new(Own { runs, missing: here.len(), is_fresh: false }));
            missing.extend(here.into_iter().map(|number| (place, number)));
        }
        let (next, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
        Ok(Self { parts, shard, missing, next, own, stopped })
    }

    /// The work of one thread: run after run; a part that is complete is kept.
    fn on_a_thread(
        &self,
        control: &Control,
        one: &impl Fn(usize, u32) -> Ended,
        written: &Sender<Result<(), Error>>,
    ) {
        while control.goes_on()
            && !self.stopped.load(Ordering::Relaxed)
            && let Some((place, number)) =
                self.missing.get(self.next.fetch_add(1, Ordering::Relaxed))
        {
            let ended = one(*place, *number);
            control.encounter_done();
            let complete = {
                let mut own = self.own(*place);
                own.runs.insert(*number, ended);
                own.missing -= 1;
                own.is_fresh = true;
                own.missing == 0
            };
            // Nobody listens where the search has ended.
            if complete && written.send(self.keep(*place)).is_err() {
                break;
            }
        }
    }

    /// Keeps what this shard has of a part.
    fn keep(&self, place: usize) -> Result<(), Error> {
        let runs = {
            let mut own = self.own(place);
            own.is_fresh = false;
            std::mem::take(&mut own.runs)
        };
        let Part { store, name, numbers } = &self.parts[place];
        store.write(name, numbers, self.shard, runs)
    }

    /// Keeps the runs of parts that were not finished.
    fn keep_unfinished(&self) -> Result<(), Error> {
        (0..self.parts.len())
            .filter(|place| self.own(*place).is_fresh)
            .try_for_each(|place| self.keep(place))
    }

    fn own(&self, place: usize) -> MutexGuard<'_, Own> {
        self.own[place].lock().unwrap_or_else(PoisonError::into_inner)
    }
}
