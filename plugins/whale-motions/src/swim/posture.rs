//! From beat and smoothed controls to joint angles.

use endline_sdk::{Posture, SPINE_JOINTS};

use super::floats::Floats;
use super::settings::Settings;
use super::wave::Beat;

/// Side bend of the whole spine in a full yaw turn, head and tail towards its inside [rad]; an estimate.
const YAW_BEND_RAD: f64 = 0.5;

/// Bend of the whole spine in a full pitch turn, head and tail towards its inside [rad]; an estimate.
const PITCH_BEND_RAD: f64 = 0.25;

/// How far the inner and the outer flipper swing forward in a full yaw turn [rad]; estimates.
const TURN_SWEEP_RAD: [f64; 2] = [0.5, 0.15];

/// Flipper twist in a full roll or pitch turn [rad]; an estimate.
const STEER_TWIST_RAD: f64 = 0.3;

/// How far the flippers are swept forward and aft of where they are in swimming [rad]: of a working range of 10 degrees
/// forward to 80 aft of the perpendicular, an estimate; rest is 30 aft of it.
const SWEEP_RAD: [f64; 2] = [0.70, 0.60];

/// Range of a flipper up and down [rad]: 25 and 60 degrees, as far as a right whale's joint turns; an estimate.
const RAISE_RAD: [f64; 2] = [0.436, 1.047];

/// Range of a flipper's twist either way [rad]; an estimate.
const TWIST_RAD: f64 = 0.52;

/// The posture at the end of the step.
pub(super) fn of(settings: &Settings, floats: &Floats, beat: &Beat) -> Posture {
    let (wave, peduncle) = beat.spine_pitch(floats.phase);
    let arch = -PITCH_BEND_RAD * floats.pitch / SPINE_JOINTS as f64;
    let bend = -YAW_BEND_RAD * floats.yaw / SPINE_JOINTS as f64;
    Posture {
        spine_pitch: wave.map(|angle| angle + arch),
        spine_yaw: [bend; SPINE_JOINTS],
        fluke_pitch: beat.fluke_pitch(floats.phase, peduncle),
        fluke_flex: [beat.fluke_flex(floats.phase); 2],
        flipper_sweep: flipper_sweep(settings, floats),
        flipper_raise: [flipper_raise(floats.flipper_raise); 2],
        flipper_twist: flipper_twist(floats),
        jaw: settings.jaw_open_rad * floats.mouth,
        ..Posture::default()
    }
}

/// Aft while swimming; forward in a turn, the inner flipper further; forward or aft as the pilot asks.
fn flipper_sweep(settings: &Settings, floats: &Floats) -> [f64; 2] {
    let aft = settings.flipper_sweep_rad * floats.effort;
    let [inner, outer] = TURN_SWEEP_RAD;
    let (to_port, to_starboard) = (floats.yaw.max(0.0), (-floats.yaw).max(0.0));
    let [forward, back] = SWEEP_RAD;
    let asked = aft
        - if floats.flipper_sweep > 0.0 {
            forward * floats.flipper_sweep
        } else {
            back * floats.flipper_sweep
        };
    [asked - inner * to_port - outer * to_starboard, asked - inner * to_starboard - outer * to_port]
        .map(|angle| angle.max(-forward))
}

fn flipper_raise(control: f64) -> f64 {
    let [up, down] = RAISE_RAD;
    if control > 0.0 { up * control } else { down * control }
}

/// Leading edges up to lift the nose; to roll to starboard, the left up and the right down.
fn flipper_twist(floats: &Floats) -> [f64; 2] {
    let asked = TWIST_RAD * floats.flipper_twist;
    let (nose_up, roll) = (STEER_TWIST_RAD * floats.pitch, STEER_TWIST_RAD * floats.roll);
    [asked - nose_up - roll, asked - nose_up + roll].map(|angle| angle.clamp(-0.8, 0.8))
}
