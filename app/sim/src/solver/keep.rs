//! Writes the solved step into the state.

use glam::DVec3;

use crate::model::Model;
use crate::solver::Solver;
use crate::state::State;
use crate::trial::scheme::Scheme;

impl Solver {
    /// Writes the solved step into the state.
    pub(crate) fn keep(&mut self, model: &Model, scheme: &Scheme, state: &mut State) {
        if self.in_lanes {
            self.keep_from_lanes(model, scheme, state);
        } else {
            self.keep_from_lines(model, scheme, state);
        }
        self.solid.keep_within(state);
    }

    fn keep_from_lines(&mut self, model: &Model, scheme: &Scheme, state: &mut State) {
        self.keep_grips(model, scheme, state);
        self.keep_solid_grips(scheme, state);
        self.keep_rope_grips(scheme, state);
        let rope = &mut state.rope;
        rope.earlier_position.clone_from(&rope.position);
        rope.earlier_velocity.clone_from(&rope.velocity);
        rope.earlier_dt_s = scheme.dt;
        rope.tension.clone_from(&self.trial.tension);
        for node in 0..model.node_count {
            rope.position[node] = self.trial.place[node];
            rope.velocity[node] =
                (self.trial.place[node] - self.trial.place_history[node]) * scheme.rate;
        }
        self.keep_bodies(scheme, state);
    }

    /// Writes bodies and time into the state.
    pub(crate) fn keep_bodies(&self, scheme: &Scheme, state: &mut State) {
        self.keep_pair_grips(state);
        for (trial, body) in self.trial.bodies.iter().zip(&mut state.bodies) {
            body.earlier_position = body.position;
            body.earlier_velocity = body.velocity;
            body.earlier_orientation = body.orientation;
            body.earlier_spin = body.spin;
            body.position = trial.place;
            body.velocity = (trial.place - trial.place_history) * scheme.rate;
            body.spin = if scheme.is_static() { DVec3::ZERO } else { trial.spin(scheme) };
            body.orientation = trial.orientation;
        }
        state.time_s = self.trial.time;
    }
}
