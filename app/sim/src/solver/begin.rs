//! Begins a solver step: the guess `x + h v`, held off skin and other rope, and whether rope met more on its way than was gathered.

use glam::DVec3;

use crate::contact::rope_on_solid::{MARGIN_M, UNWATCHED_M};
use crate::cost::CostPart;
use crate::model::Model;
use crate::solver::Solver;
use crate::solver::newton::Skin;
use crate::state::{RopeState, State};
use crate::trial::StepContext;

impl Solver {
    /// Begins a step: in the lanes of the processor where they know all that touches rope, else line by line.
    pub(crate) fn begin_step(&mut self, context: &StepContext<'_>, mut skin: Skin<'_>) {
        let StepContext { model, state, scheme } = *context;
        let on_body = self.body_skin.as_ref().is_some_and(|work| work.touching);
        self.in_contact = skin.is_some()
            || self.solid.touching
            || self.ropes.touching
            || self.body_pairs.touching
            || on_body;
        self.cost.enter(if self.in_contact { CostPart::Contact } else { CostPart::FreeRope });
        if self.lanes.suit(model) && !self.ropes.touching {
            self.begin_in_lanes(model, state, scheme, |solver| {
                solver.hold_off(model, state, skin.as_deref_mut());
            });
        } else {
            self.begin(model, state, scheme);
            self.hold_off(model, state, skin);
        }
    }

    /// Holds the guess of a step off skin and other rope.
    fn hold_off(&mut self, model: &Model, state: &State, skin: Skin<'_>) {
        if !self.in_contact {
            return;
        }
        if let Some(work) = &skin {
            work.near.hold_off(&state.rope.position, &mut self.trial.place);
        }
        if self.ropes.touching {
            self.ropes.hold_off(&state.rope.position, &mut self.trial.place);
        }
        self.hold_bodies_off(state);
        self.trial.place_ends(model, &self.plan);
        if let Some(work) = skin {
            work.near.follow(&state.rope.position, &self.trial.place);
        }
    }

    /// Whether rope whose passes moved it by `moved_m` in all met rope, obstacles or bodies that its drift would not have brought it near
    /// to [m]; they are looked at from now on. Rope that hardly strayed from its drift has met nothing but what was gathered by it.
    pub(crate) fn met_more(&mut self, context: &StepContext<'_>, moved_m: f64) -> bool {
        let StepContext { model, state, scheme } = *context;
        let beyond_solids = self.solid.touching || moved_m > MARGIN_M;
        let beyond_ropes = self.ropes.law.is_some()
            && (!self.ropes.pairs.is_empty() || moved_m > self.ropes.unwatched_m());
        if !beyond_solids && !beyond_ropes {
            return false;
        }
        self.take_places();
        let (rope, to) = (&state.rope, &self.trial.place);
        let strayed_m = strayed_m(rope, scheme.dt, to);
        let beyond_solids = beyond_solids && strayed_m > UNWATCHED_M;
        let beyond_gathered = beyond_ropes && strayed_m > self.ropes.unwatched_m();
        if beyond_solids || beyond_gathered {
            self.pieces.measure(&rope.position, |node| to[node], &rope.segment_length);
        }
        let on_solid = beyond_solids && self.solid.gather_more(state, &self.pieces, to, scheme.dt);
        let on_rope = match (self.ropes.touching, beyond_gathered) {
            _ if !beyond_ropes => false,
            (true, true) => self.ropes.gather_more(model, state, &self.pieces, to),
            (true, false) => false,
            (false, true) => self.ropes.met(model, state, &self.pieces, to),
            (false, false) => self.ropes.met_known(&rope.position, to),
        };
        on_solid || on_rope
    }

    /// Ends a step on the straight path from where it began; the number of times ropes cross on it, or `None` where they may.
    pub(crate) fn end_ropes(&mut self, state: &State) -> Option<u64> {
        if self.ropes.pairs.is_empty() {
            return Some(0);
        }
        self.take_places();
        self.ropes.end(&state.rope.position, &self.trial.place)
    }

    /// Places of the nodes now.
    pub(crate) fn places(&self) -> &[DVec3] {
        &self.trial.place
    }
}

/// How far rope that goes to these places in a step has strayed from where its velocities would have brought it, at most [m].
fn strayed_m(rope: &RopeState, dt: f64, to: &[DVec3]) -> f64 {
    let drift = rope.position.iter().zip(&rope.velocity).map(|(place, speed)| *place + *speed * dt);
    drift.zip(to).map(|(drift, to)| drift.distance_squared(*to)).fold(0.0, f64::max).sqrt()
}
