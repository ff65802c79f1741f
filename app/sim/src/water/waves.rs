//! Waves as sums of linear components, their dispersion, and the JONSWAP spectrum.
//!
//! Dispersion: `ω² = g k tanh(k d)`, with `ω` the angular frequency [rad/s], `k` the wave number [rad/m], `d` the depth [m] and
//! `g` gravity [m/s²]. It is solved for `k` by Newton's method from Guo's explicit approximation. Waves are long-crested: all
//! components have one direction. Frequencies are those in still water; the current does not shift them.
//! References: Airy 1845, Tides and waves; Guo 2002 (doi:10.1016/S0378-3839(02)00039-X).
//!
//! Irregular waves: `S(ω) = C ω⁻⁵ exp(-5/4 (ω_p/ω)⁴) γ^b`, `b = exp(-(ω - ω_p)²/(2 σ² ω_p²))` [m² s/rad], with `σ` = 0.07 below
//! the peak frequency `ω_p` and 0.09 above it. The range is 0.5 to 10 `ω_p`, and `C` satisfies `m₀ = ∫ S dω = H_s²/16` over it.
//! Each component has an equal share of `m₀` and the root mean square frequency of its share. With `m₂ = ∫ ω² S dω`, the
//! significant height `H_s` and the mean zero-crossing period `2π (m₀/m₂)^½` are therefore exact for any number of components.
//! Because no two frequency intervals are equal, the record does not repeat. Phases are uniform random numbers from the seed.
//! Reference: Hasselmann et al. 1973, Measurements of wind-wave growth and swell decay during JONSWAP; DNV-RP-C205,
//! section 3.5.5.

use core::f64::consts::TAU;

use glam::DVec3;

use crate::bits::unit;

/// Newton iterations; five from Guo's approximation give full precision.
const PASSES: usize = 8;

/// Factor of the breaking limit `H k = 0.89 tanh(k d)` (Miche 1944).
const STEEPEST: f64 = 0.89;

/// Unidirectional waves, regular or irregular.
#[derive(Clone, Debug, PartialEq)]
pub struct Waves {
    /// Direction of propagation, a horizontal unit vector.
    pub toward: DVec3,
    /// Time over which they grow from zero, starting at time zero [s].
    pub ramp_s: f64,
    /// Regular or irregular.
    pub kind: WaveKind,
}

/// Kind of waves.
#[derive(Clone, Debug, PartialEq)]
pub enum WaveKind {
    /// One component.
    Regular {
        /// Height from trough to crest [m].
        height_m: f64,
        /// Period [s].
        period_s: f64,
        /// Phase at the origin at time zero; a crest where it is zero [rad].
        phase_rad: f64,
    },
    /// A JONSWAP spectrum as components of equal energy with random phases.
    Jonswap {
        /// The spectrum.
        spectrum: Spectrum,
        /// Number of components.
        components: usize,
    },
}

impl Waves {
    /// Linear components; the seed determines the phases of irregular waves.
    pub fn components(&self, seed: u64) -> Vec<Component> {
        match self.kind {
            WaveKind::Regular { height_m, period_s, phase_rad } => {
                vec![Component {
                    amplitude_m: 0.5 * height_m,
                    frequency_rad_s: TAU / period_s,
                    phase_rad,
                }]
            }
            WaveKind::Jonswap { spectrum, components: count } => components(&spectrum, count, seed),
        }
    }

    /// Height and period of regular waves, or significant height and peak period [m, s].
    pub fn height_and_period(&self) -> (f64, f64) {
        match self.kind {
            WaveKind::Regular { height_m, period_s, .. } => (height_m, period_s),
            WaveKind::Jonswap { spectrum, .. } => {
                (spectrum.significant_height_m, spectrum.peak_period_s)
            }
        }
    }
}

