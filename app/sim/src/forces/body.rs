//! Rigid bodies with six degrees of freedom: traps, buoys, anchors.
//!
//! Newton and Euler about the centre of mass, in the world frame:
//! `(m + A) dv/dt = Σ F`, `I dω/dt + ω × Iω = Σ r × F + τ_drag`, with `A` and `I` turned with the body.
//! Floats lift by the water they displace (`float.rs`). Drag by body axis `k`, of a float at its own place or of the body as a
//! whole, `u` the water's velocity relative to that place: `F_k = ½ρ (C_d A)_k |u| u_k`; turning drag `τ_k = -½ρ D_k |ω_k| ω_k`.
//! Water that passes a float at the surface draws it down and raises waves, which add to its drag (`float.rs`).
//! The matrix omits how the force down depends on speed.
//! In waves heights are those above the surface over the body's middle, and the water's acceleration acts (`water.rs`).
//! Place and rotation (`rotation.rs`) follow the step's scheme. Rope ends pull on the body inside the same linear solve (`interface.rs`).

use glam::{DMat3, DVec3};

use crate::forces::Forces;
use crate::matrix::{outer, turned};
use crate::model::{Body, Float, Model, Passing, Wet};
use crate::state::State;
use crate::system::LinearSystem;
use crate::trial::plan::{Attachment, Plan};
use crate::trial::rotation::momentum_rate;
use crate::trial::scheme::Scheme;
use crate::trial::{BodyTrial, StepContext, Trial};

/// Stiffness that holds a body in place.
pub(crate) const HELD: f64 = 1e30;

/// A body as its forces read it.
#[derive(Clone, Copy)]
pub(crate) struct BodyAt<'a> {
    /// Index of the body.
    pub index: usize,
    pub body: &'a Body,
    /// First block of the body in the interface system.
    pub block: usize,
    pub trial: &'a BodyTrial,
    /// Its axes in the world frame, by columns.
    axes: DMat3,
    /// Velocity of its place at the end of the step [m/s].
    velocity: DVec3,
    /// Angular velocity at the end of the step, zero in statics [rad/s].
    spin: DVec3,
}

impl<'a> BodyAt<'a> {
    fn of(
        index: usize,
        body: &'a Body,
        block: usize,
        trial: &'a BodyTrial,
        scheme: &Scheme,
    ) -> Self {
        Self {
            index,
            body,
            block,
            trial,
            axes: DMat3::from_quat(trial.orientation),
            velocity: (trial.place - trial.place_history) * scheme.rate,
            spin: if scheme.is_static() { DVec3::ZERO } else { trial.spin(scheme) },
        }
    }

    /// A place in the body's frame as an attachment, and the arm to it in the world frame.
    fn point(&self, offset: DVec3) -> (Attachment, DVec3) {
        let attachment = Attachment::Body { block: self.block, body: self.index, offset };
        (attachment, self.trial.orientation * offset)
    }
}

impl Forces {
    /// Adds inertia, weight, floats, drag and seabed of every body.
    pub(crate) fn add_bodies(
        &self,
        context: &StepContext<'_>,
        (plan, trial): (&Plan, &Trial),
        system: &mut LinearSystem,
    ) {
        let StepContext { model, scheme, .. } = *context;
        for (index, body) in model.spec.bodies.iter().enumerate() {
            self.add_body_in_water(context, index, (plan, trial), system);
            if scheme.exact {
                self.add_slopes(model, (index, body), (plan, trial), system);
            }
            Self::add_feet(context, index, (plan, trial), system);
        }
    }

    /// Adds inertia, weight and the water's forces of a body.
    pub(crate) fn add_body_in_water(
        &self,
        context: &StepContext<'_>,
        index: usize,
        (plan, trial): (&Plan, &Trial),
        system: &mut LinearSystem,
    ) {
        let StepContext { model, state, scheme } = *context;
        let body = &model.spec.bodies[index];
        let at = BodyAt::of(index, body, plan.body_block[index], &trial.bodies[index], scheme);
        system.interface.force[at.block].z -= body.mass_kg * model.spec.water.gravity_m_s2;
        let passing = self.passing(model, &at);
        let [wet, facing] = self.add_floats(model, &at, &passing, scheme, system);
        add_body_inertia(state, &at, wet, scheme, system);
        let drag = PartDrag { area: body.drag_area_m2 * facing, passing: &passing };
        self.add_part_drag(model, &at, (at.point(DVec3::ZERO), drag), scheme, system);
        add_turn_drag(model, &at, wet, scheme, system);
        self.water.add_body_push(model, &at, wet, system);
    }

