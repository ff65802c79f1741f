//! One encounter played: every option meets it.

use std::cmp::Ordering;
use std::sync::Arc;

use endline_sim::Model;
use endline_sim::metrics::{Outcome, Summary};

use crate::error::Error;
use crate::report::Report;
use crate::run::{Run, RunOptions};

use super::encounter::Encounter;
use super::open::Opened;
use super::rest::fitted;
use super::row::row;
use super::same::{least_strength_n, same_run};
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
    model: Arc<Model>,
    summary: Summary,
    report: Report,
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
        let prepared: Vec<_> = (0..self.options.len()).map(|option| self.prepare(option, &encounter)).collect();
        let mut order: Vec<usize> = (0..self.options.len()).collect();
        let strength = |option: &usize| prepared[*option].as_ref().map_or(0.0, |prepared| least_strength_n(&prepared.model.spec));
        order.sort_by(|one, other| strength(other).partial_cmp(&strength(one)).unwrap_or(Ordering::Equal));
        let mut came: Vec<Came> = Vec::new();
        let mut rows: Vec<Row> = vec![Row::new(); self.options.len()];
        for option in order {
            let told = match &prepared[option] {
                Err(error) => Err(error.to_string()),
                Ok(prepared) => {
                    let twin = came.iter().find(|came| sharing && same_run(&prepared.model, &came.model, &came.summary));
                    if let Some(twin) = twin {
                        rows[option] = row(self, option, &encounter, Ok(&twin.report));
                        continue;
                    }
                    self.play(option, &encounter, 0.0).map_err(|error| error.to_string())
                }
            };
            rows[option] = row(self, option, &encounter, told.as_ref().map(|played| &played.report).map_err(String::as_str));
            if let Ok(Played { run, report }) = told {
                came.push(Came { model: Arc::clone(run.model()), summary: run.summary(), report });
            }
        }
        rows
    }

    /// Plays an option in an encounter to its end.
    ///
    /// # Errors
    /// Faults of the scenario so made, or gear that does not come to rest.
    pub fn play(&self, option: usize, encounter: &Encounter, frames_hz: f64) -> Result<Played, Error> {
        let prepared = self.prepare(option, encounter)?;
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
