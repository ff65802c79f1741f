//! Queries and operations of statics beyond the balance of forces: how far an iteration turns the gear, anchored iterations, and where
//! the residual is greatest.

use glam::DVec3;

use crate::forces::pulled;
use crate::matrix::outer;
use crate::model::{BodyRole, Model};
use crate::solver::Solver;
use crate::state::State;
use crate::trial::plan::Attachment;

/// Where the greatest force out of balance is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WorstAt {
    /// A node within a line.
    Line(usize),
    /// A free joint.
    Joint(usize),
    /// A body.
    Body(usize),
}

/// Whether a body is one that is laid on the seabed.
pub(crate) fn is_laid(model: &Model, body: usize) -> bool {
    model.spec.seabed.is_some()
        && model.spec.bodies[body].role != BodyRole::Buoy
        && !model.spec.bodies[body].feet_m.is_empty()
}

impl Solver {
    /// Holds every laid body in place, in this attempt.
    pub(crate) fn hold_laid(&mut self, model: &Model) {
        for (index, body) in self.trial.bodies.iter_mut().enumerate() {
            body.held |= is_laid(model, index);
        }
    }

    /// Lets every laid body move but not turn, in this attempt.
    pub(crate) fn keep_upright(&mut self, model: &Model) {
        for (index, body) in self.trial.bodies.iter_mut().enumerate() {
            body.upright |= is_laid(model, index);
        }
    }

    /// Sets the trial to the places of another state; held bodies stay.
    pub(crate) fn start_at(&mut self, model: &Model, guess: &State) {
        self.trial.place.clone_from(&guess.rope.position);
        self.trial.tension.clone_from(&guess.rope.tension);
        for (trial, body) in
            self.trial.bodies.iter_mut().zip(&guess.bodies).filter(|(trial, _)| !trial.held)
        {
            (trial.place, trial.orientation) = (body.position, body.orientation);
        }
        self.trial.place_ends(model, &self.plan);
        self.forces.water.measure_flow(model, &self.trial);
    }

    /// Makes the trial the place to which anchored iterations pull back.
    pub(crate) fn anchor(&mut self) {
        self.trial.place_history.clone_from(&self.trial.place);
        for body in &mut self.trial.bodies {
            (body.place_history, body.anchor) = (body.place, body.orientation);
        }
    }

    /// Puts the trial back to its anchor, with these tensions.
    pub(crate) fn return_to_anchor(&mut self, model: &Model, tension: &[f64]) {
        self.trial.place.clone_from(&self.trial.place_history);
        for body in &mut self.trial.bodies {
            (body.place, body.orientation) = (body.place_history, body.anchor);
        }
        self.trial.tension.clone_from_slice(tension);
        self.forces.water.measure_flow(model, &self.trial);
    }

    /// Moves the trial by a share of the solved step. Tension is an unknown of its own: it moves by the same share from its value to the
    /// predicted one, whatever the strain.
    pub(crate) fn advance_at_rest(&mut self, model: &Model, share: f64, before: &mut Vec<f64>) {
        before.clone_from(&self.trial.tension);
        let Self { forces, trial, system, .. } = self;
        forces.predict_tension(model, trial, system, 1.0);
        for (before, predicted) in before.iter_mut().zip(&self.trial.tension) {
            *before += share * (predicted - *before);
        }
        self.advance(model, share);
        self.trial.tension.clone_from(before);
        self.forces.water.measure_flow(model, &self.trial);
    }

    /// Gives slack segments a share of the stiffness of taut rope within an iteration. It changes the path of the iterations and not
    /// their limit.
    pub(crate) fn stiffen_slack(&mut self, model: &Model, share: f64) {
        for (index, segments) in model.line_segments.iter().enumerate() {
            let first_node = model.line_nodes[index].start;
            for (node, segment) in (first_node..).zip(segments.clone()) {
                let pull = self.forces.pull[segment];
                if pull.taut || self.forces.cut[segment] {
                    continue;
                }
                let block = outer(pull.direction, pull.direction) * (pull.stiffness * share);
                self.system.rope.diagonal[node] += block;
                self.system.rope.diagonal[node + 1] += block;
                self.system.rope.up[segment] -= block;
                self.system.rope.low[segment] -= block;
            }
        }
    }

