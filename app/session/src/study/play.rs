//! One encounter played: every option meets it.

use std::cmp::Ordering;

use endline_sim::metrics::Summary;

use crate::error::Error;
use crate::report::Report;
use crate::run::{Moment, Run, RunOptions};
use crate::source::Prepared;

use super::branch::{self, Watch};
use super::equivalence::{least_strength_n, same_run};
use super::open::Opened;
use super::ready::Ready;
use super::row::row;
use crate::encounters::Encounter;
use crate::encounters::equilibria::fitted;
use crate::table::Row;

/// Time after which a run that has stayed invalid is given up: what has crossed stays crossed, and what presses too hard goes on doing so [s].
const INVALID_FOR_S: f64 = 60.0;

/// Frames kept for each second of a run that is replayed.
pub const REPLAY_HZ: f64 = 10.0;

/// A run of an encounter, at its end.
pub struct Played {
    /// The run.
    pub run: Run,
    /// Its summary.
    pub report: Report,
}

/// What a run came to, for options that may have the same, or the same until something parts.
struct Came {
    option: usize,
    run: Run,
    summary: Summary,
    report: Report,
    parted: Vec<(usize, Moment)>,
}

impl Opened {
    /// Rows of every option in encounter `index`, in the order of the options; none where `goes_on` says on the way that nobody
    /// wants them any more.
    #[must_use]
    pub fn rows(&self, index: u32, goes_on: &dyn Fn() -> bool) -> Option<Vec<Row>> {
        let ready = Ready::new(self, index);
        let mut rows: Vec<Row> = vec![Row::new(); self.options.len()];
        let mut came: Vec<Came> = Vec::new();
        let order = self.by_falling_strength();
        for (place, option) in order.iter().copied().enumerate() {
            if let Some(twin) = came.iter().find(|came| is_twin(&ready, option, came)) {
                rows[option] = row(self, option, &ready.encounter, Ok(&twin.report));
                continue;
            }
            let ended = self.came(&ready, option, &order[place + 1..], &came, goes_on);
            if !goes_on() {
                return None;
            }
            rows[option] = row(
                self,
                option,
                &ready.encounter,
                ended.as_ref().map(|came| &came.report).map_err(String::as_str),
            );
            came.extend(ended.ok());
        }
        Some(rows)
    }

    /// The run of an option, begun where it parts ways with one that came before if it can be; watched for those that come after.
    fn came(
        &self,
        ready: &Ready<'_>,
        option: usize,
        after: &[usize],
        came: &[Came],
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Came, String> {
        let prepared = ready.option(option)?;
        let begun =
            came.iter().find_map(|came| branch::begun(option, prepared, &came.run, &came.parted));
        let begin = || {
            self.begin(option, &ready.encounter, prepared.clone(), 0.0)
                .map_err(|error| error.to_string())
        };
        let mut run = begun.map_or_else(begin, Ok)?;
        let mut watch = Watch::new(ready, option, after);
        self.to_its_end_while(&mut run, |run| {
            watch.look(run);
            goes_on()
        });
        Ok(Came {
            option,
            summary: run.summary(),
            report: Report::from_run(&run),
            parted: watch.parted,
            run,
        })
    }

    /// Options, the strongest first: it is the one whose run others may share.
    fn by_falling_strength(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.options.len()).collect();
        let strength =
            |option: &usize| least_strength_n(&self.options[*option].prepared.model.spec);
        order.sort_by(|one, other| {
            strength(other).partial_cmp(&strength(one)).unwrap_or(Ordering::Equal)
        });
        order
    }

    /// Plays an option in an encounter to its end.
    ///
    /// # Errors
    /// Faults of the scenario so made, or gear that does not come to rest.
    pub fn play(
        &self,
        option: usize,
        encounter: &Encounter,
        frames_hz: f64,
    ) -> Result<Played, Error> {
        self.play_watched(option, encounter, frames_hz, |_| {})
    }

    /// The same, looked at twice a second of its time.
    ///
    /// # Errors
    /// As [`play`](Self::play).
    pub fn play_watched(
        &self,
        option: usize,
        encounter: &Encounter,
        frames_hz: f64,
        look: impl FnMut(&Run),
    ) -> Result<Played, Error> {
        let prepared = self.prepare(option, encounter)?;
        self.play_prepared(option, encounter, prepared, frames_hz, look)
    }

    /// Plays an encounter as prepared.
    ///
    /// # Errors
    /// Gear that does not come to rest.
    pub(super) fn play_prepared(
        &self,
        option: usize,
        encounter: &Encounter,
        prepared: Prepared,
        frames_hz: f64,
        look: impl FnMut(&Run),
    ) -> Result<Played, Error> {
        let mut run = self.begin(option, encounter, prepared, frames_hz)?;
        self.to_its_end(&mut run, look);
        let report = Report::from_run(&run);
        Ok(Played { run, report })
    }

    /// A run of an option at its start, its gear at rest.
    fn begin(
        &self,
        option: usize,
        encounter: &Encounter,
        prepared: Prepared,
        frames_hz: f64,
    ) -> Result<Run, Error> {
        let equilibrium = self.equilibrium(option, encounter)?;
        let settled = fitted(&equilibrium, &prepared.model);
        if !settled.converged {
            return Err(Error::Unsettled { why: settled.why(), passes: settled.trace_n.len() });
        }
        Ok(Run::from_settled(prepared, RunOptions { unsettled: false, frames_hz }, settled))
    }

    /// Takes a run to its end, looking at it now and then.
    fn to_its_end(&self, run: &mut Run, mut look: impl FnMut(&Run)) {
        self.to_its_end_while(run, |run| {
            look(run);
            true
        });
    }

    /// The same while each look says to go on.
    fn to_its_end_while(&self, run: &mut Run, mut look: impl FnMut(&Run) -> bool) {
        run.to_end_until(|run| {
            if !run.is_time_to_look() {
                return false;
            }
            let invalid = run.stays_invalid(INVALID_FOR_S);
            if !look(run) || run.is_over(&self.study.run) {
                return true;
            }
            if let Some(reason) = &invalid {
                run.give_up(&format!("it stayed invalid for {INVALID_FOR_S} s: {reason}"));
            }
            invalid.is_some()
        });
    }
}

/// Whether an option has the run of another that came before.
fn is_twin(ready: &Ready<'_>, option: usize, came: &Came) -> bool {
    let exactly = || {
        ready
            .option(option)
            .is_ok_and(|prepared| same_run(&prepared.model, came.run.model(), &came.summary))
    };
    ready.opened.is_family(option, came.option)
        && (ready.opened.surely(option, came.option, &came.run, &came.summary) || exactly())
}
