//! Thrust of a living whale, and its step under its own forces.
//!
//! A clean whale needs the thrust `T₀` [N] at the requested speed `u₀` [m/s]. Flukes that sweep the area `A` [m²] accelerate
//! water by
//! `w` [m/s]: `T = 2ρA (u + w) w`, with the power `P = T (u + w)` [W] (actuator disk). There are three models of effort against
//! gear:
//!
//! | effort | constant quantity | the whale slows until |
//! |---|---|---|
//! | power | `P` of `T₀` at `u₀`, at any speed: thrust grows as the whale slows | `(D + R) u` is the former `D u` |
//! | thrust | `T₀` | `D + R` is the former `D` |
//! | speed | `u₀`; thrust compensates the drag of gear | its strength is exceeded |
//!
//! Thrust is never negative, and at most what a whale of its length can sustain or, in a burst, produce. In a burst the whale
//! tries to reach the requested speed with any effort. Muscle power is `P/η`, with `η` the efficiency.
//!
//! Thrust above the sustained one tires. With `S` the sustained thrust, `B` that of a burst `b` of 0 to 1 when rested, and the
//! fatigue `f` of 0 (rested) to 1,
//!
//! ```text
//! T ≤ S + b (B - S) (1 - f)        df/dt = (T - S) / ((B - S) τ_t)   if T > S        df/dt = -f/τ_r   otherwise
//! ```
//!
//! so that the thrust of a lasting full burst decays to the sustained one with the time constant `τ_t` [s], and the whale recovers
//! with `τ_r` [s]. This is the model of critical power, with force in place of power.
//! References: Skiba and Clarke 2021 (Int. J. Sports Physiol. Perform. 16, 1561) for fatigue; Arthur et al. 2015 (doi:10.1111/mms.12230) for the greatest forces; van der Hoop et al. 2017
//! (doi:10.3354/esr00781) for `η`; Rankine 1865 and Froude 1889 for the disk.

use glam::{DQuat, DVec3};

use super::hull::{AxialDrag, coast, drag_n, speed_of_drag};
use super::{Exertion, Kinetic, Weight};
use crate::model::Model;
use crate::state::WhaleState;

/// Model of a whale's effort against gear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Effort {
    /// Constant power.
    #[default]
    Power,
    /// Constant thrust.
    Thrust,
    /// Constant speed.
    Speed,
}

/// A whale's thrust and power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Muscle {
    /// Greatest sustained thrust [N].
    pub sustained_n: f64,
    /// Greatest thrust in a burst [N].
    pub burst_n: f64,
    /// Time constant with which a full burst tires it; infinite if it never tires [s].
    pub tires_s: f64,
    /// Time constant of its recovery; infinite if it never recovers [s].
    pub recovers_s: f64,
    /// Ratio of useful power to muscle power.
    pub efficiency: f64,
    /// Area swept by its flukes [m²].
    pub swept_area_m2: f64,
    /// Model of effort.
    pub effort: Effort,
}

/// Request to the muscle in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Asked {
    /// Thrust of a clean whale at the requested speed [N].
    pub thrust_n: f64,
    /// Requested speed [m/s].
    pub speed_m_s: f64,
    /// Thrust that accelerates the whale to the requested speed within the step [N].
    pub answer_n: f64,
    /// Burst, 0 to 1.
    pub burst: f64,
    /// Fatigue, 0 to 1.
    pub fatigue: f64,
}

impl Muscle {
    /// Greatest thrust at a burst control and a fatigue, both of 0 to 1 [N].
    pub fn strength_n(&self, burst: f64, fatigue: f64) -> f64 {
        self.sustained_n + self.reserve_n() * burst.clamp(0.0, 1.0) * (1.0 - fatigue)
    }

    /// Thrust of a rested whale's burst above the sustained thrust [N].
    fn reserve_n(&self) -> f64 {
        (self.burst_n - self.sustained_n).max(0.0)
    }

