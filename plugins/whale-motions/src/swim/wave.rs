//! The travelling wave of the body, the pitch of the flukes relative to mid-body, and the posture that results.
//!
//! ```text
//! heave    y(x) = A/2 e(x) sin(phi - k x)
//!          e(x) = ((x - xm)/(xf - xm))^1.5   from the joint xm behind mid-body to the flukes' hinge xf
//!                 0.2 ((xn - x)/xn)²         from the snout to the joint xn ahead of mid-body; 0 between
//! joint    angle = slope ahead - slope aft   slopes of the chords between joints; positive bends down
//! flukes   against the water: theta cos(phi - k xf),  theta = max(atan(pi St) - attack, 0)
//! ```
//!
//! The envelope `e` follows published ones (0.2 at the head, minimum before mid-body, 1 at the flukes), except that the minimum
//! is 0 at mid-body, because the whale's frame moves straight. The wavelength 1.25 L is an estimate. While the hinge rises,
//! `cos(phi - k xf) > 0`, the trailing edge turns down: the flukes push water back on both strokes.

use std::f64::consts::{PI, TAU};

use endline_sdk::{FLUKE_STATION, Posture, SPINE_JOINTS, SPINE_STATIONS};

use super::Floats;
use super::settings::Settings;

/// Wave number over body length: 2 pi over a wavelength of 1.25 body lengths.
const WAVE_NUMBER: f64 = TAU / 1.25;

/// The section at mid-body that is fixed to the whale's frame, between two joints.
const STILL: [f64; 2] = [SPINE_STATIONS[2], SPINE_STATIONS[3]];

/// Heave of the snout over that of the flukes [1].
const HEAD_HEAVE: f64 = 0.2;

/// Length of a whale with the attribute's fastest beat [m], and the exponent of length: f ~ L^-0.53 (Gough et al. 2019,
/// rorquals).
const GROWN_M: f64 = 13.7;
const QUICKER: f64 = -0.53;

/// Greatest bend of a fluke blade under its load [rad]; an estimate.
const BLADE_FLEX_RAD: f64 = 0.15;

/// The fluke beat at one moment.
pub(super) struct Beat {
    /// Frequency [Hz].
    pub frequency_hz: f64,
    /// Peak-to-peak excursion of the flukes, over body length [1].
    excursion: f64,
    /// Amplitude of the flukes' pitch against the water [rad].
    fluke_pitch_rad: f64,
    /// Intensity of the beat, 0 to 1.
    effort: f64,
}

impl Beat {
    /// The beat at a speed of the beat [m/s] of a whale of a length [m].
    pub(super) fn of(settings: &Settings, floats: &Floats, speed_m_s: f64, length_m: f64) -> Self {
        let widest_m = settings.beat_amplitude * length_m;
        let quicker = libm::pow(length_m / GROWN_M, QUICKER);
        let greatest = (settings.greatest_beat_hz * quicker).max(settings.least_beat_hz);
        let frequency_hz =
            (settings.strouhal * speed_m_s / widest_m).clamp(settings.least_beat_hz, greatest);
        let excursion_m = widest_m.min(settings.strouhal * speed_m_s / frequency_hz).max(0.0);
        let strouhal = if speed_m_s > 0.0 { frequency_hz * excursion_m / speed_m_s } else { 0.0 };
        Self {
            frequency_hz,
            excursion: floats.effort * excursion_m / length_m,
            fluke_pitch_rad: floats.effort
                * (libm::atan(PI * strouhal) - settings.fluke_attack_rad).max(0.0),
            effort: floats.effort,
        }
    }

    /// Spine pitch at each joint, and pitch of the peduncle's end, trailing end down [rad].
    pub(super) fn spine_pitch(&self, phase: f64) -> ([f64; SPINE_JOINTS], f64) {
        let mut angles = [0.0; SPINE_JOINTS];
        let mut ahead = self.slope(phase, 0.0, SPINE_STATIONS[0]);
        for (joint, angle) in angles.iter_mut().enumerate() {
            let next = SPINE_STATIONS.get(joint + 1).copied().unwrap_or(FLUKE_STATION);
            let aft = self.slope(phase, SPINE_STATIONS[joint], next);
            *angle = ahead - aft;
            ahead = aft;
        }
        (angles, -ahead)
    }

    /// Pitch of the flukes relative to a peduncle with a pitch, trailing end down [rad].
    pub(super) fn fluke_pitch(&self, phase: f64, peduncle_rad: f64) -> f64 {
        self.fluke_pitch_rad * libm::cos(phase - WAVE_NUMBER * FLUKE_STATION) - peduncle_rad
    }

    /// Bend of the blades [rad]: tips lag behind the heave.
    pub(super) fn fluke_flex(&self, phase: f64) -> f64 {
        -BLADE_FLEX_RAD * self.effort * libm::cos(phase - WAVE_NUMBER * FLUKE_STATION)
    }

    /// Slope of the chord between two stations, rising aft [rad].
    fn slope(&self, phase: f64, from: f64, to: f64) -> f64 {
        libm::atan((self.heave(phase, to) - self.heave(phase, from)) / (to - from))
    }

    /// Heave of the body's line at a station, dorsal, over body length [1].
    fn heave(&self, phase: f64, station: f64) -> f64 {
        0.5 * self.excursion * envelope(station) * libm::sin(phase - WAVE_NUMBER * station)
    }
}

fn envelope(station: f64) -> f64 {
    let [ahead, aft] = STILL;
    if station < ahead {
        let rise = (ahead - station) / ahead;
        HEAD_HEAVE * rise * rise
    } else {
        let rise = ((station - aft) / (FLUKE_STATION - aft)).max(0.0);
        rise * rise.sqrt()
    }
}

/// Side bend of the whole spine in a full yaw turn, head and tail towards the inside [rad]; an estimate.
const YAW_BEND_RAD: f64 = 0.5;

/// Bend of the whole spine in a full pitch turn, head and tail towards the inside [rad]; an estimate.
const PITCH_BEND_RAD: f64 = 0.25;

/// Forward sweep of the inner and the outer flipper in a full yaw turn [rad]; estimates.
const TURN_SWEEP_RAD: [f64; 2] = [0.5, 0.15];

/// Flipper twist in a full roll or pitch turn [rad]; an estimate.
const STEER_TWIST_RAD: f64 = 0.3;

/// Sweep of the flippers forward and aft of their place in swimming [rad], within a working range of 10 degrees forward to 80
/// aft of the perpendicular (an estimate); rest is 30 aft of it.
const SWEEP_RAD: [f64; 2] = [0.70, 0.60];

/// Range of a flipper up and down [rad]: 25 and 60 degrees, the range of a right whale's joint; an estimate.
const RAISE_RAD: [f64; 2] = [0.436, 1.047];

/// Range of a flipper's twist either way [rad]; an estimate.
const TWIST_RAD: f64 = 0.52;

/// The posture at the end of the step.
pub(super) fn posture(settings: &Settings, floats: &Floats, beat: &Beat) -> Posture {
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

/// Sweep of the flippers: aft while swimming, forward in a turn, more at the inner flipper; plus the control.
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

/// Twist of the flippers: leading edges up for nose up; left up and right down for a roll to starboard.
fn flipper_twist(floats: &Floats) -> [f64; 2] {
    let asked = TWIST_RAD * floats.flipper_twist;
    let (nose_up, roll) = (STEER_TWIST_RAD * floats.pitch, STEER_TWIST_RAD * floats.roll);
    [asked - nose_up - roll, asked - nose_up + roll].map(|angle| angle.clamp(-0.8, 0.8))
}
