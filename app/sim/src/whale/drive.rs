//! The whale's own motion over one step: its plugin decides, the water carries.
//!
//! Kinematic: `dx/dt = R x̂ u + U(x)`, `R` turned by the plugin's rates about the whale's own axes, with the
//! speed through the water `u` taken as the mean over the step. Kinetic: the plugin asks, mass, drag and strength
//! decide (`kinetic/mod.rs`). Neither leaves the water nor enters the seabed: the height of its
//! origin is held between them. Joints turn no further than their ranges (`joints.rs`). A dead whale floats (`kinetic/dead.rs`).

use glam::{DQuat, DVec3};

use super::Whale;
use super::kinetic::dead::drift;
use super::kinetic::swim::{self, Wish, swim};
use super::pose::pose;
use crate::model::Model;
use crate::state::WhaleState;
use crate::step::{Input, Stop};
use endline_sdk::{MotionInput, MotionOutput, Posture};
use glam::DAffine3;

/// Half height of a right whale as a share of its length, kept above the seabed.
const CLEARANCE: f64 = 0.11;

/// The whale at the end of a step that begins with `whale`, written over `next`; whether its motion asked for a posture
/// beyond the joints' ranges.
///
/// # Errors
/// With the motion plugin's id, where it fails or gives a number that is not finite.
pub(crate) fn drive(model: &Model, input: &Input, whale: &WhaleState, time_s: f64, next: &mut WhaleState) -> Result<bool, Stop> {
    next.clone_from(whale);
    let Some(spec) = &model.spec.whale else { return Ok(false) };
    if let Some((kinetic, dead)) = spec.kinetic.as_ref().and_then(|kinetic| Some((kinetic, kinetic.dead.as_ref()?))) {
        drift(model, kinetic, dead, (whale, time_s), next);
        keep_in_water(model, spec, next);
        return Ok(false);
    }
    let (asked, told_m_s) = ask(model, spec, input, whale, (time_s, next))?;
    next.posture = asked.posture;
    let held = spec.joints.hold(&mut next.posture);
    let turn_rate = DVec3::from_array(asked.turn_rate_rad_s);
    match &spec.kinetic {
        Some(kinetic) => {
            let wish = Wish { from_m_s: told_m_s, speed_m_s: asked.speed_m_s, turn_rate, burst: input.controls.burst };
            swim(model, kinetic, &wish, (whale, time_s), next);
        }
        None => go(model, (asked.speed_m_s, turn_rate), (whale, time_s), next),
    }
    keep_in_water(model, spec, next);
    Ok(held)
}

/// What the motion plugin asks for, and the speed it was told.
fn ask(
    model: &Model,
    spec: &Whale,
    input: &Input,
    whale: &WhaleState,
    (time_s, next): (f64, &mut WhaleState),
) -> Result<(MotionOutput, f64), Stop> {
    let stop = |reason: String| Stop { time_s, part: spec.motion.descriptor().id.to_string(), reason };
    let told_m_s = if spec.kinetic.is_some() { swim::told_speed(whale) } else { whale.speed_m_s };
    let seen = MotionInput {
        time_s,
        dt_s: model.spec.settings.step_s,
        length_m: spec.length_m,
        speed_m_s: told_m_s,
        position_m: whale.position.to_array(),
        orientation: whale.orientation.to_array(),
        controls: input.controls,
        contact_force_n: &whale.contact_force_n,
    };
    let asked = spec.motion.step(&spec.motion_attributes, &seen, &mut next.motion).map_err(|error| stop(error.message))?;
    if !(asked.speed_m_s.is_finite() && DVec3::from_array(asked.turn_rate_rad_s).is_finite() && is_finite(&asked.posture)) {
        return Err(stop("gave a speed, turn rate or joint angle that is not a finite number".into()));
    }
    Ok((asked, told_m_s))
}

