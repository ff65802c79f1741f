//! Waves as a scenario has them, as sums of linear components, and their dispersion.
//!
//! Dispersion: `ω² = g k tanh(k d)`, `ω` the frequency, `k` the wave number, `d` the depth; solved for `k` by Newton from
//! Guo's explicit guess. Waves are long-crested: all components run one way. Frequencies are those in water at rest; a
//! current does not shift them.
//! Reference: Airy 1845, Tides and waves; Guo 2002 (doi:10.1016/S0378-3839(02)00039-X).

use core::f64::consts::TAU;

use glam::DVec3;

use super::component::Component;
use super::jonswap::{self, Spectrum};

/// Passes of Newton; five give all digits from Guo's guess.
const PASSES: usize = 8;
/// Steepness beyond which a wave breaks: `H k = 0.89 tanh(k d)` (Miche 1944).
const STEEPEST: f64 = 0.89;

/// Waves that run one way, regular or irregular.
#[derive(Clone, Debug, PartialEq)]
pub struct Waves {
    /// Which way they run, a level unit vector.
    pub toward: DVec3,
    /// Time over which they grow from nothing, beginning at time zero [s].
    pub ramp_s: f64,
    /// What they are made of.
    pub kind: WaveKind,
}

/// Regular or irregular.
#[derive(Clone, Debug, PartialEq)]
pub enum WaveKind {
    /// One component.
    Regular {
        /// Trough to crest [m].
        height_m: f64,
        /// Period [s].
        period_s: f64,
        /// Phase at the origin at time zero; a crest where it is zero [rad].
        phase_rad: f64,
    },
    /// A JONSWAP spectrum as components of equal energy with phases drawn from the run's seed.
    Jonswap {
        /// The spectrum.
        spectrum: Spectrum,
        /// How many components.
        components: usize,
    },
}

impl Waves {
    /// The linear waves they are made of; phases of irregular waves follow from the seed.
    #[must_use]
    pub fn components(&self, seed: u64) -> Vec<Component> {
        match self.kind {
            WaveKind::Regular { height_m, period_s, phase_rad } => {
                vec![Component {
                    amplitude_m: 0.5 * height_m,
                    frequency_rad_s: TAU / period_s,
                    phase_rad,
                }]
            }
            WaveKind::Jonswap { spectrum, components } => {
                jonswap::components(&spectrum, components, seed)
            }
        }
    }

    /// Height and period that speak for them: those of the regular wave, or significant height and peak period [m, s].
    #[must_use]
    pub fn height_and_period(&self) -> (f64, f64) {
        match self.kind {
            WaveKind::Regular { height_m, period_s, .. } => (height_m, period_s),
            WaveKind::Jonswap { spectrum, .. } => {
                (spectrum.significant_height_m, spectrum.peak_period_s)
            }
        }
    }
}

/// Wave number of a frequency in water of a depth [rad/m].
#[must_use]
pub fn wave_number(frequency_rad_s: f64, depth_m: f64, gravity_m_s2: f64) -> f64 {
    let deep = frequency_rad_s * frequency_rad_s * depth_m / gravity_m_s2;
    let mut kd = deep * libm::pow(-libm::expm1(-libm::pow(deep, 1.2454)), -0.4015);
    for _ in 0..PASSES {
        let tanh = libm::tanh(kd);
        kd -= (kd * tanh - deep) / (tanh + kd * (1.0 - tanh * tanh));
    }
    kd / depth_m
}

/// Greatest height of a regular wave of a period before it breaks, by Miche [m].
#[must_use]
pub fn breaking_height(period_s: f64, depth_m: f64, gravity_m_s2: f64) -> f64 {
    let number = wave_number(TAU / period_s, depth_m, gravity_m_s2);
    STEEPEST * libm::tanh(number * depth_m) / number
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The relation itself, from hair-thin to deep water, and both limits in closed form.
    #[test]
    fn wave_numbers_satisfy_the_dispersion_relation() {
        for depth in [0.5, 5.0, 25.0, 200.0, 6000.0] {
            for period in [0.5, 1.0, 4.0, 8.0, 16.0, 60.0, 3600.0] {
                let frequency = TAU / period;
                let number = wave_number(frequency, depth, 9.81);
                let error =
                    9.81 * number * libm::tanh(number * depth) / (frequency * frequency) - 1.0;
                assert!(error.abs() < 1e-13, "{depth} m, {period} s: {error:e}");
            }
        }
        assert!((wave_number(TAU, 1000.0, 9.81) * 9.81 / (TAU * TAU) - 1.0).abs() < 1e-15);
        let long = TAU / 3600.0;
        assert!(
            (wave_number(long, 10.0, 9.81) * libm::sqrt(9.81 * 10.0) / long - 1.0).abs() < 1e-5
        );
    }

    /// Miche: 0.142 of the length in deep water.
    #[test]
    fn waves_break_at_a_seventh_of_their_length_in_deep_water() {
        let length = TAU / wave_number(TAU / 6.0, 500.0, 9.81);
        assert!((breaking_height(6.0, 500.0, 9.81) / length - 0.1416).abs() < 1e-3);
    }
}
