//! Forces of each source on rope and bodies in a solver step that is solved (see `balance/mod.rs`).
//!
//! Forces come from the laws that the solver uses, at the places where the step ends; only tension is the one that was solved for.
//! With `f` the sum of all forces on the end of a line, inertia included, the holder of the end exerts `-f`: a fixture, the whale or a
//! held body. The scratch of the linear system serves for the sums: forces on nodes, and on free joints and bodies.

use glam::{DMat3, DVec3};

use crate::balance::{Given, Source};
use crate::contact::body_on_skin::BodyContact;
use crate::contact::{ContactPoint, Contacts};
use crate::forces::laws::{self, PerMetre, Shared};
use crate::forces::{Forces, body, pulled};
use crate::matrix::plane_across;
use crate::model::JointKind;
use crate::system::LinearSystem;
use crate::trial::plan::{Attachment, Plan};
use crate::trial::rotation::momentum_rate;
use crate::trial::{StepContext, Trial};

/// Least chord that is divided by [m].
const TINY_M: f64 = 1e-9;

/// Velocity and spin of a body [m/s, rad/s].
#[derive(Clone, Copy)]
pub(crate) struct BodyMotion {
    pub velocity: DVec3,
    pub spin: DVec3,
}

impl BodyMotion {
    /// Velocity of its point at the end of an arm [m/s].
    pub fn at(&self, arm: DVec3) -> DVec3 {
        self.velocity + self.spin.cross(arm)
    }
}

/// Force and torque on a body [N, N m].
type Wrench = [DVec3; 2];

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

/// The sums of a solver step that is solved and not yet stored.
pub(crate) struct SourceForces<'a> {
    pub context: StepContext<'a>,
    pub plan: &'a Plan,
    pub trial: &'a Trial,
    pub forces: &'a Forces,
    pub system: &'a mut LinearSystem,
    /// Whether rope may be near the seabed.
    pub near_seabed: bool,
    /// Rope and bodies on skin at the end of the step.
    pub rope_on_skin: &'a [ContactPoint],
    pub body_on_skin: &'a [BodyContact],
    /// Force on each node [N].
    pub on_nodes: &'a mut [DVec3],
    pub given: Given,
}

