//! Bodies on each other and on obstacles in the stages of a solver step.
//!
//! A touch at `p` with normal force and friction `F` on the first body, `-F` on the second, and block `B = -dF/d(p₁ - p₂)` acts on the
//! six freedoms of each and couples them: the layout of the interface matrix holds the blocks of the bodies that may touch in the
//! step. An obstacle has no freedom.

use crate::balance::Source;
use crate::balance::source_forces::SourceForces;
use crate::contact::body_on_body::BodyOnBody;
use crate::contact::failure::{ContactFailure, Kind, Reason};
use crate::contact::{Accepted, Assembly, ContactError, ContactKind, GRIP_STRICTER, Order, Search};
use crate::cost::CostClock;
use crate::state::State;
use crate::system::LinearSystem;
use crate::trial::plan::{Attachment, Plan};
use crate::trial::{BodyTrial, StepContext, Trial};

impl BodyOnBody {
    /// The attachments of a pair of things: obstacles are fixed.
    fn attachments(&self, plan: &Plan, bodies: [usize; 2]) -> [Attachment; 2] {
        bodies.map(
            |thing| {
                if thing < plan.body_block.len() { plan.body(thing) } else { Attachment::Fixed }
            },
        )
    }
}

impl ContactKind for BodyOnBody {
    fn kind(&self) -> Kind {
        Kind::BodyOnBody
    }

    fn find(&mut self, search: &Search<'_>) -> Result<(), ContactFailure> {
        self.gather(search.state, search.dt);
        Ok(())
    }

    fn is_touching(&self) -> bool {
        self.touching
    }

    fn add_couplings(&self, coupled: &mut Vec<[usize; 2]>) {
        coupled.extend(self.coupled());
    }

    fn measure(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
        _: &mut CostClock,
    ) -> Result<(), ContactFailure> {
        if !self.touching {
            return Ok(());
        }
        let poses = trial.bodies.iter().map(BodyTrial::pose);
        self.evaluate(context.state, poses).map_err(|bodies| {
            ContactFailure::refused(Kind::BodyOnBody, bodies, Reason::Overcompressed)
        })
    }

    fn assemble_on_bodies(&self, order: Order, assembly: &Assembly<'_>, system: &mut LinearSystem) {
        if order != Order::Last || !self.touching {
            return;
        }
        let Assembly { plan, trial, .. } = *assembly;
        for touch in self.forces_at(|body| trial.bodies[body].pose()) {
            let bodies = self.attachments(plan, touch.bodies);
            system.couple_bodies(bodies, touch.arms, touch.force, touch.block);
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
        ContactError { gap_n: GRIP_STRICTER * gap_n, greatest_n }
    }

    fn check_path(
        &mut self,
        context: &StepContext<'_>,
        trial: &Trial,
    ) -> Result<u64, ContactFailure> {
        if !self.touching {
            return Ok(0);
        }
        match self.meeting(context.state, |body| trial.bodies[body].pose()) {
            Some(bodies) => {
                Err(ContactFailure::refused(Kind::BodyOnBody, bodies, Reason::Overcompressed))
            }
            None => Ok(0),
        }
    }

    fn store(&self, _: &Accepted<'_>, state: &mut State) {
        self.store_grips(&mut state.pair_grips);
    }

    fn source_forces(&self, sources: &mut SourceForces<'_>) {
        if !self.touching {
            return;
        }
        let trial = sources.trial;
        for touch in self.forces_at(|body| trial.bodies[body].pose()) {
            let [first, second] = touch.bodies;
            let one = sources.motion_of(first).at(touch.arms[0]);
            if second >= trial.bodies.len() {
                sources.given.at_end.add(Source::Obstacles, touch.force, one);
            } else {
                let two = sources.motion_of(second).at(touch.arms[1]);
                sources.given.at_end.contact += touch.force.dot(one - two);
            }
            sources.push_body(first, touch.arms[0], touch.force);
            if second < trial.bodies.len() {
                sources.push_body(second, touch.arms[1], -touch.force);
            }
        }
    }
}
