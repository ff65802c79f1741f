//! Rotation of bodies by the scheme of the step.
//!
//! Angular momentum about the centre of mass in the world frame, `J` the moments of inertia `I` turned with the body:
//!
//! ```text
//! dL/dt = Σ r × F + τ        L = J ω        J = R I Rᵀ
//! ```
//!
//! The unknown is the turn `θ = log(q qₙ⁻¹)` since the step began. With `h` and the history of the step's scheme (`scheme.rs`)
//!
//! ```text
//! θ′ = (θ - θ̂)/h        ω = θ′ + θ × θ′/2        dL/dt = (L - L̂)/h
//! ```
//!
//! where `θ̂` is formed from zero and from the turn to the earlier orientation, and `L̂` from the momentum at both. The next term of `ω`
//! is below the order of the scheme. By backward Euler `θ̂` is zero, and `ω = θ/dt`. A small turn `δ` more changes the momentum by
//! `J δ/h - L × δ + J (ω × δ)/2`, which Newton's matrix holds, so that one pass leaves an error of second order.
//! Reference: Iserles, Munthe-Kaas, Nørsett and Zanna 2000, Lie-group methods (doi:10.1017/S0962492900002154).

use glam::{DMat3, DQuat, DVec3};

use crate::matrix::{cross_matrix, times_cross, turned};
use crate::state::BodyState;
use crate::trial::BodyTrial;
use crate::trial::scheme::Scheme;

impl BodyTrial {
    /// Turn since the step began, the shorter way round [rad].
    pub fn turn(&self) -> DVec3 {
        turn_between(self.anchor, self.orientation)
    }

    /// Angular velocity in the world frame at the end of a step that is not one of statics [rad/s].
    pub fn spin(&self, scheme: &Scheme) -> DVec3 {
        let turn = self.turn();
        let rate = (turn - self.turn_history) * scheme.rate;
        rate + turn.cross(rate) * 0.5
    }
}

/// `θ̂` of a body [rad].
pub(crate) fn turn_history(now: &BodyState, scheme: &Scheme) -> DVec3 {
    scheme.history(DVec3::ZERO, turn_between(now.orientation, now.earlier_orientation))
}

/// Rate at which a body of these moments of inertia gains angular momentum [N m], and its growth with a turn [N m/rad]. It has these axes
/// in the world frame, by columns, and this angular velocity at the end of the step [rad/s].
pub(crate) fn momentum_rate(
    axes: &DMat3,
    spin: DVec3,
    now: &BodyState,
    inertia_kg_m2: DVec3,
    scheme: &Scheme,
) -> (DVec3, DMat3) {
    let inertia = turned(axes, inertia_kg_m2);
    let momentum = inertia * spin;
    let momentum_of = |orientation: DQuat, spin: DVec3| {
        turned(&DMat3::from_quat(orientation), inertia_kg_m2) * spin
    };
    // Backward Euler has no earlier step.
    let earlier = if scheme.earlier > 0.0 {
        momentum_of(now.earlier_orientation, now.earlier_spin)
    } else {
        DVec3::ZERO
    };
    let history = scheme.history(momentum_of(now.orientation, now.spin), earlier);
    let growth = inertia * scheme.rate - cross_matrix(momentum) + times_cross(&inertia, spin) * 0.5;
    ((momentum - history) * scheme.rate, growth * scheme.rate)
}

/// The turn that leads from one orientation to another, the shorter way round [rad].
fn turn_between(from: DQuat, to: DQuat) -> DVec3 {
    let turn = to * from.inverse();
    let turn = if turn.w < 0.0 { -turn } else { turn };
    turn.to_scaled_axis()
}
