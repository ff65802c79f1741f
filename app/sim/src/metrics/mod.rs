//! Metrics of a run: tensions, bodies, probes, and the effects of rope on the whale.
//!
//! [`Metrics`] are updated once after every step. They depend only on the model, the state and the results of the step, so that
//! a live run and its replay give the same numbers. Fold the initial state first to include it in means and peaks.
//! Definitions and thresholds: `docs/entanglement.md`.

mod bodies;
mod events;
mod flukes;
mod knots;
mod lines;
mod loads;
mod mouth;
mod pressure;
mod probes;
mod route;
mod summary;
mod trailing;
mod whale;
mod whale_momentum;
mod winding;
mod wraps;

#[cfg(test)]
pub(crate) mod tests;

use crate::contact::ContactPoint;
use crate::contact::body_on_skin::sums::BodySums;
use crate::contact::rope_on_rope::RopeTouch;
use crate::contact::rope_on_skin::step_sums::{SkinContact, StepSums};
use crate::model::Model;
use crate::state::State;
use crate::step::Workspace;
use lines::Peaks;

pub use bodies::{CAUGHT_S, DRAGGED_M};
pub use events::{Event, EventKind, HOOKED_TURNS, LONG_CONTACT_S, LOST_S, RELEASE_S};
pub use flukes::TURN_SHARE;
pub use knots::HELD_N;
pub use lines::{TENSION_BIN_M, end_tension};
pub use loads::DRAG_WINDOW_S;
pub use mouth::LODGED_S;
pub use probes::{energy, reading, unit};
pub use route::{LeadsTo, Route, RouteEnd, Station, routes};
pub use summary::{
    ANCHORED_M_S, BeatSummary, BodyOnWhale, BodySummary, CONSTRICTING_TURNS, KineticSummary,
    LineSummary, LinkSummary, Outcome, PatchSummary, ProbeSummary, RegionSummary, RopePlace,
    Summary, TRAILING_M, WhaleSummary,
};
pub use whale_momentum::{MADE_GOOD_S, MomentumBalance};
pub use winding::{ACROSS_GAP_M, BESIDE_M, BRIDGED_GAP_M, LEAST_ACROSS, WINDING_JUMP};
pub use wraps::LOOSE_M;

/// Metrics of a run, updated step by step.
#[derive(Clone, Debug)]
pub struct Metrics {
    time_s: f64,
    lines: lines::LineMeter,
    bodies: bodies::BodyMeter,
    probes: probes::ProbeMeter,
    whale: Option<whale::WhaleMeter>,
    knots: knots::KnotMeter,
    log: events::Log,
}

impl Metrics {
    /// Metrics before the start of a run.
    pub fn new(model: &Model) -> Self {
        Self {
            time_s: 0.0,
            lines: lines::LineMeter::new(model),
            bodies: bodies::BodyMeter::new(model),
            probes: probes::ProbeMeter::new(model),
            whale: whale::WhaleMeter::new(model),
            knots: knots::KnotMeter::new(model),
            log: events::Log::default(),
        }
    }

    /// Adds the last step of `workspace`, which ended at `state`: its contacts and the greatest tensions of its solver steps,
    /// so that a peak between two states or at a parting is included.
    pub fn fold_step(&mut self, model: &Model, state: &State, workspace: &Workspace) {
        let Workspace { contacts, peak_tension_n, unconverged_peak_n, sums, body_sums, .. } =
            workspace;
        let peaks = Peaks { converged_n: peak_tension_n, unconverged_n: unconverged_peak_n };
        let (contact, ropes) = (SkinContact { contacts, sums }, &workspace.rope_touches);
        self.take(model, state, (contact, ropes), body_sums, &peaks);
    }

    /// Adds a state and its contacts without a step: tensions are those of the state.
    ///
    /// Means and work are weighted by the time since the previous fold, or since 0 at the first.
    pub fn fold(&mut self, model: &Model, state: &State, contacts: &[ContactPoint]) {
        let step_s = (state.time_s - self.time_s).max(0.0);
        let sums =
            model.spec.whale.as_ref().map(|whale| StepSums::of(&whale.skin, contacts, step_s));
        let sums = sums.unwrap_or_default();
        let peaks = Peaks { converged_n: &state.rope.tension, unconverged_n: &[] };
        let contact = SkinContact { contacts, sums: &sums };
        self.take(model, state, (contact, &[]), &BodySums::default(), &peaks);
    }

    fn take(
        &mut self,
        model: &Model,
        state: &State,
        (contact, ropes): (SkinContact<'_>, &[RopeTouch]),
        on_whale: &BodySums,
        peaks: &Peaks<'_>,
    ) {
        let dt_s = (state.time_s - self.time_s).max(0.0);
        self.time_s = state.time_s;
        self.lines.fold(model, state, peaks, &mut self.log);
        self.bodies.fold(model, state, (on_whale, dt_s), &mut self.log);
        self.probes.fold(model, state, dt_s);
        self.knots.fold(model, state, (contact.contacts, ropes), dt_s, &mut self.log);
        if let Some(meter) = &mut self.whale {
            meter.fold(model, state, contact, dt_s, &mut self.log);
        }
    }

    /// Metrics so far; `state` is that of the last fold.
    pub fn summary(&self, model: &Model, state: &State) -> Summary {
        let bodies = self.bodies.summary(model, state);
        Summary {
            lines: self.lines.lines(model, state, self.whale.as_ref()),
            links: self.lines.links(model, state),
            probes: self.probes.summary(model),
            whale: self.whale.as_ref().map(|whale| whale.summary(model, state, &bodies)),
            bodies,
        }
    }

    /// Events so far, in the order of time.
    pub fn events(&self) -> &[Event] {
        &self.log.events
    }
}
