//! The implicit solve: one linear system for ropes, joints and bodies, solved directly.
//!
//! Newton on `M (v - v̂)/h = F(x, v)` with `v = (x - x̂)/h` (`scheme.rs`): each `pass`
//! assembles forces and their derivatives at the trial places, eliminates every line down to its ends
//! (`chain.rs`), solves the hubs (`hubs.rs`) and moves the trial. Cost is linear in the number of nodes;
//! no stiffness or mass ratio limits the step.

mod axial;
mod bending;
mod body;
mod carry;
mod chain;
mod columns;
mod coupled;
mod forces;
mod free;
mod ground;
mod hubs;
mod lanes;
mod lengths;
mod plan;
mod pulled;
mod rest;
mod rope;
mod rope_on_rope;
mod scheme;
mod search;
mod solid;
mod suction;
mod tied;
mod tilt;
mod touch;
mod trial;
mod water;

use glam::{DMat3, DVec3};

use crate::contact::ropes::near::RopeWorkspace;
use crate::model::Model;
use crate::solids::workspace::SolidWorkspace;
use crate::state::State;
use crate::water::WaterAt;
use crate::water::field::Walk;
use crate::whale::hitch::Hitches;
pub(crate) use axial::Axial;
use chain::{Band, Ends};
use coupled::Coupling;
pub(crate) use free::FreePass;
use hubs::{Hubs, Seat};
use lanes::Lanes;
use lengths::Lengths;
use plan::Plan;
pub(crate) use rest::{WorstAt, is_laid};
use rope::Pull;
pub(crate) use scheme::Scheme;
use solid::Judged;
pub(crate) use suction::LOOSE_M;
pub(crate) use tied::RopeContactEnd;
pub(crate) use touch::{CONTACT_WANTED_M, ContactEnd, TENSION_GAP_N, TENSION_GAP_SHARE};
pub(crate) use trial::BodyTrial;
use trial::Trial;

/// Scratch of the solver for one model; it keeps nothing that a step depends on.
#[derive(Clone, Debug)]
pub(crate) struct Solver {
    pub(crate) plan: Plan,
    pub(crate) trial: Trial,
    lengths: Lengths,
    band: Band,
    lanes: Lanes,
    /// Whether rope may touch the seabed in a step of free rope.
    near_seabed: bool,
    hubs: Hubs,
    pull: Vec<Pull>,
    cut: Vec<bool>,
    /// What the pseudo-mass of each line is multiplied by in anchored passes of statics.
    burden: Vec<f64>,
    rest: Rest,
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
    coupling: Coupling,
    /// Rope and bodies before a move.
    before: Vec<DVec3>,
    bodies_before: Vec<BodyTrial>,
    /// Seat and arm of each joint, for a solve again.
    seats: Vec<(Seat, DVec3)>,
}

