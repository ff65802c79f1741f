//! A whale that feels the gear: mass, drag, thrust and the rope's pull decide how it goes.
//!
//! Alive, in its own axes, `u` ahead, `v` to port, `w` to the back, all through the water; `ω` its turn rates:
//!
//! ```text
//! ahead      (m + A_x) du/dt = T - D(u) + R_x              T thrust (`muscle`), D body drag (`drag`)
//! sideways   (m + A_k) dv_k/dt = B_k - ½ρ C_k |U| v_k + R_k  k = y, z;  B net buoyancy
//! turning    (I + A_k') dω_k/dt = S_k - ½ρ D_k |δ_k| δ_k + M_k  δ = ω - what the motion asks for
//! ```
//!
//! `R` and `M` are force and moment of all rope on the whale. `S` turns it as its motion asks and, as far as its
//! strength goes, takes back what the rope turned: `S = (I + A') dω_asked/dt - (I + A') δ/τ`, the second part at most `S_max`.
//! What is out of the water weighs on it besides (`out`).
//! Flippers and flukes are taken to carry the centripetal force of a turn, so that without rope it goes as its motion asks.
//!
//! Rope and whale take turns (`pull`): the whale drifts over a step as its own forces send it, rope is solved for that path, and
//! the impulse that rope gave is added to the whale's momentum at the end. Such stepping is symplectic: it neither feeds nor
//! eats energy over a swing, and is stable for a pull of stiffness `k` as long as `k dt² < 4 m`: 1e9 N/m for 30 t and 10 ms.
//!
//! Symbols: `m` mass, `A` added mass (`added`), `I` moment of inertia, `C`, `D` drag area and turning drag, `ρ` density of the water.
//! References: van der Hoop et al. 2013 (doi:10.1111/mms.12042) for the drag, Lamb 1932, Hydrodynamics, articles 114 and 115, for
//! added mass, Arthur et al. 2015 (doi:10.1111/mms.12230) for the greatest thrust, Hairer, Lubich and Wanner 2003 for the stepping.

pub mod added;
pub mod dead;
pub mod drag;
pub mod hull;
pub mod muscle;
pub(crate) mod out;
pub(crate) mod pull;
pub(crate) mod swim;

use std::sync::Arc;

use glam::DVec3;

pub use dead::Dead;
pub use drag::AxialDrag;
pub use hull::Hull;
pub use muscle::{Effort, Muscle};

/// What makes a whale kinetic.
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
    /// Turning drag by axis: moment = ½ρ · this · ω|ω| [m⁵].
    pub turn_drag_m5: DVec3,
    /// Thrust and power.
    pub muscle: Muscle,
    /// Greatest moment by which it takes back what rope turned, by axis [N m].
    pub steering_n_m: DVec3,
    /// How fast it does [s].
    pub steering_time_s: f64,
    /// Net buoyancy under water as a share of its weight; of a living whale.
    pub buoyancy: f64,
    /// Its skin at rest, or as it lies dead, by which it is wetted near the surface; empty for one that is always deep.
    pub hull: Arc<Hull>,
    /// What it is besides where it is dead.
    pub dead: Option<Dead>,
}

impl Kinetic {
    /// Mass with added mass, by axis [kg].
    #[must_use]
    pub fn whole_mass_kg(&self) -> DVec3 {
        self.added_mass_kg + self.mass_kg
    }

    /// Moments of inertia with the added ones, by axis [kg m²].
    #[must_use]
    pub fn whole_inertia_kg_m2(&self) -> DVec3 {
        self.inertia_kg_m2 + self.added_inertia_kg_m2
    }

    /// What is wrong with it, if anything.
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
            Some("steering time, buoyancy or centre of mass is not sound")
        } else {
            self.drag.fault().or(self.muscle.fault())
        }
    }
}

/// What a whale does and bears over a step, for its next step and for reports.
///
/// All zero of a kinematic whale.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exertion {
    /// Velocity through the water to port and to the back [m/s].
    pub slip_m_s: [f64; 2],
    /// Speed that its motion asks for [m/s].
    pub asked_speed_m_s: f64,
    /// Turn rates that its motion asks for, about its own axes [rad/s].
    pub asked_turn_rate: DVec3,
    /// Thrust [N].
    pub thrust_n: f64,
    /// Drag of its body [N].
    pub drag_n: f64,
    /// Power put in, thrust's over the efficiency [W].
    pub power_w: f64,
    /// Force of all rope on it, mean over the step, in the world's frame [N].
    pub rope_force_n: DVec3,
    /// Moment of that about its centre of mass, in the world's frame [N m].
    pub rope_moment_n_m: DVec3,
    /// How far the pull over the step still has to move its centre, in the world's frame [m].
    pub behind_m: DVec3,
    /// How far the moment over the step still has to turn it, about its own axes [rad].
    pub behind_rad: DVec3,
}