    /// Fatigue after a step with a thrust [N] for a time [s].
    fn fatigue_after(&self, fatigue: f64, thrust_n: f64, dt_s: f64) -> f64 {
        let above_n = thrust_n - self.sustained_n;
        let next = if above_n > 0.0 {
            fatigue + dt_s * above_n / (self.reserve_n() * self.tires_s)
        } else {
            fatigue * (1.0 - dt_s / self.recovers_s).max(0.0)
        };
        debug_assert!(next >= 0.0, "fatigue is a share: {next}");
        next.min(1.0)
    }

    /// Useful power of a thrust at a speed ahead [W].
    pub fn disk_power_w(&self, density_kg_m3: f64, thrust_n: f64, speed_m_s: f64) -> f64 {
        let speed = speed_m_s.max(0.0);
        let mass_m = density_kg_m3 * self.swept_area_m2;
        let wash = if mass_m > 0.0 {
            0.5 * ((speed * speed + 2.0 * thrust_n.max(0.0) / mass_m).sqrt() - speed)
        } else {
            0.0
        };
        thrust_n * (speed + wash)
    }

    /// Thrust of a useful power at a speed ahead [N].
    pub fn disk_thrust_n(&self, density_kg_m3: f64, power_w: f64, speed_m_s: f64) -> f64 {
        let twice = 2.0 * density_kg_m3 * self.swept_area_m2;
        if power_w <= 0.0 || twice <= 0.0 {
            return 0.0;
        }
        let (speed, target) = (speed_m_s.max(0.0), power_w / twice);
        // w (u + w)² = P/2ρA. Both guesses are upper bounds, from which Newton's method converges monotonically.
        let mut wash = libm::cbrt(target);
        if speed > 0.0 {
            wash = wash.min(target / (speed * speed));
        }
        for _ in 0..MOST_PASSES {
            let past = speed + wash;
            let change = (wash * past * past - target) / (past * (past + 2.0 * wash));
            wash -= change;
            if change <= 1e-15 * wash {
                break;
            }
        }
        power_w / (speed + wash)
    }

    /// Muscle power for a thrust at a speed [W].
    pub fn power_w(&self, density_kg_m3: f64, thrust_n: f64, speed_m_s: f64) -> f64 {
        self.disk_power_w(density_kg_m3, thrust_n, speed_m_s) / self.efficiency
    }

    /// Thrust in a step at a speed [N].
    pub(super) fn thrust_n(&self, density_kg_m3: f64, asked: &Asked, speed_m_s: f64) -> f64 {
        let wanted = match self.effort {
            _ if asked.burst > 0.0 => asked.answer_n,
            Effort::Speed => asked.answer_n,
            Effort::Thrust => asked.thrust_n,
            Effort::Power if density_kg_m3 * self.swept_area_m2 <= 0.0 => asked.thrust_n,
            Effort::Power => {
                let power_w = self.disk_power_w(density_kg_m3, asked.thrust_n, asked.speed_m_s);
                self.disk_thrust_n(density_kg_m3, power_w, speed_m_s)
            }
        };
        wanted.clamp(0.0, self.strength_n(asked.burst, asked.fatigue))
    }

    pub(super) fn fault(&self) -> Option<&'static str> {
        let sound = |size: f64| size.is_finite() && size >= 0.0;
        let all = sound(self.sustained_n)
            && sound(self.burst_n)
            && sound(self.swept_area_m2)
            && self.efficiency.is_finite();
        let positive =
            [self.efficiency, self.tires_s, self.recovers_s].iter().all(|one| *one > 0.0);
        (!all || !positive).then_some("a property of its strength is not above zero")
    }
}

/// Limit of Newton iterations, far above the number needed.
const MOST_PASSES: usize = 60;

