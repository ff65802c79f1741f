//! The linear system of one Newton iteration: `A δ = r` for the moves of rope nodes, free joints and bodies.
//!
//! `r` is the force out of balance, `A = -dr/dx`. Kinds of contact add to both by these functions alone; force laws also write the
//! blocks of nodes, segments and bodies directly:
//!
//! | function | adds |
//! |---|---|
//! | [`add_on_rope`](LinearSystem::add_on_rope), [`add_on_node`](LinearSystem::add_on_node) | a force and its block at a place on rope |
//! | [`add_on_body`](LinearSystem::add_on_body) | a force and its block at a place on a body |
//! | [`couple_ropes`](LinearSystem::couple_ropes), [`couple_bodies`](LinearSystem::couple_bodies) | a force and its block between two places |
//!
//! Rope is held in one of two forms. *Lines*: one block-tridiagonal matrix for each line (`block_tridiagonal.rs`).
//! *Lanes*: pieces of lines side by side in the lanes of the processor (`lanes`), which evaluate the force laws of rope as well.
//! Both eliminate each line down to its two ends, which join the interface system of free joints and bodies (`interface.rs`).
//! Couplings of rope on rope cut the lines at the touched nodes (`coupled.rs`, `lanes/kept.rs`), which join that system; both are
//! sparse (`sparse.rs`).
//! Cost is linear in the number of nodes; no ratio of stiffness or mass limits the step.

pub(crate) mod block_tridiagonal;
pub(crate) mod coupled;
pub(crate) mod interface;
pub(crate) mod lanes;
mod sparse;
#[cfg(test)]
pub(crate) mod tests;

use glam::{DMat3, DVec3};

use crate::forces::laws::Shared;
use crate::model::Model;
use crate::trial::Trial;
use crate::trial::plan::{Attachment, Plan};
use block_tridiagonal::{BlockTridiagonal, Ends};
use coupled::{ContactBlock, CoupledRopes};
use interface::InterfaceSystem;
use lanes::Lanes;

/// Largest number of places at which rope presses on rope at a time: four times as many as in four tight hitches.
const MOST_COUPLINGS: usize = 400;

/// Matrix, right-hand side and solution.
#[derive(Clone, Debug)]
pub(crate) struct LinearSystem {
    /// Rope as lines.
    pub rope: BlockTridiagonal,
    /// Rope as lanes.
    pub lanes: Lanes,
    /// Whether rope is held as lanes in this step.
    in_lanes: bool,
    /// Free joints and bodies.
    pub interface: InterfaceSystem,
    /// Pairs of bodies that the layout of the interface system couples.
    coupled: Vec<[usize; 2]>,
    ropes: CoupledRopes,
    /// Attachment and arm of each joint at the last solution.
    attachments: Vec<(Attachment, DVec3)>,
    #[cfg(test)]
    pub method: tests::Method,
}

impl LinearSystem {
    /// Storage for a model.
    pub fn new(model: &Model, plan: &Plan) -> Self {
        Self {
            rope: BlockTridiagonal::new(model.node_count, model.segment_count),
            lanes: Lanes::new(model),
            in_lanes: false,
            interface: InterfaceSystem::of_model(plan, model, &[]),
            coupled: Vec::new(),
            ropes: CoupledRopes::default(),
            attachments: Vec::new(),
            #[cfg(test)]
            method: tests::Method::default(),
        }
    }

    /// Whether rope of this model can be held as lanes: they evaluate no waves.
    pub fn suits_lanes(&self, model: &Model) -> bool {
        #[cfg(test)]
        if self.method == tests::Method::Dense {
            return false;
        }
        self.lanes.suit(model)
    }

    /// Begins a solver step with rope held in this form.
    pub fn begin(&mut self, in_lanes: bool) {
        self.in_lanes = in_lanes;
        self.ropes.begin();
    }

    /// Whether rope is held as lanes.
    pub fn in_lanes(&self) -> bool {
        self.in_lanes
    }

    /// Lays out the interface matrix for these coupled pairs of bodies; returns whether the layout changed.
    pub fn lay_out(&mut self, model: &Model, plan: &Plan, coupled: &[[usize; 2]]) -> bool {
        debug_assert!(coupled.iter().all(|[one, two]| one != two), "two bodies each: {coupled:?}");
        if self.coupled == coupled {
            return false;
        }
        self.coupled.clear();
        self.coupled.extend_from_slice(coupled);
        self.interface = InterfaceSystem::of_model(plan, model, coupled);
        self.ropes.discard_layout();
        true
    }

