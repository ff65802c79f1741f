//! Derivatives of the water's forces on a body, with which statics converges quickly.
//!
//! Near its balance a body's forces and torques `f(x, q)` are differentiated as they are: floats and drag by central
//! differences of six small moves `δ`, `∂f/∂x_k ≈ (f(x + δ e_k) - f(x - δ e_k))/2δ`, rotations about the world's axes likewise;
//! a force `F` at the end of an arm `a` that turns with the body has `-∂(a × F)/∂θ = (a·F) 1 - a Fᵀ`. The matrix that stays
//! definite while a body capsizes (`body.rs`) omits the part that is not symmetric; with it a tilted buoy takes a hundred iterations.

use glam::{DMat3, DQuat, DVec3};

use crate::forces::Forces;
use crate::matrix::outer;
use crate::model::{Body, Float, Model};
use crate::system::LinearSystem;
use crate::trial::Trial;
use crate::trial::plan::Plan;

/// Move and turn of the differences [m], [rad].
const STEP: f64 = 1e-6;

/// Force and torque.
type Wrench = (DVec3, DVec3);

/// `-∂(arm × force)/∂θ` of a steady force at the end of an arm that turns.
pub(crate) fn turning(arm: DVec3, force: DVec3) -> DMat3 {
    DMat3::from_diagonal(DVec3::splat(arm.dot(force))) - outer(arm, force)
}

impl Forces {
    /// Adds `-∂f/∂(x, θ)` of the water's force and torque on a body at rest.
    pub(crate) fn add_slopes(
        &self,
        model: &Model,
        (index, body): (usize, &Body),
        (plan, trial): (&Plan, &Trial),
        system: &mut LinearSystem,
    ) {
        let (place, orientation) = (trial.bodies[index].place, trial.bodies[index].orientation);
        let block = plan.body_block[index];
        let moved = |forces: &Self, axis: DVec3| {
            let at =
                |step: f64| forces.wrench(model, index, body, place + axis * step, orientation);
            slope(at(-STEP), at(STEP))
        };
        let turned = |forces: &Self, axis: DVec3| {
            let at = |step: f64| {
                forces.wrench(
                    model,
                    index,
                    body,
                    place,
                    (DQuat::from_scaled_axis(axis * step) * orientation).normalize(),
                )
            };
            slope(at(-STEP), at(STEP))
        };
        let by_place = DVec3::AXES.map(|axis| moved(self, axis));
        let by_turn = DVec3::AXES.map(|axis| turned(self, axis));
        for (column, by) in [(block, by_place), (block + 1, by_turn)] {
            *system.interface.at(block, column) -= DMat3::from_cols(by[0].0, by[1].0, by[2].0);
            *system.interface.at(block + 1, column) -= DMat3::from_cols(by[0].1, by[1].1, by[2].1);
        }
    }

    /// Force and torque of still floats and of the current on a body, placed and turned like this.
    fn wrench(
        &self,
        model: &Model,
        index: usize,
        body: &Body,
        place: DVec3,
        orientation: DQuat,
    ) -> Wrench {
        let (water, flow) = (&model.spec.water, &self.water.flow_bodies[index]);
        let axes = DMat3::from_quat(orientation);
        let mut wrench = (DVec3::ZERO, DVec3::ZERO);
        let mut push = |arm: DVec3, force: DVec3, torque: DVec3| {
            wrench = (wrench.0 + force, wrench.1 + arm.cross(force) + torque)
        };
        let constants = [water.density_kg_m3, water.gravity_m_s2];
        let wet = |float: &Float| {
            let height = place.z + (axes * float.offset_m).z - flow.surface_m;
            float.form.wet(height, axes * DVec3::Z)
        };
        let passing = body.passing(flow.velocity_m_s, constants, wet);
        let drag = |area: DVec3| {
            let along = axes.transpose() * flow.velocity_m_s;
            let half = 0.5 * water.density_kg_m3 * (1.0 + passing.waves);
            axes * (area * along * (half * along.length()))
        };
        let (mut facing, mut whole) = (0.0, 0.0);
        for float in &body.floats {
            let arm = axes * float.offset_m;
            let wet = wet(float);
            let lift = DVec3::Z * (water.density_kg_m3 * water.gravity_m_s2 * float.volume_m3);
            let drawn = DVec3::Z * (passing.pull_pa * float.volume_m3 * wet.slope);
            push(
                arm,
                lift * wet.share - drawn + drag(float.drag_area_m2 * wet.facing),
                wet.moment.cross(lift),
            );
            facing += wet.facing * float.volume_m3;
            whole += float.volume_m3;
        }
        let wet = if body.wetted_drag && whole > 0.0 { facing / whole } else { 1.0 };
        push(DVec3::ZERO, drag(body.drag_area_m2 * wet), DVec3::ZERO);
        wrench
    }
}

/// Change of a wrench by a step between two.
fn slope(before: Wrench, after: Wrench) -> Wrench {
    ((after.0 - before.0) / (2.0 * STEP), (after.1 - before.1) / (2.0 * STEP))
}