    /// Force on a laid body besides its feet's push, as last assembled with the body held [N].
    pub(crate) fn load_on(&self, model: &Model, index: usize) -> DVec3 {
        let mut interface = self.system.interface.force.clone();
        for (line, nodes) in model.spec.lines.iter().zip(&model.line_nodes) {
            for (joint, node) in [(line.from, nodes.start), (line.to, nodes.end - 1)] {
                self.push_interface(&mut interface, joint, self.system.rope.force[node]);
            }
        }
        let (body, now) = (&model.spec.bodies[index], &self.trial.bodies[index]);
        let push = model.spec.seabed.as_ref().map_or(DVec3::ZERO, |seabed| {
            let arm = |foot| body.foot_arm(foot, now.orientation, seabed.normal);
            let feet =
                (0..body.feet_m.len()).map(|foot| seabed.push_on_foot(now.place + arm(foot)));
            seabed.normal * feet.sum::<f64>()
        });
        interface[self.plan.body_block[index]] - push
    }

    /// Greatest turn of any segment or body in the last solve, turned or stretched as one [rad].
    pub(crate) fn sharpest_turn(&self, model: &Model) -> f64 {
        let lines = (0..model.spec.lines.len())
            .map(|line| self.turn_of_line(model, line))
            .fold(0.0, f64::max);
        (0..model.spec.bodies.len()).map(|body| self.turn_of_body(body)).fold(lines, f64::max)
    }

    /// Greatest turn of any segment of a line in the last solve [rad].
    pub(crate) fn turn_of_line(&self, model: &Model, line: usize) -> f64 {
        let (first_node, mut greatest) = (model.line_nodes[line].start, 0.0_f64);
        for (node, segment) in (first_node..).zip(model.line_segments[line].clone()) {
            let step = self.system.rope.step[node + 1] - self.system.rope.step[node];
            let step = step.reject_from_normalized(self.forces.pull[segment].direction);
            greatest = greatest.max(
                step.length_squared()
                    / (self.forces.lengths.segment[segment] * self.forces.lengths.segment[segment]),
            );
        }
        greatest.sqrt()
    }

    /// Turn of a body in the last solve, counted fourfold [rad].
    pub(crate) fn turn_of_body(&self, body: usize) -> f64 {
        4.0 * self.system.interface.step[self.plan.body_block[body] + 1].length()
    }

    /// Greatest force out of balance within a line, as last assembled [N].
    pub(crate) fn left_in_line(&self, model: &Model, line: usize) -> f64 {
        let nodes = &model.line_nodes[line];
        self.system.rope.force[nodes.start + 1..nodes.end - 1]
            .iter()
            .map(|force| force.length())
            .fold(0.0, f64::max)
    }

    /// Multiplies the pseudo-mass of a line from here on.
    pub(crate) fn scale_pseudo_mass_of_line(&mut self, line: usize, factor: f64) {
        self.forces.pseudo_mass_scale[line] *= factor;
    }

    /// Multiplies the pseudo-mass of a body from here on.
    pub(crate) fn scale_pseudo_mass_of_body(&mut self, body: usize, factor: f64) {
        self.trial.bodies[body].pseudo_mass_scale *= factor;
    }

    /// Where the force out of balance is greatest, as last assembled (before [`solve`](Self::solve)), and how great [N].
    pub(crate) fn worst(&self, model: &Model) -> Option<(WorstAt, f64)> {
        let mut interface = self.system.interface.force.clone();
        let mut worst: Option<(WorstAt, f64)> = None;
        let mut offer = |at: WorstAt, force: f64| {
            if worst.is_none_or(|(_, most)| force > most || force.is_nan()) {
                worst = Some((at, force));
            }
        };
        for (index, line) in model.spec.lines.iter().enumerate() {
            let nodes = &model.line_nodes[index];
            let inner = self.system.rope.force[nodes.start + 1..nodes.end - 1]
                .iter()
                .map(|force| force.length())
                .fold(0.0, f64::max);
            offer(WorstAt::Line(index), inner);
            for (joint, node) in [(line.from, nodes.start), (line.to, nodes.end - 1)] {
                self.push_interface(&mut interface, joint, self.system.rope.force[node]);
            }
        }
        for (joint, attachment) in self.plan.attachments.iter().enumerate() {
            if let Attachment::Free(block) = attachment {
                offer(WorstAt::Joint(joint), interface[*block].length());
            }
        }
        for (index, block) in self
            .plan
            .body_block
            .iter()
            .enumerate()
            .filter(|(index, _)| !self.trial.bodies[*index].held)
        {
            let torque =
                if self.trial.bodies[index].upright { 0.0 } else { interface[block + 1].length() };
            offer(WorstAt::Body(index), interface[*block].length().max(torque));
        }
        worst
    }

