//! Pause, cancellation and progress of a study or a search, from any thread.

use std::sync::{Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::task::lock;

/// A number of encounters or blocks, and how many of them are done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Number done, including the found ones.
    pub done: u32,
    /// Number that an earlier run or another process has done.
    pub found: u32,
    /// All of them.
    pub total: u32,
}

impl Count {
    /// None done of a total.
    pub(crate) fn of(total: usize) -> Self {
        Self { total: u32::try_from(total).unwrap_or(u32::MAX), ..Self::default() }
    }
}

/// Processing time of encounters on one thread.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pace {
    /// Encounters that were timed.
    pub encounters: u32,
    sum_s: f64,
    squares_s2: f64,
    contact: ContactTime,
}

/// Simulated time in contact, on which most of the processing time is spent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactTime {
    /// Of one encounter, or the sum over several [s].
    pub spent_s: f64,
    /// Greatest time that the rules allow in one encounter; 0 without such rules [s].
    pub longest_s: f64,
}

impl Pace {
    /// Adds an encounter.
    pub fn add(&mut self, took: Duration, contact: ContactTime) {
        let took_s = took.as_secs_f64();
        self.encounters += 1;
        self.sum_s += took_s;
        self.squares_s2 += took_s * took_s;
        self.contact.spent_s += contact.spent_s;
        self.contact.longest_s = self.contact.longest_s.max(contact.longest_s);
    }

    /// Mean time of an encounter; `None` before the first [s].
    pub fn mean_s(&self) -> Option<f64> {
        (self.encounters > 0).then(|| self.sum_s / f64::from(self.encounters))
    }

    /// Factor by which the true mean may be greater or smaller; `None` for fewer than three encounters, or before the first contact if
    /// the rules limit its time. Times have a long tail, so that the range is one of ratios.
    ///
    /// It is `1 + max(2 s / (m √n), 3 L / C)`: n encounters with mean m and standard deviation s, time in contact C of all of them, and
    /// its greatest value L in one. The second term is for encounters that last longest: where none of n does, their share may still be
    /// 3 / n with 95 % confidence (rule of three), and each takes L n / C times the mean if processing time follows time in contact.
    pub fn factor(&self) -> Option<f64> {
        Some(1.0 + self.spread()?.max(self.unseen()?))
    }

    /// Number of encounters after which that factor is expected to be at most `factor`.
    pub fn encounters_for(&self, factor: f64) -> Option<f64> {
        let excess = factor - 1.0;
        debug_assert!(excess > 0.0);
        let by_spread = (self.spread()? / excess).powi(2);
        Some(f64::from(self.encounters) * by_spread.max(self.unseen()? / excess))
    }

    /// Two standard errors of the mean time, in means.
    fn spread(&self) -> Option<f64> {
        let (count, mean_s) = (f64::from(self.encounters), self.mean_s()?);
        if self.encounters < 3 || mean_s <= 0.0 {
            return None;
        }
        let variance = (self.squares_s2 - count * mean_s * mean_s).max(0.0) / (count - 1.0);
        Some(2.0 * (variance / count).sqrt() / mean_s)
    }

    /// Greatest share that encounters of the greatest length can add to the mean if none is among those timed.
    fn unseen(&self) -> Option<f64> {
        let ContactTime { spent_s, longest_s } = self.contact;
        if longest_s <= 0.0 {
            return Some(0.0);
        }
        (spent_s > 0.0).then(|| 3.0 * longest_s / spent_s)
    }
}

/// The progress of a campaign.
#[derive(Clone, Copy, Debug, Default)]
pub struct Progress {
    /// Encounters of the shard.
    pub encounters: Count,
    /// Blocks of encounters of the shard; a block counts when it is written.
    pub blocks: Count,
    /// Times of the encounters that this process ran.
    pub pace: Pace,
    /// Blocks of other processes for which it waits, once all others are done.
    pub elsewhere: u32,
    /// Time at work until the last pause.
    worked: Duration,
    /// When work began or was resumed; `None` while it is paused or has ended.
    since: Option<Instant>,
    /// When the last encounter ended.
    ended: Option<Instant>,
}

