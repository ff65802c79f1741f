//! A trial: an encounter run to its end and held against the observation.

use endline_sim::metrics::{EventKind, Outcome};
use serde::{Deserialize, Serialize};

use crate::run::Run;
use crate::study::Played;
use crate::study::encounter::Encounter;

use super::distance::Distance;
use super::ending::Ending;
use super::question::Question;

/// Distance of a run that did not come to a valid end.
pub(super) const FAULTY: f64 = 1e3;

/// What a trial came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Distance of its ending from the observation; [`FAULTY`] of one that is not valid.
    pub distance: f64,
    /// The least distance at any time of the run.
    pub nearest: f64,
    /// The terms of the distance, each with its reason.
    pub terms: Vec<(f64, String)>,
    /// Whether the ending's mirror image was held against the observation.
    pub mirrored: bool,
    /// The part that rope touched first; empty where it touched none.
    pub first_part: String,
    /// Outcome, such as `entangled`.
    pub outcome: String,
    /// Why it does not count; empty where it does.
    pub fault: String,
    /// Time simulated [s].
    pub simulated_s: f64,
    /// Hash of the last state.
    pub state_hash: String,
}

/// Progress of less than this is none, and an aim below it is as good as none.
pub(super) const PROGRESS: f64 = 0.05;

/// Weight of the nearest moment of a run beside its end: where ends are equally far, a search follows what came near on the way.
const ON_THE_WAY: f64 = 0.2;

impl Trial {
    /// What a search makes small.
    pub(super) fn aim(&self) -> f64 {
        self.distance + ON_THE_WAY * self.nearest
    }

    /// Runs the encounter at a point.
    pub(super) fn of(question: &Question, point: &[f64]) -> Self {
        let encounter = Encounter::at_point(&question.opened, point);
        Self::of_encounter(question, &encounter)
    }

    /// Runs an encounter.
    pub(super) fn of_encounter(question: &Question, encounter: &Encounter) -> Self {
        let mut nearest = FAULTY;
        let mut look = |run: &Run| {
            let summary = run.summary();
            let held = |outcome| matches!(outcome, Outcome::Entangled | Outcome::PartedEntangled);
            if summary.whale.is_some_and(|whale| held(whale.outcome)) {
                let now = Distance::of(&question.observation, &Ending::of(run)).sum();
                nearest = nearest.min(now);
            }
        };
        match question.opened.play_watched(0, encounter, 0.0, &mut look) {
            Ok(played) => Self::ended(question, &played, nearest),
            Err(error) => Self::without_run(error.to_string()),
        }
    }

    fn ended(question: &Question, played: &Played, nearest: f64) -> Self {
        let report = &played.report;
        let valid = report.is_valid();
        let held_against = Distance::of(&question.observation, &Ending::of(&played.run));
        let distance = if valid { held_against.sum() } else { FAULTY };
        let events = played.run.metrics().events();
        let first = events.iter().find(|event| event.kind == EventKind::Contact);
        let outcome = report.summary.whale.as_ref().map(|whale| whale.outcome.name());
        let fault = || report.stopped.clone().unwrap_or_else(|| report.invalid_because.join("; "));
        Self {
            distance,
            nearest: nearest.min(distance),
            terms: held_against.terms.into_iter().map(|term| (term.cost, term.says)).collect(),
            mirrored: held_against.mirrored,
            first_part: first.map(|event| event.subject.clone()).unwrap_or_default(),
            outcome: outcome.unwrap_or_default().to_owned(),
            fault: if valid { String::new() } else { fault() },
            simulated_s: report.simulated_s,
            state_hash: report.state_hash.clone(),
        }
    }

    fn without_run(fault: String) -> Self {
        Self {
            distance: FAULTY,
            nearest: FAULTY,
            terms: Vec::new(),
            mirrored: false,
            first_part: String::new(),
            outcome: String::new(),
            fault,
            simulated_s: 0.0,
            state_hash: String::new(),
        }
    }
}
