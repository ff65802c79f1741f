//! The implicit solve: one linear system for ropes, joints and bodies, solved directly.
//!
//! Newton on `M (v - v̂)/h = F(x, v)` with `v = (x - x̂)/h` (`scheme.rs`): each `pass`
//! assembles forces and their derivatives at the trial places, eliminates every line down to its ends
//! (`block_tridiagonal.rs`), solves the interface system (`interface.rs`) and moves the trial. Cost is linear in the number of nodes;
//! no stiffness or mass ratio limits the step.

mod axial;
mod bending;
mod block_tridiagonal;
mod body;
mod carry;
mod columns;
mod contact_newton;
mod elastic_grip;
mod forces;
mod free;
mod interface;
mod lanes;
mod lengths;
mod line_search;
mod plan;
mod pulled;
mod rest;
mod rope;
mod rope_contact_newton;
mod rope_on_rope;
mod scheme;
mod seabed;
mod solid;
mod suction;
mod tilt;
mod trial;
mod water;
mod woodbury;

use glam::{DMat3, DVec3};

use crate::contact::ropes::near::RopeWorkspace;
use crate::model::Model;
use crate::solids::workspace::SolidWorkspace;
use crate::state::State;
use crate::water::WaterAt;
use crate::water::field::Walk;
use crate::whale::hitch::Hitches;
pub(crate) use axial::Axial;
use block_tridiagonal::{BlockTridiagonal, Ends};
pub(crate) use contact_newton::{CONTACT_WANTED_M, ContactEnd, TENSION_GAP_N, TENSION_GAP_SHARE};
pub(crate) use free::FreePass;
use interface::{Attachment, InterfaceSystem};
use lanes::Lanes;
use lengths::Lengths;
use plan::Plan;
pub(crate) use rest::{WorstAt, is_laid};
use rope::Pull;
pub(crate) use rope_contact_newton::RopeContactEnd;
pub(crate) use scheme::Scheme;
use solid::ActiveSet;
pub(crate) use suction::LOOSE_M;
pub(crate) use trial::BodyTrial;
use trial::Trial;
use woodbury::Woodbury;

/// Scratch of the solver for one model; it keeps nothing that a step depends on.
#[derive(Clone, Debug)]
pub(crate) struct Solver {
    pub(crate) plan: Plan,
    pub(crate) trial: Trial,
    lengths: Lengths,
    tridiagonal: BlockTridiagonal,
    lanes: Lanes,
    /// Whether rope may touch the seabed in a step of free rope.
    near_seabed: bool,
    interface: InterfaceSystem,
    pull: Vec<Pull>,
    cut: Vec<bool>,
    /// What the pseudo-mass of each line is multiplied by in anchored passes of statics.
    pseudo_mass_scale: Vec<f64>,
    linear_part: LinearPart,
    /// Velocity of the water at each node: current and waves [m/s].
    flow: Vec<DVec3>,
    /// Acceleration of the water at each node; empty where there are no waves [m/s²].
    flow_acceleration: Vec<DVec3>,
    /// Height of the surface above each node's z = 0; empty where there are no waves [m].
    surface: Vec<f64>,
    /// What the water's acceleration does to each node through pressure and added mass; empty where there are no waves [N].
    push: Vec<DVec3>,
    /// The water at each body.
    flow_bodies: Vec<WaterAt>,
    wave_walk: Walk,
    /// Where rope and bodies would go on their own from where a step with contact begins.
    pub(crate) drift: Vec<DVec3>,
    pub(crate) drift_bodies: Vec<BodyTrial>,
    /// Rope near obstacles and bodies.
    pub(crate) solid: SolidWorkspace,
    /// Rope near rope.
    pub(crate) ropes: RopeWorkspace,
    woodbury: Woodbury,
    /// Rope and bodies before a move.
    before: Vec<DVec3>,
    bodies_before: Vec<BodyTrial>,
    /// Attachment and arm of each joint, for a solve again.
    attachments: Vec<(Attachment, DVec3)>,
}