impl Progress {
    /// Time left at the mean pace so far; `None` before the first encounter is done.
    pub fn left(&self) -> Option<Duration> {
        let Count { done, found, total } = self.encounters;
        let fresh = done.saturating_sub(found);
        let worked = self.worked + self.since.map_or(Duration::ZERO, |since| since.elapsed());
        (fresh > 0)
            .then(|| worked.mul_f64(f64::from(total.saturating_sub(done)) / f64::from(fresh)))
    }

    /// Range of the time left, by the spread of the encounters' times; `None` before the third encounter is done.
    pub fn left_range(&self) -> Option<[Duration; 2]> {
        let (left, factor) = (self.left()?, self.pace.factor()?);
        Some([left.div_f64(factor), left.mul_f64(factor)])
    }

    /// Time for which the encounters in progress have run since the last one ended, or since work began or was resumed; `None` while
    /// none runs.
    pub fn since_last(&self) -> Option<Duration> {
        let began = self.since?;
        Some(self.ended.map_or(began, |ended| ended.max(began)).elapsed())
    }

    /// Share of the encounters that are done, 0 to 1.
    pub fn share(&self) -> f32 {
        let Count { done, total, .. } = self.encounters;
        if total == 0 { 0.0 } else { done as f32 / total as f32 }
    }

    fn stop_clock(&mut self) {
        self.worked += self.since.take().map_or(Duration::ZERO, |since| since.elapsed());
    }
}

/// The last request to the campaign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wish {
    Run,
    Pause,
    Cancel,
}

/// Called with each progress.
type Watcher = Box<dyn Fn(&Progress) + Send + Sync>;

/// Controls one campaign.
pub struct Control {
    wish: Mutex<Wish>,
    changed: Condvar,
    progress: Mutex<Progress>,
    /// Locked while it is called, so that it sees progress in order.
    watcher: Mutex<Watcher>,
}

impl Default for Control {
    fn default() -> Self {
        Self::new(|_| {})
    }
}

impl Control {
    /// A control of a campaign that may run. `watcher` is called at the start, after each encounter and after each block, from the
    /// threads that run them.
    pub fn new(watcher: impl Fn(&Progress) + Send + Sync + 'static) -> Self {
        Self {
            wish: Mutex::new(Wish::Run),
            changed: Condvar::new(),
            progress: Mutex::default(),
            watcher: Mutex::new(Box::new(watcher)),
        }
    }

    /// Pauses after the encounters in progress. A cancelled campaign stays cancelled.
    pub fn pause(&self) {
        self.ask(Wish::Pause);
        lock(&self.progress).stop_clock();
    }

    /// Resumes a paused campaign.
    pub fn resume(&self) {
        self.ask(Wish::Run);
        let mut progress = lock(&self.progress);
        if progress.encounters.total > 0 && progress.since.is_none() {
            progress.since = Some(Instant::now());
        }
    }

    /// Ends the campaign; encounters in progress are dropped. Stored blocks stay.
    pub fn cancel(&self) {
        self.ask(Wish::Cancel);
        lock(&self.progress).stop_clock();
    }

    fn ask(&self, wish: Wish) {
        let mut now = lock(&self.wish);
        if *now != Wish::Cancel {
            *now = wish;
        }
        self.changed.notify_all();
    }

    /// Whether it is paused.
    pub fn is_paused(&self) -> bool {
        *lock(&self.wish) == Wish::Pause
    }

    /// Whether it is cancelled.
    pub fn is_cancelled(&self) -> bool {
        *lock(&self.wish) == Wish::Cancel
    }

    /// Its progress.
    pub fn progress(&self) -> Progress {
        *lock(&self.progress)
    }

    /// Waits while it is paused; then false if it is cancelled.
    pub(crate) fn may_continue(&self) -> bool {
        let mut wish = lock(&self.wish);
        while *wish == Wish::Pause {
            wish = self.changed.wait(wish).unwrap_or_else(PoisonError::into_inner);
        }
        *wish == Wish::Run
    }

