//! Motion of the whale over a step: requests of its plugin, current, and limits of the water.
//!
//! Kinematic: `dx/dt = R x̂ u + U(x)` with `x` the position [m], `R` the orientation, turned by the plugin's rates about the
//! whale's own axes,
//! `u` the mean speed through the water over the step [m/s], and `U` the velocity of the current [m/s]. Kinetic: mass, drag and
//! strength determine the response to the plugin's request (`kinetic/mod.rs`), also for a dead whale.
//! No part of its skin enters the seabed: the whale is lifted by the depth of its lowest vertex. It leaves the water at most as far as its
//! speed carries it ([`carried_m`]); for a kinetic whale its weight in air limits this. The jaws close as far as contact permits (`jaws.rs`), and joints turn within their
//! ranges (`pose.rs`).

use endline_sdk::{MotionInput, MotionOutput, Posture};
use glam::{DAffine3, DQuat, DVec3};

use super::kinetic::muscle::{MotionRequest, Surroundings, reported_speed, swim, thrust_speed};
use super::kinetic::{drift, weight_out};
use super::pose::pose;
use crate::model::{Model, Whale};
use crate::state::WhaleState;
use crate::step::{Input, Stop};

/// Gravity on the part above the surface [m/s²].
const GRAVITY_M_S2: f64 = 9.81;

/// Buffers for the motion of a whale.
#[derive(Clone, Debug, Default)]
pub(crate) struct DriveScratch {
    /// Vertices of a kinetic whale's hull near the surface.
    hull: Vec<DVec3>,
    /// Bone transforms at the end of the step.
    bones: Vec<DAffine3>,
}

impl DriveScratch {
    /// Buffers for a model's whale; empty without one.
    pub fn new(model: &Model) -> Self {
        let Some(whale) = &model.spec.whale else { return Self::default() };
        let hull = whale.kinetic.as_ref().map(|kinetic| kinetic.hull.scratch());
        Self { hull: hull.unwrap_or_default(), bones: Vec::with_capacity(whale.skin.bones.len()) }
    }
}

/// Computes the whale at the end of a step from `whale` to `next`. Returns whether its motion requested a posture beyond the
/// joints' ranges.
/// Errors: reports the motion plugin's id if it fails or returns a number that is not finite.
pub(crate) fn drive(
    model: &Model,
    input: &Input,
    whale: &WhaleState,
    time_s: f64,
    next: &mut WhaleState,
    scratch: &mut DriveScratch,
) -> Result<bool, Stop> {
    next.clone_from(whale);
    let Some(spec) = &model.spec.whale else {
        debug_assert!(false, "a state with a whale belongs to a model with a whale");
        return Ok(false);
    };
    if let Some(kinetic) = spec.kinetic.as_ref().filter(|kinetic| kinetic.dead.is_some()) {
        drift(model, kinetic, whale, time_s, next, &mut scratch.hull);
        keep_in_water(model, spec, next, &mut scratch.bones);
        return Ok(false);
    }
    let (asked, reported_m_s) = call_motion(model, spec, input, whale, time_s, next)?;
    next.posture = asked.posture;
    if let Some(jaws) = &spec.jaws {
        let dt_s = model.spec.settings.step_s;
        jaws.close(&whale.posture, &mut next.posture, whale.mouth_moment_n_m, dt_s);
    }
    let held = spec.joints.hold(&mut next.posture);
    let turn_rate = DVec3::from_array(asked.turn_rate_rad_s);
    match &spec.kinetic {
        Some(kinetic) => {
            let request = MotionRequest {
                from_m_s: reported_m_s,
                speed_m_s: asked.speed_m_s,
                turn_rate,
                burst: input.controls.burst,
            };
            let out = weight_out(model, kinetic, whale, time_s, &mut scratch.hull);
            let current_m_s = model.sea.current(whale.position, time_s);
            swim(model, kinetic, &request, whale, Surroundings { out, current_m_s }, next);
        }
        None => follow(model, &asked, whale, time_s, next),
    }
    keep_in_water(model, spec, next, &mut scratch.bones);
    Ok(held)
}

