//! One solver step outside the iterations: search, predictor, assembly, solution, move, path check and storage.

use glam::{DQuat, DVec3};

use crate::balance::Given;
use crate::balance::source_forces::SourceForces;
use crate::contact::body_on_skin::BodyContact;
use crate::contact::failure::{ContactFailure, Kind};
use crate::contact::{Accepted, ActiveSet, Assembly, ContactPoint, Order, Solution};
use crate::cost::CostPart;
use crate::forces::{Forces, body, pulled, tilt};
use crate::model::Model;
use crate::solver::Solver;
use crate::state::State;
use crate::system::LinearSystem;
use crate::trial::plan::{Attachment, Plan};
use crate::trial::scheme::Scheme;
use crate::trial::{StepContext, Trial};

/// Contact with skin at the end of a solver step.
pub(crate) struct SkinTouches<'a> {
    /// Of rope.
    pub rope: &'a [ContactPoint],
    /// Of bodies.
    pub bodies: &'a [BodyContact],
}

impl Solver {
    /// Finds what may touch in a solver step of length `dt`, and lays out the linear system for it.
    pub(crate) fn find_contacts(
        &mut self,
        model: &Model,
        state: &State,
        dt: f64,
    ) -> Result<(), ContactFailure> {
        self.contacts.find(model, state, dt, self.trial.hitches.span[1])?;
        if self.system.lay_out(model, &self.plan, self.contacts.coupled()) {
            self.linear_part.interface = self.system.interface.clone();
        }
        Ok(())
    }

    /// Begins a step: rope is held as lanes where these can evaluate all its forces, else as lines.
    pub(crate) fn begin_step(&mut self, context: &StepContext<'_>) {
        let StepContext { model, state, scheme } = *context;
        self.in_contact = self.contacts.is_touching();
        self.cost.enter(if self.in_contact { CostPart::Contact } else { CostPart::FreeRope });
        if self.system.suits_lanes(model) {
            self.begin_in_lanes(model, state, scheme, |solver| solver.project_guess(model, state));
        } else {
            self.begin(model, state, scheme);
            self.project_guess(model, state);
        }
    }

    /// Begins a step from a state, with rope held as lines.
    pub(crate) fn begin(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        let Self { forces, trial, plan, system, cost, .. } = self;
        system.begin(false);
        forces.lengths.take(model, &state.rope.segment_length);
        trial.begin(model, plan, state, scheme);
        forces.cut.clone_from(&state.rope.cut);
        let outer = cost.enter(CostPart::Water);
        forces.water.measure_flow(model, trial);
        forces.water.measure_push(&StepContext { model, state, scheme }, &forces.lengths);
        cost.enter(outer);
    }

    /// Moves the predictor out of contact.
    fn project_guess(&mut self, model: &Model, state: &State) {
        if self.in_contact {
            self.contacts.project_guess(state, &mut self.trial);
            self.trial.place_ends(model, &self.plan);
        }
    }

    /// Assembles forces and matrix at the trial places. The order of the calls is the order of the sums.
    pub(crate) fn assemble(&mut self, context: &StepContext<'_>) {
        let StepContext { model, state, scheme } = *context;
        let Self { forces, plan, trial, contacts, system, .. } = self;
        if scheme.is_static() {
            contacts.find_at_rest(state, trial);
        }
        let assembly =
            Assembly { context: *context, plan, trial, active_set: ActiveSet::Predicted };
        system.clear();
        forces.add_nodes(model, scheme, trial, system);
        forces.water.add_push(system);
        forces.add_seabed(context, trial, system);
        contacts.assemble_on_rope(Order::First, &assembly, system);
        contacts.assemble_on_bodies(Order::First, &assembly, system);
        pulled::add_pulled(model, scheme, (plan, trial), system);
        forces.add_tension(model, scheme, trial, system);
        forces.add_bending(model, trial, system);
        forces.add_bodies(context, (plan, trial), system);
        contacts.assemble_on_bodies(Order::Last, &assembly, system);
        add_end_turns(context, forces, (plan, trial), system);
        contacts.assemble_on_rope(Order::Last, &assembly, system);
    }

