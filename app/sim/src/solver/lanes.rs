//! An iteration with rope held as lanes: rope in contact with anything, in water without waves.

use glam::{DMat3, DVec3};

use crate::contact::{ActiveSet, Assembly, Order};
use crate::cost::CostPart;
use crate::forces::laws::Shared;
use crate::forces::{body, pulled};
use crate::model::Model;
use crate::solver::Solver;
use crate::state::State;
use crate::trial::StepContext;
use crate::trial::plan::{Attachment, Plan};
use crate::trial::scheme::Scheme;

/// Rope nearer to the seabed than this is not free [m].
const SEABED_MARGIN_M: f64 = 0.05;

/// Result of an iteration with rope held as lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LanePass {
    /// Longest move of any node or body [m].
    pub longest_m: f64,
    /// Greatest difference between the solved tension and the law at the trial, to second order [N].
    pub gap_n: f64,
    /// Greatest difference across the rope, as a segment turns [N].
    pub turned_n: f64,
    /// Greatest tension of a segment that was assumed taut and is slack in the solution, or the reverse [N].
    pub flipped_n: f64,
    /// Greatest tension [N].
    pub greatest_n: f64,
    /// Whether all moves are finite.
    pub finite: bool,
    /// Whether rope may touch the seabed.
    pub near_seabed: bool,
}

impl Solver {
    /// Whether rope may touch the seabed in a step of this length.
    fn nears_seabed(&self, model: &Model, state: &State, dt: f64) -> bool {
        let Some(seabed) = &model.spec.seabed else { return false };
        let near = |(place, velocity): (&DVec3, &DVec3)| {
            let depth = seabed.depth_of(*place);
            depth.max(depth - seabed.normal.dot(*velocity) * dt) > -SEABED_MARGIN_M
        };
        state.rope.position.iter().zip(&state.rope.velocity).any(near)
    }

    /// Begins a step with rope held as lanes, from a predictor that `change` may change.
    pub(crate) fn begin_in_lanes(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        change: impl FnOnce(&mut Self),
    ) {
        self.system.begin(true);
        self.forces.lengths.take(model, &state.rope.segment_length);
        self.trial.begin_free(model, &self.plan, state, scheme);
        change(self);
        let outer = self.cost.enter(CostPart::Water);
        self.forces.water.measure_flow(model, &self.trial);
        self.cost.enter(outer);
        let Self { system, forces, trial, .. } = self;
        system.lanes.take_lengths(model, &forces.lengths, &state.rope.cut);
        system.lanes.gather(&state.rope, scheme, &trial.place, &forces.water.flow);
        self.near_seabed = self.nears_seabed(model, state, scheme.dt);
        self.system.lanes.leave_ground();
        self.system.clear_contact();
    }

    /// One solution; moves the trial by a share of it.
    pub(crate) fn pass_in_lanes(&mut self, context: &StepContext<'_>, share: f64) -> LanePass {
        let StepContext { model, scheme, .. } = *context;
        let shared = Shared::of(model, scheme);
        self.system.interface.clear();
        self.assemble_on_bodies(context, Order::First);
        if self.near_seabed {
            self.measure_ground(context);
        }
        let Self { system, plan, trial, forces, .. } = self;
        system.eliminate_lanes(model, plan, trial, &shared);
        forces.add_bodies(context, (plan, trial), system);
        self.assemble_on_bodies(context, Order::Last);
        let Self { system, plan, trial, .. } = self;
        pulled::add_pulled(model, scheme, (plan, trial), system);
        self.add_end_turns_in_lanes(model);
        self.system.solve_lanes(model, &self.plan, &self.trial);
        let rope = self.system.lanes.advance(&shared, share);
        let (bodies_m, finite) = self.advance_bodies(share);
        self.system.lanes.give_ends(model, &mut self.trial);
        self.trial.place_ends(model, &self.plan);
        self.system.lanes.take_ends(model, &self.trial);
        LanePass {
            longest_m: rope.longest_m.max(bodies_m),
            gap_n: rope.gap_n,
            turned_n: rope.turned_n,
            flipped_n: rope.flipped_n,
            greatest_n: rope.greatest_n,
            finite: finite && rope.finite,
            near_seabed: self.near_seabed,
        }
    }

    /// Adds contact on bodies, which is made linear again at each solution.
    fn assemble_on_bodies(&mut self, context: &StepContext<'_>, order: Order) {
        let Self { contacts, plan, trial, system, .. } = self;
        let assembly =
            Assembly { context: *context, plan, trial, active_set: ActiveSet::Predicted };
        contacts.assemble_on_bodies(order, &assembly, system);
    }

    /// Copies forces and blocks of the seabed to the lanes.
    fn measure_ground(&mut self, context: &StepContext<'_>) {
        let Self { system, trial, forces, .. } = self;
        system.lanes.give_places(&mut trial.place);
        system.rope.force.fill(DVec3::ZERO);
        system.rope.diagonal.fill(DMat3::ZERO);
        forces.add_seabed(context, trial, system);
        system.lanes.take_ground(&system.rope.force, &system.rope.diagonal);
    }

    /// Adds the turning stiffness of rope that pulls on bodies.
    fn add_end_turns_in_lanes(&mut self, model: &Model) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            for (joint, at_b, sign) in [(line.from, false, 1.0), (line.to, true, -1.0)] {
                let attachment = self.plan.attachments[joint];
                let Attachment::Body { block, .. } = attachment else { continue };
                let (direction, tension) = self.system.lanes.end_pull(index, at_b);
                let arm = Plan::arm(attachment, |body| self.trial.bodies[body].orientation);
                *self.system.interface.at(block + 1, block + 1) +=
                    body::turn_stiffness(arm, direction * (sign * tension.max(0.0)));
            }
        }
    }
}
