//! The whale's own motion over one step: its plugin decides, the water carries.
//!
//! Kinematic: `dx/dt = R x̂ u + U(x)`, `R` turned by the plugin's rates about the whale's own axes, with the
//! speed through the water `u` taken as the mean over the step. It neither leaves the water nor enters the seabed:
//! the height of its origin is held between them. Its joints turn no further than their ranges (`joints.rs`).

use glam::{DQuat, DVec3};

use super::pose::pose;
use crate::model::Model;
use crate::state::WhaleState;
use crate::step::{Input, Stop};
use endline_sdk::{MotionInput, Posture};
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
    let dt_s = model.spec.settings.step_s;
    let stop = |reason: String| Stop { time_s, part: spec.motion.descriptor().id.to_string(), reason };
    let seen = MotionInput {
        time_s,
        dt_s,
        length_m: spec.length_m,
        speed_m_s: whale.speed_m_s,
        position_m: whale.position.to_array(),
        orientation: whale.orientation.to_array(),
        controls: input.controls,
        contact_force_n: &whale.contact_force_n,
    };
    let moved = spec.motion.step(&spec.motion_attributes, &seen, &mut next.motion).map_err(|error| stop(error.message))?;
    let turn_rate = DVec3::from_array(moved.turn_rate_rad_s);
    if !(moved.speed_m_s.is_finite() && turn_rate.is_finite() && is_finite(&moved.posture)) {
        return Err(stop("gave a speed, turn rate or joint angle that is not a finite number".into()));
    }
    next.speed_m_s = moved.speed_m_s;
    next.turn_rate = turn_rate;
    next.posture = moved.posture;
    let held = spec.joints.hold(&mut next.posture);
    next.orientation = (whale.orientation * DQuat::from_scaled_axis(turn_rate * dt_s)).normalize();
    let ahead = whale.orientation.slerp(next.orientation, 0.5) * DVec3::X;
    next.position += (ahead * (0.5 * (whale.speed_m_s + next.speed_m_s)) + model.sea.current(whale.position, time_s)) * dt_s;
    let floor = model.spec.seabed.as_ref().map_or(f64::NEG_INFINITY, |seabed| seabed.height_at(next.position) + CLEARANCE * spec.length_m);
    next.position.z = next.position.z.max(floor).min(0.0);
    Ok(held)
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
