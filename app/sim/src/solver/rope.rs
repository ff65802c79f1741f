//! Forces along and on a rope: inertia, weight, drag, axial tension.
//!
//! Segment of unstretched length `l`, ends `a`, `b`, direction `t`:
//! strain `ε = |x_b - x_a|/l - 1`, strain rate `ε̇ = t·(v_b - v_a)/l`: `T = T(ε, ε̇)` (`axial.rs`), and it pulls only
//! while `T > 0`.
//! Node with hanging length `L`, tangent `t`, water velocity relative to it `u = U - v`,
//! `u_t = u·t`, `u_n = u - u_t t` (Morison):
//! `F = L [½ρ C_n d |u_n| u_n + ½ρ C_t π d |u_t| u_t t - (m - ρ A_m) g ẑ]`,
//! mass `L [m + ρ (π d²/4)(C_a (I - t tᵀ) + C_at t tᵀ)]`, with `A_m` the volume of fibre per metre.
//! A segment is judged taut, and stiffened across, by the tension that the last linear solve foretold
//! rather than by the tension at the guess: one or two solves a step then suffice (see docs/physics.md).
//! Reference: Morison et al. 1950 (doi:10.2118/950149-G); drag coefficients from the gear library.

use core::f64::consts::PI;

use glam::{DMat3, DVec3};

use super::Solver;
use super::scheme::Scheme;
use crate::model::{Model, Rope};
use crate::state::State;

/// Height over which a node goes from wet to dry at the surface [m].
pub(super) const SURFACE_HEIGHT_M: f64 = 0.1;

/// The matrix `v vᵀ`.
pub(crate) fn outer(one: DVec3, other: DVec3) -> DMat3 {
    DMat3::from_cols(one * other.x, one * other.y, one * other.z)
}