/// Calls the motion plugin; returns its request and the speed that was reported to it.
fn call_motion(
    model: &Model,
    spec: &Whale,
    input: &Input,
    whale: &WhaleState,
    time_s: f64,
    next: &mut WhaleState,
) -> Result<(MotionOutput, f64), Stop> {
    let stop =
        |reason: String| Stop { time_s, part: spec.motion.descriptor().id.to_string(), reason };
    let reported_m_s = if spec.kinetic.is_some() { reported_speed(whale) } else { whale.speed_m_s };
    let seen = MotionInput {
        time_s,
        dt_s: model.spec.settings.step_s,
        length_m: spec.length_m,
        speed_m_s: reported_m_s,
        position_m: whale.position.to_array(),
        orientation: whale.orientation.to_array(),
        controls: input.controls,
        contact_force_n: &whale.contact_force_n,
        contact_port_m: &whale.contact_port_m,
        thrust_speed_m_s: spec
            .kinetic
            .as_ref()
            .map(|kinetic| thrust_speed(&kinetic.drag, model.spec.water.density_kg_m3, whale)),
    };
    let asked = spec
        .motion
        .step(&spec.motion_attributes, &seen, &mut next.motion)
        .map_err(|error| stop(error.message))?;
    if !(asked.speed_m_s.is_finite()
        && DVec3::from_array(asked.turn_rate_rad_s).is_finite()
        && asked.posture.angles().all(f64::is_finite))
    {
        return Err(stop(
            "returned a speed, turn rate or joint angle that is not a finite number".into(),
        ));
    }
    Ok((asked, reported_m_s))
}

/// Advances a kinematic whale, which follows the request.
fn follow(
    model: &Model,
    asked: &MotionOutput,
    whale: &WhaleState,
    time_s: f64,
    next: &mut WhaleState,
) {
    let dt_s = model.spec.settings.step_s;
    let turn_rate = DVec3::from_array(asked.turn_rate_rad_s);
    next.speed_m_s = asked.speed_m_s;
    next.turn_rate = turn_rate;
    next.orientation = (whale.orientation * DQuat::from_scaled_axis(turn_rate * dt_s)).normalize();
    let ahead = whale.orientation.slerp(next.orientation, 0.5) * DVec3::X;
    next.position += (ahead * (0.5 * (whale.speed_m_s + next.speed_m_s))
        + model.sea.current(whale.position, time_s))
        * dt_s;
}

/// Greatest height of mid-body above the surface that its speed permits, against the weight of the part above the surface [m].
///
/// With the length `s` of `L` out of the water at a climb angle `θ`: `½ u² = g sinθ s²/2L` up to `s = L`; beyond,
/// `s = u²/(2g sinθ) + L/2`.
/// Mid-body is then `(s - L/2) sinθ` above the surface, and at least 0.
fn carried_m(length_m: f64, whale: &WhaleState) -> f64 {
    let rise = (whale.orientation * DVec3::X).z;
    if rise <= 0.0 || whale.speed_m_s <= 0.0 {
        return 0.0;
    }
    let free = whale.speed_m_s * whale.speed_m_s / (GRAVITY_M_S2 * rise);
    let out = if free < length_m { (free * length_m).sqrt() } else { 0.5 * (free + length_m) };
    ((out - 0.5 * length_m) * rise).max(0.0)
}

/// Limits the whale's height to the range from the seabed to [`carried_m`], which does not apply to a kinetic whale with weight
/// in air. A kinetic whale loses its velocity into the limit.
fn keep_in_water(model: &Model, spec: &Whale, whale: &mut WhaleState, bones: &mut Vec<DAffine3>) {
    let depth_m = depth_in_seabed(model, spec, whale, bones);
    let weighs = spec.kinetic.as_ref().is_some_and(|kinetic| kinetic.hull.volume_m3 > 0.0);
    let ceiling = if weighs { f64::INFINITY } else { carried_m(spec.length_m, whale) };
    let held =
        if depth_m > 0.0 { whale.position.z + depth_m } else { whale.position.z.min(ceiling) };
    let [port, back] = whale.exertion.slip_m_s;
    if (whale.orientation * DVec3::new(0.0, port, back)).z * (whale.position.z - held) > 0.0 {
        whale.exertion.slip_m_s = [0.0; 2];
    }
    whale.position.z = held;
}

