//! One encounter with every option, and one run alone.
//!
//! Options that differ in strengths alone share a run until a part of different strength is overloaded (`equivalence.rs`). During a run
//! we test whether the weaker options of its family still share its trajectory. When one diverges, its run starts from the last
//! shared snapshot, of whichever run it shares longest.

use std::cell::OnceCell;
use std::cmp::Ordering;

use endline_sim::metrics::Summary;

use crate::encounters::Encounter;
use crate::encounters::equilibria::fitted;
use crate::error::Error;
use crate::report::Report;
use crate::run::{Moment, Run, RunOptions};
use crate::source::Prepared;
use crate::table::Row;

use super::equivalence::{
    is_certainly_same_run, least_strength_n, same_run, same_so_far, same_until_parting,
};
use super::exposure::Crossing;
use super::prepared::PreparedStudy;
use super::row::{add_track, row};

/// A run that has been invalid for this long is abandoned; invalid states do not recover [s].
const INVALID_FOR_S: f64 = 60.0;

/// Frames stored for each second of a run that is replayed.
pub const REPLAY_HZ: f64 = 10.0;

/// A run of an encounter, at its end.
pub struct Played {
    /// The run.
    pub run: Run,
    /// Its summary.
    pub report: Report,
}

/// An encounter with the models of its options, each assembled at its first use.
struct EncounterModels<'a> {
    study: &'a PreparedStudy,
    encounter: Encounter,
    options: Vec<OnceCell<Result<Prepared, String>>>,
    /// Tracks through the gear of the options, in a study with `[exposure]`.
    tracks: Vec<OnceCell<Result<Option<Crossing>, String>>>,
}

/// The run of an option at its end, which other options may share in whole or up to a snapshot.
struct OptionRun {
    option: usize,
    run: Run,
    summary: Summary,
    report: Report,
    /// Options that have diverged from this run, each with the last shared snapshot.
    diverged: Vec<(usize, Moment)>,
}

/// Whether a line or weak link has parted.
fn has_parted(summary: &Summary) -> bool {
    summary.lines.iter().any(|line| line.parted_at_s.is_some())
        || summary.links.iter().any(|link| link.parted_at_s.is_some())
}

impl PreparedStudy {
    /// Rows of every option in an encounter, in the order of the options; `None` if `is_wanted` becomes false.
    pub fn rows(&self, encounter: Encounter, is_wanted: &dyn Fn() -> bool) -> Option<Vec<Row>> {
        let models = EncounterModels::new(self, encounter);
        let mut rows: Vec<Row> = vec![Row::new(); self.options.len()];
        let mut runs: Vec<OptionRun> = Vec::new();
        let order = self.by_falling_strength();
        for (place, option) in order.iter().copied().enumerate() {
            if models.meets_nothing(option) {
                rows[option] = models.row(option, Err(""));
                continue;
            }
            if let Some(same) = runs.iter().find(|run| models.is_same_run(option, run)) {
                rows[option] = models.row(option, Ok(&same.report));
                continue;
            }
            let run = self.run_option(&models, option, &order[place + 1..], &runs, is_wanted);
            if !is_wanted() {
                return None;
            }
            let report = run.as_ref().map(|run| &run.report).map_err(String::as_str);
            rows[option] = models.row(option, report);
            runs.extend(run.ok());
        }
        Some(rows)
    }