/// Wave number of an angular frequency at a depth [rad/m].
pub fn wave_number(frequency_rad_s: f64, depth_m: f64, gravity_m_s2: f64) -> f64 {
    let deep = frequency_rad_s * frequency_rad_s * depth_m / gravity_m_s2;
    let mut kd = deep * libm::pow(-libm::expm1(-libm::pow(deep, 1.2454)), -0.4015);
    for _ in 0..PASSES {
        let tanh = libm::tanh(kd);
        kd -= (kd * tanh - deep) / (tanh + kd * (1.0 - tanh * tanh));
    }
    kd / depth_m
}

/// Height at which a regular wave of a period breaks, by Miche [m].
pub fn breaking_height(period_s: f64, depth_m: f64, gravity_m_s2: f64) -> f64 {
    let number = wave_number(TAU / period_s, depth_m, gravity_m_s2);
    STEEPEST * libm::tanh(number * depth_m) / number
}

/// One linear wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// Amplitude, half of the height [m].
    pub amplitude_m: f64,
    /// Angular frequency [rad/s].
    pub frequency_rad_s: f64,
    /// Phase at the origin at time zero [rad].
    pub phase_rad: f64,
}

/// Range of frequencies as multiples of the peak frequency.
const RANGE: (f64, f64) = (0.5, 10.0);

/// Intervals of the numerical integration.
const STRIPS: u32 = 8192;

/// A JONSWAP spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum {
    /// Significant height `H_s = 4 √m₀` [m].
    pub significant_height_m: f64,
    /// Period of the peak [s].
    pub peak_period_s: f64,
    /// Peak enhancement γ: 1 for a fully developed sea, 3.3 for the JONSWAP mean.
    pub gamma: f64,
}

/// Spectral density without the factor `C`, at a ratio of frequency to peak frequency.
fn shape(gamma: f64, ratio: f64) -> f64 {
    let width = if ratio <= 1.0 { 0.07 } else { 0.09 };
    let off = (ratio - 1.0) / width;
    let squared = ratio * ratio;
    libm::exp(-1.25 / (squared * squared)) * libm::pow(gamma, libm::exp(-0.5 * off * off))
        / (squared * squared * ratio)
}

/// Components of a spectrum, sorted by frequency.
pub fn components(spectrum: &Spectrum, count: usize, seed: u64) -> Vec<Component> {
    let amplitude_m = 0.25 * spectrum.significant_height_m * libm::sqrt(2.0 / count as f64);
    let peak_rad_s = TAU / spectrum.peak_period_s;
    let ratios = ratios(spectrum.gamma, count);
    let phases = (0..count as u64).map(|index| TAU * unit(seed, index));
    ratios
        .iter()
        .zip(phases)
        .map(|(ratio, phase_rad)| Component {
            amplitude_m,
            frequency_rad_s: ratio * peak_rad_s,
            phase_rad,
        })
        .collect()
}

/// Frequencies of `count` equal shares of energy, as multiples of the peak frequency.
fn ratios(gamma: f64, count: usize) -> Vec<f64> {
    let strips = strips(gamma);
    let whole: f64 = strips.iter().map(|strip| strip.0).sum();
    debug_assert!(count > 0, "a spectrum needs at least one component");
    let mut ratios = Vec::with_capacity(count);
    let (mut energy, mut moment) = (0.0, 0.0);
    let share = whole / count as f64;
    for (mut strip_energy, strip_moment) in strips {
        let mean_square = strip_moment / strip_energy;
        while energy + strip_energy >= share && ratios.len() + 1 < count {
            let part = share - energy;
            ratios.push(libm::sqrt((moment + part * mean_square) / share));
            strip_energy -= part;
            (energy, moment) = (0.0, 0.0);
        }
        energy += strip_energy;
        moment += strip_energy * mean_square;
    }
    ratios.push(libm::sqrt(moment / energy));
    ratios
}

