//! A dead whale afloat: a rigid body with six degrees of freedom, without muscle.
//!
//! About its centre of mass, `ν` its velocity through the water and `ω` its spin, `M = m + A` and `J = I + A'` turning with it:
//! `d(Mν)/dt = (ρ g V - m g) ẑ + D + R`, `d(Jω)/dt = r × ρ g V ẑ - ν × Mν + D_ω + M_R`, in the world's frame.
//! `V` and the middle `r` of what it displaces are those of its skin below the surface over its centre (`Kinetic::hull`). Drag goes with the water's
//! velocity there, current and waves, and the whale is carried with the water's acceleration, as a body nearly as heavy as its water is:
//! ahead the body's drag without its beating, crossways and turning as alive. Its joints stay as they are.
//!
//! Momentum is kicked first and moves the whale then, and is kept in the world's frame, so that a free body keeps it exactly.

use glam::{DQuat, DVec3};

use super::drag::{coast, drag_n};
use super::{Exertion, Kinetic};
use crate::model::Model;
use crate::state::WhaleState;
use endline_sdk::Posture;

/// What a dead whale is besides.
#[derive(Clone, Debug, PartialEq)]
pub struct Dead {
    /// Its joint angles.
    pub posture: Posture,
}

/// Moves `next` over a step of length `dt` from `whale`; `hull_scratch` is scratch of its hull.
pub(crate) fn drift(
    model: &Model,
    kinetic: &Kinetic,
    whale: &WhaleState,
    time_s: f64,
    next: &mut WhaleState,
    hull_scratch: &mut Vec<DVec3>,
) {
    let (water, dt) = (&model.spec.water, model.spec.settings.step_s);
    let (mass, inertia) = (kinetic.whole_mass_kg(), kinetic.whole_inertia_kg_m2());
    let centre = whale.position + whale.orientation * kinetic.centre_m;
    let sea = model.sea.at(centre, time_s);
    let height_m = centre.z - sea.surface_m;
    let wet = kinetic.hull.wetted(kinetic.centre_m, whale.orientation, height_m, hull_scratch);
    let lift = water.density_kg_m3 * water.gravity_m_s2;
    let [east, north] = wet.moment_m4;
    let force = DVec3::Z * (lift * wet.volume_m3 - kinetic.mass_kg * water.gravity_m_s2);
    let moment = DVec3::new(north, -east, 0.0) * lift;
    let velocity =
        DVec3::new(whale.speed_m_s, whale.exertion.slip_m_s[0], whale.exertion.slip_m_s[1]);
    let outward = whale.orientation;
    let momentum = outward * (mass * velocity) + force * dt;
    let carried = (outward * velocity).cross(outward * (mass * velocity));
    let turning = outward * (inertia * whale.turn_rate) + (moment - carried) * dt;

    let spin = outward.conjugate() * turning / inertia;
    next.orientation =
        (outward * DQuat::from_scaled_axis(spin * dt + whale.exertion.behind_rad)).normalize();
    let inward = next.orientation.conjugate();
    let (velocity, drag) = slowed(model, kinetic, inward * momentum / mass, dt);
    next.turn_rate = slowed_turn(model, kinetic, inward * turning / inertia, dt);
    let middle = outward.slerp(next.orientation, 0.5);
    let centre = centre + whale.exertion.behind_m + (middle * velocity + sea.velocity_m_s) * dt;
    next.position = centre - next.orientation * kinetic.centre_m;
    next.speed_m_s = velocity.x;
    next.exertion = Exertion { slip_m_s: [velocity.y, velocity.z], drag_n: drag, ..whale.exertion };
}

/// Velocity in its own axes after the water's drag over a step, and that drag.
fn slowed(model: &Model, kinetic: &Kinetic, velocity: DVec3, dt: f64) -> (DVec3, f64) {
    let (density, mass) = (model.spec.water.density_kg_m3, kinetic.whole_mass_kg());
    let factor = kinetic.drag.factor(density, 0.0) / kinetic.drag.oscillation.max(1.0);
    let [side, plan] = kinetic.side_drag_m2.map(|area| 0.5 * density * area * velocity.length());
    let ahead = coast(velocity.x, factor * dt / mass.x);
    let after = DVec3::new(
        ahead,
        velocity.y / (1.0 + side * dt / mass.y),
        velocity.z / (1.0 + plan * dt / mass.z),
    );
    (after, DVec3::new(drag_n(factor, after.x), side * after.y, plan * after.z).length())
}

/// Spin about its own axes after the water's drag over a step.
fn slowed_turn(model: &Model, kinetic: &Kinetic, spin: DVec3, dt: f64) -> DVec3 {
    let inertia = kinetic.whole_inertia_kg_m2();
    spin / (DVec3::ONE
        + kinetic.turn_drag_m5 * spin.abs() * (0.5 * model.spec.water.density_kg_m3 * dt) / inertia)
}
