//! Momentum and energy of a living kinetic whale along its own axis, by source.
//!
//! ```text
//! (m + A_x) (u - u₀) = ∫ T dt - ∫ D dt + ∫ R_x dt        ½ (m + A_x) (u² - u₀²) = ∫ (T - D + R_x) u dt
//! ```
//!
//! `T` thrust, `D` drag of its body, `R_x` force of the gear ahead, `u` speed through the water (`whale/kinetic`). Drag and speed within a step
//! are means of its ends, while the whale itself is stepped by pushing first and coasting then, so that the residual is what steps miss. What is
//! out of the water weighs on the whale besides and stands in the residual.

use glam::DVec3;

use crate::state::WhaleState;

/// Impulse and work of each source since the first step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WhaleBooks {
    /// Change of momentum with added mass [N s].
    pub momentum_change_ns: f64,
    /// Impulse of thrust, of the body's drag and of the gear [N s].
    pub thrust_impulse_ns: f64,
    /// As said.
    pub drag_impulse_ns: f64,
    /// As said.
    pub gear_impulse_ns: f64,
    /// Change of kinetic energy with added mass [J].
    pub kinetic_j: f64,
    /// Work of thrust, of the body's drag and of the gear [J].
    pub thrust_work_j: f64,
    /// As said.
    pub drag_work_j: f64,
    /// As said.
    pub gear_work_j: f64,
}

impl WhaleBooks {
    /// Change of momentum less all impulses [N s].
    #[must_use]
    pub fn residual_ns(&self) -> f64 {
        self.momentum_change_ns
            - self.thrust_impulse_ns
            - self.drag_impulse_ns
            - self.gear_impulse_ns
    }

    /// Change of energy less all work [J].
    #[must_use]
    pub fn residual_j(&self) -> f64 {
        self.kinetic_j - self.thrust_work_j - self.drag_work_j - self.gear_work_j
    }
}

/// What was when the last step ended.
#[derive(Clone, Copy, Debug)]
struct Last {
    speed_m_s: f64,
    drag_n: f64,
}

/// Keeps the books, step by step.
#[derive(Clone, Debug)]
pub(super) struct BookMeter {
    mass_kg: f64,
    last: Option<Last>,
    books: WhaleBooks,
}

impl BookMeter {
    /// Of a whale with this mass and added mass ahead.
    pub(super) fn new(mass_kg: f64) -> Self {
        Self { mass_kg, last: None, books: WhaleBooks::default() }
    }

    pub(super) fn fold(&mut self, whale: &WhaleState, dt_s: f64) {
        let now = Last { speed_m_s: whale.speed_m_s, drag_n: whale.exertion.drag_n };
        if let Some(last) = self.last.replace(now) {
            let speed = 0.5 * (last.speed_m_s + now.speed_m_s);
            let thrust = whale.exertion.thrust_n * dt_s;
            let drag = -0.5 * (last.drag_n + now.drag_n) * dt_s;
            let gear = whale.exertion.rope_force_n.dot(whale.orientation * DVec3::X) * dt_s;
            let gained = self.mass_kg * (now.speed_m_s - last.speed_m_s);
            let books = &mut self.books;
            books.momentum_change_ns += gained;
            books.thrust_impulse_ns += thrust;
            books.drag_impulse_ns += drag;
            books.gear_impulse_ns += gear;
            books.kinetic_j += gained * speed;
            books.thrust_work_j += thrust * speed;
            books.drag_work_j += drag * speed;
            books.gear_work_j += gear * speed;
        }
    }

    pub(super) fn books(&self) -> WhaleBooks {
        self.books
    }
}
