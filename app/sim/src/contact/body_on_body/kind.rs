//! Bodies of the rig pressed on each other and on obstacles, in the linear system of a step.
//!
//! A touch at `p` with push and friction `F` on the first body, `-F` on the second, and block `B = -dF/d(p₁ - p₂)` acts on the six freedoms of each and
//! couples them: the layout of the interface matrix holds the blocks of the bodies that may touch in the step (`interface.rs`), and is
//! laid out anew where these change. An obstacle has no blocks.

use glam::DVec3;

use crate::contact::{ContactMissed, GRIP_STRICTER};
use crate::model::Model;
use crate::solver::Solver;
use crate::solver::newton::NewtonEnd;
use crate::state::State;
use crate::system::interface::InterfaceSystem;
use crate::trial::StepContext;
use crate::trial::plan::Attachment;

impl Solver {
    /// Finds bodies that may touch each other in a solver step, and lays out their coupling; whether there are any.
    pub(crate) fn gather_body_pairs(&mut self, model: &Model, state: &State, dt: f64) -> bool {
        let touching = self.body_pairs.gather(state, dt);
        if !self.body_pairs.coupled().eq(self.coupled.iter().copied()) {
            self.coupled.clear();
            self.coupled.extend(self.body_pairs.coupled());
            self.interface = InterfaceSystem::of_model(&self.plan, model, &self.coupled);
            self.linear_part.interface = self.interface.clone();
        }
        touching
    }

    /// Measures bodies on bodies where the trial stands.
    pub(crate) fn measure_body_pairs(
        &mut self,
        context: &StepContext<'_>,
    ) -> Result<(), NewtonEnd> {
        if !self.body_pairs.touching {
            return Ok(());
        }
        let poses = self.trial.bodies.iter().map(crate::trial::BodyTrial::pose);
        self.body_pairs.measure(context.state, poses).map_err(NewtonEnd::BodiesCrushed)
    }

    /// Adds push and friction of bodies on each other, linear about where they were measured.
    pub(crate) fn push_bodies_apart(&mut self) {
        let Self { body_pairs, trial, interface, plan, .. } = self;
        if !body_pairs.touching {
            return;
        }
        for touch in body_pairs.forces_at(|body| trial.bodies[body].pose()) {
            // An obstacle has no freedom.
            let [one, two] = touch.bodies.map(|thing| {
                let block = plan.body_block.get(thing);
                block.map_or(Attachment::Fixed, |block| Attachment::Body {
                    block: *block,
                    body: thing,
                    offset: DVec3::ZERO,
                })
            });
            let [one_arm, two_arm] = touch.arms;
            interface.push(one, one_arm, touch.force);
            interface.push(two, two_arm, -touch.force);
            interface.add(one, one_arm, one, one_arm, touch.block);
            interface.add(two, two_arm, two, two_arm, touch.block);
            interface.add(one, one_arm, two, two_arm, -touch.block);
            interface.add(two, two_arm, one, one_arm, -touch.block);
        }
    }

    /// After a solution: push and friction of bodies on each other by it.
    pub(crate) fn note_solved_body_pairs(&mut self) {
        let Self { body_pairs, trial, .. } = self;
        if body_pairs.touching {
            body_pairs.note_solved(|body| trial.bodies[body].pose());
        }
    }

    /// What the last solution misses of push and friction of bodies on each other.
    pub(crate) fn body_pairs_missed(&self) -> ContactMissed {
        if !self.body_pairs.touching {
            return ContactMissed::default();
        }
        let [gap_n, greatest_n] = self.body_pairs.missed_n();
        ContactMissed { gap_n: GRIP_STRICTER * gap_n, greatest_n }
    }

    /// Two bodies whose cores come too near to each other on the path of the step, if any do.
    pub(crate) fn meeting_bodies(&self, state: &State) -> Option<[usize; 2]> {
        if !self.body_pairs.touching {
            return None;
        }
        self.body_pairs.meeting(state, |body| self.trial.bodies[body].pose())
    }

    /// Writes the grips of bodies on each other into the state.
    pub(crate) fn keep_pair_grips(&self, state: &mut State) {
        self.body_pairs.keep(&mut state.pair_grips);
    }
}