impl Solver {
    /// Mass of each node, with the added mass of its direction when the step begins.
    pub(super) fn weigh(&mut self, model: &Model, state: &State) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            let rope = &model.spec.ropes[line.rope];
            let nodes = model.line_nodes[index].clone();
            let water = model.spec.water.density_kg_m3 * PI * rope.diameter_m * rope.diameter_m / 4.0;
            let (added, added_along) = (water * rope.added_mass_normal, water * rope.added_mass_tangential);
            for node in nodes.clone() {
                let (tangent, _) = tangent(&state.rope.position, node, nodes.start, nodes.end);
                let along = outer(tangent, tangent);
                let added = (DMat3::IDENTITY - along) * added + along * added_along;
                let wet = wet_share(model, state.rope.position[node].z - self.surface_at(node));
                self.mass[node] = (DMat3::from_diagonal(DVec3::splat(rope.mass_kg_m)) + added * wet) * self.lengths.node[node];
            }
        }
    }

    /// Adds inertia, weight, buoyancy and drag of every node.
    pub(super) fn add_nodes(&mut self, model: &Model, scheme: &Scheme) {
        for (index, line) in model.spec.lines.iter().enumerate() {
            let rope = &model.spec.ropes[line.rope];
            let nodes = model.line_nodes[index].clone();
            for node in nodes.clone() {
                self.add_inertia(node, scheme);
                self.add_weight(model, rope, node);
                if model.spec.water.density_kg_m3 > 0.0 {
                    self.add_drag(model, (index, rope), node, scheme);
                }
            }
        }
    }

    fn add_inertia(&mut self, node: usize, scheme: &Scheme) {
        let mass = self.mass[node];
        let velocity = (self.trial.place[node] - self.trial.place_history[node]) * scheme.rate;
        self.band.diagonal[node] += mass * scheme.inertia;
        self.band.force[node] -= mass * ((velocity - self.trial.velocity_history[node]) * scheme.rate);
    }

    fn add_weight(&mut self, model: &Model, rope: &Rope, node: usize) {
        let water = &model.spec.water;
        let length = self.lengths.node[node];
        let height = self.trial.place[node].z - self.surface_at(node);
        let lift = water.density_kg_m3 * rope.displaced_m3_m * water.gravity_m_s2 * length;
        self.band.force[node].z += lift * wet_share(model, height) - rope.mass_kg_m * water.gravity_m_s2 * length;
        if water.rope_dries && height.abs() < 0.5 * SURFACE_HEIGHT_M {
            self.band.diagonal[node].z_axis.z += lift / SURFACE_HEIGHT_M;
        }
    }

    fn add_drag(&mut self, model: &Model, (line, rope): (usize, &Rope), node: usize, scheme: &Scheme) {
        let place = self.trial.place[node];
        let wet = wet_share(model, place.z - self.surface_at(node)) * self.lengths.node[node];
        if wet <= 0.0 {
            return;
        }
        let (first, end) = (model.line_nodes[line].start, model.line_nodes[line].end);
        let velocity = (place - self.trial.place_history[node]) * scheme.rate;
        let relative = self.flow[node] - velocity;
        let (tangent, inverse_chord) = tangent(&self.trial.place, node, first, end);
        let half_density = 0.5 * model.spec.water.density_kg_m3 * rope.diameter_m * wet;
        let (across, along) = (half_density * rope.drag_normal, half_density * rope.drag_tangential * PI);
        let drag = Drag::new(relative, tangent, across, along);
        self.band.force[node] += drag.force();
        self.band.diagonal[node] += drag.by_velocity() * scheme.rate;
        if scheme.is_static() {
            self.add_drag_turn(node, (first, end), node - line, drag.by_tangent() * inverse_chord);
        }
    }

    /// Adds the change of a node's drag as its neighbours turn it: makes statics converge quadratically.
    fn add_drag_turn(&mut self, node: usize, (first, end): (usize, usize), segment: usize, turn: DMat3) {
        if node + 1 < end {
            self.band.up[segment] -= turn;
        } else {
            self.band.diagonal[node] -= turn;
        }
        if node > first {
            self.band.low[segment - 1] += turn;
        } else {
            self.band.diagonal[node] += turn;
        }
    }

    /// Adds the pull of every segment that is taut.
    pub(super) fn add_tension(&mut self, model: &Model, scheme: &Scheme) {
        for index in 0..model.spec.lines.len() {
            let first_node = model.line_nodes[index].start;
            for (k, segment) in model.line_segments[index].clone().enumerate() {
                self.add_segment(segment, first_node + k, scheme);
            }
        }
    }

    fn add_segment(&mut self, segment: usize, node: usize, scheme: &Scheme) {
        if self.cut[segment] {
            self.pull[segment] = Pull::default();
            return;
        }
        let mut pull = self.pull_of(segment, node, scheme);
        pull.taut = self.trial.tension[segment] > 0.0;
        self.pull[segment] = pull;
        if !pull.taut {
            return;
        }
        let along = outer(pull.direction, pull.direction);
        let across = self.trial.tension[segment].max(0.0) / pull.chord;
        let block = along * (pull.stiffness - across) + DMat3::from_diagonal(DVec3::splat(across));
        let force = pull.direction * pull.tension;
        self.band.force[node] += force;
        self.band.force[node + 1] -= force;
        self.band.diagonal[node] += block;
        self.band.diagonal[node + 1] += block;
        self.band.up[segment] -= block;
        self.band.low[segment] -= block;
    }

    /// Tension of a segment at the trial places, before it is judged taut or slack.
    pub(super) fn pull_of(&self, segment: usize, node: usize, scheme: &Scheme) -> Pull {
        let between = self.trial.place[node + 1] - self.trial.place[node];
        self.pull_between(segment, node, scheme, between)
    }

    /// The same with the trial moved by a share of the solved step.
    pub(super) fn pull_moved(&self, segment: usize, node: usize, scheme: &Scheme, share: f64) -> Pull {
        let between = self.trial.place[node + 1] - self.trial.place[node];
        self.pull_between(segment, node, scheme, between + (self.band.step[node + 1] - self.band.step[node]) * share)
    }

    fn pull_between(&self, segment: usize, node: usize, scheme: &Scheme, between: DVec3) -> Pull {
        let length = self.lengths.segment[segment];
        let chord = between.length().max(1e-9 * length);
        let direction = between / chord;
        let history = self.trial.place_history[node + 1] - self.trial.place_history[node];
        let rate = direction.dot(between - history) * scheme.rate / length;
        let (law, strain) = (&self.lengths.axial[segment], chord / length - 1.0);
        let tension = law.tension(strain, rate);
        let stiffness = law.slope(strain, scheme.rate) / length;
        Pull { direction, chord, tension, stiffness, taut: false }
    }

    /// After a solve: the tension each segment will have by the linear solution.
    pub(super) fn foretell_tension(&mut self, model: &Model, share: f64) {
        for (index, _) in model.spec.lines.iter().enumerate() {
            let first_node = model.line_nodes[index].start;
            for (k, segment) in model.line_segments[index].clone().enumerate() {
                let pull = &self.pull[segment];
                self.trial.tension[segment] = pull.tension + pull.stiffness * pull.stretch(&self.band.step, first_node + k) * share;
            }
        }
    }
}