/// Forces and blocks that the search along a step holds linear.
#[derive(Clone, Debug, Default)]
struct LinearPart {
    diagonal: Vec<DMat3>,
    force: Vec<DVec3>,
    interface: InterfaceSystem,
}

/// What is fine enough for a small rig or short segments, below the usual tolerances.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// Move of the last pass [m].
    pub move_m: f64,
    /// Difference between solved and true tension [N].
    pub gap_n: f64,
}

/// Move of the last pass, as a share of the shortest segment.
const FINE_MOVE_SHARE: f64 = 0.02;
/// Difference of tension, as a share of the weight of all gear.
const FINE_GAP_SHARE: f64 = 0.02;

/// What a pass did.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passed {
    /// Longest move of any node or body [m].
    pub longest_m: f64,
    /// Whether all moves are finite.
    pub finite: bool,
}

impl Solver {
    /// Scratch for a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let plan = Plan::new(model);
        let interface = plan.interface(model);
        Self {
            linear_part: LinearPart { interface: interface.clone(), ..LinearPart::default() },
            interface,
            plan,
            trial: Trial { hitches: Hitches::new(model), ..Trial::default() },
            lengths: Lengths::default(),
            tridiagonal: BlockTridiagonal::new(model.node_count, model.segment_count),
            lanes: Lanes::new(model),
            near_seabed: false,
            pull: vec![Pull::default(); model.segment_count],
            cut: vec![false; model.segment_count],
            pseudo_mass_scale: vec![1.0; model.spec.lines.len()],
            flow: vec![DVec3::ZERO; model.node_count],
            flow_acceleration: Vec::new(),
            surface: Vec::new(),
            push: Vec::new(),
            flow_bodies: Vec::new(),
            wave_walk: Walk::default(),
            drift: Vec::new(),
            drift_bodies: Vec::new(),
            solid: SolidWorkspace::new(model),
            ropes: RopeWorkspace::new(model),
            woodbury: Woodbury::default(),
            before: Vec::new(),
            bodies_before: Vec::new(),
            attachments: Vec::new(),
        }
    }

    /// What is fine enough for the gear at hand.
    pub(crate) fn tolerance(&self) -> Tolerance {
        Tolerance {
            move_m: FINE_MOVE_SHARE * self.lengths.shortest,
            gap_n: FINE_GAP_SHARE * self.plan.weight_n,
        }
    }

    /// Begins a step from a state.
    pub(crate) fn begin(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.lengths.take(model, &state.rope.segment_length);
        self.trial.begin(model, &self.plan, state, scheme);
        self.cut.clone_from(&state.rope.cut);
        self.measure_flow(model);
        self.measure_push(model, state, scheme);
    }

    /// Assembles forces and matrix at the trial places.
    pub(crate) fn assemble(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.tridiagonal.clear();
        self.interface.clear();
        self.woodbury.touches.clear();
        self.add_nodes(model, scheme);
        self.add_push();
        self.add_seabed(model, state, scheme);
        self.add_solids(state, scheme, ActiveSet::Predicted);
        self.add_pulled(model, scheme);
        self.add_tension(model, scheme);
        self.add_bending(model);
        self.add_bodies(model, state, scheme);
        self.add_end_turns(model, scheme);
    }

    /// Assembles forces and matrix with every segment taut or slack by its tension where it is. What is linear along the
    /// step is kept apart for the line search.
    pub(crate) fn assemble_searchable(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.tridiagonal.clear();
        self.interface.clear();
        self.add_nodes(model, scheme);
        self.add_push();
        self.add_seabed(model, state, scheme);
        self.add_pulled(model, scheme);
        self.add_bodies(model, state, scheme);
        self.linear_part.diagonal.clone_from(&self.tridiagonal.diagonal);
        self.linear_part.force.clone_from(&self.tridiagonal.force);
        self.linear_part.interface.copy_values(&self.interface);
        self.measure_tension(model, scheme);
        self.ropes.follow(&self.trial.place);
        self.add_taut(model, state, scheme);
    }

    /// Assembles again at the places of [`assemble_searchable`](Self::assemble_searchable), with every segment taut or
    /// slack by the tension it has in `trial`.
    fn assemble_again(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.tridiagonal.clear();
        self.tridiagonal.diagonal.clone_from(&self.linear_part.diagonal);
        self.tridiagonal.force.clone_from(&self.linear_part.force);
        self.interface.copy_values(&self.linear_part.interface);
        self.add_taut(model, state, scheme);
    }

    /// Adds what a search along a step takes anew, but for contact with skin.
    fn add_taut(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.add_solids(state, scheme, ActiveSet::AtTrial);
        self.add_ropes(state);
        self.add_tension(model, scheme);
        self.add_bending(model);
        self.add_end_turns(model, scheme);
    }

    /// Solves the assembled system; the moves lie in `tridiagonal.step` and `interface.step`.
    pub(crate) fn solve(&mut self, model: &Model) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            let (attachment_a, attachment_b) =
                (self.plan.attachments[line.from], self.plan.attachments[line.to]);
            let (nodes, segments) = (&model.line_nodes[index], &model.line_segments[index]);
            let ends =
                self.tridiagonal.eliminate(nodes, segments, attachment_a != Attachment::Fixed);
            self.join(attachment_a, attachment_b, &ends);
        }
        self.interface.solve();
        for (index, line) in model.spec.lines.iter().enumerate() {
            let (attachment_a, attachment_b) =
                (self.plan.attachments[line.from], self.plan.attachments[line.to]);
            let step_a = self.interface.step_of(attachment_a, self.arm(attachment_a));
            let step_b = self.interface.step_of(attachment_b, self.arm(attachment_b));
            self.tridiagonal.substitute(
                &model.line_nodes[index],
                &model.line_segments[index],
                attachment_a != Attachment::Fixed,
                step_a,
                step_b,
            );
        }
        self.correct_for_rope_contact(model);
    }

    /// Longest solved move of any node or body [m].
    pub(crate) fn longest(&self) -> f64 {
        let nodes =
            self.tridiagonal.step.iter().map(|step| step.length_squared()).fold(0.0, f64::max);
        let bodies = self
            .plan
            .body_block
            .iter()
            .map(|block| self.interface.step[*block].length_squared())
            .fold(nodes, f64::max);
        bodies.sqrt()
    }

    /// Moves the trial by a share of the solved step.
    pub(crate) fn advance(&mut self, model: &Model, share: f64) -> Passed {
        let mut finite = true;
        self.predict_tension(model, share);
        self.predict_pushes(share);
        for (place, step) in self.trial.place.iter_mut().zip(&self.tridiagonal.step) {
            *place += *step * share;
            finite &= step.is_finite();
        }
        finite &= self.advance_bodies(share).1;
        self.trial.place_ends(model, &self.plan);
        Passed { longest_m: self.longest() * share, finite }
    }

    /// One Newton pass.
    pub(crate) fn pass(&mut self, model: &Model, state: &State, scheme: &Scheme) -> Passed {
        self.assemble(model, state, scheme);
        self.solve(model);
        self.advance(model, 1.0)
    }

    /// One Newton pass that goes along the step as far as the forces balance.
    pub(crate) fn line_searched_pass(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
    ) -> Passed {
        self.assemble_searchable(model, state, scheme);
        self.solve(model);
        let share = self.line_search_free(model, state, scheme, 1.0);
        // What a short share leaves is still to go.
        Passed { longest_m: self.longest(), ..self.advance(model, share) }
    }

    /// Greatest force out of balance at any node or interface block, as last assembled (before [`solve`](Self::solve)) [N].
    pub(crate) fn residual(&self, model: &Model) -> f64 {
        let mut interface = self.interface.force.clone();
        let mut greatest = 0.0_f64;
        for (index, line) in model.spec.lines.iter().enumerate() {
            let nodes = &model.line_nodes[index];
            for node in nodes.start + 1..nodes.end - 1 {
                greatest = greatest.max(self.tridiagonal.force[node].length());
            }
            for (joint, node) in [(line.from, nodes.start), (line.to, nodes.end - 1)] {
                match self.plan.attachments[joint] {
                    Attachment::Fixed => {}
                    Attachment::Free(block) => interface[block] += self.tridiagonal.force[node],
                    Attachment::Body { block, .. } => {
                        interface[block] += self.tridiagonal.force[node];
                        interface[block + 1] += self
                            .arm(self.plan.attachments[joint])
                            .cross(self.tridiagonal.force[node]);
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
            if let (Attachment::Free(block), true) = (attachment, self.is_held(&joint.kind, true)) {
                interface[*block] = DVec3::ZERO;
            }
        }
        // A maximum would pass over what is not a number.
        let all_finite =
            interface.iter().chain(&self.tridiagonal.force).all(|force| force.is_finite());
        if all_finite {
            interface.iter().map(|force| force.length()).fold(greatest, f64::max)
        } else {
            f64::INFINITY
        }
    }

    /// Tension of each segment at the end of the step being solved; below zero it is slack [N].
    pub(crate) fn tension(&self) -> &[f64] {
        &self.trial.tension
    }

    /// The line with the longest or a not finite move in the last solve.
    pub(crate) fn worst_line(&self, model: &Model) -> Option<usize> {
        let size = |line: &usize| {
            let steps = &self.tridiagonal.step[model.line_nodes[*line].clone()];
            steps
                .iter()
                .map(|step| if step.is_finite() { step.length() } else { f64::INFINITY })
                .fold(0.0, f64::max)
        };
        (0..model.spec.lines.len()).max_by(|one, other| size(one).total_cmp(&size(other)))
    }

    fn arm(&self, attachment: Attachment) -> DVec3 {
        Plan::arm(attachment, |body| self.trial.bodies[body].orientation)
    }

    /// Adds what a line leaves on its ends to the interface system.
    fn join(&mut self, attachment_a: Attachment, attachment_b: Attachment, ends: &Ends) {
        let (arm_a, arm_b) = (self.arm(attachment_a), self.arm(attachment_b));
        self.interface.push(attachment_a, arm_a, ends.force_a);
        self.interface.push(attachment_b, arm_b, ends.force_b);
        self.interface.add(attachment_a, arm_a, attachment_a, arm_a, ends.aa);
        self.interface.add(attachment_a, arm_a, attachment_b, arm_b, ends.ab);
        self.interface.add(attachment_b, arm_b, attachment_a, arm_a, ends.ba);
        self.interface.add(attachment_b, arm_b, attachment_b, arm_b, ends.bb);
    }

    /// Keeps the turning stiffness of rope pulling on bodies (see [`body::turn_stiffness`]).
    pub(super) fn add_end_turns(&mut self, model: &Model, scheme: &Scheme) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            let segments = &model.line_segments[index];
            for (joint, segment, sign) in
                [(line.from, segments.start, 1.0), (line.to, segments.end - 1, -1.0)]
            {
                let attachment = self.plan.attachments[joint];
                let Attachment::Body { block, .. } = attachment else { continue };
                let force =
                    self.pull[segment].direction * (sign * self.trial.tension[segment].max(0.0));
                let turning = if scheme.exact { tilt::turning } else { body::turn_stiffness };
                let stiffness = turning(self.arm(attachment), force);
                *self.interface.at(block + 1, block + 1) += stiffness;
            }
        }
    }

    /// Writes the solved step into the state.
    pub(crate) fn keep(&self, model: &Model, scheme: &Scheme, state: &mut State) {
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
    fn keep_bodies(&self, scheme: &Scheme, state: &mut State) {
        for (trial, body) in self.trial.bodies.iter().zip(&mut state.bodies) {
            body.earlier_position = body.position;
            body.earlier_velocity = body.velocity;
            body.position = trial.place;
            body.velocity = (trial.place - trial.place_history) * scheme.rate;
            body.spin = if scheme.is_static() {
                DVec3::ZERO
            } else {
                body::spin(trial.orientation, body.orientation, scheme.dt)
            };
            body.orientation = trial.orientation;
        }
        state.time_s = self.trial.time;
    }
}