    /// Greatest force out of balance at any node or interface block, as last assembled (before [`solve`](Self::solve)) [N].
    pub(crate) fn residual(&self, model: &Model) -> f64 {
        let mut interface = self.system.interface.force.clone();
        let mut greatest = 0.0_f64;
        for (index, line) in model.spec.lines.iter().enumerate() {
            let nodes = &model.line_nodes[index];
            for node in nodes.start + 1..nodes.end - 1 {
                greatest = greatest.max(self.system.rope.force[node].length());
            }
            for (joint, node) in [(line.from, nodes.start), (line.to, nodes.end - 1)] {
                match self.plan.attachments[joint] {
                    Attachment::Fixed => {}
                    Attachment::Free(block) => interface[block] += self.system.rope.force[node],
                    Attachment::Body { block, .. } => {
                        let arm = self.trial.arm(self.plan.attachments[joint]);
                        interface[block] += self.system.rope.force[node];
                        interface[block + 1] += arm.cross(self.system.rope.force[node]);
                    }
                }
            }
        }
        for (index, block) in self.plan.body_block.iter().enumerate() {
            let body = &self.trial.bodies[index];
            if body.held {
                interface[*block] = DVec3::ZERO;
            }
            if body.held || body.upright {
                interface[block + 1] = DVec3::ZERO;
            }
        }
        for (joint, attachment) in model.spec.joints.iter().zip(&self.plan.attachments) {
            if let (Attachment::Free(block), true) =
                (attachment, pulled::is_held(&self.trial, &joint.kind, true))
            {
                interface[*block] = DVec3::ZERO;
            }
        }
        // `f64::max` ignores NaN.
        let all_finite =
            interface.iter().chain(&self.system.rope.force).all(|force| force.is_finite());
        if all_finite {
            interface.iter().map(|force| force.length()).fold(greatest, f64::max)
        } else {
            f64::INFINITY
        }
    }

    /// The line with the longest or a not finite move in the last solve.
    pub(crate) fn worst_line(&self, model: &Model) -> Option<usize> {
        let size = |line: &usize| {
            let steps = &self.system.rope.step[model.line_nodes[*line].clone()];
            steps
                .iter()
                .map(|step| if step.is_finite() { step.length() } else { f64::INFINITY })
                .fold(0.0, f64::max)
        };
        (0..model.spec.lines.len()).max_by(|one, other| size(one).total_cmp(&size(other)))
    }

    /// Longest solved move of any node or body [m].
    pub(crate) fn longest(&self) -> f64 {
        self.system.longest(&self.plan)
    }

    /// Share of the solved step, at most `longest`, that takes no rope through a solid.
    pub(crate) fn share_past_solids(&self, longest: f64) -> f64 {
        self.contacts.rope_on_solid.share_past(&self.trial, &self.system, longest)
    }

    /// Evaluates the water at the trial.
    pub(crate) fn measure_flow(&mut self, model: &Model) {
        self.forces.water.measure_flow(model, &self.trial);
    }

    fn push_interface(&self, interface: &mut [DVec3], joint: usize, force: DVec3) {
        match self.plan.attachments[joint] {
            Attachment::Fixed => {}
            Attachment::Free(block) => interface[block] += force,
            Attachment::Body { block, .. } => {
                interface[block] += force;
                interface[block + 1] += self.trial.arm(self.plan.attachments[joint]).cross(force);
            }
        }
    }
}
