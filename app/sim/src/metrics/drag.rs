//! Drag that rope and gear add to the whale, and what a kinetic whale does about it.

use glam::DVec3;

use super::books::BookMeter;
use super::summary::KineticSummary;
use super::window::Window;
use crate::model::Model;
use crate::state::{State, WhaleState};
use crate::whale::hitch;

/// How hard rope that touches it, with this force on its skin, or is made fast to it holds the whale back along its x axis [N].
pub(super) fn added_drag(
    model: &Model,
    state: &State,
    whale: &WhaleState,
    on_skin_n: DVec3,
) -> f64 {
    let made_fast: DVec3 = hitch::pulls(model, state).map(|(force, _)| force).sum();
    -(on_skin_n + made_fast).dot(whale.orientation * DVec3::X)
}

/// Effort of a kinetic whale.
#[derive(Clone, Debug)]
pub(super) struct EffortMeter {
    /// Thrust, power, drag of the body, speed, speed lost.
    means: Window<5>,
    peak_thrust_n: f64,
    peak_pull_n: f64,
    books: BookMeter,
    /// Velocity through the water and momentum now, in the world's frame.
    velocity_m_s: DVec3,
    momentum_ns: DVec3,
    mass_kg: DVec3,
}

impl EffortMeter {
    /// Of a model whose whale is kinetic.
    pub(super) fn new(model: &Model) -> Option<Self> {
        let mass_kg = model.spec.whale.as_ref()?.kinetic.as_ref()?.whole_mass_kg();
        Some(Self {
            means: Window::new(model),
            peak_thrust_n: 0.0,
            peak_pull_n: 0.0,
            books: BookMeter::new(mass_kg.x),
            velocity_m_s: DVec3::ZERO,
            momentum_ns: DVec3::ZERO,
            mass_kg,
        })
    }

    pub(super) fn fold(&mut self, whale: &WhaleState, dt_s: f64) {
        let now = &whale.exertion;
        let lost = now.asked_speed_m_s - whale.speed_m_s;
        self.means.fold([now.thrust_n, now.power_w, now.drag_n, whale.speed_m_s, lost], dt_s);
        self.peak_thrust_n = self.peak_thrust_n.max(now.thrust_n);
        self.peak_pull_n = self.peak_pull_n.max(now.rope_force_n.length());
        self.books.fold(whale, dt_s);
        let [port, back] = now.slip_m_s;
        let velocity = DVec3::new(whale.speed_m_s, port, back);
        self.velocity_m_s = whale.orientation * velocity;
        self.momentum_ns = whale.orientation * (self.mass_kg * velocity);
    }

    pub(super) fn summary(&self) -> KineticSummary {
        let [thrust_n, power_w, body_drag_n, speed_m_s, speed_lost_m_s] = self.means.mean();
        let (peak_thrust_n, peak_rope_pull_n) = (self.peak_thrust_n, self.peak_pull_n);
        KineticSummary {
            thrust_n,
            power_w,
            body_drag_n,
            speed_m_s,
            speed_lost_m_s,
            peak_thrust_n,
            peak_rope_pull_n,
            velocity_m_s: self.velocity_m_s,
            momentum_ns: self.momentum_ns,
            books: self.books.books(),
        }
    }
}