/// Energy and its second moment in intervals of equal width in the logarithm of frequency, by the midpoint rule.
fn strips(gamma: f64) -> Vec<(f64, f64)> {
    let step = libm::log(RANGE.1 / RANGE.0) / f64::from(STRIPS);
    let strip = |index: u32| {
        let ratio = RANGE.0 * libm::exp(step * (f64::from(index) + 0.5));
        let energy = shape(gamma, ratio) * ratio * step;
        (energy, energy * ratio * ratio)
    };
    (0..STRIPS).map(strip).filter(|strip| strip.0 > 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The dispersion relation, from very shallow to deep water, and both limits in closed form.
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

    /// Miche: 0.142 of the wavelength in deep water.
    #[test]
    fn waves_break_at_a_seventh_of_their_length_in_deep_water() {
        let length = TAU / wave_number(TAU / 6.0, 500.0, 9.81);
        assert!((breaking_height(6.0, 500.0, 9.81) / length - 0.1416).abs() < 1e-3);
    }

    const SEA: Spectrum = Spectrum { significant_height_m: 1.2, peak_period_s: 5.0, gamma: 3.3 };

    fn moment(sea: &[Component], power: f64) -> f64 {
        sea.iter()
            .map(|wave| {
                0.5 * wave.amplitude_m * wave.amplitude_m * libm::pow(wave.frequency_rad_s, power)
            })
            .sum()
    }

    /// `H_s = 4 √m₀`, and the zero-crossing period against the fit of DNV-RP-C205, 3.5.5.5.
    #[test]
    fn components_carry_the_height_and_period_of_the_spectrum() {
        for (gamma, count) in [(1.0, 8), (3.3, 8), (3.3, 64), (5.0, 200)] {
            let sea = components(&Spectrum { gamma, ..SEA }, count, 1);
            assert_eq!(sea.len(), count);
            let height = 4.0 * moment(&sea, 0.0).sqrt();
            assert!((height / 1.2 - 1.0).abs() < 1e-12, "{height}");
            let crossing = TAU * (moment(&sea, 0.0) / moment(&sea, 2.0)).sqrt() / 5.0;
            let fit = 0.6673 + 0.05037 * gamma - 0.006230 * gamma * gamma
                + 0.0003341 * gamma * gamma * gamma;
            println!(
                "gamma {gamma}, {count} components: crossing period {crossing:.4} of the peak's, fit {fit:.4}"
            );
            assert!((crossing / fit - 1.0).abs() < 0.012, "{crossing} for {fit}");
        }
    }

    /// Variance and zero up-crossings of three hours of record at the origin, sampled every 0.1 s.
    #[test]
    fn a_record_has_the_height_and_the_crossings_of_its_spectrum() {
        let sea = components(&SEA, 64, 7);
        let height = |time: f64| {
            sea.iter()
                .map(|wave| {
                    wave.amplitude_m * libm::cos(wave.phase_rad - wave.frequency_rad_s * time)
                })
                .sum::<f64>()
        };
        let record: Vec<f64> = (0..108_000).map(|sample| height(0.1 * f64::from(sample))).collect();
        let variance =
            record.iter().map(|height| height * height).sum::<f64>() / record.len() as f64;
        assert!((4.0 * variance.sqrt() / 1.2 - 1.0).abs() < 0.01, "{}", 4.0 * variance.sqrt());
        let crossings = record.windows(2).filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count();
        let expected = TAU * (moment(&sea, 0.0) / moment(&sea, 2.0)).sqrt();
        assert!(
            (10_800.0 / crossings as f64 / expected - 1.0).abs() < 0.03,
            "{crossings} crossings"
        );
    }

    /// The autocorrelation from twenty waves to three hours is far below 1.
    #[test]
    fn a_record_of_three_hours_does_not_repeat() {
        let sea = components(&SEA, 64, 1);
        let correlation = |lag: f64| {
            sea.iter().map(|wave| libm::cos(wave.frequency_rad_s * lag)).sum::<f64>()
                / sea.len() as f64
        };
        let greatest =
            (1000..108_000).map(|lag| correlation(0.1 * f64::from(lag))).fold(0.0, f64::max);
        println!("greatest correlation after 100 s: {greatest:.2}");
        assert!(greatest < 0.6, "{greatest}");
    }

    #[test]
    fn a_seed_gives_one_sea_and_another_seed_another() {
        assert_eq!(components(&SEA, 16, 3), components(&SEA, 16, 3));
        assert_ne!(components(&SEA, 16, 3), components(&SEA, 16, 4));
    }
}