    /// Assembles forces and matrix with every segment taut or slack by its tension at the trial. What is linear along the
    /// step is stored for the line search.
    pub(crate) fn assemble_searchable(&mut self, context: &StepContext<'_>) {
        let StepContext { model, state, scheme } = *context;
        let Self { forces, plan, trial, contacts, system, linear_part, .. } = self;
        system.clear();
        forces.add_nodes(model, scheme, trial, system);
        forces.water.add_push(system);
        forces.add_seabed(context, trial, system);
        pulled::add_pulled(model, scheme, (plan, trial), system);
        forces.add_bodies(context, (plan, trial), system);
        linear_part.diagonal.clone_from(&system.rope.diagonal);
        linear_part.force.clone_from(&system.rope.force);
        linear_part.interface.copy_values(&system.interface);
        forces.measure_tension(model, scheme, trial);
        if scheme.is_static() {
            contacts.find_at_rest(state, trial);
        }
        let assembly = Assembly { context: *context, plan, trial, active_set: ActiveSet::AtTrial };
        contacts.assemble_on_rope(Order::First, &assembly, system);
        contacts.assemble_on_bodies(Order::First, &assembly, system);
        forces.add_tension(model, scheme, trial, system);
        forces.add_bending(model, trial, system);
        add_end_turns(context, forces, (plan, trial), system);
    }

    /// Solves the assembled system.
    pub(crate) fn solve(&mut self, model: &Model) {
        self.system.solve(model, &self.plan, &self.trial);
    }

    /// Moves the trial by a share of the solved step; returns whether all moves are finite.
    pub(crate) fn advance(&mut self, model: &Model, share: f64) -> bool {
        let Self { forces, plan, trial, contacts, system, .. } = self;
        forces.predict_tension(model, trial, system, share);
        contacts.store_solution(trial, &Solution::Step { system, plan, share });
        let mut finite = true;
        for (place, step) in trial.place.iter_mut().zip(&system.rope.step) {
            *place += *step * share;
            finite &= step.is_finite();
        }
        finite &= self.advance_bodies(share).1;
        self.trial.place_ends(model, &self.plan);
        finite
    }

    /// Moves the bodies by a share of the solved step; returns the longest solved move and whether all are finite.
    pub(super) fn advance_bodies(&mut self, share: f64) -> (f64, bool) {
        let (mut longest, mut finite) = (0.0_f64, true);
        for (index, body) in self.trial.bodies.iter_mut().enumerate().filter(|(_, body)| !body.held)
        {
            let block = self.plan.body_block[index];
            let interface = &self.system.interface;
            let (step, turn) = (interface.step[block], interface.step[block + 1]);
            body.place += step * share;
            body.orientation =
                (DQuat::from_scaled_axis(turn * share) * body.orientation).normalize();
            longest = longest.max(step.length());
            finite &= step.is_finite() && turn.is_finite();
        }
        (longest, finite)
    }

    /// Whether rope whose iterations moved it by `moved_m` in all reached rope, obstacles or bodies that the search did not find; they
    /// are found from now on.
    pub(crate) fn find_more(&mut self, context: &StepContext<'_>, moved_m: f64) -> bool {
        if self.contacts.reads_places(moved_m) {
            self.take_places();
        }
        self.contacts.find_more(context, moved_m, &self.trial.place)
    }

    /// Checks the straight path of the step; adds the crossings that exact tests find.
    ///
    /// With rope held as lanes and far from whale and rope, the path on solids ends at the predictor, from which rope that touches no
    /// solid has not moved as far as a solid's thickness.
    pub(crate) fn check_path(
        &mut self,
        context: &StepContext<'_>,
        crossings: &mut [u64; Kind::COUNT],
    ) -> Result<(), ContactFailure> {
        if self.contacts.checks_path_of_rope() {
            self.take_places();
        }
        self.contacts.check_path(context, &self.trial, crossings)
    }

    /// Tension of each segment at the end of the step being solved; below zero it is slack [N].
    pub(crate) fn tension(&mut self) -> &[f64] {
        if self.system.in_lanes() {
            self.trial.tension.resize(self.forces.lengths.segment.len(), 0.0);
            self.system.lanes.give_tension(&mut self.trial.tension);
        }
        &self.trial.tension
    }

