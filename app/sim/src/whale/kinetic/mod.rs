//! Dynamics of a kinetic whale: mass, drag, thrust, buoyancy and the forces of rope determine its motion.
//!
//! A living whale, in its own axes, with `u` ahead, `v_y` to port, `v_z` dorsal, all relative to the water, and turn rates `ω`:
//!
//! ```text
//! ahead      (m + A_x) du/dt = T - D(u) + R_x              T thrust (`muscle`), D body drag (`hull`)
//! sideways   (m + A_k) dv_k/dt = B_k - ½ρ C_k |U| v_k + R_k  k = y, z;  B net buoyancy
//! turning    (I + A_k') dω_k/dt = S_k - ½ρ D_k |δ_k| δ_k + M_k  δ = ω - requested turn rate
//! ```
//!
//! `R` [N] and `M` [N m] are force and moment of all rope on the whale. `S` is the steering moment: it follows the requested
//! turn rate and corrects deviations, `S = (I + A') dω_req/dt - (I + A') δ/τ`, with the second term limited to `S_max`.
//! Flippers and flukes are assumed to carry the centripetal force of a turn, so that a whale without rope follows its motion.
//! The part of the body above the surface adds its weight in air:
//!
//! ```text
//! F = -ρ g (V - V_wet) ẑ      at the centroid of the dry volume;      M = r_dry × F
//! ```
//!
//! `V` is the volume of the skin at rest, `V_wet` its part below the surface level above the centre of mass [m³] (`hull`), and
//! `r` is measured from the centre of mass. A whale that leaves the water vertically at `u` therefore emerges by `u √(L/g)` of
//! its length if it is a cylinder.
//!
//! A dead whale is a rigid body with six degrees of freedom. With `ν` the velocity of its centre of mass relative to the water,
//! `ω` its spin, `M = m + A` and `J = I + A'` in the world frame:
//! `d(Mν)/dt = (ρ g V - m g) ẑ + D + R`, `d(Jω)/dt = r × ρ g V ẑ - ν × Mν + D_ω + M_R`.
//! `V` and the centroid `r` are those of the skin below the surface level above the centre of mass. Drag is relative to the
//! velocity of current and waves there, and the whale follows the water's acceleration. Drag ahead is without the factor of
//! swimming; drag sideways and in rotation is that of a living whale. Joint angles are constant. The step applies the impulse
//! first, then the displacement. Momentum is stored in the world frame, so that a free body conserves it exactly.
//!
//! Coupling with rope is staggered. The whale moves over a step under its own forces, rope is solved for that path, and the
//! impulse of rope,
//! `Σ F h` over the solver steps `h`, is added to the whale's momentum at the end. Rope steps are implicit, with `F` the force
//! at their end, so that momentum is conserved to rounding. At a hitch, weight, drag and inertia of the last half segment are
//! not transferred (`balance/mod.rs` reports the difference). The displacement that the impulses would have caused during the step,
//! `Σ F h (t_end - t)/m`, is applied over the next step. With one solver step per step the scheme is symplectic Euler, with
//! many it is velocity Verlet. Without this correction the whale would gain `0.2 ω dt` of its speed in each half swing on a
//! tether.
//! The scheme is symplectic and stable for a tether of stiffness `k` if `k dt² < 4 m`: 1e9 N/m for 30 t and 10 ms.
//!
//! Symbols: `m` mass [kg], `A` added mass [kg], `I`, `A'` moments of inertia and their added part [kg m²], `C` drag area [m²],
//! `D` rotational drag [m⁵], `ρ` density of water [kg/m³], `τ` steering time [s].
//! References: van der Hoop et al. 2013 (doi:10.1111/mms.12042) for drag, Lamb 1932, Hydrodynamics, articles 114 and 115, for
//! added mass, Arthur et al. 2015 (doi:10.1111/mms.12230) for the greatest thrust, Hairer, Lubich and Wanner 2003 for the
//! scheme.

pub mod hull;
pub mod muscle;

use std::sync::Arc;

use endline_sdk::Posture;
use glam::{DQuat, DVec3};

use crate::contact::ContactPoint;
use crate::contact::body_on_skin::BodyContact;
use crate::model::Model;
use crate::state::WhaleState;
use hull::{coast, drag_n};

pub use hull::{AxialDrag, Hull};
pub use muscle::{Effort, Muscle};

