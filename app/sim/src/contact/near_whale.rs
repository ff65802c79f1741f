//! The search for rope and bodies near the whale over a step of the model.

use crate::contact::Contacts;
use crate::model::Model;
use crate::state::State;

/// Rope this close to the path of the whale over a step of the model makes the solver steps short [m].
const NEAR_M: f64 = 0.2;

impl Contacts {
    /// Searches for rope and bodies near the whale between its two poses; returns whether there may be any.
    pub fn find_near_whale(&mut self, model: &Model, state: &State) -> bool {
        let Self { rope_on_skin, body_on_skin, pieces, poses, .. } = self;
        let Some(on_skin) = rope_on_skin else { return false };
        let step_s = model.spec.settings.step_s;
        let [start, end] = [&poses[0].bones, &poses[1].bones];
        pieces.measure_drift(state, step_s);
        let near = &mut on_skin.near;
        near.pairs.clear();
        let may_be_near = near.begin_search(
            [start, end],
            pieces,
            &state.rope.position,
            |node| state.rope.velocity[node] * step_s,
            NEAR_M,
        );
        // Rope that touched skin is expected to be near it still; other rope is gathered only if it is.
        let touched = !state.rope.friction.sites.is_empty();
        let rope_near = may_be_near && (touched || near.is_any_near(NEAR_M)) && {
            near.gather_swept(model, (&state.rope.cut, 0.0));
            !touched || !near.pairs.is_empty() || near.is_any_near(NEAR_M)
        };
        let skin = ([&start[..], &end[..]], &on_skin.near.whole());
        let body_near =
            body_on_skin.as_mut().is_some_and(|bodies| bodies.gather(model, state, skin, 0.0));
        rope_near || body_near
    }

    /// Searches again, for the rest of a step of the model of which a share has passed.
    pub fn find_near_whale_again(&mut self, model: &Model, state: &State, passed: f64) {
        let Self { rope_on_skin, body_on_skin, poses, .. } = self;
        let Some(on_skin) = rope_on_skin else { return };
        let left_s = model.spec.settings.step_s * (1.0 - passed);
        let [start, end] = [&poses[0].bones, &poses[1].bones];
        on_skin.near.gather(
            model,
            [start, end],
            &state.rope.position,
            |node| state.rope.velocity[node] * left_s,
            (&state.rope.cut, passed),
        );
        if let Some(bodies) = body_on_skin {
            bodies.gather(model, state, ([start, end], &on_skin.near.whole()), passed);
        }
    }

    /// Whether rope and bodies with constant velocities touch no skin for the rest of the model's step.
    pub fn stays_clear(&mut self, state: &State, left_s: f64) -> bool {
        let bodies = self.body_on_skin.as_mut().filter(|bodies| bodies.is_near());
        if bodies.is_some_and(|bodies| bodies.find_active_pairs(state, 1.0, left_s)) {
            return false;
        }
        let rope = self.rope_on_skin.as_mut().filter(|rope| rope.is_near());
        rope.is_none_or(|rope| !rope.find_active_pairs(state, 1.0, left_s))
    }
}