/// Request of the motion for a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MotionRequest {
    /// Speed at the start, as reported to the motion [m/s].
    pub from_m_s: f64,
    /// Speed at the end [m/s].
    pub speed_m_s: f64,
    /// Turn rates [rad/s].
    pub turn_rate: DVec3,
    /// Burst, 0 to 1.
    pub burst: f64,
}

/// Effects of the sea over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surroundings {
    /// Weight of the part above the surface.
    pub out: Weight,
    /// Velocity of the current at the whale [m/s].
    pub current_m_s: DVec3,
}

/// Speed that is reported to a motion: the greater of the requested and the actual speed.
///
/// The reduction by gear is not reported, because a motion would compensate it regardless of effort.
pub(crate) fn reported_speed(whale: &WhaleState) -> f64 {
    whale.speed_m_s.max(whale.exertion.asked_speed_m_s)
}

/// Speed at which the drag of the body, in its posture, equals its thrust [m/s].
pub(crate) fn thrust_speed(drag: &AxialDrag, density_kg_m3: f64, whale: &WhaleState) -> f64 {
    speed_of_drag(drag.factor(density_kg_m3, whale.posture.jaw), whale.exertion.thrust_n)
}

/// Advances a living whale to `next` by a step; `next` already has the posture at the end of the step.
pub(crate) fn swim(
    model: &Model,
    kinetic: &Kinetic,
    request: &MotionRequest,
    whale: &WhaleState,
    Surroundings { out, current_m_s }: Surroundings,
    next: &mut WhaleState,
) {
    let dt = model.spec.settings.step_s;
    let (thrust_n, speed_m_s) =
        ahead(model, kinetic, request, whale, next.posture.jaw, out.force.x);
    let turn_rate = turned(model, kinetic, request, whale, &out);
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
        asked_speed_m_s: request.speed_m_s,
        asked_turn_rate: request.turn_rate,
        thrust_n,
        fatigue: kinetic.muscle.fatigue_after(whale.exertion.fatigue, thrust_n, dt),
        drag_n: drag_n(factor, speed_m_s),
        power_w: kinetic.muscle.power_w(density, thrust_n, speed_m_s),
        ..whale.exertion
    };
}

/// Thrust, and speed ahead at the end of the step: first the impulse of thrust, then coasting.
fn ahead(
    model: &Model,
    kinetic: &Kinetic,
    request: &MotionRequest,
    whale: &WhaleState,
    jaw_rad: f64,
    weight_n: f64,
) -> (f64, f64) {
    let dt = model.spec.settings.step_s;
    let density = model.spec.water.density_kg_m3;
    let mass = kinetic.whole_mass_kg().x;
    let fading = kinetic.drag.factor(density, jaw_rad) * dt / mass;
    let before = coast(request.speed_m_s, -fading);
    let felt_n = whale.exertion.rope_force_n.dot(whale.orientation * DVec3::X);
    let asked = Asked {
        thrust_n: (before - request.from_m_s) * mass / dt,
        speed_m_s: request.from_m_s,
        answer_n: (before - whale.speed_m_s) * mass / dt - felt_n,
        burst: request.burst,
        fatigue: whale.exertion.fatigue,
    };
    let thrust_n = kinetic.muscle.thrust_n(density, &asked, whale.speed_m_s);
    (thrust_n, coast(whale.speed_m_s + (thrust_n + weight_n) * dt / mass, fading))
}

/// Velocity to port and dorsally at the end of the step.
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