impl SourceForces<'_> {
    /// Adds the forces of every source.
    pub fn add_all(&mut self, contacts: &Contacts) {
        self.system.interface.clear();
        self.add_nodes();
        self.add_seabed();
        self.add_damping();
        self.forces.push_hinges(self.context.model, self.trial, self.on_nodes);
        contacts.source_forces(self);
        for index in 0..self.context.model.spec.bodies.len() {
            self.add_body(index);
        }
        self.add_ends();
    }

    /// Velocity of a node at the end of the step [m/s].
    pub fn velocity_of(&self, node: usize) -> DVec3 {
        (self.trial.place[node] - self.trial.place_history[node]) * self.context.scheme.rate
    }

    /// Velocity of a place on the rope behind a node [m/s].
    pub fn velocity_at(&self, node: usize, fraction: f64) -> DVec3 {
        self.velocity_of(node).lerp(self.velocity_of(node + 1), fraction)
    }

    /// Motion of a body at the end of the step.
    pub fn motion_of(&self, index: usize) -> BodyMotion {
        let (trial, scheme) = (&self.trial.bodies[index], self.context.scheme);
        let velocity = (trial.place - trial.place_history) * scheme.rate;
        BodyMotion { velocity, spin: trial.spin(scheme) }
    }

    /// Adds a force on the rope behind a node to those on the nodes.
    pub fn push_at(&mut self, node: usize, fraction: f64, force: DVec3) {
        self.on_nodes[node] += force * (1.0 - fraction);
        if fraction > 0.0 {
            self.on_nodes[node + 1] += force * fraction;
        }
    }

    /// Adds a force at the end of an arm from a body's place.
    pub fn push_body(&mut self, body: usize, arm: DVec3, force: DVec3) {
        self.system.interface.push(self.plan.body(body), arm, force);
    }

    /// Weight and water of every node.
    fn add_nodes(&mut self) {
        let StepContext { model, state, scheme } = self.context;
        let shared = Shared::of(model, scheme);
        let (mut of_weight, mut of_water, mut momentum_ns) =
            (Pushed::default(), Pushed::default(), DVec3::ZERO);
        for (line, nodes) in model.spec.lines.iter().zip(&model.line_nodes) {
            let rope = PerMetre::of(&model.spec.ropes[line.rope], &model.spec.water);
            for node in nodes.clone() {
                let at = self.forces.node_at(self.trial, node, nodes);
                let push = self.forces.water.push.get(node).copied().unwrap_or(DVec3::ZERO);
                let force = DVec3::from(laws::node(&rope, &shared, &at).0) + push;
                let velocity = self.velocity_of(node);
                let mass = rope.mass * at.length;
                let weight = DVec3::Z * -(rope.weight * at.length);
                let inertial =
                    (velocity - self.trial.velocity_history[node]) * (scheme.rate * mass);
                of_weight.add(weight, velocity);
                of_water.add(force - weight + inertial, velocity);
                momentum_ns += (velocity - state.rope.velocity[node]) * mass;
                self.on_nodes[node] = force;
            }
        }
        for (source, pushed) in [(Source::Weight, of_weight), (Source::Water, of_water)] {
            self.given.at_end.push[source as usize] += pushed.force;
            self.given.at_end.work[source as usize] += pushed.power;
        }
        self.given.momentum_ns += momentum_ns;
    }

    /// The seabed under rope.
    fn add_seabed(&mut self) {
        let StepContext { model, state, scheme } = self.context;
        let Some(seabed) = &model.spec.seabed else { return };
        if self.system.in_lanes() && !self.near_seabed {
            return;
        }
        let plane = plane_across(seabed.normal);
        for node in 0..self.on_nodes.len() {
            let at = self.forces.seabed_at((seabed, &plane), state, scheme, self.trial, node);
            let Some((push, grip)) = at else { continue };
            let friction = grip.map_or(DVec3::ZERO, |grip| grip.force);
            let force = seabed.normal * push.force + friction;
            self.given.at_end.add(Source::Seabed, force, self.velocity_of(node));
            self.on_nodes[node] += force;
        }
    }

    /// Dissipation of axial damping: with strain `ε` and its rate `ε̇`, solved tension `T` and length `l`, `-(T - T_e) ε̇ l` of every segment,
    /// where `T_e = T(max(ε, 0), 0)` is the tension that goes into stretch.
    fn add_damping(&mut self) {
        for (segment, node) in self.plan.segment_node.iter().copied().enumerate() {
            let law = &self.forces.lengths.axial[segment];
            if law.damping <= 0.0 || self.forces.cut[segment] {
                continue;
            }
            let (between, length) = (
                self.trial.place[node + 1] - self.trial.place[node],
                self.forces.lengths.segment[segment],
            );
            let is_slack = self.trial.tension[segment] <= 0.0;
            if is_slack && between.length_squared() <= length * length {
                continue;
            }
            let chord = between.length();
            let apart = self.velocity_of(node + 1) - self.velocity_of(node);
            let speed = between.dot(apart) / chord.max(TINY_M);
            let stretched = law.tension((chord / length - 1.0).max(0.0), 0.0);
            let tension = self.trial.tension[segment].max(0.0);
            self.given.at_end.damping -= (tension - stretched) * speed;
        }
    }

    /// Weight, water and seabed of a body.
    fn add_body(&mut self, index: usize) {
        let context = self.context;
        let StepContext { model, state, scheme } = context;
        let at = (self.plan, self.trial);
        let (body, now) = (&model.spec.bodies[index], &state.bodies[index]);
        let motion = self.motion_of(index);
        let start = self.wrench_on(index);
        self.forces.add_body_in_water(&context, index, at, self.system);
        let in_water = self.wrench_on(index);
        Forces::add_feet(&context, index, at, self.system);
        let end = self.wrench_on(index);

        let weight = DVec3::Z * -(body.mass_kg * model.spec.water.gravity_m_s2);
        let (trial, mass) =
            (&self.trial.bodies[index], DMat3::from_diagonal(DVec3::splat(body.mass_kg)));
        let axes = DMat3::from_quat(trial.orientation);
        let inertial = [
            body::inertial(trial, scheme, mass),
            momentum_rate(&axes, trial.spin(scheme), now, body.inertia_kg_m2, scheme).0,
        ];
        let water =
            [in_water[0] - start[0] + inertial[0] - weight, in_water[1] - start[1] + inertial[1]];
        let seabed = [end[0] - in_water[0], end[1] - in_water[1]];
        self.given.at_end.add(Source::Weight, weight, motion.velocity);
        for (source, wrench) in [(Source::Water, water), (Source::Seabed, seabed)] {
            self.given.at_end.add(source, wrench[0], motion.velocity);
            self.given.at_end.work[source as usize] += wrench[1].dot(motion.spin);
        }
        self.given.momentum_ns += (motion.velocity - now.velocity) * body.mass_kg;
    }

    /// Force and torque that the interface system holds for a body.
    fn wrench_on(&self, index: usize) -> Wrench {
        let block = self.plan.body_block[index];
        [self.system.interface.force[block], self.system.interface.force[block + 1]]
    }

    /// Forces that hold or pull the ends of lines, and that hold bodies.
    fn add_ends(&mut self) {
        let model = self.context.model;
        for (index, line) in model.spec.lines.iter().enumerate() {
            let (nodes, segments) = (&model.line_nodes[index], &model.line_segments[index]);
            for (joint, tip, inner, segment) in [
                (line.from, nodes.start, nodes.start + 1, segments.start),
                (line.to, nodes.end - 1, nodes.end - 2, segments.end - 1),
            ] {
                let load =
                    self.on_nodes[tip] + self.forces.pull_at(self.trial, [tip, inner, segment]);
                let attachment = self.plan.attachments[joint];
                if attachment == Attachment::Fixed {
                    let held_by = match model.spec.joints[joint].kind {
                        JointKind::Whale(_) => Source::Skin,
                        _ => Source::Fixtures,
                    };
                    self.given.at_end.add(held_by, -load, self.velocity_of(tip));
                } else {
                    self.system.interface.push(attachment, self.trial.arm(attachment), load);
                }
            }
        }
        self.add_pulled();
        for (body, block) in self.trial.bodies.iter().zip(&self.plan.body_block) {
            if body.held {
                self.given.at_end.add(
                    Source::Fixtures,
                    -self.system.interface.force[*block],
                    DVec3::ZERO,
                );
            }
        }
    }

    /// Constant forces on free ends, and the force that holds such an end until its force begins.
    fn add_pulled(&mut self) {
        for (index, joint) in self.context.model.spec.joints.iter().enumerate() {
            let (JointKind::Pulled { force_n, .. }, Attachment::Free(block)) =
                (&joint.kind, self.plan.attachments[index])
            else {
                continue;
            };
            if pulled::is_held(self.trial, &joint.kind, false) {
                self.given.at_end.add(
                    Source::Fixtures,
                    -self.system.interface.force[block],
                    DVec3::ZERO,
                );
            } else if let Some(node) = self.plan.joint_node[index] {
                self.given.at_end.add(Source::Fixtures, *force_n, self.velocity_of(node));
            }
        }
    }
}
