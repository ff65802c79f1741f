//! Newton with rope on rope, away from the whale: every move is cut where ropes would cross, then searched along.
//!
//! As in `contact_newton.rs`: the step begins where ropes were, goes as far along their drift as nothing crosses, and from there to the
//! balance of all forces. What lies on obstacles and bodies is judged by where it is.

use glam::DVec3;

use super::Solver;
use super::contact_newton::{LEAST_CUT, MOST_CUTS, MOST_PASSES, UNSEARCHED_M, enough, left_to_go};
use super::scheme::Scheme;
use crate::cost::CostPart;
use crate::model::Model;
use crate::state::State;

/// Share of the safe part of a drift that is made.
const SAFE_SHARE: f64 = 0.95;

/// How Newton with rope on rope ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum RopeContactEnd {
    /// The last move was this long after so many passes [m].
    Ended { last_m: f64, passes: usize },
    /// A number was not finite.
    NotFinite,
    /// These two segments are crushed.
    Crushed([usize; 2]),
}

impl Solver {
    /// Newton passes until the moves are small.
    pub(crate) fn solve_rope_contact(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
    ) -> RopeContactEnd {
        let (mut last_m, mut passes) = (f64::INFINITY, 0);
        while passes < MOST_PASSES && last_m > enough(passes) {
            passes += 1;
            self.assemble_searchable(model, state, scheme);
            if let Some(segments) = self.crushed_ropes(false) {
                return RopeContactEnd::Crushed(segments);
            }
            self.solve_active_set(model, state, scheme, None);
            let longest = self.longest();
            if !longest.is_finite() {
                return RopeContactEnd::NotFinite;
            }
            self.cost.enter(CostPart::Detection);
            let safe = self.ropes.safe_share(&self.trial.place, |node| {
                self.trial.place[node] + self.tridiagonal.step[node]
            });
            self.cost.enter(CostPart::Contact);
            let share = if longest * safe > UNSEARCHED_M {
                self.line_search_free(model, state, scheme, safe)
            } else {
                safe
            };
            self.cost.enter(CostPart::Detection);
            let taken = self.move_in_rope_contact(model, share);
            // What a short share leaves is still to go.
            let moved_before_m = last_m;
            last_m = if taken >= 1.0 { left_to_go(longest, moved_before_m) } else { longest };
            if (taken < 1.0 || last_m <= enough(passes))
                && self.ropes.open_more(state, &self.trial.place)
            {
                last_m = f64::INFINITY;
            }
            self.cost.enter(CostPart::Contact);
        }
        RopeContactEnd::Ended { last_m, passes }
    }

    /// Goes from where ropes were as far along their drift as nothing crosses.
    pub(crate) fn drift_in_rope_contact(&mut self) {
        self.remember();
        let mut share = 1.0;
        for _ in 0..MOST_CUTS {
            for (node, place) in self.trial.place.iter_mut().enumerate() {
                *place = self.before[node].lerp(self.drift[node], share);
            }
            for ((trial, from), to) in
                self.trial.bodies.iter_mut().zip(&self.bodies_before).zip(&self.drift_bodies)
            {
                trial.place = from.place.lerp(to.place, share);
                trial.orientation = from.orientation.slerp(to.orientation, share);
            }
            let safe = self.safe_of_ropes();
            if safe >= 1.0 {
                self.move_ropes();
                return;
            }
            share *= SAFE_SHARE * safe;
        }
        self.go_back();
    }

    /// Moves the trial by at most this share of the step; the share taken. As the move comes out, with ends on bodies that turn,
    /// it is made shorter until nothing crosses.
    fn move_in_rope_contact(&mut self, model: &Model, mut share: f64) -> f64 {
        self.remember();
        for _ in 0..MOST_CUTS {
            self.advance(model, share);
            let safe = self.safe_of_ropes();
            if safe >= 1.0 {
                self.move_ropes();
                return share;
            }
            self.go_back();
            share *= (0.9 * safe).max(LEAST_CUT);
        }
        0.0
    }

    fn remember(&mut self) {
        self.before.clone_from(&self.trial.place);
        self.bodies_before.clone_from(&self.trial.bodies);
    }

    fn go_back(&mut self) {
        self.trial.place.clone_from(&self.before);
        self.trial.bodies.clone_from(&self.bodies_before);
    }

    /// Share of the move made since `remember` along which no ropes cross.
    fn safe_of_ropes(&self) -> f64 {
        self.ropes.safe_share(&self.before, |node| self.trial.place[node])
    }

    /// Takes in the move made since `remember`.
    fn move_ropes(&mut self) {
        self.ropes.make_move(&self.before, |node| self.trial.place[node]);
    }

    /// Share of the move from places to where the trial is along which no ropes cross.
    pub(crate) fn safe_of_ropes_from(&self, before: &[DVec3]) -> f64 {
        self.ropes.safe_share(before, |node| self.trial.place[node])
    }

    /// Takes in the move from places to where the trial is.
    pub(crate) fn move_ropes_from(&mut self, before: &[DVec3]) {
        self.ropes.make_move(before, |node| self.trial.place[node]);
    }
}
