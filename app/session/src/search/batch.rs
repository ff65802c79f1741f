//! Runs of a search on several threads and shards; runs that are stored already are read.
//!
//! Runs are divided into parts, and each shard stores a part in one file. Threads continue with the next part without waiting for
//! the others, so that a long run delays none of them; parts are passed on in order, once all shards have stored theirs.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Instant;

use crate::campaign::control::{ContactTime, Control};
use crate::campaign::pool::Shard;
use crate::campaign::pool::{self, Failure, Next, POLL, Work};
use crate::error::Error;
use crate::task::lock;

use super::Effort;
use super::ending::RunEnding;
use super::folder::Store;

/// Runs that are stored together.
pub(super) struct Part<'a> {
    /// Where.
    pub(super) store: &'a Store,
    /// Under which name.
    pub(super) name: &'a str,
    /// Which numbers of that name.
    pub(super) numbers: Range<u32>,
}

/// Runs the numbers of all parts by `one(part, number)`: reads stored runs, runs those of this shard and waits for those of other
/// shards. Passes each part with its place to `take`, in order. False if the control ended the search before all parts were
/// complete; their runs are stored.
/// Errors: a folder that cannot be read or written.
pub(super) fn run(
    parts: &[Part<'_>],
    effort: &Effort,
    control: &Control,
    one: impl Fn(usize, u32) -> RunEnding + Sync,
    mut take: impl FnMut(usize, Vec<RunEnding>),
) -> Result<bool, Error> {
    let (stored, news) = channel();
    let runs = Runs::find(parts, effort.shard, control, one, stored)?;
    let threads = effort.threads.clamp(1, runs.missing.len().max(1));
    let collect = |failure: &Failure| collect(parts, control, failure, &news, &mut take);
    let all = pool::run(&runs, threads, control, collect);
    // The runs of unfinished parts are stored too.
    (0..parts.len())
        .filter(|place| lock(&runs.own[*place]).is_fresh)
        .try_for_each(|place| runs.store(place))?;
    all
}

/// Waits for each part in order and passes it on; false if the control or a failure ended the runs before.
fn collect(
    parts: &[Part<'_>],
    control: &Control,
    failure: &Failure,
    news: &Receiver<()>,
    take: &mut impl FnMut(usize, Vec<RunEnding>),
) -> Result<bool, Error> {
    for (place, part) in parts.iter().enumerate() {
        loop {
            let runs = part.store.read(part.name, &part.numbers)?;
            if runs.len() == part.numbers.len() {
                take(place, runs.into_values().collect());
                break;
            }
            if !control.may_continue() || failure.is_there() {
                return Ok(false);
            }
            // A timeout: another shard may have stored its runs.
            let _ = news.recv_timeout(POLL);
        }
    }
    Ok(true)
}

/// The runs of this shard.
struct Runs<'a, R> {
    parts: &'a [Part<'a>],
    shard: Shard,
    control: &'a Control,
    /// Runs a number of a part.
    one: R,
    /// Part and number of the missing runs, in order.
    missing: Vec<(usize, u32)>,
    /// Place of the next one.
    next: AtomicUsize,
    /// The runs of each part.
    own: Vec<Mutex<Own>>,
    /// Notified when a part is stored.
    stored: Sender<()>,
}

/// The runs of this shard in a part.
struct Own {
    runs: BTreeMap<u32, RunEnding>,
    /// Number of runs that are missing.
    missing: usize,
    /// Whether some of the runs are not stored yet.
    is_fresh: bool,
}

impl<'a, R> Runs<'a, R> {
    /// Reads stored runs and finds the missing ones.
    fn find(
        parts: &'a [Part<'a>],
        shard: Shard,
        control: &'a Control,
        one: R,
        stored: Sender<()>,
    ) -> Result<Self, Error> {
        let (mut missing, mut own) = (Vec::new(), Vec::new());
        for (place, part) in parts.iter().enumerate() {
            let mut runs = part.store.read(part.name, &part.numbers)?;
            control.encounters_found(runs.len());
            let is_missing = |number: &u32| shard.holds(*number) && !runs.contains_key(number);
            let here: Vec<u32> = part.numbers.clone().filter(is_missing).collect();
            runs.retain(|number, _| shard.holds(*number));
            own.push(Mutex::new(Own { runs, missing: here.len(), is_fresh: false }));
            missing.extend(here.into_iter().map(|number| (place, number)));
        }
        Ok(Self { parts, shard, control, one, missing, next: AtomicUsize::new(0), own, stored })
    }

    /// Stores the runs of a part.
    fn store(&self, place: usize) -> Result<(), Error> {
        let runs = {
            let mut own = lock(&self.own[place]);
            own.is_fresh = false;
            std::mem::take(&mut own.runs)
        };
        let Part { store, name, numbers } = &self.parts[place];
        store.write(name, numbers, self.shard, runs)
    }
}

impl<R: Fn(usize, u32) -> RunEnding + Sync> Work for Runs<'_, R> {
    type Piece = (usize, u32);

    fn next(&self) -> Result<Next<(usize, u32)>, Error> {
        let next = self.missing.get(self.next.fetch_add(1, Ordering::Relaxed));
        Ok(next.map_or(Next::Nothing, |piece| Next::Run(*piece)))
    }

    fn run(&self, (place, number): (usize, u32)) -> Result<bool, Error> {
        let start = Instant::now();
        let ended = (self.one)(place, number);
        self.control.encounter_done(start.elapsed(), ContactTime::default());
        let is_complete = {
            let mut own = lock(&self.own[place]);
            own.runs.insert(number, ended);
            own.missing -= 1;
            own.is_fresh = true;
            own.missing == 0
        };
        if is_complete {
            self.store(place)?;
            // The receiver is gone once the search has ended.
            let _ = self.stored.send(());
        }
        Ok(true)
    }
}
