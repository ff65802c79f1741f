//! The rope's pull on the whale over a step: where it touches and where it is made fast.
//!
//! Rope's own solver steps are implicit, so the impulse rope gave is `Σ F h` with `F` as each of them ended. What rope is
//! given by contact the whale loses: momentum is kept to rounding. Where a line is made fast to the whale, weight, drag and inertia of
//! the half segment at its end are left out (`balance/summary.rs` tells what that comes to).
//!
//! The whale's path over a step is laid before the rope is solved, so the impulse changes its velocity at the end, and what
//! each `F h` would have moved it until then, `Σ F h (t_end - t)/m`, is made up for over the next step. With one solver step in a
//! step that is nothing and the pair is stepped by symplectic Euler; with many it is velocity Verlet. Without it the whale
//! would lag and gain `0.2 ω dt` of its speed in each half swing on a tether.

use glam::DVec3;

use super::{Exertion, Kinetic};
use crate::contact::ContactPoint;
use crate::contact::body_on_skin::BodyContact;
use crate::state::WhaleState;

/// Impulse and turning impulse of rope on the whale over the solver steps so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct RopeImpulse {
    force: DVec3,
    moment: DVec3,
    /// Impulse and turning impulse times what was left of the step.
    force_left: DVec3,
    moment_left: DVec3,
}

/// Length of a solver step, and what is left of the step after it [s].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Times {
    pub dt: f64,
    pub left: f64,
}

impl RopeImpulse {
    /// Takes in the contacts of a solver step; moments are about `centre`.
    pub fn add_contacts(&mut self, contacts: &[ContactPoint], centre: DVec3, times: Times) {
        for contact in contacts {
            self.add(
                contact.normal * -contact.normal_force_n - contact.friction_n,
                contact.position - centre,
                times,
            );
        }
    }

    /// Takes in the contacts of bodies in a solver step; moments are about `centre`.
    pub fn add_bodies(&mut self, contacts: &[BodyContact], centre: DVec3, times: Times) {
        for contact in contacts {
            self.add(
                contact.normal * -contact.normal_force_n - contact.friction_n,
                contact.position - centre,
                times,
            );
        }
    }

    /// Takes in a force at an arm from the centre.
    pub fn add(&mut self, force: DVec3, arm: DVec3, times: Times) {
        let (impulse, turning) = (force * times.dt, arm.cross(force) * times.dt);
        self.force += impulse;
        self.moment += turning;
        self.force_left += impulse * times.left;
        self.moment_left += turning * times.left;
    }

    /// The impulse so far [N s].
    pub fn impulse(&self) -> DVec3 {
        self.force
    }

    /// Tells the whale at the end of a step of length `dt` what it bore, and changes its momentum by it.
    pub fn give(&self, kinetic: &Kinetic, dt: f64, whale: &mut WhaleState) {
        whale.exertion.rope_force_n = self.force / dt;
        whale.exertion.rope_moment_n_m = self.moment / dt;
        let inward = whale.orientation.conjugate();
        let (mass, inertia) = (kinetic.whole_mass_kg(), kinetic.whole_inertia_kg_m2());
        let change = inward * self.force / mass;
        whale.turn_rate += inward * self.moment / inertia;
        whale.exertion.behind_m = whale.orientation * (inward * self.force_left / mass);
        whale.exertion.behind_rad = inward * self.moment_left / inertia;
        whale.speed_m_s += change.x;
        let Exertion { slip_m_s, .. } = &mut whale.exertion;
        slip_m_s[0] += change.y;
        slip_m_s[1] += change.z;
    }
}

/// Place of a whale's centre of mass [m].
pub(crate) fn centre_of(kinetic: &Kinetic, whale: &WhaleState) -> DVec3 {
    whale.position + whale.orientation * kinetic.centre_m
}