    /// Empties matrix and forces, of rope as lines.
    pub fn clear(&mut self) {
        self.rope.clear();
        self.interface.clear();
        self.ropes.couplings.clear();
    }

    /// Removes contact from rope as lanes.
    pub fn clear_contact(&mut self) {
        if self.in_lanes {
            self.lanes.clear_contact();
            self.ropes.couplings.clear();
        }
    }

    /// Adds a force and its block `-dF/dx` at a fraction of a segment, whose first node is `node`.
    pub fn add_on_rope(
        &mut self,
        [segment, node]: [usize; 2],
        fraction: f64,
        force: DVec3,
        block: &DMat3,
    ) {
        debug_assert!(is_fraction(fraction), "fraction {fraction} of a segment");
        if self.in_lanes {
            self.lanes.add_contact(segment, fraction, force, block);
        } else {
            self.rope.add_at(segment, node, fraction, force, block);
        }
    }

    /// Adds a force and its block at a node, which is an end of a segment.
    pub fn add_on_node(&mut self, [segment, node]: [usize; 2], force: DVec3, block: &DMat3) {
        if self.in_lanes {
            let fraction = if self.lanes.first_node_of(segment) == node { 0.0 } else { 1.0 };
            self.lanes.add_contact(segment, fraction, force, block);
        } else {
            self.rope.force[node] += force;
            self.rope.diagonal[node] += *block;
        }
    }

    /// Adds a force and its block at the end of an arm from a body's place.
    pub fn add_on_body(&mut self, body: Attachment, arm: DVec3, force: DVec3, block: DMat3) {
        self.interface.push(body, arm, force);
        self.interface.add(body, arm, body, arm, block);
    }

    /// Adds a force on the first of two places on rope, its reaction on the second, and the block between them.
    /// Returns whether there was room: at most 400 places are coupled at a time.
    pub fn couple_ropes(&mut self, coupling: ContactBlock, force: DVec3) -> bool {
        debug_assert!(
            coupling.fractions.into_iter().all(is_fraction),
            "fractions {:?} of segments",
            coupling.fractions
        );
        if self.ropes.couplings.len() == MOST_COUPLINGS {
            return false;
        }
        for (k, sign) in [(0, 1.0), (1, -1.0)] {
            let (node, fraction) = (coupling.nodes[k], coupling.fractions[k]);
            if self.in_lanes {
                self.lanes.add_force(coupling.segments[k], fraction, force * sign);
                continue;
            }
            self.rope.force[node] += force * (sign * (1.0 - fraction));
            self.rope.force[node + 1] += force * (sign * fraction);
        }
        self.ropes.couplings.push(coupling);
        true
    }

    /// Adds a force on the first of two bodies at the ends of their arms, its reaction on the second, and the block between them.
    /// The layout must couple the two (see [`lay_out`](Self::lay_out)); an obstacle is [`Attachment::Fixed`].
    pub fn couple_bodies(
        &mut self,
        [one, two]: [Attachment; 2],
        [one_arm, two_arm]: [DVec3; 2],
        force: DVec3,
        block: DMat3,
    ) {
        self.interface.push(one, one_arm, force);
        self.interface.push(two, two_arm, -force);
        self.interface.add(one, one_arm, one, one_arm, block);
        self.interface.add(two, two_arm, two, two_arm, block);
        self.interface.add(one, one_arm, two, two_arm, -block);
        self.interface.add(two, two_arm, one, one_arm, -block);
    }

    /// Whether rope presses on rope in the system as assembled.
    pub fn ropes_are_coupled(&self) -> bool {
        !self.ropes.couplings.is_empty()
    }

    /// Solves the assembled system with rope as lines; the moves are in `rope.step` and `interface.step`.
    pub fn solve(&mut self, model: &Model, plan: &Plan, trial: &Trial) {
        self.solve_changed(model, plan, trial, None);
    }