    /// Runs an option, from the snapshot at which it diverged from an earlier run if there is one; later options are tested on the way.
    fn run_option(
        &self,
        models: &EncounterModels<'_>,
        option: usize,
        later: &[usize],
        earlier: &[OptionRun],
        is_wanted: &dyn Fn() -> bool,
    ) -> Result<OptionRun, String> {
        let prepared = models.option(option)?;
        let latest = earlier.iter().max_by_key(|run| run.shared_until(option).map(Moment::step));
        let branched = latest.and_then(|run| run.branch(option, prepared));
        let begin = || {
            self.begin(option, &models.encounter, prepared.clone(), 0.0)
                .map_err(|error| error.to_string())
        };
        let mut run = branched.map_or_else(begin, Ok)?;
        let mut sharing = Sharing::new(models, option, later);
        self.to_its_end_while(option, &mut run, |run| {
            sharing.test(run);
            is_wanted()
        });
        Ok(OptionRun {
            option,
            summary: run.summary(),
            report: Report::from_run(&run),
            diverged: sharing.diverged,
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
    /// Errors: faults of the scenario so made, or gear without an equilibrium.
    pub fn play(
        &self,
        option: usize,
        encounter: &Encounter,
        frames_hz: f64,
    ) -> Result<Played, Error> {
        self.play_watched(option, encounter, frames_hz, |_| {})
    }

    /// Plays an option in an encounter to its end; `observe` is called twice in each simulated second.
    /// Errors: as [`play`](Self::play).
    pub fn play_watched(
        &self,
        option: usize,
        encounter: &Encounter,
        frames_hz: f64,
        observe: impl FnMut(&Run),
    ) -> Result<Played, Error> {
        let prepared = self.prepare(option, encounter)?;
        self.play_prepared(option, encounter, prepared, frames_hz, observe)
    }

    /// Plays an encounter as prepared.
    /// Errors: gear without an equilibrium.
    pub(super) fn play_prepared(
        &self,
        option: usize,
        encounter: &Encounter,
        prepared: Prepared,
        frames_hz: f64,
        mut observe: impl FnMut(&Run),
    ) -> Result<Played, Error> {
        let mut run = self.begin(option, encounter, prepared, frames_hz)?;
        self.to_its_end_while(option, &mut run, |run| {
            observe(run);
            true
        });
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

    /// Runs to the end by the study's rules while `observe`, called twice in each simulated second, returns true.
    fn to_its_end_while(
        &self,
        option: usize,
        run: &mut Run,
        mut observe: impl FnMut(&Run) -> bool,
    ) {
        let until_parted = self.options[option].until_parted;
        run.to_end_until(|run| {
            if !run.is_time_to_look() {
                return false;
            }
            let invalid = run.stays_invalid(INVALID_FOR_S);
            let is_over = |run: &Run| {
                run.is_over(&self.study.run) || (until_parted && has_parted(&run.summary()))
            };
            if !observe(run) || is_over(run) {
                return true;
            }
            if let Some(reason) = &invalid {
                run.give_up(&format!("it stayed invalid for {INVALID_FOR_S} s: {reason}"));
            }
            invalid.is_some()
        });
    }

    /// Whether two options differ in strengths alone.
    fn is_family(&self, one: usize, other: usize) -> bool {
        self.families[one] == self.families[other]
    }

    /// Whether the runs of two options, which are equal so far, end alike: one that ends where something parts differs then.
    fn end_alike(&self, one: usize, other: usize, summary: &Summary) -> bool {
        self.options[one].until_parted == self.options[other].until_parted || !has_parted(summary)
    }

    /// Whether an option certainly has the run of another of its family with this summary; decided without assembling its model.
    fn is_certainly_same(&self, option: usize, other: usize, run: &Run, summary: &Summary) -> bool {
        let bare = |option: usize| &self.options[option].prepared.model.spec;
        is_certainly_same_run([bare(option), bare(other)], run.model(), summary)
    }
}

impl<'a> EncounterModels<'a> {
    fn new(study: &'a PreparedStudy, encounter: Encounter) -> Self {
        let options = study.options.iter().map(|_| OnceCell::new()).collect();
        let tracks = study.options.iter().map(|_| OnceCell::new()).collect();
        Self { study, encounter, options, tracks }
    }

    /// The track through the gear of an option, or why there is none; `None` if the study has no `[exposure]`.
    fn track(&self, option: usize) -> Result<Option<&Crossing>, &str> {
        let cross =
            || self.study.crossing(option, &self.encounter).map_err(|error| error.to_string());
        let track = self.tracks[option].get_or_init(cross);
        track.as_ref().map(Option::as_ref).map_err(String::as_str)
    }

    /// Whether the whale meets no gear on its track, so that nothing is simulated.
    fn meets_nothing(&self, option: usize) -> bool {
        matches!(self.track(option), Ok(Some(Crossing { met: None, .. })))
    }

    /// The row of an option.
    fn row(&self, option: usize, report: Result<&Report, &str>) -> Row {
        if self.study.study.exposure.is_none() {
            return row(self.study, option, &self.encounter, report);
        }
        let track = self.track(option).ok().flatten();
        let met = track.and_then(|track| track.met.as_ref());
        let encounter = met.map(|met| self.encounter.with_number("depth", met.depth_m));
        let encounter = encounter.as_ref().unwrap_or(&self.encounter);
        let mut row = row(self.study, option, encounter, report);
        add_track(&mut row, track, &self.study.options[option]);
        row
    }

    /// An option ready to run, or why it is not.
    fn option(&self, option: usize) -> Result<&Prepared, String> {
        let prepare =
            || self.study.prepare(option, &self.encounter).map_err(|error| error.to_string());
        self.options[option].get_or_init(prepare).as_ref().map_err(Clone::clone)
    }

    /// Whether an option has the run of an earlier one.
    fn is_same_run(&self, option: usize, earlier: &OptionRun) -> bool {
        let OptionRun { run, summary, .. } = earlier;
        let exactly = |prepared: &Prepared| same_run(&prepared.model, run.model(), summary);
        self.study.is_family(option, earlier.option)
            && self.study.end_alike(option, earlier.option, summary)
            && (self.study.is_certainly_same(option, earlier.option, run, summary)
                || self.option(option).is_ok_and(exactly))
    }
}

impl OptionRun {
    /// The last snapshot that an option shares with this run; `None` if it did not diverge from it.
    fn shared_until(&self, option: usize) -> Option<&Moment> {
        self.diverged.iter().find(|(other, _)| *other == option).map(|(_, moment)| moment)
    }

    /// The run of an option from the last snapshot that it shares with this one; `None` if it did not diverge from it.
    fn branch(&self, option: usize, prepared: &Prepared) -> Option<Run> {
        let moment = self.shared_until(option)?;
        let is_same = same_until_parting(&prepared.model, self.run.model());
        is_same.then(|| self.run.branched(moment, prepared.clone()).ok()).flatten()
    }
}

/// The options that share a run so far, and those that have diverged from it.
struct Sharing<'a> {
    models: &'a EncounterModels<'a>,
    option: usize,
    sharing: Vec<Follower>,
    /// The last snapshot that all of them share.
    last: Option<Moment>,
    diverged: Vec<(usize, Moment)>,
}

/// An option that shares a run so far.
struct Follower {
    option: usize,
    /// Whether its model differs in strengths alone, once this was computed.
    differs_only_in_strength: OnceCell<bool>,
}

impl<'a> Sharing<'a> {
    /// The later options of an option's family, all of which share its run at its start.
    fn new(models: &'a EncounterModels<'a>, option: usize, later: &[usize]) -> Self {
        let own = later.iter().copied().filter(|other| models.study.is_family(*other, option));
        let follower = |option| Follower { option, differs_only_in_strength: OnceCell::new() };
        let sharing = own.map(follower).collect();
        Self { models, option, sharing, last: None, diverged: Vec::new() }
    }

    /// Tests which options still share the run, and stores its snapshot for the next test.
    fn test(&mut self, run: &Run) {
        if self.sharing.is_empty() {
            return;
        }
        let summary = run.summary();
        let all = std::mem::take(&mut self.sharing);
        let (sharing, diverged): (Vec<Follower>, Vec<Follower>) =
            all.into_iter().partition(|other| self.is_same(other, run, &summary));
        self.sharing = sharing;
        if let Some(last) = &self.last {
            self.diverged.extend(diverged.iter().map(|other| (other.option, last.clone())));
        }
        if !self.sharing.is_empty() {
            self.last = Some(run.moment());
        }
    }

    fn is_same(&self, other: &Follower, run: &Run, summary: &Summary) -> bool {
        let exactly = |prepared: &Prepared| {
            same_so_far(&prepared.model, run.model(), summary)
                && *other
                    .differs_only_in_strength
                    .get_or_init(|| same_until_parting(&prepared.model, run.model()))
        };
        let study = self.models.study;
        study.end_alike(other.option, self.option, summary)
            && (study.is_certainly_same(other.option, self.option, run, summary)
                || self.models.option(other.option).is_ok_and(exactly))
    }
}