    /// Begins to count; the clock runs unless the campaign is paused or cancelled.
    pub(crate) fn begin(&self, encounters: Count, blocks: Count) {
        let runs = *lock(&self.wish) == Wish::Run;
        let since = runs.then(Instant::now);
        self.note(|progress| {
            *progress = Progress { encounters, blocks, since, ..Progress::default() };
        });
    }

    /// Changes the number of encounters that are to be done.
    pub(crate) fn expect(&self, encounters: usize) {
        let Count { total, .. } = Count::of(encounters);
        if self.progress().encounters.total != total {
            self.note(|progress| progress.encounters.total = total);
        }
    }

    /// Counts encounters that an earlier run has done.
    pub(crate) fn encounters_found(&self, count: usize) {
        let count = u32::try_from(count).unwrap_or(u32::MAX);
        self.note(|progress| {
            progress.encounters.done += count;
            progress.encounters.found += count;
        });
    }

    /// Counts blocks, with their encounters, that another process has run.
    pub(crate) fn blocks_found(&self, blocks: u32, encounters: u32) {
        self.note(|progress| {
            for (count, found) in
                [(&mut progress.blocks, blocks), (&mut progress.encounters, encounters)]
            {
                count.done += found;
                count.found += found;
            }
        });
    }

    /// Sets the number of other processes' blocks for which this process waits; 0 ends the wait.
    pub(crate) fn waits_for(&self, others: u32) {
        if self.progress().elsewhere != others {
            self.note(|progress| progress.elsewhere = others);
        }
    }

    /// Counts an encounter that took this time of a thread.
    pub(crate) fn encounter_done(&self, took: Duration, contact: ContactTime) {
        self.note(|progress| {
            progress.encounters.done += 1;
            progress.ended = Some(Instant::now());
            progress.pace.add(took, contact);
        });
    }

    /// Counts a block.
    pub(crate) fn block_done(&self) {
        self.note(|progress| progress.blocks.done += 1);
    }

    /// Stops the clock.
    pub(crate) fn end(&self) {
        lock(&self.progress).stop_clock();
    }

    fn note(&self, change: impl FnOnce(&mut Progress)) {
        let watcher = lock(&self.watcher);
        let progress = {
            let mut progress = lock(&self.progress);
            change(&mut progress);
            *progress
        };
        watcher(&progress);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Encounters of 1, 2 and 6 s: mean 3 s, standard deviation √7 s.
    #[test]
    fn the_range_of_a_mean_is_two_standard_errors() {
        let mut pace = Pace::default();
        assert_eq!((pace.mean_s(), pace.factor()), (None, None));
        for seconds in [1, 2, 6] {
            pace.add(Duration::from_secs(seconds), ContactTime::default());
        }
        let expected = 1.0 + 2.0 * (7.0_f64 / 3.0).sqrt() / 3.0;
        assert!((pace.mean_s().unwrap() - 3.0).abs() < 1e-12);
        assert!((pace.factor().unwrap() - expected).abs() < 1e-12);
        // Four times as many encounters halve the standard error.
        let half = 1.0 + 0.5 * (expected - 1.0);
        assert!((pace.encounters_for(half).unwrap() - 12.0).abs() < 1e-9);
    }

    /// One encounter of 60 lasts 10 s in contact, the others 2 s; one of 600 s, of which none was seen, may be 3 of 60.
    #[test]
    fn the_range_covers_long_encounters_that_were_not_seen() {
        let mut pace = Pace::default();
        let contact = |spent_s| ContactTime { spent_s, longest_s: 600.0 };
        for _ in 0..3 {
            pace.add(Duration::from_secs(1), contact(0.0));
        }
        assert_eq!(pace.factor(), None);
        for _ in 3..59 {
            pace.add(Duration::from_secs(1), contact(2.0));
        }
        pace.add(Duration::from_secs(1), contact(8.0));
        let mean_with_unseen = (60.0 * 1.0 + 3.0 * 600.0 * 60.0 / 120.0) / 60.0;
        assert!((pace.factor().unwrap() - mean_with_unseen).abs() < 1e-9);
        assert!((pace.encounters_for(1.5).unwrap() - 60.0 * 15.0 / 0.5).abs() < 1e-9);
    }
}
