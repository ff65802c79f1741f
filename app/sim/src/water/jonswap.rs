//! Irregular waves: the JONSWAP spectrum and the components it is cut into.
//!
//! `S(ω) = C ω⁻⁵ exp(-5/4 (ω_p/ω)⁴) γ^b`, `b = exp(-(ω - ω_p)²/(2 σ² ω_p²))`, `σ` = 0.07 below the peak frequency `ω_p` and
//! 0.09 above, between half and ten times `ω_p`, with `C` such that `m₀ = ∫ S dω = H_s²/16` there.
//! Each component takes an equal share of `m₀`, from the lowest frequencies to the highest, and runs at the root mean
//! square frequency of its share: `m₀` and `m₂ = ∫ ω² S dω`, hence `H_s` and the mean zero-crossing period
//! `2π (m₀/m₂)^½`, are exact for any number of components, and as no two spacings are alike the record does not repeat.
//! Phases are drawn evenly from the seed (SplitMix64), so that one seed gives one sea.
//! Reference: Hasselmann et al. 1973, Measurements of wind-wave growth and swell decay during JONSWAP; DNV-RP-C205,
//! section 3.5.5; Steele, Lea and Flood 2014 (doi:10.1145/2660193.2660195).

use core::f64::consts::TAU;

use super::component::Component;
use crate::random::unit;

/// Range of frequencies, over that of the peak.
const RANGE: (f64, f64) = (0.5, 10.0);
/// Strips of the numerical integral.
const STRIPS: u32 = 8192;

/// A JONSWAP spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum {
    /// Significant height `H_s = 4 √m₀` [m].
    pub significant_height_m: f64,
    /// Period of the peak [s].
    pub peak_period_s: f64,
    /// Peak enhancement γ: 1 for a fully grown sea, 3.3 on the mean of JONSWAP.
    pub gamma: f64,
}

/// Density of a spectrum at a frequency over the peak's, without the factor `C`.
fn shape(gamma: f64, ratio: f64) -> f64 {
    let width = if ratio <= 1.0 { 0.07 } else { 0.09 };
    let off = (ratio - 1.0) / width;
    let squared = ratio * ratio;
    libm::exp(-1.25 / (squared * squared)) * libm::pow(gamma, libm::exp(-0.5 * off * off))
        / (squared * squared * ratio)
}

/// The components of a spectrum in rising order of frequency.
#[must_use]
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

/// Frequencies of `count` equal shares of energy, over the peak's.
fn ratios(gamma: f64, count: usize) -> Vec<f64> {
    let strips = strips(gamma);
    let whole: f64 = strips.iter().map(|strip| strip.0).sum();
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

/// Energy and its second moment in strips of equal width in the logarithm of frequency, by the midpoint rule.
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

    /// The record's correlation with itself, from twenty waves on to three hours, stays far below 1.
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
