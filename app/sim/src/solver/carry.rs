//! Carries rope and bodies along with skin that moves, as far as nothing crosses.

use glam::DVec3;

use super::{BodyTrial, Solver};
use crate::contact::workspace::ContactWorkspace;
use crate::model::Model;
use crate::state::State;

/// Most times the move of skin and rope together is cut.
const MOST_CUTS: usize = 20;

impl Solver {
    /// Puts rope and bodies back where the step begins; where they would drift to is kept as the first target.
    pub(crate) fn set_out(&mut self, state: &State) {
        self.drift.clone_from(&self.trial.place);
        self.drift_bodies.clone_from(&self.trial.bodies);
        self.trial.place.clone_from(&state.rope.position);
        self.trial.hitches.share = self.trial.hitches.span[0];
        for (trial, body) in self.trial.bodies.iter_mut().zip(&state.bodies) {
            (trial.place, trial.orientation) = (body.position, body.orientation);
        }
    }

    /// Holds the guess of a short step off the skin.
    pub(crate) fn hold_off(&mut self, model: &Model, state: &State, work: &mut ContactWorkspace) {
        work.near.hold_off(&state.rope.position, &mut self.trial.place);
        self.trial.place_ends(model, &self.plan);
        work.near.follow(&state.rope.position, &self.trial.place);
    }

    /// Places of the nodes now.
    pub(crate) fn places(&self) -> &[DVec3] {
        &self.trial.place
    }

    /// Moves skin to the end of the solver step, and rope and bodies along with it, as far as nothing crosses; the
    /// number of crossings an exact test finds.
    pub(crate) fn carry(&mut self, model: &Model, work: &mut ContactWorkspace) -> u64 {
        work.before.clone_from(&self.trial.place);
        work.bodies_before.clone_from(&self.trial.bodies);
        let first = work.near.fraction <= work.near.start;
        if first {
            work.target.clone_from(&self.drift);
            work.near.hold_off(&work.before, &mut work.target);
            if let Ok(crossings) = self.carry_by(model, work, 1.0, first) {
                return crossings;
            }
        }
        work.target.clone_from(if first { &self.drift } else { &work.before });
        work.near.carry(&work.before, &mut work.target);
        let mut share = 1.0;
        for _ in 0..MOST_CUTS {
            match self.carry_by(model, work, share, first) {
                Ok(crossings) => return crossings,
                Err(safe) => share *= 0.95 * safe,
            }
        }
        self.trial.place.clone_from(&work.before);
        self.trial.bodies.clone_from(&work.bodies_before);
        self.trial.hitches.share = work.near.fraction;
        0
    }

    /// Makes a share of the move to the target: the number of crossings found, or the share of it that is safe where
    /// all of it is not.
    fn carry_by(
        &mut self,
        model: &Model,
        work: &mut ContactWorkspace,
        share: f64,
        with_bodies: bool,
    ) -> Result<u64, f64> {
        for (node, place) in self.trial.place.iter_mut().enumerate() {
            *place = work.before[node].lerp(work.target[node], share);
        }
        if with_bodies {
            self.blend_bodies(&work.bodies_before, share);
        }
        let skin_to = work.near.fraction + (work.near.goal - work.near.fraction) * share;
        self.trial.hitches.share = skin_to;
        self.trial.place_ends(model, &self.plan);
        let safe = work.near.safe_share(&work.before, |node| self.trial.place[node], skin_to);
        let safe = safe.min(self.safe_of_ropes_from(&work.before));
        if safe < 1.0 {
            return Err(safe);
        }
        self.move_ropes_from(&work.before);
        Ok(work.near.make_move(&work.before, |node| self.trial.place[node], skin_to))
    }

    /// Puts bodies a share of the way from where they were to where they would drift.
    fn blend_bodies(&mut self, from: &[BodyTrial], share: f64) {
        for ((trial, from), to) in self.trial.bodies.iter_mut().zip(from).zip(&self.drift_bodies) {
            trial.place = from.place.lerp(to.place, share);
            trial.orientation = from.orientation.slerp(to.orientation, share);
        }
    }
}
