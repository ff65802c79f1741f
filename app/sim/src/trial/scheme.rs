//! Time schemes: how velocity and acceleration follow from places.
//!
//! With `x` the unknown place at the end of a step of length `dt`:
//! `v = (x - x̂)/h`, `a = (v - v̂)/h`, where
//!
//! | scheme | h | x̂ |
//! |---|---|---|
//! | backward Euler | dt | xₙ |
//! | two stages, the second; `h` for a whole step of length `dt`, γ = 1 - 1/√2 | γ dt | (1+√2) x₁ - √2 xₙ |
//! | BDF2, step ratio ω = dt/dt₋₁ | dt(1+ω)/(1+2ω) | ((1+ω)²xₙ - ω²xₙ₋₁)/(1+2ω) |
//! | statics | ∞ | any (v = 0) |
//!
//! and `v̂` is formed from velocities as `x̂` from places. `x₁` is the end of the first stage, a step of backward Euler of length
//! γ dt; both stages together are the L-stable method of second order of Alexander (1977), `x = xₙ + dt ((1-γ) v₁ + γ v)`.
//! Its error is an eighth of that of BDF2. In statics `inertia` is not `1/h²` but the
//! weight of a pseudo-mass that limits the move of each iteration.
//! Reference: Hairer and Wanner, Solving Ordinary Differential Equations II, section V.1.

use core::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use glam::DVec3;

/// Greatest growth of the step for which BDF2 is used (its bound of stability is 1 + √2).
const GREATEST_RATIO: f64 = 2.0;

/// Share of a step in two stages that the first takes, `1 - 1/√2`: with it the step is of second order and L-stable.
pub(crate) const FIRST_SHARE: f64 = 1.0 - FRAC_1_SQRT_2;

/// Coefficients of one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scheme {
    /// Length of the step [s]; zero in statics.
    pub dt: f64,
    /// `1/h` [1/s]; zero in statics.
    pub rate: f64,
    /// Weight of the mass in the matrix: `1/h²`, or the pseudo-mass of statics [1/s²].
    pub inertia: f64,
    /// Whether the pseudo-mass of statics pulls back to where a pass began (`statics.rs`).
    pub anchored: bool,
    /// Whether forces on bodies are differentiated as they are, and not so that the matrix stays definite while a body
    /// is far from its balance.
    pub exact: bool,
    /// Share of the present value in the history.
    pub now: f64,
    /// Share of the earlier value in the history.
    pub earlier: f64,
}

impl Scheme {
    /// First order, strongly damped: for contact and for retries.
    pub fn backward_euler(dt: f64) -> Self {
        Self {
            dt,
            rate: 1.0 / dt,
            inertia: 1.0 / (dt * dt),
            anchored: false,
            exact: false,
            now: 1.0,
            earlier: 0.0,
        }
    }

    /// Second order where the last step allows it, else backward Euler.
    pub fn bdf2(dt: f64, earlier_dt: f64) -> Self {
        let ratio = if earlier_dt > 0.0 { dt / earlier_dt } else { f64::INFINITY };
        if ratio > GREATEST_RATIO {
            return Self::backward_euler(dt);
        }
        let below = 1.0 + 2.0 * ratio;
        let rate = below / (dt * (1.0 + ratio));
        let now = (1.0 + ratio) * (1.0 + ratio) / below;
        Self {
            dt,
            rate,
            inertia: rate * rate,
            anchored: false,
            exact: false,
            now,
            earlier: ratio * ratio / below,
        }
    }

    /// Second stage of a step of this length in two stages; the first is backward Euler over [`FIRST_SHARE`] of it.
    pub fn second_stage(whole: f64) -> Self {
        let rate = 1.0 / (FIRST_SHARE * whole);
        Self {
            dt: (1.0 - FIRST_SHARE) * whole,
            rate,
            inertia: rate * rate,
            anchored: false,
            exact: false,
            now: 1.0 + SQRT_2,
            earlier: SQRT_2,
        }
    }

    /// At rest, with a pseudo-mass [1/s²].
    pub fn statics(pseudo_mass: f64) -> Self {
        Self {
            dt: 0.0,
            rate: 0.0,
            inertia: pseudo_mass,
            anchored: false,
            exact: false,
            now: 1.0,
            earlier: 0.0,
        }
    }

    /// Whether nothing moves.
    pub fn is_static(&self) -> bool {
        self.rate <= 0.0
    }

    /// History of the unknown: `x̂` of places, `v̂` of velocities.
    pub fn history(&self, now: DVec3, earlier: DVec3) -> DVec3 {
        now * self.now - earlier * self.earlier
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bdf2_is_exact_for_a_parabola_at_any_step_ratio() {
        for ratio in [0.3, 1.0, 1.9] {
            let (dt, earlier_dt) = (0.01 * ratio, 0.01);
            let place = |t: f64| DVec3::new(3.0 * t * t - 2.0 * t + 1.0, 0.0, 0.0);
            let scheme = Scheme::bdf2(dt, earlier_dt);
            let speed = (place(dt) - scheme.history(place(0.0), place(-earlier_dt))) * scheme.rate;
            assert!((speed.x - (6.0 * dt - 2.0)).abs() < 1e-12, "{ratio}: {}", speed.x);
        }
    }

    #[test]
    fn a_step_that_grows_too_fast_falls_back_to_backward_euler() {
        assert_eq!(
            Scheme::bdf2(0.01, 0.001).inertia.to_bits(),
            Scheme::backward_euler(0.01).inertia.to_bits()
        );
    }

    /// Phase lag of steps of a length behind `x″ = -x` over `radians`, and the remaining amplitude.
    fn swing(dt: f64, radians: f64) -> (f64, f64) {
        let solved = |scheme: &Scheme, now: [DVec3; 2], earlier: [DVec3; 2]| {
            let [place, velocity] = [0, 1].map(|of| scheme.history(now[of], earlier[of]));
            let end = (place * scheme.inertia + velocity * scheme.rate) / (scheme.inertia + 1.0);
            [end, (end - place) * scheme.rate]
        };
        let mut now = [DVec3::X, DVec3::ZERO];
        let steps = (radians / dt).round() as usize;
        for _ in 0..steps {
            let middle = solved(&Scheme::backward_euler(FIRST_SHARE * dt), now, now);
            now = solved(&Scheme::second_stage(dt), middle, now);
        }
        let at = libm::atan2(-now[1].x, now[0].x);
        let lag = libm::remainder(dt * steps as f64 - at, core::f64::consts::TAU);
        (lag, libm::hypot(now[0].x, now[1].x))
    }

    #[test]
    fn two_stages_lag_by_an_eighth_of_what_bdf2_lags_by() {
        for dt in [0.1, 0.05] {
            let (lag, left) = swing(dt, 20.0);
            assert!((lag / (0.0404 * dt * dt * 20.0) - 1.0).abs() < 0.02, "{dt}: {lag}");
            assert!(left < 1.0 && left > 1.0 - 3.0 * dt * dt * dt, "{dt}: {left} left");
        }
    }

    #[test]
    fn two_stages_damp_what_they_do_not_resolve() {
        let (_, left) = swing(1e3, 5e3);
        assert!(left < 1e-6, "{left} left after five steps");
    }
}