/// Turn rates over the step: the requested ones, and the remaining deviation due to rope and weight above the surface.
fn turned(
    model: &Model,
    kinetic: &Kinetic,
    request: &MotionRequest,
    whale: &WhaleState,
    out: &Weight,
) -> DVec3 {
    let (density, dt) = (model.spec.water.density_kg_m3, model.spec.settings.step_s);
    let inertia = kinetic.whole_inertia_kg_m2();
    let deviation = whale.turn_rate - whale.exertion.asked_turn_rate + out.moment / inertia * dt;
    let left = |axis: usize| {
        let strength = kinetic.steering_n_m[axis] * dt / inertia[axis];
        let taken = deviation[axis] * dt / (dt + kinetic.steering_time_s);
        let steered = deviation[axis] - taken.clamp(-strength, strength);
        steered
            / (1.0
                + 0.5 * density * kinetic.turn_drag_m5[axis] * libm::fabs(steered) * dt
                    / inertia[axis])
    };
    request.turn_rate + DVec3::new(left(0), left(1), left(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn muscle(effort: Effort) -> Muscle {
        Muscle {
            sustained_n: 5_800.0,
            burst_n: 23_900.0,
            tires_s: 30.0,
            recovers_s: 300.0,
            efficiency: 0.13,
            swept_area_m2: 14.6,
            effort,
        }
    }

    #[test]
    fn thrust_and_power_of_the_disk_are_inverse_functions() {
        let muscle = muscle(Effort::Power);
        for thrust in [1e-3, 10.0, 350.0, 5e4] {
            for speed in [0.0, 1e-6, 0.3, 1.3, 6.0] {
                let back =
                    muscle.disk_thrust_n(1025.0, muscle.disk_power_w(1025.0, thrust, speed), speed);
                assert!((back / thrust - 1.0).abs() < 1e-9, "{thrust} N at {speed} m/s: {back}");
            }
        }
        // At speed zero: T³ = 2ρA P².
        let pull = muscle.disk_thrust_n(1025.0, 455.0, 0.0);
        assert!((pull - libm::cbrt(2.0 * 1025.0 * 14.6 * 455.0 * 455.0)).abs() < 1e-6 * pull);
    }

    #[test]
    fn no_effort_exceeds_the_whales_strength() {
        let asked =
            |burst| Asked { thrust_n: 300.0, speed_m_s: 1.3, answer_n: 1e6, burst, fatigue: 0.0 };
        assert!((muscle(Effort::Speed).thrust_n(1025.0, &asked(0.0), 0.0) - 5_800.0).abs() < 1e-9);
        assert!((muscle(Effort::Power).thrust_n(1025.0, &asked(1.0), 0.0) - 23_900.0).abs() < 1e-9);
        assert!((muscle(Effort::Thrust).thrust_n(1025.0, &asked(0.0), 0.0) - 300.0).abs() < 1e-9);
        let kept = muscle(Effort::Power).thrust_n(1025.0, &asked(0.0), 0.6);
        assert!(
            kept > 600.0 && kept < 650.0,
            "at less than half the speed, a correspondingly greater thrust: {kept}"
        );
    }

    /// A lasting full burst decays to the sustained thrust, and the whale recovers, each as an exponential.
    #[test]
    fn a_burst_tires_and_recovers() {
        let muscle = muscle(Effort::Power);
        let (dt_s, mut fatigue) = (0.01, 0.0);
        let rested = Asked { thrust_n: 0.0, speed_m_s: 0.0, answer_n: 1e6, burst: 1.0, fatigue };
        for step in 0..6000 {
            let thrust_n = muscle.thrust_n(1025.0, &Asked { fatigue, ..rested }, 0.0);
            let expected = 5_800.0 + 18_100.0 * libm::exp(-f64::from(step) * dt_s / 30.0);
            assert!((thrust_n / expected - 1.0).abs() < 1e-3, "step {step}: {thrust_n} N");
            fatigue = muscle.fatigue_after(fatigue, thrust_n, dt_s);
        }
        let tired = fatigue;
        (0..30_000).for_each(|_| fatigue = muscle.fatigue_after(fatigue, 5_000.0, dt_s));
        assert!((fatigue / tired / libm::exp(-1.0) - 1.0).abs() < 1e-3, "{fatigue} of {tired}");
        let tireless = Muscle { tires_s: f64::INFINITY, ..muscle };
        assert!(tireless.fatigue_after(0.0, 23_900.0, 1e6).abs() < 1e-15);
    }
}
