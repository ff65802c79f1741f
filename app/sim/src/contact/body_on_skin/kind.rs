//! Bodies on skin in the stages of a solver step.
//!
//! A touch at `p` (`measure.rs`) with normal force and friction `F` and block `B = -dF/dp` acts at the arm `r = p - x` of the body's
//! place `x`: on the six freedoms of the body by `F`, `r × F`, and by `B` between the moves of that point. Skin moves as the whale
//! swims, so nothing else is coupled. At the end of a step the floats of the friction law are stored in the state.

use crate::balance::Source;
use crate::balance::source_forces::SourceForces;
use crate::contact::body_on_skin::measure::Unmeasured;
use crate::contact::body_on_skin::{BodyContact, BodyOnSkin};
use crate::contact::failure::{ContactFailure, Kind, Reason};
use crate::contact::law::friction_arrays::Failed;
use crate::contact::{Accepted, Assembly, ContactError, ContactKind, Order, Reports, Search};
use crate::cost::{CostClock, CostPart};
use crate::geometry::Pose;
use crate::model::Friction;
use crate::state::{BodyGrip, BodyGrips, State};
use crate::system::LinearSystem;
use crate::trial::{BodyTrial, StepContext, Trial};

impl ContactKind for BodyOnSkin {
    fn kind(&self) -> Kind {
        Kind::BodyOnSkin
    }

    fn find(&mut self, search: &Search<'_>) -> Result<(), ContactFailure> {
        if self.is_near() {
            self.find_active_pairs(search.state, search.goal, search.dt);
        }
        Ok(())
    }

    fn is_touching(&self) -> bool {
        self.touching
    }

    fn project_guess(&self, state: &State, trial: &mut Trial) {
        if !self.touching {
            return;
        }
        for (body, trial) in trial.bodies.iter_mut().enumerate() {
            let Pose { place, orientation } = self.held_off(state, body, trial.pose());
            (trial.place, trial.orientation) = (place, orientation);
        }
    }

    fn measure(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
        cost: &mut CostClock,
    ) -> Result<(), ContactFailure> {
        cost.enter(CostPart::Detection);
        if !self.touching {
            return Ok(());
        }
        let poses = trial.bodies.iter().map(BodyTrial::pose);
        let StepContext { model, state, scheme } = *context;
        self.evaluate(model, state, poses, scheme.dt).map_err(|why| match why {
            Unmeasured::Crushed(body, triangle) => {
                ContactFailure::refused(Kind::BodyOnSkin, [body, triangle], Reason::Overcompressed)
            }
            Unmeasured::Plugin(failed) => ContactFailure::Plugin(failed),
        })
    }

    fn assemble_on_bodies(&self, order: Order, assembly: &Assembly<'_>, system: &mut LinearSystem) {
        if order != Order::Last || !self.touching {
            return;
        }
        let Assembly { plan, trial, .. } = *assembly;
        for force in self.forces_at(|body| trial.bodies[body].pose()) {
            system.add_on_body(plan.body(force.body), force.arm, force.force, force.block);
        }
    }

    fn store_iteration(&mut self, trial: &Trial) {
        if self.touching {
            self.store_solved(|body| trial.bodies[body].pose());
        }
    }

    fn error(&mut self, _: &StepContext<'_>, _: &Trial) -> ContactError {
        if !self.touching {
            return ContactError::default();
        }
        let [gap_n, greatest_n] = self.error_n();
        ContactError { gap_n, greatest_n }
    }

    fn check_path(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
    ) -> Result<u64, ContactFailure> {
        if !self.is_near() {
            return Ok(0);
        }
        self.end_path(context.state, |body| trial.bodies[body].pose())
            .map_err(|(parts, reason)| ContactFailure::refused(Kind::BodyOnSkin, parts, reason))
    }

    fn reject(&mut self) {
        self.go_back();
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
                .advance_friction(friction, scheme.dt, &mut state.body_grips, reports.body_on_skin)
                .map_err(ContactFailure::Plugin),
            _ => {
                state.body_grips.clear();
                Ok(())
            }
        }
    }

    fn source_forces(&self, sources: &mut SourceForces<'_>) {
        for contact in sources.body_on_skin {
            let force = contact.normal * contact.normal_force_n + contact.friction_n;
            let arm = contact.position - sources.trial.bodies[contact.body].place;
            let velocity = sources.motion_of(contact.body).at(arm);
            sources.given.at_end.add(Source::Skin, force, velocity);
            sources.push_body(contact.body, arm, force);
        }
    }
}

impl BodyOnSkin {
    /// Stores the grips of an accepted step, and reports contact.
    pub fn advance_friction(
        &mut self,
        friction: &Friction,
        dt_s: f64,
        grips: &mut BodyGrips,
        contacts: &mut Vec<BodyContact>,
    ) -> Result<(), Failed> {
        contacts.clear();
        self.arrays.advance(friction, dt_s)?;
        grips.clear();
        for (place, touch) in self.touches.iter().enumerate() {
            grips.contacts.push(BodyGrip {
                part: touch.part,
                place: self.measured[touch.body].inward(touch.place),
                normal: touch.normal,
            });
            self.arrays.keep(friction, place, &mut grips.floats);
            contacts.push(BodyContact {
                body: touch.body,
                triangle: self.pairs[touch.pair].triangle as usize,
                region: touch.region,
                position: touch.place,
                normal: touch.normal,
                depth_m: touch.depth,
                normal_force_n: touch.push_n,
                friction_n: self.arrays.friction_of(place),
                slip_m: self.arrays.slip_of(place),
            });
        }
        Ok(())
    }
}