    /// What passing water adds to a body.
    fn passing(&self, model: &Model, at: &BodyAt<'_>) -> Passing {
        let (water, flow) = (&model.spec.water, &self.water.flow_bodies[at.index]);
        let BodyAt { body, trial, .. } = *at;
        let (height, axis) = (trial.place.z - flow.surface_m, trial.orientation * DVec3::Z);
        let constants = [water.density_kg_m3, water.gravity_m_s2];
        body.passing(flow.velocity_m_s - at.velocity, constants, |float| {
            float.form.wet(height + (trial.orientation * float.offset_m).z, axis)
        })
    }

    /// Adds buoyancy and drag of a body's floats; returns the wet shares of its volume, for added mass, and of the area that
    /// faces the flow, for drag as a whole.
    fn add_floats(
        &self,
        model: &Model,
        at: &BodyAt<'_>,
        passing: &Passing,
        scheme: &Scheme,
        system: &mut LinearSystem,
    ) -> [f64; 2] {
        let body = at.body;
        let (mut wet, mut facing, mut whole) = (0.0, 0.0, 0.0);
        for float in &body.floats {
            let point = at.point(float.offset_m);
            let under = self.add_float(model, at, (float, point, passing), scheme, system);
            let drag = PartDrag { area: float.drag_area_m2 * under.facing, passing };
            self.add_part_drag(model, at, (point, drag), scheme, system);
            wet += under.share * float.volume_m3;
            facing += under.facing * float.volume_m3;
            whole += float.volume_m3;
        }
        if body.wetted_drag && whole > 0.0 { [wet / whole, facing / whole] } else { [1.0; 2] }
    }

    /// Adds the buoyancy of a float and the force that draws it down; returns how much of it is under water.
    fn add_float(
        &self,
        model: &Model,
        at: &BodyAt<'_>,
        (float, (attachment, arm), passing): (&Float, (Attachment, DVec3), &Passing),
        scheme: &Scheme,
        system: &mut LinearSystem,
    ) -> Wet {
        let water = &model.spec.water;
        let BodyAt { index, block, trial, .. } = *at;
        let wet = float.form.wet(
            trial.place.z + arm.z - self.water.flow_bodies[index].surface_m,
            trial.orientation * DVec3::Z,
        );
        let lift = water.density_kg_m3 * water.gravity_m_s2 * float.volume_m3;
        let plane = float.volume_m3 * wet.slope;
        let force = DVec3::Z * (lift * wet.share - passing.pull_pa * plane);
        system.interface.push(attachment, arm, force);
        system.interface.force[block + 1] += wet.moment.cross(DVec3::Z * lift);
        if scheme.exact {
            return wet;
        }
        // Under water and above it most of these blocks are zero.
        let up = outer(DVec3::Z, DVec3::Z);
        let stiffness = lift * wet.slope - passing.softening_pa_m * plane;
        let turning = lift * wet.turn;
        if stiffness != 0.0 {
            system.interface.add(attachment, arm, attachment, arm, up * stiffness);
        }
        if turning != 0.0 || arm.dot(force) > 0.0 {
            *system.interface.at(block + 1, block + 1) +=
                turn_stiffness(arm, force) + (DMat3::IDENTITY - up) * turning;
        }
        wet
    }