/// Forces and blocks that the search along a step holds linear.
#[derive(Clone, Debug, Default)]
struct Rest {
    diagonal: Vec<DMat3>,
    force: Vec<DVec3>,
    hubs: Hubs,
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
        let hubs = plan.hubs(model);
        Self {
            rest: Rest { hubs: hubs.clone(), ..Rest::default() },
            hubs,
            plan,
            trial: Trial { hitches: Hitches::new(model), ..Trial::default() },
            lengths: Lengths::default(),
            band: Band::new(model.node_count, model.segment_count),
            lanes: Lanes::new(model),
            near_seabed: false,
            pull: vec![Pull::default(); model.segment_count],
            cut: vec![false; model.segment_count],
            burden: vec![1.0; model.spec.lines.len()],
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
            coupling: Coupling::default(),
            before: Vec::new(),
            bodies_before: Vec::new(),
            seats: Vec::new(),
        }
    }

    /// What is fine enough for the gear at hand.
    pub(crate) fn fine(&self) -> Tolerance {
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
        self.band.clear();
        self.hubs.clear();
        self.coupling.touches.clear();
        self.add_nodes(model, scheme);
        self.add_push();
        self.add_seabed(model, state, scheme);
        self.add_solids(state, scheme, Judged::Foretold);
        self.add_pulled(model, scheme);
        self.add_tension(model, scheme);
        self.add_bending(model);
        self.add_bodies(model, state, scheme);
        self.add_end_turns(model, scheme);
    }

    /// The same with every segment judged by its tension where it is, and what is linear in a search kept apart.
    pub(crate) fn assemble_searchable(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.band.clear();
        self.hubs.clear();
        self.add_nodes(model, scheme);
        self.add_push();
        self.add_seabed(model, state, scheme);
        self.add_pulled(model, scheme);
        self.add_bodies(model, state, scheme);
        self.rest.diagonal.clone_from(&self.band.diagonal);
        self.rest.force.clone_from(&self.band.force);
        self.rest.hubs.copy_values(&self.hubs);
        self.measure_tension(model, scheme);
        self.ropes.follow(&self.trial.place);
        self.add_taut(model, state, scheme);
    }

    /// The same again at the same places, with every segment judged by the tension it has in `trial`.
    fn assemble_again(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.band.clear();
        self.band.diagonal.clone_from(&self.rest.diagonal);
        self.band.force.clone_from(&self.rest.force);
        self.hubs.copy_values(&self.rest.hubs);
        self.add_taut(model, state, scheme);
    }

    /// Adds what a search along a step takes anew, but for contact with skin.
    fn add_taut(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.add_solids(state, scheme, Judged::AsItIs);
        self.add_ropes(state);
        self.add_tension(model, scheme);
        self.add_bending(model);
        self.add_end_turns(model, scheme);
    }

    /// Solves the assembled system; the moves lie in `band.step` and `hubs.step`.
    pub(crate) fn solve(&mut self, model: &Model) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            let (seat_a, seat_b) = (self.plan.seats[line.from], self.plan.seats[line.to]);
            let (nodes, segments) = (&model.line_nodes[index], &model.line_segments[index]);
            let ends = self.band.eliminate(nodes, segments, seat_a != Seat::Fixed);
            self.join(seat_a, seat_b, &ends);
        }
        self.hubs.solve();
        for (index, line) in model.spec.lines.iter().enumerate() {
            let (seat_a, seat_b) = (self.plan.seats[line.from], self.plan.seats[line.to]);
            let step_a = self.hubs.step_of(seat_a, self.arm(seat_a));
            let step_b = self.hubs.step_of(seat_b, self.arm(seat_b));
            self.band.substitute(
                &model.line_nodes[index],
                &model.line_segments[index],
                seat_a != Seat::Fixed,
                step_a,
                step_b,
            );
        }
        self.solve_coupled(model);
    }

    /// Longest solved move of any node or body [m].
    pub(crate) fn longest(&self) -> f64 {
        let nodes = self.band.step.iter().map(|step| step.length_squared()).fold(0.0, f64::max);
        let bodies = self
            .plan
            .body_block
            .iter()
            .map(|block| self.hubs.step[*block].length_squared())
            .fold(nodes, f64::max);
        bodies.sqrt()
    }

    /// Moves the trial by a share of the solved step.
    pub(crate) fn advance(&mut self, model: &Model, share: f64) -> Passed {
        let mut finite = true;
        self.foretell_tension(model, share);
        self.foretell_pushes(share);
        for (place, step) in self.trial.place.iter_mut().zip(&self.band.step) {
            *place += *step * share;
            finite &= step.is_finite();
        }
        finite &= self.advance_bodies(share).1;
        self.trial.seat_ends(model, &self.plan);
        Passed { longest_m: self.longest() * share, finite }
    }

    /// One Newton pass.
    pub(crate) fn pass(&mut self, model: &Model, state: &State, scheme: &Scheme) -> Passed {
        self.assemble(model, state, scheme);
        self.solve(model);
        self.advance(model, 1.0)
    }

    /// One Newton pass that goes along the step as far as the forces balance.
    pub(crate) fn searched_pass(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
    ) -> Passed {
        self.assemble_searchable(model, state, scheme);
        self.solve(model);
        let share = self.search_free(model, state, scheme, 1.0);
        // What a short share leaves is still to go.
        Passed { longest_m: self.longest(), ..self.advance(model, share) }
    }

    /// Greatest force out of balance at any node or hub, as last assembled (before [`solve`](Self::solve)) [N].
    pub(crate) fn residual(&self, model: &Model) -> f64 {
        let mut hubs = self.hubs.force.clone();
        let mut greatest = 0.0_f64;
        for (index, line) in model.spec.lines.iter().enumerate() {
            let nodes = &model.line_nodes[index];
            for node in nodes.start + 1..nodes.end - 1 {
                greatest = greatest.max(self.band.force[node].length());
            }
            for (joint, node) in [(line.from, nodes.start), (line.to, nodes.end - 1)] {
                match self.plan.seats[joint] {
                    Seat::Fixed => {}
                    Seat::Free(block) => hubs[block] += self.band.force[node],
                    Seat::Body { block, .. } => {
                        hubs[block] += self.band.force[node];
                        hubs[block + 1] +=
                            self.arm(self.plan.seats[joint]).cross(self.band.force[node]);
                    }
                }
            }
        }
        for (index, block) in self.plan.body_block.iter().enumerate() {
            let body = &self.trial.bodies[index];
            if body.held {
                hubs[*block] = DVec3::ZERO;
            }
            if body.held || body.upright {
                hubs[block + 1] = DVec3::ZERO;
            }
        }
        for (joint, seat) in model.spec.joints.iter().zip(&self.plan.seats) {
            if let (Seat::Free(block), true) = (seat, self.is_held(&joint.kind, true)) {
                hubs[*block] = DVec3::ZERO;
            }
        }
        // A maximum would pass over what is not a number.
        let all_finite = hubs.iter().chain(&self.band.force).all(|force| force.is_finite());
        if all_finite {
            hubs.iter().map(|force| force.length()).fold(greatest, f64::max)
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
            let steps = &self.band.step[model.line_nodes[*line].clone()];
            steps
                .iter()
                .map(|step| if step.is_finite() { step.length() } else { f64::INFINITY })
                .fold(0.0, f64::max)
        };
        (0..model.spec.lines.len()).max_by(|one, other| size(one).total_cmp(&size(other)))
    }

    fn arm(&self, seat: Seat) -> DVec3 {
        Plan::arm(seat, |body| self.trial.bodies[body].orientation)
    }

    /// Adds what a line leaves on its ends to the hubs.
    fn join(&mut self, seat_a: Seat, seat_b: Seat, ends: &Ends) {
        let (arm_a, arm_b) = (self.arm(seat_a), self.arm(seat_b));
        self.hubs.push(seat_a, arm_a, ends.force_a);
        self.hubs.push(seat_b, arm_b, ends.force_b);
        self.hubs.add(seat_a, arm_a, seat_a, arm_a, ends.aa);
        self.hubs.add(seat_a, arm_a, seat_b, arm_b, ends.ab);
        self.hubs.add(seat_b, arm_b, seat_a, arm_a, ends.ba);
        self.hubs.add(seat_b, arm_b, seat_b, arm_b, ends.bb);
    }

    /// Keeps the turning stiffness of rope pulling on bodies (see [`body::turn_stiffness`]).
    pub(super) fn add_end_turns(&mut self, model: &Model, scheme: &Scheme) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            let segments = &model.line_segments[index];
            for (joint, segment, sign) in
                [(line.from, segments.start, 1.0), (line.to, segments.end - 1, -1.0)]
            {
                let seat = self.plan.seats[joint];
                let Seat::Body { block, .. } = seat else { continue };
                let force =
                    self.pull[segment].direction * (sign * self.trial.tension[segment].max(0.0));
                let turning = if scheme.exact { tilt::turning } else { body::turn_stiffness };
                let stiffness = turning(self.arm(seat), force);
                *self.hubs.at(block + 1, block + 1) += stiffness;
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
