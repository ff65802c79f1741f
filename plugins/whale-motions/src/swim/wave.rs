//! The travelling wave of the body and the pitch of the flukes.
//!
//! ```text
//! heave    y(x) = A/2 e(x) sin(phi - k x),   e(x) = ((x - x0)/(x1 - x0))²  from the skull's joint x0 to the flukes' hinge x1
//! joint    angle = atan(slope ahead) - atan(slope aft)     of the chords between joints; positive bends down
//! flukes   against the water: theta cos(phi - k x1),  theta = max(atan(pi St) - attack, 0)
//! ```
//!
//! `e` is 0 at the stiff head and 1 at the hinge, within a few hundredths of published envelopes
//! (about 0.05 at x = 0.35). Wavelength 1.25 L is an estimate. The hinge rises where
//! `cos(phi - k x1) > 0`, and there the trailing edge turns down: the flukes push water back both ways.

use std::f64::consts::{PI, TAU};

use endline_sdk::{FLUKE_STATION, SPINE_JOINTS, SPINE_STATIONS};

use super::floats::Floats;
use super::settings::Settings;

/// Wave number over body length: 2 pi over a wavelength of 1.25 body lengths.
const WAVE_NUMBER: f64 = TAU / 1.25;

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
    /// How much the whale beats, 0 to 1.
    effort: f64,
}

impl Beat {
    /// The beat at a speed [m/s] of a whale of a length [m].
    pub(super) fn of(settings: &Settings, floats: &Floats, speed_m_s: f64, length_m: f64) -> Self {
        let widest_m = settings.beat_amplitude * length_m;
        let greatest = settings.greatest_beat_hz.max(settings.least_beat_hz);
        let frequency_hz = (settings.strouhal * speed_m_s / widest_m).clamp(settings.least_beat_hz, greatest);
        let excursion_m = widest_m.min(settings.strouhal * speed_m_s / frequency_hz).max(0.0);
        let strouhal = if speed_m_s > 0.0 { frequency_hz * excursion_m / speed_m_s } else { 0.0 };
        Self {
            frequency_hz,
            excursion: floats.effort * excursion_m / length_m,
            fluke_pitch_rad: floats.effort * (libm::atan(PI * strouhal) - settings.fluke_attack_rad).max(0.0),
            effort: floats.effort,
        }
    }

    /// Spine pitch at each joint [rad].
    pub(super) fn spine_pitch(&self, phase: f64) -> [f64; SPINE_JOINTS] {
        let mut angles = [0.0; SPINE_JOINTS];
        let mut slope_ahead = 0.0;
        for (joint, angle) in angles.iter_mut().enumerate() {
            let here = SPINE_STATIONS[joint];
            let next = SPINE_STATIONS.get(joint + 1).copied().unwrap_or(FLUKE_STATION);
            let slope = libm::atan((self.heave(phase, next) - self.heave(phase, here)) / (next - here));
            *angle = slope_ahead - slope;
            slope_ahead = slope;
        }
        angles
    }

    /// Pitch of the flukes against a peduncle whose own pitch, trailing end down, is given [rad].
    pub(super) fn fluke_pitch(&self, phase: f64, peduncle_rad: f64) -> f64 {
        self.fluke_pitch_rad * libm::cos(phase - WAVE_NUMBER * FLUKE_STATION) - peduncle_rad
    }

    /// Bend of the blades [rad]: tips lag behind the heave.
    pub(super) fn fluke_flex(&self, phase: f64) -> f64 {
        -BLADE_FLEX_RAD * self.effort * libm::cos(phase - WAVE_NUMBER * FLUKE_STATION)
    }

    /// Heave of the body's line at a station, dorsal, over body length [1].
    fn heave(&self, phase: f64, station: f64) -> f64 {
        0.5 * self.excursion * envelope(station) * libm::sin(phase - WAVE_NUMBER * station)
    }
}

fn envelope(station: f64) -> f64 {
    let rise = ((station - SPINE_STATIONS[0]) / (FLUKE_STATION - SPINE_STATIONS[0])).max(0.0);
    rise * rise
}