    /// Places of the nodes at the trial.
    pub(crate) fn places(&self) -> &[DVec3] {
        &self.trial.place
    }

    /// Copies the places of rope from the lanes, if rope is held there.
    pub(crate) fn take_places(&mut self) {
        if self.system.in_lanes() {
            self.system.lanes.give_places(&mut self.trial.place);
        }
    }

    /// Forces of each source in a step that is solved and not yet stored.
    pub(crate) fn source_forces(
        &mut self,
        context: &StepContext<'_>,
        skin: &SkinTouches<'_>,
    ) -> Given {
        if self.system.in_lanes() {
            self.tension();
            self.take_places();
            self.trial.take_history(context.state, context.scheme);
            self.forces.cut.clone_from(&context.state.rope.cut);
        }
        let mut on_nodes = core::mem::take(&mut self.system.rope.force);
        let mut sources = SourceForces {
            context: *context,
            plan: &self.plan,
            trial: &self.trial,
            forces: &self.forces,
            system: &mut self.system,
            near_seabed: self.near_seabed,
            rope_on_skin: skin.rope,
            body_on_skin: skin.bodies,
            on_nodes: &mut on_nodes,
            given: Given::default(),
        };
        sources.add_all(&self.contacts);
        let given = sources.given;
        self.system.rope.force = on_nodes;
        given
    }

    /// Writes the solved step into the state.
    pub(crate) fn store(&mut self, model: &Model, scheme: &Scheme, state: &mut State) {
        let in_lanes = self.system.in_lanes();
        if in_lanes && self.near_seabed {
            self.take_places();
        }
        let Self { forces, trial, contacts, system, .. } = self;
        if in_lanes && !self.near_seabed {
            Forces::keep_grips_free(model, scheme, trial, state);
        } else {
            forces.keep_grips(model, scheme, trial, state);
        }
        contacts.store_grips(&Accepted { model, scheme, trial, in_lanes }, state);
        if in_lanes {
            system.lanes.keep(scheme, &mut state.rope);
        } else {
            let rope = &mut state.rope;
            rope.earlier_position.clone_from(&rope.position);
            rope.earlier_velocity.clone_from(&rope.velocity);
            rope.tension.clone_from(&trial.tension);
            for node in 0..model.node_count {
                rope.position[node] = trial.place[node];
                rope.velocity[node] = (trial.place[node] - trial.place_history[node]) * scheme.rate;
            }
        }
        state.rope.earlier_dt_s = scheme.dt;
        self.store_bodies(scheme, state);
        self.contacts.rope_on_solid.keep_within(state);
    }

    /// Writes bodies and time into the state.
    fn store_bodies(&self, scheme: &Scheme, state: &mut State) {
        for (trial, body) in self.trial.bodies.iter().zip(&mut state.bodies) {
            body.earlier_position = body.position;
            body.earlier_velocity = body.velocity;
            body.earlier_orientation = body.orientation;
            body.earlier_spin = body.spin;
            body.position = trial.place;
            body.velocity = (trial.place - trial.place_history) * scheme.rate;
            body.spin = if scheme.is_static() { DVec3::ZERO } else { trial.spin(scheme) };
            body.orientation = trial.orientation;
        }
        state.time_s = self.trial.time;
    }
}

/// Adds the turning stiffness of rope that pulls on bodies (see [`body::turn_stiffness`]).
fn add_end_turns(
    context: &StepContext<'_>,
    forces: &Forces,
    (plan, trial): (&Plan, &Trial),
    system: &mut LinearSystem,
) {
    let StepContext { model, scheme, .. } = *context;
    let turning = if scheme.exact { tilt::turning } else { body::turn_stiffness };
    for (line, segments) in model.spec.lines.iter().zip(&model.line_segments) {
        for (joint, segment, sign) in
            [(line.from, segments.start, 1.0), (line.to, segments.end - 1, -1.0)]
        {
            let attachment = plan.attachments[joint];
            let Attachment::Body { block, .. } = attachment else { continue };
            let force = forces.pull[segment].direction * (sign * trial.tension[segment].max(0.0));
            *system.interface.at(block + 1, block + 1) += turning(trial.arm(attachment), force);
        }
    }
}
