//! One encounter played: every option meets it.

use std::cmp::Ordering;
use std::sync::Arc;

use endline_sim::Model;
use endline_sim::metrics::{Outcome, Summary};

use crate::error::Error;
use crate::report::Report;
use crate::run::{Run, RunOptions};
use crate::source::Prepared;

use super::encounter::Encounter;
use super::open::Opened;
use super::rest::fitted;
use super::row::row;
use super::same::{least_strength_n, same_run, surely_same_run};
use super::table::Row;

/// How often a run is asked whether it is over [Hz].
const LOOKS_HZ: f64 = 2.0;

/// Frames kept for each second of a run that is replayed.
pub const REPLAY_HZ: f64 = 10.0;

/// A run of an encounter, at its end.
pub struct Played {
    /// The run.
    pub run: Run,
    /// Its summary.
    pub report: Report,
}

/// What a run came to, for options that may have the same.
struct Came {
    option: usize,
    model: Arc<Model>,
    summary: Summary,
    report: Report,
}

/// Whether an option needs a run of its own.
enum Twin {
    /// It has the run of this place among those that came before.
    Same(usize),
    /// It does.
    None(Prepared),
}

impl Opened {
    /// Rows of every option in encounter `index`, in the order of the options.
    #[must_use]
    pub fn rows(&self, index: u32) -> Vec<Row> {
        self.rows_with(index, true)
    }

    /// The same; without `sharing` each option is run whether it needs to or not.
    #[must_use]
    pub fn rows_with(&self, index: u32, sharing: bool) -> Vec<Row> {
        let encounter = Encounter::of(self, index);
        let mut rows: Vec<Row> = vec![Row::new(); self.options.len()];
        let mut came: Vec<Came> = Vec::new();
        for option in self.by_falling_strength() {
            let told = match self.twin(option, &encounter, if sharing { &came } else { &[] }) {
                Ok(Twin::Same(twin)) => {
                    rows[option] = row(self, option, &encounter, Ok(&came[twin].report));
                    continue;
                }
                Ok(Twin::None(prepared)) => self.played(option, &encounter, prepared, 0.0),
                Err(error) => Err(error),
            };
            let told = told.map_err(|error| error.to_string());
            rows[option] = row(self, option, &encounter, told.as_ref().map(|played| &played.report).map_err(String::as_str));
            if let Ok(Played { run, report }) = told {
                came.push(Came { option, model: Arc::clone(run.model()), summary: run.summary(), report });
            }
        }
        rows
    }

    /// Options, the strongest first: it is the one whose run others may share.
    fn by_falling_strength(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.options.len()).collect();
        let strength = |option: &usize| least_strength_n(&self.options[*option].prepared.model.spec);
        order.sort_by(|one, other| strength(other).partial_cmp(&strength(one)).unwrap_or(Ordering::Equal));
        order
    }

    /// A run that is this option's too; else the option ready to run.
    fn twin(&self, option: usize, encounter: &Encounter, came: &[Came]) -> Result<Twin, Error> {
        let bare = &self.options[option].prepared.model.spec;
        let surely = |came: &Came| self.families[option] == self.families[came.option] && surely_same_run(bare, &came.summary);
        if let Some(twin) = came.iter().position(surely) {
            return Ok(Twin::Same(twin));
        }
        let prepared = self.prepare(option, encounter)?;
        let twin = came.iter().position(|came| same_run(&prepared.model, &came.model, &came.summary));
        Ok(twin.map_or(Twin::None(prepared), Twin::Same))
    }

    /// Plays an option in an encounter to its end.
    ///
    /// # Errors
    /// Faults of the scenario so made, or gear that does not come to rest.
    pub fn play(&self, option: usize, encounter: &Encounter, frames_hz: f64) -> Result<Played, Error> {
        let prepared = self.prepare(option, encounter)?;
        self.played(option, encounter, prepared, frames_hz)
    }

    fn played(&self, option: usize, encounter: &Encounter, prepared: Prepared, frames_hz: f64) -> Result<Played, Error> {
        let rest = self.rest(option, encounter)?;
        let settled = fitted(&rest, &prepared.model);
        if !settled.converged {
            return Err(Error::Unsettled { why: settled.why(), passes: settled.trace_n.len() });
        }
        let mut run = Run::from_settled(prepared, RunOptions { unsettled: false, frames_hz }, settled);
        let look = (1.0 / (LOOKS_HZ * run.step_s())).round().max(1.0) as u64;
        while !run.finished() && run.step(run.pilot()).is_ok() {
            if run.state().step.is_multiple_of(look) && self.is_over(&run) {
                break;
            }
        }
        let report = Report::of(&run);
        Ok(Played { run, report })
    }

    /// Whether nothing more can happen that counts.
    fn is_over(&self, run: &Run) -> bool {
        let (rule, now) = (self.study.run, run.state().time_s);
        let Some(whale) = run.summary().whale else { return false };
        match whale.outcome {
            Outcome::NoContact => now >= rule.passed_s,
            Outcome::Shed | Outcome::PartedFree => whale.decided,
            Outcome::Entangled | Outcome::PartedEntangled => {
                whale.decided && whale.first_contact_s.is_some_and(|first| now - first >= rule.held_s)
            }
        }
    }
}