/// Properties of a kinetic whale.
#[derive(Clone, Debug, PartialEq)]
pub struct Kinetic {
    /// Mass [kg].
    pub mass_kg: f64,
    /// Centre of mass in the whale's frame [m].
    pub centre_m: DVec3,
    /// Moments of inertia about the centre of mass, by axis of the whale [kg m²].
    pub inertia_kg_m2: DVec3,
    /// Added mass by axis [kg].
    pub added_mass_kg: DVec3,
    /// Added moments of inertia by axis [kg m²].
    pub added_inertia_kg_m2: DVec3,
    /// Drag ahead.
    pub drag: AxialDrag,
    /// Drag coefficient times area to the side and up [m²].
    pub side_drag_m2: [f64; 2],
    /// Rotational drag `D` by axis: moment = `½ρ D ω|ω|` [m⁵].
    pub turn_drag_m5: DVec3,
    /// Thrust and power.
    pub muscle: Muscle,
    /// Greatest steering moment against deviations, by axis [N m].
    pub steering_n_m: DVec3,
    /// Time constant of steering [s].
    pub steering_time_s: f64,
    /// Net buoyancy of a living whale under water, as a share of its weight.
    pub buoyancy: f64,
    /// Skin at rest, or in the posture of a dead whale, for hydrostatics; empty if the surface is ignored.
    pub hull: Arc<Hull>,
    /// Properties of a dead whale; `None` if alive.
    pub dead: Option<Dead>,
}

impl Kinetic {
    /// Mass with added mass, by axis [kg].
    pub fn whole_mass_kg(&self) -> DVec3 {
        self.added_mass_kg + self.mass_kg
    }

    /// Moments of inertia with the added ones, by axis [kg m²].
    pub fn whole_inertia_kg_m2(&self) -> DVec3 {
        self.inertia_kg_m2 + self.added_inertia_kg_m2
    }

    /// Returns an error message if a value is invalid.
    pub(crate) fn fault(&self) -> Option<&'static str> {
        let sound = |vector: DVec3| vector.is_finite() && vector.min_element() >= 0.0;
        let vectors =
            [self.added_mass_kg, self.added_inertia_kg_m2, self.turn_drag_m5, self.steering_n_m];
        if !(self.mass_kg.is_finite()
            && self.mass_kg > 0.0
            && self.inertia_kg_m2.is_finite()
            && self.inertia_kg_m2.min_element() > 0.0)
        {
            Some("mass and moments of inertia are not all above zero")
        } else if !(vectors.into_iter().all(sound)
            && self.side_drag_m2.iter().all(|area| area.is_finite() && *area >= 0.0))
        {
            Some("an added mass, a drag or a steering moment is below zero")
        } else if !(self.steering_time_s > 0.0
            && self.buoyancy.is_finite()
            && self.centre_m.is_finite())
        {
            Some("steering time, buoyancy or centre of mass is not finite or not above zero")
        } else {
            self.drag.fault().or(self.muscle.fault())
        }
    }
}

/// Effort of a whale and forces on it over a step; zero for a kinematic whale.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exertion {
    /// Velocity relative to the water to port and dorsally [m/s].
    pub slip_m_s: [f64; 2],
    /// Speed that its motion requests [m/s].
    pub asked_speed_m_s: f64,
    /// Turn rates that its motion requests, about its own axes [rad/s].
    pub asked_turn_rate: DVec3,
    /// Thrust [N].
    pub thrust_n: f64,
    /// Share of its burst that it has spent: 0 rested, 1 exhausted.
    pub fatigue: f64,
    /// Drag of its body [N].
    pub drag_n: f64,
    /// Muscle power: power of the thrust over the efficiency [W].
    pub power_w: f64,
    /// Force of all rope on it, mean over the step, world frame [N].
    pub rope_force_n: DVec3,
    /// Moment of that force about its centre of mass, world frame [N m].
    pub rope_moment_n_m: DVec3,
    /// Displacement of its centre due to rope that the next step applies, world frame [m].
    pub behind_m: DVec3,
    /// Rotation due to rope that the next step applies, about its own axes [rad].
    pub behind_rad: DVec3,
}

/// Depth below which no part can be above the surface in any sea [m].
const HIGHEST_WAVE_M: f64 = 20.0;

