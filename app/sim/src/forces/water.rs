//! The water at nodes and bodies, and the forces of its acceleration.
//!
//! Evaluated once a step at the predictor, for the end of the step. With acceleration `a` of the water:
//! rope node `F = L [ρ A_m a + ρ (π d²/4)(C_a (I - t tᵀ) + C_at t tᵀ) a]`, body `F = (ρ V_wet + A) a`: the pressure gradient that drives
//! the water (Froude and Krylov) and the added mass against it (Morison). Buoyancy from the surface of the wave is the rest of the
//! pressure. Without waves, and before they begin, none of this is computed.
//! Reference: Morison et al. 1950 (doi:10.2118/950149-G); Sumer and Fredsøe 2006, section 4.1.

use glam::DVec3;

use crate::forces::body::BodyAt;
use crate::forces::laws::{PerMetre, Shared};
use crate::forces::rope::{Lengths, tangent};
use crate::model::Model;
use crate::system::LinearSystem;
use crate::trial::{StepContext, Trial};
use crate::water::field::Walk;
use crate::water::{WaterAt, WavesOut};

/// The water at the gear, for the end of the step.
#[derive(Clone, Debug, Default)]
pub(crate) struct WaterAtGear {
    /// Velocity of the water at each node: current and waves [m/s].
    pub flow: Vec<DVec3>,
    /// Acceleration of the water at each node; empty where there are no waves [m/s²].
    flow_acceleration: Vec<DVec3>,
    /// Height of the surface above each node's z = 0; empty where there are no waves [m].
    surface: Vec<f64>,
    /// Force of the water's acceleration on each node through pressure and added mass; empty where there are no waves [N].
    pub push: Vec<DVec3>,
    /// The water at each body.
    pub flow_bodies: Vec<WaterAt>,
    wave_walk: Walk,
}

impl WaterAtGear {
    /// Storage for a number of nodes.
    pub fn new(nodes: usize) -> Self {
        Self { flow: vec![DVec3::ZERO; nodes], ..Self::default() }
    }

    /// Evaluates velocity, acceleration and surface of the water at every node and body of the trial.
    pub(crate) fn measure_flow(&mut self, model: &Model, trial: &Trial) {
        let (sea, time_s) = (&model.sea, trial.time);
        sea.current_at(&trial.place, time_s, &mut self.flow);
        let out = WavesOut {
            flow: &mut self.flow,
            acceleration: &mut self.flow_acceleration,
            surface: &mut self.surface,
        };
        sea.add_waves(&trial.place, time_s, &mut self.wave_walk, out);
        self.flow_bodies.clear();
        self.flow_bodies.extend(trial.bodies.iter().map(|body| sea.at(body.place, time_s)));
    }

    /// Height of the surface over a node [m].
    pub(crate) fn surface_at(&self, node: usize) -> f64 {
        self.surface.get(node).copied().unwrap_or(0.0)
    }

    /// Evaluates the force of accelerating water on every node, at the start of the step.
    pub(crate) fn measure_push(&mut self, context: &StepContext<'_>, lengths: &Lengths) {
        let StepContext { model, state, scheme } = *context;
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
                    * lengths.node[node];
                let acceleration = self.flow_acceleration[node];
                let (tangent, _) = tangent(&state.rope.position, node, nodes);
                let along = tangent * (per_metre.spared * tangent.dot(acceleration));
                self.push.push((acceleration * (per_metre.added + pressure) - along) * wet);
            }
        }
    }

    /// Adds the force of accelerating water on rope.
    pub(crate) fn add_push(&self, system: &mut LinearSystem) {
        for (force, push) in system.rope.force.iter_mut().zip(&self.push) {
            *force += *push;
        }
    }

    /// Adds the force of accelerating water on a body with this wet share.
    pub(crate) fn add_body_push(
        &self,
        model: &Model,
        at: &BodyAt<'_>,
        wet: f64,
        system: &mut LinearSystem,
    ) {
        let BodyAt { index, body, block, trial, .. } = *at;
        let WaterAt { acceleration_m_s2: acceleration, surface_m, .. } = self.flow_bodies[index];
        if acceleration == DVec3::ZERO {
            return;
        }
        let height = |offset: DVec3| trial.place.z + (trial.orientation * offset).z - surface_m;
        let axis = trial.orientation * DVec3::Z;
        let volume: f64 = body
            .floats
            .iter()
            .map(|float| float.volume_m3 * float.form.wet(height(float.offset_m), axis).share)
            .sum();
        let added = trial.orientation
            * (body.added_mass_kg * wet * (trial.orientation.inverse() * acceleration));
        system.interface.force[block] +=
            acceleration * (model.spec.water.density_kg_m3 * volume) + added;
    }
}
