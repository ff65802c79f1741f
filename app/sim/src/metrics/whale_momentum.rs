//! Momentum and energy of a living kinetic whale along its own axis by source, and its speed made good.
//!
//! ```text
//! (m + A_x) (u - u₀) = ∫ T dt - ∫ D dt + ∫ R_x dt        ½ (m + A_x) (u² - u₀²) = ∫ (T - D + R_x) u dt
//! ```
//!
//! `m` mass and `A_x` added mass [kg], `T` thrust, `D` drag of its body, `R_x` force of the gear ahead [N], `u` speed through
//! the water [m/s] (`whale/kinetic`). Drag and speed within a step are means of its ends, whereas the whale's own step applies
//! the impulse first and then coasts; the residual is therefore the discretisation error. It also includes the weight of the
//! part above the surface.
//!
//! Speed made good over the ground: `v = |x(t) - x(t - τ)| / τ` [m/s], with `τ` = [`MADE_GOOD_S`], or the time since the start
//! if that is shorter. It is positive for a whale that tows its gear, and near zero for one on anchored gear, although it
//! swims.

use std::collections::VecDeque;

use glam::DVec3;

use crate::state::WhaleState;

/// Impulse and work of each source since the first step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MomentumBalance {
    /// Change of momentum with added mass [N s].
    pub momentum_change_ns: f64,
    /// Impulse of thrust [N s].
    pub thrust_impulse_ns: f64,
    /// Impulse of the drag of its body [N s].
    pub drag_impulse_ns: f64,
    /// Impulse of the gear [N s].
    pub gear_impulse_ns: f64,
    /// Change of kinetic energy with added mass [J].
    pub kinetic_j: f64,
    /// Work of thrust [J].
    pub thrust_work_j: f64,
    /// Work of the drag of its body [J].
    pub drag_work_j: f64,
    /// Work of the gear [J].
    pub gear_work_j: f64,
}

impl MomentumBalance {
    /// Change of momentum minus all impulses [N s].
    pub fn residual_ns(&self) -> f64 {
        self.momentum_change_ns
            - self.thrust_impulse_ns
            - self.drag_impulse_ns
            - self.gear_impulse_ns
    }

    /// Change of energy minus all work [J].
    pub fn residual_j(&self) -> f64 {
        self.kinetic_j - self.thrust_work_j - self.drag_work_j - self.gear_work_j
    }
}

/// Values at the end of the last step.
#[derive(Clone, Copy, Debug)]
struct Last {
    speed_m_s: f64,
    drag_n: f64,
}

/// Accumulates the balance step by step.
#[derive(Clone, Debug)]
pub(super) struct MomentumMeter {
    mass_kg: f64,
    last: Option<Last>,
    balance: MomentumBalance,
}

impl MomentumMeter {
    /// Meter of a whale with this mass, including added mass ahead.
    pub(super) fn new(mass_kg: f64) -> Self {
        Self { mass_kg, last: None, balance: MomentumBalance::default() }
    }

    pub(super) fn fold(&mut self, whale: &WhaleState, dt_s: f64) {
        let now = Last { speed_m_s: whale.speed_m_s, drag_n: whale.exertion.drag_n };
        if let Some(last) = self.last.replace(now) {
            let speed = 0.5 * (last.speed_m_s + now.speed_m_s);
            let thrust = whale.exertion.thrust_n * dt_s;
            let drag = -0.5 * (last.drag_n + now.drag_n) * dt_s;
            let gear = whale.exertion.rope_force_n.dot(whale.orientation * DVec3::X) * dt_s;
            let gained = self.mass_kg * (now.speed_m_s - last.speed_m_s);
            let balance = &mut self.balance;
            balance.momentum_change_ns += gained;
            balance.thrust_impulse_ns += thrust;
            balance.drag_impulse_ns += drag;
            balance.gear_impulse_ns += gear;
            balance.kinetic_j += gained * speed;
            balance.thrust_work_j += thrust * speed;
            balance.drag_work_j += drag * speed;
            balance.gear_work_j += gear * speed;
        }
    }

    pub(super) fn balance(&self) -> MomentumBalance {
        self.balance
    }
}

/// Averaging time of the speed made good; estimate: longer than a turn at the end of a line of some body lengths [s].
pub const MADE_GOOD_S: f64 = 30.0;

/// Interval between stored positions [s].
const EVERY_S: f64 = 1.0;

/// Positions of the whale over the last [`MADE_GOOD_S`].
#[derive(Clone, Debug, Default)]
pub(super) struct MadeGood {
    stored: VecDeque<(f64, DVec3)>,
    now: (f64, DVec3),
}

impl MadeGood {
    pub fn fold(&mut self, time_s: f64, place_m: DVec3) {
        self.now = (time_s, place_m);
        if self.stored.back().is_none_or(|(last_s, _)| time_s - last_s >= EVERY_S) {
            self.stored.push_back(self.now);
        }
        // The first stored position is the latest that is at least this old.
        while self.stored.get(1).is_some_and(|(second_s, _)| time_s - second_s >= MADE_GOOD_S) {
            self.stored.pop_front();
        }
    }

    /// Speed made good [m/s]; zero at the start.
    pub fn speed_m_s(&self) -> f64 {
        let Some((then_s, then_m)) = self.stored.front() else { return 0.0 };
        let (now_s, now_m) = self.now;
        if now_s > *then_s { (now_m - *then_m).length() / (now_s - then_s) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(seconds: f64, place: impl Fn(f64) -> DVec3) -> f64 {
        let mut meter = MadeGood::default();
        for step in 0..=(seconds / 0.05).round() as u32 {
            let time_s = 0.05 * f64::from(step);
            meter.fold(time_s, place(time_s));
        }
        meter.speed_m_s()
    }

    #[test]
    fn a_straight_path_counts_fully_and_a_circle_not_at_all() {
        let ahead = |time_s: f64| DVec3::new(0.8 * time_s, -0.6 * time_s, 0.0);
        for seconds in [5.0, 30.0, 200.0] {
            assert!((after(seconds, ahead) - 1.0).abs() < 1e-9, "{seconds}");
        }
        // One circle in the averaging time.
        let round = |time_s: f64| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * time_s / MADE_GOOD_S);
            10.0 * DVec3::new(cos, sin, 0.0)
        };
        assert!(after(90.0, round) < 1e-9);
        // Motion before the averaging time does not count.
        let then_still = |time_s: f64| DVec3::X * time_s.min(50.0);
        assert!(after(100.0, then_still) < 1e-9);
        assert!(after(0.0, ahead).abs() < 1e-15);
    }
}
