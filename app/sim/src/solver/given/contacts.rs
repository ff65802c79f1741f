//! What touches: rope and bodies on skin, rope on obstacles, and the gear on itself.

use glam::DVec3;

use crate::balance::{Given, Source};
use crate::solver::Solver;
use crate::solver::given::SkinTouches;
use crate::trial::StepContext;
use crate::trial::plan::Attachment;

impl Solver {
    /// Push and friction of all that touches.
    pub(crate) fn give_contacts(
        &mut self,
        context: &StepContext<'_>,
        skin: &SkinTouches<'_>,
        on_nodes: &mut [DVec3],
        given: &mut Given,
    ) {
        for contact in skin.rope {
            let node = self.plan.segment_node[contact.segment];
            let force = contact.normal * contact.normal_force_n + contact.friction_n;
            let velocity = self.velocity_at(context, node, contact.fraction);
            given.at_end.add(Source::Skin, force, velocity);
            push_at(on_nodes, node, contact.fraction, force);
        }
        for contact in skin.bodies {
            let force = contact.normal * contact.normal_force_n + contact.friction_n;
            let arm = contact.position - self.trial.bodies[contact.body].place;
            let velocity = self.motion_of(context, contact.body).at(arm);
            given.at_end.add(Source::Skin, force, velocity);
            self.interface.push(self.centre_of(contact.body), arm, force);
        }
        if self.solid.touching || !self.in_lanes {
            self.give_solids(context, on_nodes, given);
        }
        if !self.in_lanes {
            let (state, scheme) = (context.state, context.scheme);
            given.at_end.contact += self.push_touching_ropes(state, scheme, on_nodes);
        }
        self.give_body_pairs(context, given);
    }

    /// Rope on obstacles and on bodies.
    fn give_solids(
        &mut self,
        context: &StepContext<'_>,
        on_nodes: &mut [DVec3],
        given: &mut Given,
    ) {
        let work = core::mem::take(&mut self.solid);
        for point in work.open_points() {
            let solid = &work.solids[point.solid];
            let force = self.solid_force(context.state, context.scheme, solid, point);
            let velocity = point.on_rope(|node| self.velocity_of(context, node));
            push_at(on_nodes, point.node, point.fraction.unwrap_or(0.0), force);
            let Some(body) = solid.carrier.body() else {
                given.at_end.add(Source::Obstacles, force, velocity);
                continue;
            };
            let place = point.on_rope(|node| self.trial.place[node]);
            let arm = place - self.trial.bodies[body].place;
            let apart = velocity - self.motion_of(context, body).at(arm);
            given.at_end.contact += force.dot(apart);
            self.interface.push(self.centre_of(body), arm, -force);
        }
        self.solid = work;
    }

    /// Bodies on each other and on obstacles, which stand still.
    fn give_body_pairs(&mut self, context: &StepContext<'_>, given: &mut Given) {
        if !self.body_pairs.touching {
            return;
        }
        let pairs = core::mem::take(&mut self.body_pairs);
        for touch in pairs.forces_at(|body| self.trial.bodies[body].pose()) {
            let [first, second] = touch.bodies;
            let one = self.motion_of(context, first).at(touch.arms[0]);
            if second >= self.trial.bodies.len() {
                given.at_end.add(Source::Obstacles, touch.force, one);
                continue;
            }
            let two = self.motion_of(context, second).at(touch.arms[1]);
            given.at_end.contact += touch.force.dot(one - two);
        }
        self.body_pairs = pairs;
        self.push_bodies_apart();
    }

    fn centre_of(&self, body: usize) -> Attachment {
        Attachment::Body { block: self.plan.body_block[body], body, offset: DVec3::ZERO }
    }
}

/// Adds a force on the rope behind a node to those on the nodes.
fn push_at(on_nodes: &mut [DVec3], node: usize, fraction: f64, force: DVec3) {
    on_nodes[node] += force * (1.0 - fraction);
    if fraction > 0.0 {
        on_nodes[node + 1] += force * fraction;
    }
}
