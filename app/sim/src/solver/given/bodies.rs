//! Bodies of the rig: weight, water and the seabed under their feet.

use glam::{DMat3, DVec3};

use crate::balance::{Given, Source};
use crate::forces::body;
use crate::solver::Solver;
use crate::trial::StepContext;
use crate::trial::rotation::momentum_rate;

/// Velocity and spin of a body [m/s, rad/s].
#[derive(Clone, Copy)]
pub(crate) struct BodyMotion {
    pub velocity: DVec3,
    pub spin: DVec3,
}

impl BodyMotion {
    /// Velocity of its point at the end of an arm [m/s].
    pub fn at(&self, arm: DVec3) -> DVec3 {
        self.velocity + self.spin.cross(arm)
    }
}

/// Force and torque on a body [N, N m].
type Wrench = [DVec3; 2];

impl Solver {
    /// How a body moves at the end of the step.
    pub(crate) fn motion_of(&self, context: &StepContext<'_>, index: usize) -> BodyMotion {
        let (trial, scheme) = (&self.trial.bodies[index], context.scheme);
        let velocity = (trial.place - trial.place_history) * scheme.rate;
        BodyMotion { velocity, spin: trial.spin(scheme) }
    }

    /// Weight, water and seabed of every body.
    pub(crate) fn give_bodies(&mut self, context: &StepContext<'_>, given: &mut Given) {
        for index in 0..context.model.spec.bodies.len() {
            self.give_body(context, index, given);
        }
    }

    fn give_body(&mut self, context: &StepContext<'_>, index: usize, given: &mut Given) {
        let StepContext { model, state, scheme } = *context;
        let (body, now) = (&model.spec.bodies[index], &state.bodies[index]);
        let motion = self.motion_of(context, index);
        let start = self.wrench_on(index);
        self.add_body_in_water(model, state, index, scheme);
        let in_water = self.wrench_on(index);
        self.add_feet(model, state, index, scheme);
        let end = self.wrench_on(index);

        let weight = DVec3::Z * -(body.mass_kg * model.spec.water.gravity_m_s2);
        let (trial, mass) =
            (&self.trial.bodies[index], DMat3::from_diagonal(DVec3::splat(body.mass_kg)));
        let inertial = [
            body::inertial(trial, scheme, mass),
            momentum_rate(trial, now, body.inertia_kg_m2, scheme).0,
        ];
        let water =
            [in_water[0] - start[0] + inertial[0] - weight, in_water[1] - start[1] + inertial[1]];
        let seabed = [end[0] - in_water[0], end[1] - in_water[1]];
        given.at_end.add(Source::Weight, weight, motion.velocity);
        for (source, wrench) in [(Source::Water, water), (Source::Seabed, seabed)] {
            given.at_end.add(source, wrench[0], motion.velocity);
            given.at_end.work[source as usize] += wrench[1].dot(motion.spin);
        }
        given.momentum_ns += (motion.velocity - now.velocity) * body.mass_kg;
    }

    /// Force and torque that the interface system holds for a body.
    fn wrench_on(&self, index: usize) -> Wrench {
        let block = self.plan.body_block[index];
        [self.interface.force[block], self.interface.force[block + 1]]
    }
}
