//! A law of the current by height in cubic pieces, for the solver.
//!
//! Four pieces to each doubling of the height, with the law's own values and slopes at their ends: a double's exponent and
//! first two bits of its fraction number them, the rest of its fraction is the place within, so that no power, logarithm,
//! division or search is needed. A piece's error is at most `4^-4/384` times the greatest `h^4` times the law's fourth
//! derivative in it: for a power law `n (1 - n)(2 - n)(3 - n)` of the value, below 1e-5; for the logarithmic law
//! `6/ln(1 + 1/r)` of the surface speed, below 1e-4. Near the bed a straight line to zero follows the law: a power law from
//! where it has fallen to 5e-4 of the surface speed (rope that lies on the seabed would else feel a trace of current, and
//! statics wander for ten times the passes), the logarithmic law from a hundredth of the roughness length, where it is all but
//! straight. Everywhere the error is below 0.1 % of the surface speed.

use super::profile::Profile;

/// Pieces in each doubling of the height.
const PIECES: u32 = 4;
/// Bits of a double's fraction below those that count the pieces.
const SHIFT: u32 = 52 - PIECES.ilog2();
/// Bits of a double's fraction.
const FRACTION: u64 = (1 << 52) - 1;
/// Share of the surface speed below which a power law is not followed down to the seabed.
const LEAST_SHARE: f64 = 5e-4;

/// Share of the roughness length below which the logarithmic law is a straight line.
const LEAST_ROUGHNESS: f64 = 0.01;

/// A law of the current by height in cubic pieces.
#[derive(Clone, Debug, PartialEq)]
pub struct LawTable {
    /// Height at which the first piece begins.
    least: f64,
    /// Coefficients of each piece by the share of its width.
    pieces: Vec<[f64; 4]>,
}

impl LawTable {
    /// Of a profile that is a law; `None` of one that needs no table.
    #[must_use]
    pub fn of(profile: &Profile) -> Option<Self> {
        match *profile {
            Profile::Power(exponent) => Some(Self::power(exponent)),
            Profile::Log(roughness) => Some(Self::log(roughness)),
            Profile::Uniform | Profile::Table(_) => None,
        }
    }

    /// Power law with an exponent above zero.
    fn power(exponent: f64) -> Self {
        Self::new(libm::log2(LEAST_SHARE) / exponent, |height| {
            let share = libm::pow(height, exponent);
            [share, exponent * share]
        })
    }

    /// Logarithmic law over a roughness above zero.
    fn log(roughness: f64) -> Self {
        let whole = libm::log1p(1.0 / roughness);
        let least = libm::fmin(libm::log2(LEAST_ROUGHNESS * roughness), 0.0);
        Self::new(least, |height| {
            [libm::log1p(height / roughness) / whole, height / (height + roughness) / whole]
        })
    }

    /// Of a law that answers the share and the height times its slope; `least` is the doubling below which it is straight.
    fn new(least: f64, law: impl Fn(f64) -> [f64; 2]) -> Self {
        // The exponent of the least positive normal number bounds how far down it goes.
        let least = libm::exp2(libm::fmax(libm::floor(least), -1022.0));
        let (first, last) = (least.to_bits() >> SHIFT, 1.0_f64.to_bits() >> SHIFT);
        Self { least, pieces: (first..=last).map(|number| piece(&law, number)).collect() }
    }

    /// Share of the surface speed at a height from 0 to 1.
    #[inline]
    #[must_use]
    pub fn share(&self, height: f64) -> f64 {
        let bits = height.max(self.least).to_bits();
        let number = ((bits >> SHIFT) - (self.least.to_bits() >> SHIFT)) as usize;
        let place = f64::from_bits(1.0_f64.to_bits() | (bits << (52 - SHIFT) & FRACTION)) - 1.0;
        let [one, two, three, four] =
            self.pieces.get(number).copied().unwrap_or([1.0, 0.0, 0.0, 0.0]);
        let share = one + place * (two + place * (three + place * four));
        if height < self.least { share * (height / self.least) } else { share }
    }
}

/// The cubic with the law's values and slopes at the ends of a piece.
fn piece(law: impl Fn(f64) -> [f64; 2], number: u64) -> [f64; 4] {
    let (low, high) = (f64::from_bits(number << SHIFT), f64::from_bits((number + 1) << SHIFT));
    let ([at_low, slope_low], [at_high, slope_high]) = (law(low), law(high));
    let rise = at_high - at_low;
    let (rate_low, rate_high) =
        (slope_low * ((high - low) / low), slope_high * ((high - low) / high));
    [at_low, rate_low, 3.0 * rise - 2.0 * rate_low - rate_high, rate_low + rate_high - 2.0 * rise]
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// At every power of two, within every doubling, at bed and surface: from a nearly uniform to a linear power law, from
    /// smooth mud in the deep sea to a bed rougher than the water is deep.
    #[test]
    fn the_table_is_within_a_tenth_of_a_percent_of_the_surface_speed_everywhere() {
        let powers = [0.02, 0.1, 1.0 / 7.0, 0.25, 0.5, 0.8, 1.0].map(Profile::Power);
        let logs = [1e-8, 1e-5, 1e-4, 1e-2, 1.0, 3.0].map(Profile::Log);
        let mut worst = 0.0_f64;
        for profile in powers.iter().chain(&logs) {
            let table = LawTable::of(profile).unwrap();
            let heights = (0..1000).flat_map(|doublings| {
                (0..97).map(move |part| {
                    libm::exp2(-f64::from(doublings)) * (1.0 - f64::from(part) / 194.0)
                })
            });
            for height in heights.chain([0.0, f64::MIN_POSITIVE, 5e-324]) {
                worst = worst.max((table.share(height) - profile.turn(DVec3::X, height).x).abs());
            }
            assert!((table.share(1.0) - 1.0).abs() < 1e-15, "{profile:?}");
        }
        println!("worst error of the table: {worst:.2e}");
        assert!(worst < 1e-3, "{worst}");
    }

    /// The depth mean of the logarithmic law is `(1 + r) - 1/ln(1 + 1/r)`; a table of it has the same, by the trapezium rule.
    #[test]
    fn the_mean_of_the_logarithmic_law_is_its_integral() {
        for roughness in [1e-5_f64, 1e-4, 1e-3, 0.1] {
            let table = LawTable::log(roughness);
            // Heights that rise as the square of their number are close together near the bed.
            let heights: Vec<f64> =
                (0..=20_000).map(|number| f64::from(number) * f64::from(number) / 4e8).collect();
            let part = |ends: &[f64]| {
                0.5 * (table.share(ends[0]) + table.share(ends[1])) * (ends[1] - ends[0])
            };
            let mean: f64 = heights.windows(2).map(part).sum();
            let exact = 1.0 + roughness - 1.0 / libm::log1p(1.0 / roughness);
            assert!((mean - exact).abs() < 5e-5, "{roughness}: {mean} for {exact}");
        }
    }

    /// The textbook law `ln(z/z0)` between two heights well above the roughness: 0.3 m/s at 1.5 m over gravel of 3 mm is
    /// 0.334 m/s at 3 m.
    #[test]
    fn speeds_at_two_heights_are_as_their_logarithms() {
        let (depth, rough) = (30.0, 3e-3);
        let table = LawTable::log(rough / depth);
        let ratio = table.share(3.0 / depth) / table.share(1.5 / depth);
        assert!((ratio - libm::log(3.0 / rough) / libm::log(1.5 / rough)).abs() < 1e-3, "{ratio}");
    }
}
