//! Bodies of the rig pressed on skin, in the linear system of a step: force and moment on the body's place and rotation.
//!
//! A touch at `p` (`contact/bodies/measure.rs`) with push and friction `F` and block `B = -dF/dp` acts at the arm `r = p - x` of the body's place
//! `x`: on the six freedoms of the body by `F`, `r × F`, and by `B` between the moves of that point. Skin moves as the whale
//! swims, so nothing else is coupled.

use crate::contact::ContactMissed;
use crate::contact::body_on_skin::BodySkin;
use crate::contact::body_on_skin::measure::Unmeasured;
use crate::contact::body_on_skin::path::Refused;
use crate::cost::CostPart;
use crate::geometry::Pose;
use crate::solver::Solver;
use crate::solver::newton::NewtonEnd;
use crate::state::State;
use crate::trial::StepContext;
use crate::trial::plan::Attachment;

impl Solver {
    /// Bodies against skin, where any may touch in this step.
    fn touching_bodies(&mut self) -> Option<&mut BodySkin> {
        self.body_skin.as_deref_mut().filter(|work| work.touching)
    }

    /// Looks for what may touch in a solver step of length `dt` that ends at the share of the model's step to which hitches go; whether any may.
    pub(crate) fn look_at_bodies(&mut self, state: &State, dt: f64) -> bool {
        let goal = self.trial.hitches.span[1];
        let near = self.body_skin.as_deref_mut().filter(|work| work.is_near());
        near.is_some_and(|work| work.look(state, goal, dt))
    }

    /// Measures bodies on skin where the trial stands, and asks for their friction.
    pub(crate) fn measure_bodies(&mut self, context: &StepContext<'_>) -> Result<(), NewtonEnd> {
        self.cost.enter(CostPart::Detection);
        let Self { body_skin, trial, .. } = self;
        let Some(work) = body_skin.as_deref_mut().filter(|work| work.touching) else {
            return Ok(());
        };
        let poses = trial.bodies.iter().map(crate::trial::BodyTrial::pose);
        let StepContext { model, state, scheme } = *context;
        work.measure(model, state, poses, scheme.dt).map_err(|why| match why {
            Unmeasured::Crushed(body, triangle) => NewtonEnd::BodyCrushed(body, triangle),
            Unmeasured::Plugin(failed) => NewtonEnd::Plugin(failed),
        })
    }

    /// Adds push and friction of skin on bodies, linear about where they were measured.
    pub(crate) fn push_bodies_off_skin(&mut self) {
        let Self { body_skin, trial, interface, plan, .. } = self;
        let Some(work) = body_skin.as_deref().filter(|work| work.touching) else { return };
        for force in work.forces_at(|body| trial.bodies[body].pose()) {
            let attachment = Attachment::Body {
                block: plan.body_block[force.body],
                body: force.body,
                offset: glam::DVec3::ZERO,
            };
            interface.push(attachment, force.arm, force.force);
            interface.add(attachment, force.arm, attachment, force.arm, force.block);
        }
    }

    /// After a solution: push and friction of skin on bodies by it.
    pub(crate) fn note_solved_bodies(&mut self) {
        let Self { body_skin, trial, .. } = self;
        if let Some(work) = body_skin.as_deref_mut().filter(|work| work.touching) {
            work.note_solved(|body| trial.bodies[body].pose());
        }
    }

    /// What the last solution misses of push and friction of skin on bodies.
    pub(crate) fn bodies_missed(&mut self) -> ContactMissed {
        self.touching_bodies().map_or_else(ContactMissed::default, |work| {
            let [gap_n, greatest_n] = work.missed_n();
            ContactMissed { gap_n, greatest_n }
        })
    }

    /// Holds the guess of a step off skin.
    pub(crate) fn hold_bodies_off(&mut self, state: &State) {
        let Self { body_skin, trial, .. } = self;
        let Some(work) = body_skin.as_deref().filter(|work| work.touching) else { return };
        for (body, trial) in trial.bodies.iter_mut().enumerate() {
            let Pose { place, orientation } = work.held_off(state, body, trial.pose());
            (trial.place, trial.orientation) = (place, orientation);
        }
    }

    /// Ends a step where no body's path leads through skin; the number of crossings that an exact test finds.
    pub(crate) fn end_bodies(&mut self, state: &State) -> Result<u64, Refused> {
        let Self { body_skin, trial, .. } = self;
        let Some(work) = body_skin.as_deref_mut().filter(|work| work.is_near()) else {
            return Ok(0);
        };
        work.end(state, |body| trial.bodies[body].pose())
    }
}