/// Axial law of a segment at the trial places.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pull {
    pub direction: DVec3,
    pub chord: f64,
    pub tension: f64,
    pub stiffness: f64,
    /// Whether the last solve let it pull.
    pub taut: bool,
}

impl Pull {
    /// How much the solved step stretches the segment [m].
    pub fn stretch(&self, step: &[DVec3], node: usize) -> f64 {
        self.direction.dot(step[node + 1] - step[node])
    }
}

/// Drag of a short length of rope and its derivatives.
pub(crate) struct Drag {
    tangent: DVec3,
    relative: DVec3,
    normal: DVec3,
    normal_speed: f64,
    along_speed: f64,
    across: f64,
    along: f64,
}

impl Drag {
    /// `across` and `along` are half density times coefficient times area [kg/m].
    pub fn new(relative: DVec3, tangent: DVec3, across: f64, along: f64) -> Self {
        let along_speed = relative.dot(tangent);
        let normal = relative - tangent * along_speed;
        Self { tangent, relative, normal, normal_speed: normal.length(), along_speed, across, along }
    }

    /// Force on the rope [N].
    pub fn force(&self) -> DVec3 {
        self.normal * (self.across * self.normal_speed) + self.tangent * (self.along * self.along_speed.abs() * self.along_speed)
    }

    /// Derivative of the force by the relative velocity [N s/m].
    pub fn by_velocity(&self) -> DMat3 {
        let along = outer(self.tangent, self.tangent);
        let mut matrix =
            (DMat3::IDENTITY - along) * (self.across * self.normal_speed) + along * (2.0 * self.along * self.along_speed.abs());
        if self.normal_speed > 1e-12 {
            matrix += outer(self.normal, self.normal) * (self.across / self.normal_speed);
        }
        matrix
    }

    /// Derivative of the force by the tangent, kept a unit vector [N].
    pub fn by_tangent(&self) -> DMat3 {
        let mut of_normal = DMat3::from_diagonal(DVec3::splat(self.across * self.normal_speed));
        if self.normal_speed > 1e-12 {
            of_normal += outer(self.normal, self.normal) * (self.across / self.normal_speed);
        }
        let identity = DMat3::IDENTITY;
        let turn_of_normal = (outer(self.tangent, self.relative) + identity * self.along_speed) * -1.0;
        let speed = self.along_speed.abs();
        let turn_of_along = outer(self.tangent, self.relative) * (2.0 * speed) + identity * (speed * self.along_speed);
        let unit = identity - outer(self.tangent, self.tangent);
        (of_normal * turn_of_normal + turn_of_along * self.along) * unit
    }
}

/// Direction of a line at a node from its neighbours, and the inverse of the chord it was taken over.
fn tangent(place: &[DVec3], node: usize, first: usize, end: usize) -> (DVec3, f64) {
    let before = if node > first { node - 1 } else { node };
    let after = if node + 1 < end { node + 1 } else { node };
    let chord = place[after] - place[before];
    let length = chord.length();
    if length > 1e-12 { (chord / length, 1.0 / length) } else { (DVec3::Z, 0.0) }
}

/// Share of a node that is under water at a height above the surface.
pub(super) fn wet_share(model: &Model, height: f64) -> f64 {
    if model.spec.water.rope_dries { (0.5 - height / SURFACE_HEIGHT_M).clamp(0.0, 1.0) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Derivatives against central differences.
    #[test]
    fn drag_derivatives_agree_with_differences() {
        let (relative, tangent) = (DVec3::new(0.4, -0.3, 0.2), DVec3::new(0.1, 0.2, 0.9).normalize());
        let drag = Drag::new(relative, tangent, 6.0, 0.3);
        let step = 1e-6;
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let ahead = Drag::new(relative + axis * step, tangent, 6.0, 0.3).force();
            let behind = Drag::new(relative - axis * step, tangent, 6.0, 0.3).force();
            assert!((drag.by_velocity() * axis - (ahead - behind) / (2.0 * step)).length() < 1e-6);
            let ahead = Drag::new(relative, (tangent + axis * step).normalize(), 6.0, 0.3).force();
            let behind = Drag::new(relative, (tangent - axis * step).normalize(), 6.0, 0.3).force();
            assert!((drag.by_tangent() * axis - (ahead - behind) / (2.0 * step)).length() < 1e-6);
        }
    }
}
