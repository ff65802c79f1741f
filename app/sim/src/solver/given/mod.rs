//! What each source gave rope and bodies in a solver step that is solved (`balance/mod.rs`).
//!
//! Forces come from the laws that the solver uses, at the places it ended at; only tension is the one it solved for. With `f` the
//! sum of all forces on a line's end, inertia among them, what holds the end gives `-f`: a fixture, the whale or a held body.
//! The scratch of the linear system serves for the sums: forces on nodes, and on free joints and bodies.

mod bodies;
mod contacts;
mod ends;

use glam::DVec3;

use crate::balance::{Given, Source};
use crate::contact::ContactPoint;
use crate::contact::body_on_skin::BodyContact;
use crate::forces::laws::{self as forces, NodeAt, PerMetre, Shared};
use crate::solver::Solver;
use crate::trial::StepContext;

/// Least chord that is divided by [m].
const TINY_M: f64 = 1e-9;

/// Where skin was touched at the end of a solver step.
pub(crate) struct SkinTouches<'a> {
    /// By rope.
    pub rope: &'a [ContactPoint],
    /// By bodies.
    pub bodies: &'a [BodyContact],
}

/// Force of a source on many nodes, and its power [N, W].
#[derive(Clone, Copy, Default)]
struct Pushed {
    force: DVec3,
    power: f64,
}

impl Pushed {
    fn add(&mut self, force: DVec3, velocity: DVec3) {
        self.force += force;
        self.power += force.dot(velocity);
    }
}

impl Solver {
    /// What each source gave in a step that is solved and not yet kept.
    pub(crate) fn given(&mut self, context: &StepContext<'_>, skin: &SkinTouches<'_>) -> Given {
        let mut given = Given::default();
        if self.in_lanes {
            self.tension();
            self.take_places();
            self.trial.take_history(context.state, context.scheme);
            self.cut.clone_from(&context.state.rope.cut);
        }
        self.interface.clear();
        let mut on_nodes = core::mem::take(&mut self.tridiagonal.force);
        self.give_nodes(context, &mut on_nodes, &mut given);
        self.give_seabed(context, &mut on_nodes, &mut given);
        self.give_damping(context, &mut given);
        self.push_hinges(context.model, &mut on_nodes);
        self.give_contacts(context, skin, &mut on_nodes, &mut given);
        self.give_bodies(context, &mut given);
        self.give_ends(context, &on_nodes, &mut given);
        self.tridiagonal.force = on_nodes;
        given
    }

    /// Velocity of a node at the end of the step [m/s].
    fn velocity_of(&self, context: &StepContext<'_>, node: usize) -> DVec3 {
        (self.trial.place[node] - self.trial.place_history[node]) * context.scheme.rate
    }

    /// Velocity of a place on the rope behind a node [m/s].
    fn velocity_at(&self, context: &StepContext<'_>, node: usize, fraction: f64) -> DVec3 {
        self.velocity_of(context, node).lerp(self.velocity_of(context, node + 1), fraction)
    }

    /// Weight and water of every node.
    fn give_nodes(&self, context: &StepContext<'_>, on_nodes: &mut [DVec3], given: &mut Given) {
        let StepContext { model, state, scheme } = *context;
        let shared = Shared::of(model, scheme);
        let (mut of_weight, mut of_water, mut momentum_ns) =
            (Pushed::default(), Pushed::default(), DVec3::ZERO);
        for (line, nodes) in model.spec.lines.iter().zip(&model.line_nodes) {
            let rope = PerMetre::of(&model.spec.ropes[line.rope], &model.spec.water);
            for node in nodes.clone() {
                let at: NodeAt<f64> = self.node_at(node, nodes);
                let push = self.push.get(node).copied().unwrap_or(DVec3::ZERO);
                let force = DVec3::from(forces::node(&rope, &shared, &at).0) + push;
                let velocity = self.velocity_of(context, node);
                let mass = rope.mass * at.length;
                let weight = DVec3::Z * -(rope.weight * at.length);
                let inertial =
                    (velocity - self.trial.velocity_history[node]) * (scheme.rate * mass);
                of_weight.add(weight, velocity);
                of_water.add(force - weight + inertial, velocity);
                momentum_ns += (velocity - state.rope.velocity[node]) * mass;
                on_nodes[node] = force;
            }
        }
        for (source, pushed) in [(Source::Weight, of_weight), (Source::Water, of_water)] {
            given.at_end.push[source as usize] += pushed.force;
            given.at_end.work[source as usize] += pushed.power;
        }
        given.momentum_ns += momentum_ns;
    }

    /// The seabed under rope.
    fn give_seabed(&self, context: &StepContext<'_>, on_nodes: &mut [DVec3], given: &mut Given) {
        let StepContext { model, state, scheme } = *context;
        let Some(seabed) = &model.spec.seabed else { return };
        if self.in_lanes && !self.near_seabed {
            return;
        }
        for (node, on_node) in on_nodes.iter_mut().enumerate() {
            let Some((push, grip)) = self.seabed_at(seabed, state, scheme, node) else { continue };
            let friction = grip.map_or(DVec3::ZERO, |grip| grip.force);
            let force = seabed.normal * push.force + friction;
            given.at_end.add(Source::Seabed, force, self.velocity_of(context, node));
            *on_node += force;
        }
    }

    /// What axial damping takes: with strain `ε` and its rate `ε̇`, solved tension `T` and length `l`, `-(T - T_e) ε̇ l` of every segment,
    /// where `T_e = T(max(ε, 0), 0)` is the tension that goes into stretch.
    fn give_damping(&self, context: &StepContext<'_>, given: &mut Given) {
        for (segment, node) in self.plan.segment_node.iter().copied().enumerate() {
            let law = &self.lengths.axial[segment];
            if law.damping <= 0.0 || self.cut[segment] {
                continue;
            }
            let (between, length) = (
                self.trial.place[node + 1] - self.trial.place[node],
                self.lengths.segment[segment],
            );
            let is_slack = self.trial.tension[segment] <= 0.0;
            if is_slack && between.length_squared() <= length * length {
                continue;
            }
            let chord = between.length();
            let apart = self.velocity_of(context, node + 1) - self.velocity_of(context, node);
            let speed = between.dot(apart) / chord.max(TINY_M);
            let stretched = law.tension((chord / length - 1.0).max(0.0), 0.0);
            let tension = self.trial.tension[segment].max(0.0);
            given.at_end.damping -= (tension - stretched) * speed;
        }
    }
}
