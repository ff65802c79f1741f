//! How solver steps of free rope are taken, and where a step in two stages began.
//!
//! The first stage is a step of backward Euler, and a second that is refused leaves it as such; a step of the model therefore never
//! begins within a step in two stages, and nothing of this is part of the state.

use glam::{DQuat, DVec3};

use super::rejection::StepKind;
use crate::model::Model;
use crate::state::State;
use crate::step_control::Taken;
use crate::trial::scheme::FIRST_SHARE;

/// How a solver step of free rope is taken; with contact every step is backward Euler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    /// BDF2, from the step before.
    Multistep,
    /// Backward Euler, which damps a step that did not converge.
    Damped,
    /// First stage of a step in two stages.
    FirstStage,
    /// Second stage of a step in two stages, which is this long in all [s].
    SecondStage {
        /// Length of the whole step [s].
        whole_s: f64,
    },
}

/// A body where a step in two stages began.
#[derive(Clone, Copy, Debug)]
struct Placed {
    position: DVec3,
    velocity: DVec3,
    orientation: DQuat,
    spin: DVec3,
}

/// Where a step in two stages began.
#[derive(Clone, Debug)]
pub(super) struct Stages {
    /// Whether its second stage comes next.
    first_is_done: bool,
    whole_s: f64,
    earlier_dt_s: f64,
    position: Vec<DVec3>,
    velocity: Vec<DVec3>,
    bodies: Vec<Placed>,
}

impl Stages {
    /// Scratch for a model.
    pub fn new(model: &Model) -> Self {
        Self {
            first_is_done: false,
            whole_s: 0.0,
            earlier_dt_s: 0.0,
            position: Vec::with_capacity(model.node_count),
            velocity: Vec::with_capacity(model.node_count),
            bodies: Vec::with_capacity(model.spec.bodies.len()),
        }
    }

    /// Forgets a step in two stages that was begun.
    pub fn clear(&mut self) {
        self.first_is_done = false;
    }

    /// Length of the next solver step and how it is taken, where a whole step is to be `dt` long; `free` where the rope may touch nothing.
    pub fn next(&mut self, state: &State, dt: f64, halved: bool, free: bool) -> (f64, Way) {
        let first_is_done = core::mem::take(&mut self.first_is_done);
        if halved {
            return (dt, Way::Damped);
        }
        if first_is_done && free {
            let whole_s = self.whole_s;
            return ((1.0 - FIRST_SHARE) * whole_s, Way::SecondStage { whole_s });
        }
        if free && state.step_control.in_two_stages() {
            self.begin(state, dt);
            return (FIRST_SHARE * dt, Way::FirstStage);
        }
        (dt, Way::Multistep)
    }

    fn begin(&mut self, state: &State, whole_s: f64) {
        (self.whole_s, self.earlier_dt_s) = (whole_s, state.rope.earlier_dt_s);
        self.position.clone_from(&state.rope.position);
        self.velocity.clone_from(&state.rope.velocity);
        self.bodies.clear();
        self.bodies.extend(state.bodies.iter().map(|body| Placed {
            position: body.position,
            velocity: body.velocity,
            orientation: body.orientation,
            spin: body.spin,
        }));
    }

    /// Records a solver step that was accepted, with the length of the one before it; returns the step that it ends, or `None` before
    /// its second stage.
    pub fn keep(
        &mut self,
        state: &mut State,
        way: Way,
        kind: StepKind,
        [earlier_dt, dt]: [f64; 2],
    ) -> Option<Taken> {
        match way {
            Way::FirstStage if kind == StepKind::Free => {
                self.first_is_done = true;
                None
            }
            Way::SecondStage { whole_s } if kind == StepKind::Free => {
                self.end(state);
                Some(Taken { dt: whole_s, earlier_dt: self.earlier_dt_s, in_two_stages: true })
            }
            _ => Some(Taken { dt, earlier_dt, in_two_stages: false }),
        }
    }

    /// Makes the start of the whole step, and not its first stage, the earlier state.
    fn end(&mut self, state: &mut State) {
        let rope = &mut state.rope;
        core::mem::swap(&mut rope.earlier_position, &mut self.position);
        core::mem::swap(&mut rope.earlier_velocity, &mut self.velocity);
        rope.earlier_dt_s = self.whole_s;
        for (body, began) in state.bodies.iter_mut().zip(&self.bodies) {
            (body.earlier_position, body.earlier_velocity) = (began.position, began.velocity);
            (body.earlier_orientation, body.earlier_spin) = (began.orientation, began.spin);
        }
    }
}