    /// Solves the assembled system with rope as lines. If only some nodes have `changed` since the last solution, what does not depend on
    /// them is kept from it.
    pub fn solve_changed(
        &mut self,
        model: &Model,
        plan: &Plan,
        trial: &Trial,
        changed: Option<&[bool]>,
    ) {
        self.take_attachments(plan, trial);
        #[cfg(test)]
        if self.method == tests::Method::Dense {
            return self.solve_densely(model);
        }
        let coupled = self.ropes_are_coupled();
        let Self { rope, interface, attachments, ropes, .. } = self;
        if coupled {
            return ropes.solve(model, rope, interface, attachments, changed);
        }
        for (index, line) in model.spec.lines.iter().enumerate() {
            let ends = [attachments[line.from], attachments[line.to]];
            let (nodes, segments) = (&model.line_nodes[index], &model.line_segments[index]);
            let left = rope.eliminate(nodes, segments, ends[0].0 != Attachment::Fixed, true);
            join(interface, ends, &left);
        }
        interface.solve();
        for (index, line) in model.spec.lines.iter().enumerate() {
            let [a, b] = [attachments[line.from], attachments[line.to]];
            let [step_a, step_b] = [a, b].map(|(at, arm)| interface.step_of(at, arm));
            let (nodes, segments) = (&model.line_nodes[index], &model.line_segments[index]);
            rope.substitute(nodes, segments, a.0 != Attachment::Fixed, step_a, step_b);
        }
    }

    fn take_attachments(&mut self, plan: &Plan, trial: &Trial) {
        self.attachments.clear();
        self.attachments.extend(
            plan.attachments.iter().map(|attachment| (*attachment, trial.arm(*attachment))),
        );
    }

    /// Evaluates forces and eliminates rope as lanes. The ends of lines join the interface system; if ropes are coupled, the ends of spans
    /// join that of the couplings when it is solved.
    pub fn eliminate_lanes(
        &mut self,
        model: &Model,
        plan: &Plan,
        trial: &Trial,
        shared: &Shared<f64>,
    ) {
        if self.ropes_are_coupled() {
            self.take_attachments(plan, trial);
            let Self { ropes, lanes, interface, attachments, .. } = self;
            ropes.prepare(model, interface, attachments, lanes.cuts());
            lanes.keep_nodes(ropes.touched());
            return lanes.reduce(shared);
        }
        self.lanes.keep_nodes(&[]);
        self.lanes.reduce(shared);
        for (index, line) in model.spec.lines.iter().enumerate() {
            let ends = [line.from, line.to].map(|joint| {
                let attachment = plan.attachments[joint];
                (attachment, trial.arm(attachment))
            });
            let left = self.lanes.line_ends(index, ends[0].0 != Attachment::Fixed);
            join(&mut self.interface, ends, &left);
        }
    }

    /// Solves the interface system and moves the ends of lines by its solution, with rope as lanes.
    pub fn solve_lanes(&mut self, model: &Model, plan: &Plan, trial: &Trial) {
        if self.ropes_are_coupled() {
            let Self { ropes, lanes, interface, attachments, .. } = self;
            return ropes.solve_lanes(lanes, interface, attachments);
        }
        self.interface.solve();
        for (index, line) in model.spec.lines.iter().enumerate() {
            let [a, b] = [line.from, line.to].map(|joint| plan.attachments[joint]);
            let [step_a, step_b] = [a, b].map(|at| self.interface.step_of(at, trial.arm(at)));
            self.lanes.move_ends(index, a != Attachment::Fixed, step_a, step_b);
        }
    }

    /// Longest solved move of any node or body [m].
    pub fn longest(&self, plan: &Plan) -> f64 {
        let nodes = self.rope.step.iter().map(|step| step.length_squared()).fold(0.0, f64::max);
        let bodies = plan
            .body_block
            .iter()
            .map(|block| self.interface.step[*block].length_squared())
            .fold(nodes, f64::max);
        bodies.sqrt()
    }

    /// Longest solved move of any body [m].
    pub fn longest_of_bodies(&self, plan: &Plan) -> f64 {
        let moves = plan.body_block.iter().map(|block| self.interface.step[*block].length());
        moves.fold(0.0, f64::max)
    }
}

/// Whether a number is from 0 to 1, but for rounding. A trial that diverges has numbers that are not finite.
fn is_fraction(number: f64) -> bool {
    (-1e-9..=1.0 + 1e-9).contains(&number) || !number.is_finite()
}

/// Adds a line reduced to its ends to the interface system.
fn join(
    interface: &mut InterfaceSystem,
    [(a, arm_a), (b, arm_b)]: [(Attachment, DVec3); 2],
    ends: &Ends,
) {
    interface.push(a, arm_a, ends.force_a);
    interface.push(b, arm_b, ends.force_b);
    interface.add(a, arm_a, a, arm_a, ends.aa);
    interface.add(a, arm_a, b, arm_b, ends.ab);
    interface.add(b, arm_b, a, arm_a, ends.ba);
    interface.add(b, arm_b, b, arm_b, ends.bb);
}
