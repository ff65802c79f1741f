//! Runs begun midway: options that differ in strengths alone part ways only when the first of their strengths is passed.
//!
//! While a run goes on, it is seen whether the options that wait for it would still have the same one (`equivalence.rs`). Where one
//! would no longer, the moment of the look before is kept for it: its own run goes on from there.

use std::cell::OnceCell;

use endline_sim::metrics::Summary;

use crate::run::{Moment, Run};
use crate::source::Prepared;

use super::equivalence::{same_so_far, same_until_parting, surely_same_run};
use super::open::Opened;
use super::ready::Ready;

/// The options that wait for a run, and where each of them parts ways with it.
pub(super) struct Watch<'a> {
    ready: &'a Ready<'a>,
    option: usize,
    waiting: Vec<Waiting>,
    last: Option<Moment>,
    /// By option that has parted ways: the last moment at which it had not.
    pub(super) parted: Vec<(usize, Moment)>,
}

/// An option that waits.
struct Waiting {
    option: usize,
    /// Whether its model differs in strengths alone, once it was asked.
    alike: OnceCell<bool>,
}

impl<'a> Watch<'a> {
    /// Watches the run of an option for others of its family.
    pub(super) fn new(ready: &'a Ready<'a>, option: usize, others: &[usize]) -> Self {
        let own = others.iter().copied().filter(|other| ready.opened.is_family(*other, option));
        let waiting = own.map(|option| Waiting { option, alike: OnceCell::new() }).collect();
        Self { ready, option, waiting, last: None, parted: Vec::new() }
    }

    /// Looks at the run as it stands.
    pub(super) fn look(&mut self, run: &Run) {
        if self.waiting.is_empty() {
            return;
        }
        let summary = run.summary();
        let all = std::mem::take(&mut self.waiting);
        let (waiting, gone): (Vec<Waiting>, Vec<Waiting>) =
            all.into_iter().partition(|other| self.is_same(other, run, &summary));
        self.waiting = waiting;
        if let Some(last) = &self.last {
            self.parted.extend(gone.iter().map(|other| (other.option, last.clone())));
        }
        if !self.waiting.is_empty() {
            self.last = Some(run.moment());
        }
    }

    fn is_same(&self, other: &Waiting, run: &Run, summary: &Summary) -> bool {
        let exactly = |prepared: &Prepared| {
            same_so_far(&prepared.model, summary)
                && *other.alike.get_or_init(|| same_until_parting(&prepared.model, run.model()))
        };
        self.ready.opened.surely(other.option, self.option, run, summary)
            || self.ready.option(other.option).is_ok_and(exactly)
    }
}

impl Opened {
    /// Whether two options differ in strengths alone.
    pub(super) fn is_family(&self, one: usize, other: usize) -> bool {
        self.families[one] == self.families[other]
    }

    /// Whether an option has the same run as another of its family that came to `summary`, decided without assembling it.
    pub(super) fn surely(&self, option: usize, other: usize, run: &Run, summary: &Summary) -> bool {
        let bare = |option: usize| &self.options[option].prepared.model.spec;
        surely_same_run([bare(option), bare(other)], run.model(), summary)
    }
}

/// The run of an option begun where it parts ways with another's, if it is known where.
pub(super) fn begun(
    option: usize,
    prepared: &Prepared,
    run: &Run,
    parted: &[(usize, Moment)],
) -> Option<Run> {
    let (_, moment) = parted.iter().find(|(other, _)| *other == option)?;
    let same = same_until_parting(&prepared.model, run.model());
    same.then(|| run.branched(moment, prepared.clone()).ok()).flatten()
}
