//! A step of a living kinetic whale under its own forces: thrust, drag, steering, buoyancy, and its weight where it is out of the water.

use glam::{DQuat, DVec3};

use super::drag::{coast, drag_n};
use super::muscle::Asked;
use super::out::Weight;
use super::{Exertion, Kinetic};
use crate::model::Model;
use crate::state::WhaleState;

/// What the motion asks for over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wish {
    /// Speed at its begin, as reported to the motion [m/s].
    pub from_m_s: f64,
    /// Speed at its end [m/s].
    pub speed_m_s: f64,
    /// Turn rates [rad/s].
    pub turn_rate: DVec3,
    /// Burst, 0 to 1.
    pub burst: f64,
}

/// What the sea does to it over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surroundings {
    /// Weight of what is out of the water.
    pub out: Weight,
    /// Velocity of the water where it is [m/s].
    pub current_m_s: DVec3,
}

/// The speed that is reported to a motion: what it asked for, or what the whale has where that is more.
///
/// What gear takes off is not reported: it would be asked back at once, whatever the effort.
pub(crate) fn reported_speed(whale: &WhaleState) -> f64 {
    whale.speed_m_s.max(whale.exertion.asked_speed_m_s)
}

/// Moves `next`, which has the posture of the step's end and all else as in `whale`, over a step of length `dt`.
pub(crate) fn swim(
    model: &Model,
    kinetic: &Kinetic,
    wish: &Wish,
    whale: &WhaleState,
    Surroundings { out, current_m_s }: Surroundings,
    next: &mut WhaleState,
) {
    let dt = model.spec.settings.step_s;
    let (thrust_n, speed_m_s) = ahead(model, kinetic, wish, whale, next.posture.jaw, out.force.x);
    let turn_rate = turned(model, kinetic, wish, whale, &out);
    next.orientation = (whale.orientation
        * DQuat::from_scaled_axis(turn_rate * dt + whale.exertion.behind_rad))
    .normalize();
    let middle = whale.orientation.slerp(next.orientation, 0.5);
    let slip_m_s = sideways(model, kinetic, whale, middle, out.force);
    let mean = DVec3::new(0.5 * (whale.speed_m_s + speed_m_s), slip_m_s[0], slip_m_s[1]);
    let centre = whale.position + whale.orientation * kinetic.centre_m;
    let centre = centre + whale.exertion.behind_m + (middle * mean + current_m_s) * dt;
    next.position = centre - next.orientation * kinetic.centre_m;
    next.speed_m_s = speed_m_s;
    next.turn_rate = turn_rate;
    let (density, factor) = (
        model.spec.water.density_kg_m3,
        kinetic.drag.factor(model.spec.water.density_kg_m3, next.posture.jaw),
    );
    next.exertion = Exertion {
        slip_m_s,
        asked_speed_m_s: wish.speed_m_s,
        asked_turn_rate: wish.turn_rate,
        thrust_n,
        drag_n: drag_n(factor, speed_m_s),
        power_w: kinetic.muscle.power_w(density, thrust_n, speed_m_s),
        ..whale.exertion
    };
}

/// Thrust, and the speed ahead at the end of the step: pushed first, then coasting.
fn ahead(
    model: &Model,
    kinetic: &Kinetic,
    wish: &Wish,
    whale: &WhaleState,
    jaw_rad: f64,
    weight_n: f64,
) -> (f64, f64) {
    let dt = model.spec.settings.step_s;
    let density = model.spec.water.density_kg_m3;
    let mass = kinetic.whole_mass_kg().x;
    let fading = kinetic.drag.factor(density, jaw_rad) * dt / mass;
    let before = coast(wish.speed_m_s, -fading);
    let felt_n = whale.exertion.rope_force_n.dot(whale.orientation * DVec3::X);
    let asked = Asked {
        thrust_n: (before - wish.from_m_s) * mass / dt,
        speed_m_s: wish.from_m_s,
        answer_n: (before - whale.speed_m_s) * mass / dt - felt_n,
        burst: wish.burst,
    };
    let thrust_n = kinetic.muscle.thrust_n(density, &asked, whale.speed_m_s);
    (thrust_n, coast(whale.speed_m_s + (thrust_n + weight_n) * dt / mass, fading))
}

/// Velocity to port and to the back at the end of the step.
fn sideways(
    model: &Model,
    kinetic: &Kinetic,
    whale: &WhaleState,
    orientation: DQuat,
    out: DVec3,
) -> [f64; 2] {
    let dt = model.spec.settings.step_s;
    let water = &model.spec.water;
    let lift = orientation.conjugate()
        * DVec3::Z
        * (kinetic.buoyancy * kinetic.mass_kg * water.gravity_m_s2)
        + out;
    let [port, back] = whale.exertion.slip_m_s;
    let speed = DVec3::new(whale.speed_m_s, port, back).length();
    let mass = kinetic.whole_mass_kg();
    let after = |slip: f64, lift: f64, area: f64, mass: f64| {
        (slip + lift * dt / mass) / (1.0 + 0.5 * water.density_kg_m3 * area * speed * dt / mass)
    };
    let [side, plan] = kinetic.side_drag_m2;
    [after(port, lift.y, side, mass.y), after(back, lift.z, plan, mass.z)]
}

/// Turn rates over the step: what is asked for, and what is left of what rope and the weight out of the water added to that.
fn turned(
    model: &Model,
    kinetic: &Kinetic,
    wish: &Wish,
    whale: &WhaleState,
    out: &Weight,
) -> DVec3 {
    let (density, dt) = (model.spec.water.density_kg_m3, model.spec.settings.step_s);
    let inertia = kinetic.whole_inertia_kg_m2();
    let astray = whale.turn_rate - whale.exertion.asked_turn_rate + out.moment / inertia * dt;
    let left = |axis: usize| {
        let strength = kinetic.steering_n_m[axis] * dt / inertia[axis];
        let taken = astray[axis] * dt / (dt + kinetic.steering_time_s);
        let steered = astray[axis] - taken.clamp(-strength, strength);
        steered
            / (1.0
                + 0.5 * density * kinetic.turn_drag_m5[axis] * libm::fabs(steered) * dt
                    / inertia[axis])
    };
    wish.turn_rate + DVec3::new(left(0), left(1), left(2))
}