    /// Adds the drag of a part of a body at a point of it.
    fn add_part_drag(
        &self,
        model: &Model,
        at: &BodyAt<'_>,
        ((attachment, arm), PartDrag { area, passing }): ((Attachment, DVec3), PartDrag<'_>),
        scheme: &Scheme,
        system: &mut LinearSystem,
    ) {
        if area == DVec3::ZERO {
            return;
        }
        let BodyAt { index, axes, mut velocity, spin, .. } = *at;
        let half_density = 0.5 * model.spec.water.density_kg_m3;
        if !scheme.is_static() {
            velocity += spin.cross(arm);
        }
        let relative = axes.transpose() * (self.water.flow_bodies[index].velocity_m_s - velocity);
        let speed = relative.length();
        let area = area * (1.0 + passing.waves);
        system.interface.push(attachment, arm, axes * (area * relative * (half_density * speed)));
        if !scheme.is_static() {
            // Where wave drag falls with speed, the matrix has that at steady speed.
            let growth = 1.0 + passing.waves_growth.max(0.0) / (1.0 + passing.waves);
            let along = relative * relative * (growth / speed.max(1e-9));
            let slope = area * (DVec3::splat(speed) + along) * half_density;
            let slope = turned(&axes, slope * scheme.rate);
            system.interface.add(attachment, arm, attachment, arm, slope);
        }
    }
}

/// Drag of a part of a body.
#[derive(Clone, Copy)]
struct PartDrag<'a> {
    /// Coefficient times wet area by body axis, without waves [m²].
    area: DVec3,
    passing: &'a Passing,
}

/// Adds mass, added mass and the change of momentum of a body.
fn add_body_inertia(
    state: &State,
    at: &BodyAt<'_>,
    wet: f64,
    scheme: &Scheme,
    system: &mut LinearSystem,
) {
    let BodyAt { index, body, block, trial, ref axes, spin, .. } = *at;
    let now = &state.bodies[index];
    let mass =
        DMat3::from_diagonal(DVec3::splat(body.mass_kg)) + turned(axes, body.added_mass_kg * wet);
    let moments = body.inertia_kg_m2 + body.added_inertia_kg_m2 * wet;
    let share = scheme.inertia * trial.pseudo_mass_scale;
    *system.interface.at(block, block) += mass * share;
    if scheme.is_static() {
        let inertia = turned(axes, moments);
        *system.interface.at(block + 1, block + 1) += inertia * share;
        if scheme.anchored {
            system.interface.force[block] -= mass * ((trial.place - trial.place_history) * share);
            system.interface.force[block + 1] -= inertia * (trial.turn() * share);
        }
    } else {
        let (turning, growth) = momentum_rate(axes, spin, now, moments, scheme);
        system.interface.force[block] -= inertial(trial, scheme, mass);
        system.interface.force[block + 1] -= turning;
        *system.interface.at(block + 1, block + 1) += growth;
    }
    if trial.held {
        *system.interface.at(block, block) += DMat3::IDENTITY * HELD;
    }
    if trial.held || trial.upright {
        *system.interface.at(block + 1, block + 1) += DMat3::IDENTITY * HELD;
    }
}

/// Adds the drag on a body's rotation besides that of its parts.
fn add_turn_drag(
    model: &Model,
    at: &BodyAt<'_>,
    wet: f64,
    scheme: &Scheme,
    system: &mut LinearSystem,
) {
    if scheme.is_static() {
        return;
    }
    let BodyAt { body, block, ref axes, .. } = *at;
    let half_density = 0.5 * model.spec.water.density_kg_m3 * wet;
    let spin = axes.transpose() * at.spin;
    system.interface.force[block + 1] -=
        axes * (body.turn_drag_m5 * spin * spin.abs() * half_density);
    let slope = body.turn_drag_m5 * spin.abs() * (2.0 * half_density * scheme.rate);
    *system.interface.at(block + 1, block + 1) += turned(axes, slope);
}

/// Force that gives a mass the acceleration of a body's step.
pub(crate) fn inertial(trial: &BodyTrial, scheme: &Scheme, mass: DMat3) -> DVec3 {
    let velocity = (trial.place - trial.place_history) * scheme.rate;
    mass * ((velocity - trial.velocity_history) * scheme.rate)
}

/// Turning stiffness of a force at the end of an arm: the part of its derivative that is never negative, so that the matrix stays
/// definite while a body capsizes.
pub(crate) fn turn_stiffness(arm: DVec3, force: DVec3) -> DMat3 {
    let square = arm.length_squared();
    if square < 1e-18 {
        return DMat3::ZERO;
    }
    (DMat3::IDENTITY - outer(arm, arm) * (1.0 / square)) * arm.dot(force).max(0.0)
}
