//! Forces on lines, bodies and the whale: drag of the water, forces of the whale on rope, added drag, effort, and their means.
//!
//! Drag of rope is that of the solver (Morison), per metre at each node: `f_n = 1/2 rho C_n d |v_n| v_n` across and
//! `f_t = 1/2 rho C_t pi d w v_t` along [N/m], with `w` of `Rope::drag_speed_along_m_s` [m/s], `d` the diameter [m], `rho` the
//! density of water [kg/m³] and `v` the velocity of the water relative to the part [m/s]. Drag of a body is
//! `1/2 rho |v| (C A) v` [N] by its axes, over the submerged share of its floats.
//! Reference: Morison et al. 1950 (doi:10.2118/950149-G).

use std::collections::VecDeque;
use std::f64::consts::PI;

use glam::DVec3;

use super::summary::KineticSummary;
use super::whale_momentum::MomentumMeter;
use crate::contact::ContactPoint;
use crate::model::Model;
use crate::state::{State, WhaleState};
use crate::whale::hitch;

/// Force of rope on the whale against its x axis [N]: the force `on_skin_n` of contact, and lines attached to it.
pub(super) fn added_drag(
    model: &Model,
    state: &State,
    whale: &WhaleState,
    on_skin_n: DVec3,
) -> f64 {
    let attached: DVec3 = hitch::pulls(model, state).map(|(force, _)| force).sum();
    -(on_skin_n + attached).dot(whale.orientation * DVec3::X)
}

/// Effort of a kinetic whale.
#[derive(Clone, Debug)]
pub(super) struct EffortMeter {
    /// Thrust, power, drag of the body, speed, loss of speed.
    means: Window<5>,
    peak_thrust_n: f64,
    peak_pull_n: f64,
    balance: MomentumMeter,
    /// Velocity through the water and momentum, world frame.
    velocity_m_s: DVec3,
    momentum_ns: DVec3,
    mass_kg: DVec3,
}

impl EffortMeter {
    /// Meter of a kinetic whale; `None` for another model.
    pub(super) fn new(model: &Model) -> Option<Self> {
        let mass_kg = model.spec.whale.as_ref()?.kinetic.as_ref()?.whole_mass_kg();
        Some(Self {
            means: Window::new(model),
            peak_thrust_n: 0.0,
            peak_pull_n: 0.0,
            balance: MomentumMeter::new(mass_kg.x),
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
        self.balance.fold(whale, dt_s);
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
            balance: self.balance.balance(),
        }
    }
}

/// Drag of the water on a line's rope [N].
pub(super) fn line_drag(model: &Model, state: &State, line: usize) -> DVec3 {
    let (rope, water) = (&model.spec.ropes[model.spec.lines[line].rope], &model.spec.water);
    let (nodes, segments) = (model.line_nodes[line].clone(), &model.line_segments[line]);
    let on_segment = |(node, segment): (usize, usize)| {
        let [from, to] = [node, node + 1].map(|node| state.rope.position[node]);
        let (place, velocity) =
            (from.midpoint(to), state.rope.velocity[node].midpoint(state.rope.velocity[node + 1]));
        let flow = model.sea.at(place, state.time_s);
        if water.rope_dries && place.z > flow.surface_m {
            return DVec3::ZERO;
        }
        let way = (to - from).normalize_or_zero();
        let relative = flow.velocity_m_s - velocity;
        let along = way * relative.dot(way);
        let across = relative - along;
        let by_metre = across * (rope.drag_normal * across.length())
            + along * (PI * rope.drag_tangential * rope.drag_speed_along_m_s(along.length()));
        by_metre
            * (0.5 * water.density_kg_m3 * rope.diameter_m * state.rope.segment_length[segment])
    };
    nodes.zip(segments.clone()).map(on_segment).sum()
}

/// Drag of the water on a body [N].
pub(super) fn body_drag(model: &Model, state: &State, body: usize) -> DVec3 {
    let (spec, now) = (&model.spec.bodies[body], &state.bodies[body]);
    let flow = model.sea.at(now.position, state.time_s);
    let relative = now.orientation.inverse() * (flow.velocity_m_s - now.velocity);
    let half = 0.5 * model.spec.water.density_kg_m3 * relative.length();
    let axis = now.orientation * DVec3::Z;
    let wet = |float: &crate::model::Float| {
        let height = now.position.z + (now.orientation * float.offset_m).z - flow.surface_m;
        float.form.wet(height, axis)
    };
    let water = &model.spec.water;
    let constants = [water.density_kg_m3, water.gravity_m_s2];
    let passing = spec.passing(flow.velocity_m_s - now.velocity, constants, wet);
    let (mut area, mut facing, mut volume) = (DVec3::ZERO, 0.0, 0.0);
    for float in &spec.floats {
        let share = wet(float).facing;
        area += float.drag_area_m2 * share;
        (facing, volume) = (facing + share * float.volume_m3, volume + float.volume_m3);
    }
    let wet = if spec.wetted_drag && volume > 0.0 { facing / volume } else { 1.0 };
    let half = half * (1.0 + passing.waves);
    now.orientation * ((area + spec.drag_area_m2 * wet) * relative * half)
}

/// Normal force and friction of the whale on a line: sums of magnitudes [N].
pub(super) fn on_line(contacts: &[ContactPoint], line: usize) -> [f64; 2] {
    let own = contacts.iter().filter(|contact| contact.line == line);
    own.fold([0.0; 2], |[normal, friction], contact| {
        [normal + contact.normal_force_n, friction + contact.friction_n.length()]
    })
}

/// Averaging time of drag and effort; estimate [s].
pub const DRAG_WINDOW_S: f64 = 5.0;

/// Readings, current and over the last [`DRAG_WINDOW_S`].
#[derive(Clone, Debug)]
pub(super) struct Window<const N: usize> {
    pub(super) now: [f64; N],
    /// Length of each step and the readings at its end.
    steps: VecDeque<(f64, [f64; N])>,
    held_s: f64,
}

impl<const N: usize> Window<N> {
    pub(super) fn new(model: &Model) -> Self {
        let steps = DRAG_WINDOW_S / model.spec.settings.step_s.max(1e-4);
        Self { now: [0.0; N], steps: VecDeque::with_capacity(steps as usize + 3), held_s: 0.0 }
    }

    pub(super) fn fold(&mut self, readings: [f64; N], dt_s: f64) {
        debug_assert!(dt_s >= 0.0, "time does not decrease");
        self.now = readings;
        self.steps.push_back((dt_s, readings));
        self.held_s += dt_s;
        while let Some((oldest_s, _)) = self.steps.front() {
            if self.held_s - oldest_s < DRAG_WINDOW_S {
                break;
            }
            self.held_s -= oldest_s;
            self.steps.pop_front();
        }
    }

    /// Means over the last [`DRAG_WINDOW_S`], or over the time so far.
    pub(super) fn mean(&self) -> [f64; N] {
        let time: f64 = self.steps.iter().map(|(dt, _)| dt).sum();
        if time <= 0.0 {
            return self.now;
        }
        std::array::from_fn(|index| {
            self.steps.iter().map(|(dt, readings)| dt * readings[index]).sum::<f64>() / time
        })
    }
}