/// How far the whale must be lifted so that no vertex of its skin is below the seabed; 0 if none is [m].
fn depth_in_seabed(
    model: &Model,
    spec: &Whale,
    whale: &WhaleState,
    bones: &mut Vec<DAffine3>,
) -> f64 {
    let (Some(seabed), Some(tree)) = (&model.spec.seabed, &model.skin_tree) else { return 0.0 };
    let seabed_m = -seabed.depth_m * seabed.normal.z;
    if seabed.normal.dot(whale.position) - tree.reach_m > seabed_m {
        return 0.0;
    }
    pose(&spec.skin, whale.position, whale.orientation, &whale.posture, bones);
    (seabed_m - tree.lowest_m(bones, seabed.normal, seabed_m)) / seabed.normal.z
}

/// The pose of the bones at one end of a step, with the place and posture that it belongs to.
#[derive(Clone, Debug, Default)]
pub(crate) struct EndPose {
    of: Option<(DVec3, DQuat, Posture)>,
    /// Bones, whale's axes at rest to world.
    pub bones: Vec<DAffine3>,
}

impl EndPose {
    /// Poses of a whale at the start and at the end of a step; a pose that is known already is not computed again.
    pub fn take_step(poses: &mut [Self; 2], model: &Model, [from, to]: [&WhaleState; 2]) {
        let [start, end] = poses;
        if end.is_of(from) {
            std::mem::swap(start, end);
        }
        start.take(model, from);
        end.take(model, to);
    }

    fn is_of(&self, whale: &WhaleState) -> bool {
        self.of == Some((whale.position, whale.orientation, whale.posture))
    }

    fn take(&mut self, model: &Model, whale: &WhaleState) {
        let Some(spec) = model.spec.whale.as_ref().filter(|_| !self.is_of(whale)) else { return };
        pose(&spec.skin, whale.position, whale.orientation, &whale.posture, &mut self.bones);
        self.of = Some((whale.position, whale.orientation, whale.posture));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(speed_m_s: f64, climb: f64) -> WhaleState {
        let orientation = DQuat::from_rotation_y(-climb);
        WhaleState {
            position: DVec3::ZERO,
            orientation,
            speed_m_s,
            turn_rate: DVec3::ZERO,
            posture: Posture::default(),
            motion: Vec::new(),
            contact_force_n: Default::default(),
            contact_port_m: Default::default(),
            mouth_moment_n_m: [0.0; 3],
            exertion: Default::default(),
        }
    }

    /// Compared with a numerical integration in small steps of motion along its axis against the weight of the part above the
    /// surface.
    #[test]
    fn a_whale_leaves_the_water_as_far_as_its_speed_permits() {
        for (length_m, speed_m_s, climb) in
            [(13.7, 8.0, 1.2), (10.0, 9.9, 1.5), (4.2, 6.0, 0.7), (13.7, 3.0, 0.02)]
        {
            let (sin, dt) = (libm::sin(climb), 1e-5);
            let (mut out, mut speed) = (0.0, speed_m_s);
            while speed > 0.0 {
                speed -= 9.81 * sin * f64::min(out / length_m, 1.0) * dt;
                out += speed * dt;
            }
            let (found, expected) =
                (carried_m(length_m, &state(speed_m_s, climb)), (out - 0.5 * length_m) * sin);
            assert!(
                (found - expected).abs() < 1e-3,
                "{length_m} m at {speed_m_s} m/s: {found} against {expected} m"
            );
        }
        assert_eq!(
            carried_m(13.7, &state(4.5, 0.9)).to_bits(),
            0.0_f64.to_bits(),
            "at a right whale's burst speed mid-body stays under water"
        );
        assert_eq!(carried_m(13.7, &state(8.0, -0.9)).to_bits(), 0.0_f64.to_bits());
    }
}
