//! Measures of a run: tensions, bodies, probes, and what the rope did to the whale.
//!
//! A [`Metrics`] is folded over a run, once after every step, and reads nothing but the model, the
//! state and what the step left for readers: live and in replay it gives the same numbers. Fold the
//! start state first to have it in means and peaks. Definitions and thresholds: `docs/entanglement.md`.

mod along;
mod bodies;
mod body_on_whale;
mod books;
mod drag;
mod energy;
mod event;
mod extent;
mod flukes;
mod gear_loads;
mod knots;
mod lines;
mod made_good;
mod mouth;
mod outcome;
mod press;
mod probes;
mod regions;
mod route;
mod summary;
mod touches;
mod trailing;
mod twist;
mod unchanged;
mod whale;
mod winding;
mod window;
mod wraps;

#[cfg(test)]
pub(crate) mod tests;

pub use bodies::DRAGGED_M;
pub use body_on_whale::CAUGHT_S;
pub use books::WhaleBooks;
pub use energy::energy;
pub use event::{Event, EventKind};
pub use flukes::TURN_SHARE;
pub use knots::HELD_N;
pub use lines::end_tension;
pub use made_good::MADE_GOOD_S;
pub use mouth::LODGED_S;
pub use outcome::{LONG_CONTACT_S, LOST_S, RELEASE_S};
pub use probes::{reading, unit};
pub use route::{LeadsTo, Route, RouteEnd, Station, routes};
pub use summary::{
    BeatSummary, BodyOnWhale, BodySummary, KineticSummary, LineSummary, LinkSummary, Outcome,
    PatchSummary, ProbeSummary, RegionSummary, Summary, WhaleSummary,
};
pub use twist::BESIDE_M;
pub use winding::{BRIDGED_GAP_M, WINDING_JUMP};
pub use window::DRAG_WINDOW_S;
pub use wraps::LOOSE_M;

use crate::contact::ContactPoint;
use crate::contact::body_on_skin::sums::BodySums;
use crate::contact::rope_on_rope::RopeTouch;
use crate::contact::rope_on_skin::step_sums::{SkinContact, StepSums};
use crate::model::Model;
use crate::state::State;
use crate::step::Workspace;
use lines::Peaks;

/// The measures of a run, folded step by step.
#[derive(Clone, Debug)]
pub struct Metrics {
    time_s: f64,
    lines: lines::LineMeter,
    bodies: bodies::BodyMeter,
    probes: probes::ProbeMeter,
    whale: Option<whale::WhaleMeter>,
    knots: knots::KnotMeter,
    log: event::Log,
}

impl Metrics {
    /// Measures of a run that has not begun.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        Self {
            time_s: 0.0,
            lines: lines::LineMeter::new(model),
            bodies: bodies::BodyMeter::new(model),
            probes: probes::ProbeMeter::new(model),
            whale: whale::WhaleMeter::new(model),
            knots: knots::KnotMeter::new(model),
            log: event::Log::default(),
        }
    }

    /// Takes in the step that `workspace` has just taken to `state`: its contacts, and the greatest
    /// tensions of its solver steps, so that a peak between two states or at a parting is not lost.
    pub fn fold_step(&mut self, model: &Model, state: &State, workspace: &Workspace) {
        let Workspace { contacts, peak_tension_n, unconverged_peak_n, sums, body_sums, .. } =
            workspace;
        let peaks = Peaks { converged_n: peak_tension_n, unconverged_n: unconverged_peak_n };
        let (contact, ropes) = (SkinContact { contacts, sums }, &workspace.rope_touches);
        self.take(model, state, (contact, ropes), body_sums, &peaks);
    }

    /// Takes in a state and its contacts, where there is no step: tensions are those of the state.
    ///
    /// `state` has the model's layout; the time since the fold before (since 0 at the first) is
    /// what the step weighs in means and works.
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

    /// The measures so far; `state` is that of the last fold.
    #[must_use]
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

    /// What happened so far, in the order of time.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.log.events
    }
}