/// Force and moment about its centre of mass, in its own axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Weight {
    pub force: DVec3,
    pub moment: DVec3,
}

/// Computes the weight of the part above the surface; `hull_scratch` is a buffer of the hull.
pub(crate) fn weight_out(
    model: &Model,
    kinetic: &Kinetic,
    whale: &WhaleState,
    time_s: f64,
    hull_scratch: &mut Vec<DVec3>,
) -> Weight {
    let (hull, centre) = (&kinetic.hull, centre_of(kinetic, whale));
    let top_m = hull.top_m(kinetic.centre_m, whale.orientation);
    if hull.volume_m3 <= 0.0 || centre.z + top_m < -HIGHEST_WAVE_M {
        return Weight::default();
    }
    let height_m = centre.z - model.sea.at(centre, time_s).surface_m;
    if height_m + top_m < 0.0 {
        return Weight::default();
    }
    let wet = hull.wetted(kinetic.centre_m, whale.orientation, height_m, hull_scratch);
    let middle = whale.orientation * (hull.middle_m - kinetic.centre_m) * hull.volume_m3;
    let lift = model.spec.water.density_kg_m3 * model.spec.water.gravity_m_s2;
    let [east, north] = [wet.moment_m4[0] - middle.x, wet.moment_m4[1] - middle.y];
    let inward = whale.orientation.conjugate();
    Weight {
        force: inward * DVec3::Z * (lift * (wet.volume_m3 - hull.volume_m3).min(0.0)),
        moment: inward * DVec3::new(north, -east, 0.0) * lift,
    }
}

/// Impulse and angular impulse of rope on the whale over the solver steps so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct RopeImpulse {
    force: DVec3,
    moment: DVec3,
    /// Impulse and angular impulse, each times the remaining time of the step.
    force_left: DVec3,
    moment_left: DVec3,
}

/// Length of a solver step, and remaining time of the step after it [s].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Times {
    pub dt: f64,
    pub left: f64,
}

impl RopeImpulse {
    /// Adds the contacts of rope in a solver step; moments are about `centre`.
    pub fn add_contacts(&mut self, contacts: &[ContactPoint], centre: DVec3, times: Times) {
        for contact in contacts {
            self.add(
                contact.normal * -contact.normal_force_n - contact.friction_n,
                contact.position - centre,
                times,
            );
        }
    }

    /// Adds the contacts of bodies in a solver step; moments are about `centre`.
    pub fn add_bodies(&mut self, contacts: &[BodyContact], centre: DVec3, times: Times) {
        for contact in contacts {
            self.add(
                contact.normal * -contact.normal_force_n - contact.friction_n,
                contact.position - centre,
                times,
            );
        }
    }

    /// Adds a force at an arm from the centre.
    pub fn add(&mut self, force: DVec3, arm: DVec3, times: Times) {
        let (impulse, turning) = (force * times.dt, arm.cross(force) * times.dt);
        self.force += impulse;
        self.moment += turning;
        self.force_left += impulse * times.left;
        self.moment_left += turning * times.left;
    }

    /// Impulse so far [N s].
    pub fn impulse(&self) -> DVec3 {
        self.force
    }

    /// Records the mean load of a step of length `dt` in the whale's state and applies the impulse to its momentum.
    pub fn apply(&self, kinetic: &Kinetic, dt: f64, whale: &mut WhaleState) {
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

/// Position of a whale's centre of mass [m].
pub(crate) fn centre_of(kinetic: &Kinetic, whale: &WhaleState) -> DVec3 {
    whale.position + whale.orientation * kinetic.centre_m
}

/// Properties of a dead whale.
#[derive(Clone, Debug, PartialEq)]
pub struct Dead {
    /// Joint angles.
    pub posture: Posture,
}

/// Advances a dead whale from `whale` to `next` by a step; `hull_scratch` is a buffer of its hull.
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

/// Velocity in its own axes after drag over a step, and that drag.
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

/// Spin about its own axes after drag over a step.
fn slowed_turn(model: &Model, kinetic: &Kinetic, spin: DVec3, dt: f64) -> DVec3 {
    let inertia = kinetic.whole_inertia_kg_m2();
    spin / (DVec3::ONE
        + kinetic.turn_drag_m5 * spin.abs() * (0.5 * model.spec.water.density_kg_m3 * dt) / inertia)
}