/// Kinematic: the whale goes as it is asked to.
fn go(model: &Model, (speed_m_s, turn_rate): (f64, DVec3), (whale, time_s): (&WhaleState, f64), next: &mut WhaleState) {
    let dt_s = model.spec.settings.step_s;
    next.speed_m_s = speed_m_s;
    next.turn_rate = turn_rate;
    next.orientation = (whale.orientation * DQuat::from_scaled_axis(turn_rate * dt_s)).normalize();
    let ahead = whale.orientation.slerp(next.orientation, 0.5) * DVec3::X;
    next.position += (ahead * (0.5 * (whale.speed_m_s + next.speed_m_s)) + model.sea.current(whale.position, time_s)) * dt_s;
}

/// Holds the whale between seabed and surface; a kinetic one stops drifting out.
fn keep_in_water(model: &Model, spec: &Whale, whale: &mut WhaleState) {
    let seabed = model.spec.seabed.as_ref();
    let floor = seabed.map_or(f64::NEG_INFINITY, |seabed| seabed.height_at(whale.position) + CLEARANCE * spec.length_m);
    let afloat = spec.kinetic.as_ref().is_some_and(|kinetic| kinetic.dead.is_some());
    let held = whale.position.z.max(floor).min(if afloat { f64::INFINITY } else { 0.0 });
    let [port, back] = whale.exertion.slip_m_s;
    if (whale.orientation * DVec3::new(0.0, port, back)).z * (whale.position.z - held) > 0.0 {
        whale.exertion.slip_m_s = [0.0; 2];
    }
    whale.position.z = held;
}

/// Bone transforms at a share of the way between two states of the whale.
pub(crate) fn pose_between(model: &Model, from: &WhaleState, to: &WhaleState, share: f64, out: &mut Vec<DAffine3>) {
    let Some(spec) = &model.spec.whale else { return };
    let posture = mix(&from.posture, &to.posture, share);
    let orientation = from.orientation.slerp(to.orientation, share);
    pose(&spec.skin, from.position.lerp(to.position, share), orientation, &posture, out);
}

/// A posture part of the way between two.
fn mix(from: &Posture, to: &Posture, share: f64) -> Posture {
    let blend = |one: f64, other: f64| one + (other - one) * share;
    fn pairs<const N: usize>(one: [f64; N], other: [f64; N], blend: impl Fn(f64, f64) -> f64) -> [f64; N] {
        std::array::from_fn(|index| blend(one[index], other[index]))
    }
    Posture {
        spine_pitch: pairs(from.spine_pitch, to.spine_pitch, blend),
        spine_yaw: pairs(from.spine_yaw, to.spine_yaw, blend),
        spine_roll: pairs(from.spine_roll, to.spine_roll, blend),
        fluke_pitch: blend(from.fluke_pitch, to.fluke_pitch),
        fluke_flex: pairs(from.fluke_flex, to.fluke_flex, blend),
        flipper_sweep: pairs(from.flipper_sweep, to.flipper_sweep, blend),
        flipper_raise: pairs(from.flipper_raise, to.flipper_raise, blend),
        flipper_twist: pairs(from.flipper_twist, to.flipper_twist, blend),
        flipper_flex: pairs(from.flipper_flex, to.flipper_flex, blend),
        jaw: blend(from.jaw, to.jaw),
        lips: pairs(from.lips, to.lips, blend),
    }
}

/// Whether all angles of a posture are finite numbers.
fn is_finite(posture: &Posture) -> bool {
    let Posture {
        spine_pitch,
        spine_yaw,
        spine_roll,
        fluke_pitch,
        fluke_flex,
        flipper_sweep,
        flipper_raise,
        flipper_twist,
        flipper_flex,
        jaw,
        lips,
    } = posture;
    let groups: [&[f64]; 11] = [
        spine_pitch,
        spine_yaw,
        spine_roll,
        std::slice::from_ref(fluke_pitch),
        fluke_flex,
        flipper_sweep,
        flipper_raise,
        flipper_twist,
        flipper_flex,
        std::slice::from_ref(jaw),
        lips,
    ];
    groups.iter().copied().flatten().all(|angle| angle.is_finite())
}
