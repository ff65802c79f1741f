//! Rope on skin in the stages of a solver step.

use crate::balance::Source;
use crate::balance::source_forces::SourceForces;
use crate::contact::failure::{ContactFailure, Kind, Reason};
use crate::contact::law::barrier::CRUSHED_SHARE;
use crate::contact::rope_on_skin::RopeOnSkin;
use crate::contact::{Accepted, Assembly, ContactError, ContactKind, Order, Reports, Search};
use crate::cost::{CostClock, CostPart};
use crate::state::State;
use crate::system::LinearSystem;
use crate::trial::{StepContext, Trial};

impl ContactKind for RopeOnSkin {
    fn kind(&self) -> Kind {
        Kind::RopeOnSkin
    }

    fn find(&mut self, search: &Search<'_>) -> Result<(), ContactFailure> {
        let is_near = self.is_near();
        self.touching = is_near && self.find_active_pairs(search.state, search.goal, search.dt);
        if is_near && let Some(segment) = self.near.crossed() {
            let parts = [segment, 0];
            return Err(ContactFailure::refused(Kind::RopeOnSkin, parts, Reason::CrossedAtStart));
        }
        Ok(())
    }

    fn is_touching(&self) -> bool {
        self.touching
    }

    fn adds_on_rope(&self) -> bool {
        self.touching
    }

    fn checks_path_of_rope(&self) -> bool {
        self.is_near()
    }

    fn project_guess(&self, state: &State, trial: &mut Trial) {
        if self.touching {
            self.near.hold_off(&state.rope.position, &mut trial.place);
        }
    }

    fn open(&mut self, context: &StepContext<'_>, trial: &Trial) {
        if self.touching {
            let StepContext { model, state, .. } = *context;
            self.near.follow(&state.rope.position, &trial.place);
            self.open_active_points(model, state, &trial.place);
            self.is_measured = true;
            self.solved_friction.clear();
        }
    }

    fn open_more(&mut self, _: &StepContext<'_>, trial: &Trial) -> bool {
        let opened = self.touching && self.points.open_more(&self.near, &trial.place) > 0;
        if opened {
            self.solved_friction.clear();
        }
        opened
    }

    fn measure(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
        cost: &mut CostClock,
    ) -> Result<(), ContactFailure> {
        if !self.touching {
            return Ok(());
        }
        let StepContext { model, state, scheme } = *context;
        cost.enter(CostPart::Detection);
        if !std::mem::take(&mut self.is_measured) {
            self.near.follow(&state.rope.position, &trial.place);
            self.points.measure(&self.near, &trial.place);
        }
        cost.enter(CostPart::Contact);
        if let Some(parts) = self.nearer_than(CRUSHED_SHARE) {
            return Err(ContactFailure::refused(
                Kind::RopeOnSkin,
                parts.into(),
                Reason::Overcompressed,
            ));
        }
        let Some(friction) = &model.spec.friction else { return Ok(()) };
        let Self { near, points, friction: touching, .. } = self;
        touching.collect(model, near, points, state);
        touching.arrays.respond(friction, scheme.dt).map_err(ContactFailure::Plugin)
    }

    fn begin_iteration(&mut self, context: &StepContext<'_>, trial: &Trial) {
        self.is_measured = false;
        if self.touching {
            self.hold_reversed(context.model, context.scheme.dt);
            self.before.clone_from(&trial.place);
            self.store_blocks();
        }
    }

    fn assemble_on_rope(
        &mut self,
        order: Order,
        assembly: &Assembly<'_>,
        system: &mut LinearSystem,
    ) {
        if order == Order::Last && self.touching {
            for (point, force, block) in self.contacts_at(&assembly.trial.place) {
                system.add_on_rope([point.segment, point.node], point.fraction, force, block);
            }
        }
    }

    fn law_error(&self, trial: &Trial) -> ContactError {
        if self.touching { self.law_error_at(&trial.place) } else { ContactError::default() }
    }

    fn linearise_at_solution(&mut self, trial: &Trial) {
        if self.touching {
            self.follow_law(&trial.place);
        }
    }

    fn store_iteration(&mut self, trial: &Trial) {
        if self.touching {
            self.store_solved(&trial.place);
        }
    }

    fn error(&mut self, _: &StepContext<'_>, _: &Trial) -> ContactError {
        if self.touching { self.solution_error() } else { ContactError::default() }
    }

    fn check_path(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
    ) -> Result<u64, ContactFailure> {
        if !self.is_near() {
            return Ok(0);
        }
        let refused = |parts, reason| ContactFailure::refused(Kind::RopeOnSkin, parts, reason);
        let from = &context.state.rope.position;
        if self.touching
            && let Some(parts) = self.pinched(from)
        {
            return Err(refused(parts.into(), Reason::Overcompressed));
        }
        if self.has_left_margin(&trial.place) {
            return Err(refused([0, 0], Reason::LeftSearchMargin));
        }
        let crossings = self.near.end(from, &trial.place);
        crossings.ok_or_else(|| refused([0, 0], Reason::PathNotProved))
    }

    fn reject(&mut self) {
        self.near.go_back();
    }

    fn accept(
        &mut self,
        accepted: &Accepted<'_>,
        state: &mut State,
        reports: &mut Reports<'_>,
    ) -> Result<(), ContactFailure> {
        let Accepted { model, scheme, .. } = *accepted;
        match &model.spec.friction {
            Some(friction) if self.touching => self
                .advance_friction(model, friction, scheme.dt, state, reports.rope_on_skin)
                .map_err(ContactFailure::Plugin),
            _ => {
                state.rope.friction.clear();
                Ok(())
            }
        }
    }

    fn source_forces(&self, sources: &mut SourceForces<'_>) {
        for contact in sources.rope_on_skin {
            let node = sources.plan.segment_node[contact.segment];
            let force = contact.normal * contact.normal_force_n + contact.friction_n;
            let velocity = sources.velocity_at(node, contact.fraction);
            sources.given.at_end.add(Source::Skin, force, velocity);
            sources.push_at(node, contact.fraction, force);
        }
    }
}
