//! A trial: a run held against the observation.

use endline_gear::Observation;

use super::distance::Distance;
use super::ended::Ended;

/// Distance of a run that did not come to a valid end.
pub(super) const FAULTY: f64 = 1e3;

/// Progress of less than this is none, and an aim below it is as good as none.
pub(super) const PROGRESS: f64 = 0.05;

/// Weight of the nearest moment of a run beside its end: where ends are equally far, a search follows what came near on the way.
const ON_THE_WAY: f64 = 0.2;

/// What a trial came to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Trial {
    /// Distance of its ending from the observation; [`FAULTY`] of one that is not valid.
    pub(super) distance: f64,
    /// The least distance at any time of the run.
    pub(super) nearest: f64,
    /// The terms of the distance, each with its reason.
    pub(super) terms: Vec<(f64, String)>,
    /// Whether the ending's mirror image was held against the observation.
    pub(super) mirrored: bool,
    /// The part that rope touched first; empty where it touched none.
    pub(super) first_part: String,
    /// Whether the run came to a valid end.
    pub(super) is_valid: bool,
    /// Time simulated [s].
    pub(super) simulated_s: f64,
    /// Hash of the last state.
    pub(super) state_hash: String,
}

impl Trial {
    /// Holds a run against an observation.
    pub(super) fn of(observation: &Observation, ended: &Ended) -> Self {
        let at_end = Distance::of(observation, &ended.ending);
        let is_valid = ended.fault.is_empty();
        let distance = if is_valid { at_end.sum() } else { FAULTY };
        let before = ended.on_the_way.iter().map(|ending| Distance::of(observation, ending).sum());
        Self {
            distance,
            nearest: before.fold(distance, f64::min),
            mirrored: at_end.mirrored,
            terms: at_end.terms.into_iter().map(|term| (term.cost, term.says)).collect(),
            first_part: ended.first_part.clone(),
            is_valid,
            simulated_s: ended.simulated_s,
            state_hash: ended.state_hash.clone(),
        }
    }

    /// What a search makes small.
    pub(super) fn aim(&self) -> f64 {
        self.distance + ON_THE_WAY * self.nearest
    }
}
