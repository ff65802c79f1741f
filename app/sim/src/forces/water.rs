//! The water at nodes and bodies, and what its acceleration does to them.
//!
//! Measured once a step, where the step's first guess stands, for the step's end. With acceleration `a` of the water:
//! rope node `F = L [ρ A_m a + ρ (π d²/4)(C_a (I - t tᵀ) + C_at t tᵀ) a]`, body `F = (ρ V_wet + A) a`: the pressure gradient that drives
//! the water (Froude and Krylov) and the added mass against it (Morison); buoyancy reckoned from the wave's own surface
//! is the rest of the pressure. Without waves, and before they begin, none of this costs anything.
//! Reference: Morison et al. 1950 (doi:10.2118/950149-G); Sumer and Fredsøe 2006, section 4.1.

use glam::DVec3;

use crate::forces::laws::{PerMetre, Shared};
use crate::forces::rope::tangent;
use crate::model::{Body, Model};
use crate::solver::Solver;
use crate::state::State;
use crate::trial::scheme::Scheme;
use crate::water::{WaterAt, WavesOut};

impl Solver {
    /// Takes the water's velocity, acceleration and surface at every node and body where the trial stands.
    pub(crate) fn measure_flow(&mut self, model: &Model) {
        let (sea, time_s) = (&model.sea, self.trial.time);
        sea.current_at(&self.trial.place, time_s, &mut self.flow);
        let out = WavesOut {
            flow: &mut self.flow,
            acceleration: &mut self.flow_acceleration,
            surface: &mut self.surface,
        };
        sea.add_waves(&self.trial.place, time_s, &mut self.wave_walk, out);
        self.flow_bodies.clear();
        self.flow_bodies.extend(self.trial.bodies.iter().map(|body| sea.at(body.place, time_s)));
    }

    /// Height of the surface over a node [m].
    pub(crate) fn surface_at(&self, node: usize) -> f64 {
        self.surface.get(node).copied().unwrap_or(0.0)
    }

    /// Takes the push of accelerating water on every node, as the step begins.
    pub(crate) fn measure_push(&mut self, model: &Model, state: &State, scheme: &Scheme) {
        self.push.clear();
        if self.flow_acceleration.is_empty() {
            return;
        }
        let shared = Shared::of(model, scheme);
        for (line, nodes) in model.spec.lines.iter().zip(&model.line_nodes) {
            let rope = &model.spec.ropes[line.rope];
            let (per_metre, pressure) = (
                PerMetre::of(rope, &model.spec.water),
                model.spec.water.density_kg_m3 * rope.displaced_m3_m,
            );
            for node in nodes.clone() {
                let wet = shared.wet_at(state.rope.position[node].z - self.surface[node])
                    * self.lengths.node[node];
                let acceleration = self.flow_acceleration[node];
                let (tangent, _) = tangent(&state.rope.position, node, nodes);
                let along = tangent * (per_metre.spared * tangent.dot(acceleration));
                self.push.push((acceleration * (per_metre.added + pressure) - along) * wet);
            }
        }
    }

    /// Adds the push of accelerating water on rope.
    pub(crate) fn add_push(&mut self) {
        for (force, push) in self.tridiagonal.force.iter_mut().zip(&self.push) {
            *force += *push;
        }
    }

    /// Adds the push of accelerating water on a body of a wet share.
    pub(crate) fn add_body_push(&mut self, model: &Model, index: usize, body: &Body, wet: f64) {
        let WaterAt { acceleration_m_s2: acceleration, surface_m, .. } = self.flow_bodies[index];
        if acceleration == DVec3::ZERO {
            return;
        }
        let trial = self.trial.bodies[index];
        let height = |offset: DVec3| trial.place.z + (trial.orientation * offset).z - surface_m;
        let axis = trial.orientation * DVec3::Z;
        let volume: f64 = body
            .floats
            .iter()
            .map(|float| float.volume_m3 * float.form.wet(height(float.offset_m), axis).share)
            .sum();
        let added = trial.orientation
            * (body.added_mass_kg * wet * (trial.orientation.inverse() * acceleration));
        self.interface.force[self.plan.body_block[index]] +=
            acceleration * (model.spec.water.density_kg_m3 * volume) + added;
    }
}
