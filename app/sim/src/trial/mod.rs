//! The state being solved for: places at the end of the step, and the history they are measured from.

pub(crate) mod plan;
pub(crate) mod rotation;
pub(crate) mod scheme;

use glam::{DQuat, DVec3};

use crate::geometry::Pose;
use crate::model::{JointKind, Model};
use crate::state::State;
use crate::trial::plan::{Attachment, Plan};
use crate::trial::rotation::turn_history;
use crate::trial::scheme::Scheme;
use crate::whale::hitch::Hitches;

/// Unknowns of a step, with their history.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trial {
    /// Time at the end of the step [s].
    pub time: f64,
    /// Place of each node.
    pub place: Vec<DVec3>,
    /// `x̂` of each node.
    pub place_history: Vec<DVec3>,
    /// `v̂` of each node.
    pub velocity_history: Vec<DVec3>,
    /// Tension of each segment as the last solve predicted it; below zero it is slack.
    pub tension: Vec<f64>,
    /// Bodies.
    pub bodies: Vec<BodyTrial>,
    /// Joints made fast to the whale.
    pub hitches: Hitches,
}

/// Unknowns of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyTrial {
    pub place: DVec3,
    pub orientation: DQuat,
    /// Orientation at the step's begin, to which an anchored pass of statics pulls back.
    pub anchor: DQuat,
    pub place_history: DVec3,
    pub velocity_history: DVec3,
    /// `θ̂` (`rotation.rs`).
    pub turn_history: DVec3,
    /// Factor on its pseudo-mass in statics.
    pub pseudo_mass_scale: f64,
    /// Whether it is held in place.
    pub held: bool,
    /// Whether it may move but not turn.
    pub upright: bool,
}

impl BodyTrial {
    /// Where it is.
    pub fn pose(&self) -> Pose {
        Pose { place: self.place, orientation: self.orientation }
    }
}

impl Trial {
    /// Starts a step: history from the state, a first guess by its velocities, fixtures at their new place.
    pub fn begin(&mut self, model: &Model, plan: &Plan, state: &State, scheme: &Scheme) {
        self.time = state.time_s + scheme.dt;
        self.hitches.share = self.hitches.span[1];
        self.take_history(state, scheme);
        self.guess(state, scheme);
        self.tension.clone_from(&state.rope.tension);
        self.begin_bodies(model, state, scheme);
        self.place_ends(model, plan);
    }

    /// Starts a step with rope held as lanes, which read the history of rope from the state.
    pub fn begin_free(&mut self, model: &Model, plan: &Plan, state: &State, scheme: &Scheme) {
        self.time = state.time_s + scheme.dt;
        self.hitches.share = self.hitches.span[1];
        self.guess(state, scheme);
        self.begin_bodies(model, state, scheme);
        self.place_ends(model, plan);
    }

    /// Computes the history of places and velocities of rope.
    pub fn take_history(&mut self, state: &State, scheme: &Scheme) {
        let rope = &state.rope;
        let history = |now: &[DVec3], earlier: &[DVec3], out: &mut Vec<DVec3>| {
            out.clear();
            out.extend(
                now.iter().zip(earlier).map(|(now, earlier)| scheme.history(*now, *earlier)),
            );
        };
        history(&rope.position, &rope.earlier_position, &mut self.place_history);
        history(&rope.velocity, &rope.earlier_velocity, &mut self.velocity_history);
    }

    /// Sets the predictor of rope by its velocities.
    fn guess(&mut self, state: &State, scheme: &Scheme) {
        let rope = &state.rope;
        self.place.clear();
        self.place.extend(
            rope.position
                .iter()
                .zip(&rope.velocity)
                .map(|(place, velocity)| *place + *velocity * scheme.dt),
        );
    }

    fn begin_bodies(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.bodies.clear();
        for (body, now) in model.spec.bodies.iter().zip(&state.bodies) {
            let held =
                body.held_until_s.is_some_and(|until| scheme.is_static() || self.time <= until);
            let move_of = if held { DVec3::ZERO } else { now.velocity * scheme.dt };
            let turn = if held { DVec3::ZERO } else { now.spin * scheme.dt };
            self.bodies.push(BodyTrial {
                place: now.position + move_of,
                anchor: now.orientation,
                pseudo_mass_scale: 1.0,
                orientation: (DQuat::from_scaled_axis(turn) * now.orientation).normalize(),
                place_history: scheme.history(now.position, now.earlier_position),
                velocity_history: scheme.history(now.velocity, now.earlier_velocity),
                turn_history: turn_history(now, scheme),
                held,
                upright: false,
            });
        }
    }

    /// Lever arm of an attachment from its body's place, in the world frame; zero where it is not on a body [m].
    pub fn arm(&self, attachment: Attachment) -> DVec3 {
        Plan::arm(attachment, |body| self.bodies[body].orientation)
    }

    /// Sets line ends to the places of their fixture or body; free joints stay at the place of their first line end.
    pub fn place_ends(&mut self, model: &Model, plan: &Plan) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            let nodes = &model.line_nodes[index];
            for (joint, node) in [(line.from, nodes.start), (line.to, nodes.end - 1)] {
                self.place[node] = self.joint_place(model, plan, joint, node);
            }
        }
    }

    fn joint_place(&self, model: &Model, plan: &Plan, joint: usize, node: usize) -> DVec3 {
        if let Attachment::Body { body, offset, .. } = plan.attachments[joint] {
            let body = &self.bodies[body];
            return body.place + body.orientation * offset;
        }
        let place = model.spec.joints[joint].position_m;
        match model.spec.joints[joint].kind {
            JointKind::Driven { velocity_m_s, from_s, until_s } => {
                place + velocity_m_s * (self.time.min(until_s) - from_s).max(0.0)
            }
            JointKind::Fixed => place,
            JointKind::Whale(_) => self.hitches.place(joint).unwrap_or(place),
            _ => self.place[plan.joint_node[joint].unwrap_or(node)],
        }
    }
}

/// The model, the state at the start of a solver step, and the scheme that integrates over it.
#[derive(Clone, Copy)]
pub(crate) struct StepContext<'a> {
    /// The model.
    pub model: &'a Model,
    /// The state at the start of the solver step.
    pub state: &'a State,
    /// The scheme of the solver step.
    pub scheme: &'a Scheme,
}
