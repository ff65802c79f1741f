//! A solver step in the lanes of the processor: rope that water, seabed, skin, obstacles and bodies touch, but no other rope.

use glam::{DMat3, DQuat, DVec3};

use crate::cost::CostPart;
use crate::forces::body;
use crate::forces::laws::Shared;
use crate::model::Model;
use crate::solver::Solver;
use crate::state::State;
use crate::trial::plan::Attachment;
use crate::trial::plan::Plan;
use crate::trial::scheme::Scheme;

/// Rope nearer to the seabed than this is not free [m].
const SEABED_MARGIN_M: f64 = 0.05;

/// What a pass of free rope did.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LanePass {
    /// Longest move of any node or body [m].
    pub longest_m: f64,
    /// Greatest difference between the pull solved for and the tension at its place, to second order [N].
    pub gap_n: f64,
    /// Greatest difference between the pull solved for and there across the rope, as a segment turns [N].
    pub turned_n: f64,
    /// Greatest tension of a segment that was solved as taut and comes out slack, or the reverse [N].
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

    /// Begins a step in the lanes, from a guess that may be changed.
    pub(crate) fn begin_in_lanes(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        change: impl FnOnce(&mut Self),
    ) {
        self.in_lanes = true;
        self.lengths.take(model, &state.rope.segment_length);
        self.trial.begin_free(model, &self.plan, state, scheme);
        change(self);
        let outer = self.cost.enter(CostPart::Water);
        self.measure_flow(model);
        self.cost.enter(outer);
        self.lanes.take_lengths(model, &self.lengths, &state.rope.cut);
        self.lanes.gather(&state.rope, scheme, &self.trial.place, &self.flow);
        self.near_seabed = self.nears_seabed(model, state, scheme.dt);
        self.lanes.leave_ground();
        self.lanes.leave_contact();
    }

    /// One Newton pass that moves the trial by a share of what it solves.
    pub(crate) fn pass_in_lanes(
        &mut self,
        model: &Model,
        state: &State,
        scheme: &Scheme,
        share: f64,
    ) -> LanePass {
        let shared = Shared::of(model, scheme);
        self.interface.clear();
        if self.solid.touching {
            self.push_bodies_by_rope();
        }
        if self.near_seabed {
            self.measure_ground(model, state, scheme);
        }
        self.lanes.reduce(&shared);
        for (index, line) in model.spec.lines.iter().enumerate() {
            let (attachment_a, attachment_b) =
                (self.plan.attachments[line.from], self.plan.attachments[line.to]);
            let ends = self.lanes.line_ends(index, attachment_a != Attachment::Fixed);
            self.join(attachment_a, attachment_b, &ends);
        }
        self.add_bodies(model, state, scheme);
        self.add_pulled(model, scheme);
        self.add_end_turns_free(model);
        self.interface.solve();
        for (index, line) in model.spec.lines.iter().enumerate() {
            let (attachment_a, attachment_b) =
                (self.plan.attachments[line.from], self.plan.attachments[line.to]);
            let step_a = self.interface.step_of(attachment_a, self.arm(attachment_a));
            let step_b = self.interface.step_of(attachment_b, self.arm(attachment_b));
            self.lanes.move_ends(index, attachment_a != Attachment::Fixed, step_a, step_b);
        }
        let rope = self.lanes.advance(&shared, share);
        let (bodies_m, finite) = self.advance_bodies(share);
        self.lanes.give_ends(model, &mut self.trial);
        self.trial.place_ends(model, &self.plan);
        self.lanes.take_ends(model, &self.trial);
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

    /// Hands the seabed's forces and blocks to the lanes.
    fn measure_ground(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.lanes.give_places(&mut self.trial.place);
        self.tridiagonal.force.fill(DVec3::ZERO);
        self.tridiagonal.diagonal.fill(DMat3::ZERO);
        self.add_seabed(model, state, scheme);
        self.lanes.take_ground(&self.tridiagonal.force, &self.tridiagonal.diagonal);
    }

    /// Writes the solved step into the state.
    pub(crate) fn keep_from_lanes(&mut self, model: &Model, scheme: &Scheme, state: &mut State) {
        if self.near_seabed {
            self.lanes.give_places(&mut self.trial.place);
            self.keep_grips(model, scheme, state);
        } else {
            self.keep_grips_free(model, scheme, state);
        }
        if self.solid.touching {
            self.keep_solid_grips(scheme, state);
        } else {
            state.rope.solid_grips.clear();
        }
        self.lanes.keep(scheme, &mut state.rope);
        state.rope.earlier_dt_s = scheme.dt;
        state.rope.rope_grips.clear();
        self.keep_bodies(scheme, state);
    }

    /// Takes the places of rope out of the lanes, where the step was solved there.
    pub(crate) fn take_places(&mut self) {
        if self.in_lanes {
            self.lanes.give_places(&mut self.trial.place);
        }
    }

    /// Moves the bodies by a share of the solved step; the longest solved move and whether all are finite.
    pub(crate) fn advance_bodies(&mut self, share: f64) -> (f64, bool) {
        let (mut longest, mut finite) = (0.0_f64, true);
        for (index, body) in self.trial.bodies.iter_mut().enumerate().filter(|(_, body)| !body.held)
        {
            let block = self.plan.body_block[index];
            let (step, turn) = (self.interface.step[block], self.interface.step[block + 1]);
            body.place += step * share;
            body.orientation =
                (DQuat::from_scaled_axis(turn * share) * body.orientation).normalize();
            longest = longest.max(step.length());
            finite &= step.is_finite() && turn.is_finite();
        }
        (longest, finite)
    }

    /// The turning stiffness of rope pulling on bodies.
    fn add_end_turns_free(&mut self, model: &Model) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            for (joint, at_b, sign) in [(line.from, false, 1.0), (line.to, true, -1.0)] {
                let attachment = self.plan.attachments[joint];
                let Attachment::Body { block, .. } = attachment else { continue };
                let (direction, tension) = self.lanes.end_pull(index, at_b);
                let arm = Plan::arm(attachment, |body| self.trial.bodies[body].orientation);
                *self.interface.at(block + 1, block + 1) +=
                    body::turn_stiffness(arm, direction * (sign * tension.max(0.0)));
            }
        }
    }
}

#[cfg(test)]
#[path = "in_lanes_tests.rs"]
pub(crate) mod tests;
