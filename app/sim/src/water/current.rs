//! Current over height and time.
//!
//! Symbols: `h` height above the seabed as a share of the depth, `p` velocity as a share of that at the surface, `n` exponent,
//! `z` height [m], `u*` friction velocity [m/s], `kappa` = 0.4, `z0` roughness length of the bed [m], `r = z0/depth`.
//!
//! | profile | law |
//! |---|---|
//! | power law | `p(h) = h^n`, `n` = 1/7 for a tidal stream |
//! | logarithmic law | `u(z) = (u*/kappa) ln((z + z0)/z0)`, so that `p(h) = ln(1 + h/r)/ln(1 + 1/r)` |
//! | table | linear interpolation of both components, so that the direction may also vary with height |
//!
//! The logarithmic law is that of a turbulent boundary layer over a rough bed; its mean over the depth is
//! `(1 + r) - 1/ln(1 + 1/r)` of the surface velocity. With the origin at `-z0` it is zero on the bed and never negative. It
//! differs from `ln(z/z0)` by 5 % at ten roughness lengths and by 0.3 % at a hundred.
//! References: Soulsby 1997, Dynamics of Marine Sands (doi:10.1680/doms.25844), section 3.3 for the power law and chapter 3 for
//! roughness lengths; Richards and Hoxey 1993 for the logarithmic form (doi:10.1016/0167-6105(93)90124-7).
//!
//! Tidal constituent: `S(t) = R + U cos φ + r (ẑ × U) sin φ`, `φ = 2π (t - t₀)/P`, with `R` the residual [m/s], `U` the
//! velocity at the peak `t₀` [m/s], `P` the period (12.42 h for M2) [s], and `r` the ratio of the minor to the major axis of
//! the tidal ellipse, positive if the velocity turns anticlockwise seen from above. Without residual and minor axis, slack
//! water is a quarter of a period after the peak. Reference: Pugh 1987, Tides, Surges and Mean Sea-Level, section 5:3.
//!
//! The solver evaluates a law as a table of cubic pieces, four per doubling of the height, with the values and slopes of the
//! law at their ends. The exponent of a double and the first two bits of its fraction are the index of the piece, and the rest
//! of the fraction is the position in it. Evaluation therefore needs no power, logarithm, division or search.
//! The error of a piece is at most `4^-4/384` times the greatest `h^4` times the fourth derivative of the law in it. This is
//! below 1e-5 for a power law, where the product is `n (1 - n)(2 - n)(3 - n)` of the value, and below 1e-4 for the logarithmic
//! law, where it is `6/ln(1 + 1/r)` of the surface velocity.
//! Near the bed the table is linear to zero: a power law from 5e-4 of the surface velocity, because statics of rope on the
//! seabed converge ten times more slowly in a residual current; the logarithmic law from 0.01 `z0`, where it is almost linear.
//! The total error is below 0.1 % of the surface velocity.

use core::f64::consts::TAU;

use glam::DVec3;

/// Variation of the current with height, as a share of its velocity where it is fastest.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// Uniform over the depth.
    Uniform,
    /// Power law with this positive exponent.
    Power(f64),
    /// Logarithmic law; roughness length as a positive share of the depth.
    Log(f64),
    /// Rows sorted by height; constant below the first and above the last.
    Table(Vec<ProfileRow>),
}

/// The current at one height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileRow {
    /// Height above the seabed as a share of the depth.
    pub height: f64,
    /// Component along the fastest velocity, as a share of it.
    pub along: f64,
    /// Component to the left of the fastest velocity, as a share of it.
    pub left: f64,
}

impl Profile {
    /// Power law; an exponent of zero is uniform.
    pub fn power(exponent: f64) -> Self {
        if exponent > 0.0 { Self::Power(exponent) } else { Self::Uniform }
    }

    /// Velocity at a height from 0 to 1, from the fastest velocity [m/s].
    pub fn turn(&self, fastest: DVec3, height: f64) -> DVec3 {
        match self {
            Self::Uniform => fastest,
            Self::Power(exponent) => fastest * libm::pow(height, *exponent),
            Self::Log(roughness) => {
                fastest * (libm::log1p(height / roughness) / libm::log1p(1.0 / roughness))
            }
            Self::Table(rows) => {
                let (along, left) = profile_between(rows, height);
                fastest * along + DVec3::new(-fastest.y, fastest.x, 0.0) * left
            }
        }
    }
}

/// Components at a height, by linear interpolation between rows.
fn profile_between(rows: &[ProfileRow], height: f64) -> (f64, f64) {
    debug_assert!(rows.is_sorted_by(|low, high| low.height < high.height), "heights must increase");
    let above = rows.partition_point(|row| row.height <= height);
    match (above.checked_sub(1).and_then(|below| rows.get(below)), rows.get(above)) {
        (Some(low), Some(high)) => {
            let share = (height - low.height) / (high.height - low.height);
            (
                low.along + (high.along - low.along) * share,
                low.left + (high.left - low.left) * share,
            )
        }
        (Some(end), None) | (None, Some(end)) => (end.along, end.left),
        (None, None) => (0.0, 0.0),
    }
}

/// Variation of the current with time.
#[derive(Clone, Debug, PartialEq)]
pub enum Tide {
    /// Constant.
    Steady,
    /// One tidal constituent about a residual.
    Constituent {
        /// Period [s].
        period_s: f64,
        /// A time at which it has the velocity of the current [s].
        peak_s: f64,
        /// Ratio of the minor to the major axis of its ellipse; positive if it turns anticlockwise.
        minor: f64,
        /// Mean over a period [m/s].
        residual_m_s: DVec3,
    },
    /// Velocities that replace that of the current, sorted by time; constant before the first and after the last.
    Table(Vec<(f64, DVec3)>),
}

impl Tide {
    /// Velocity at the fastest height at a time, from the velocity of the current [m/s].
    pub fn velocity(&self, own: DVec3, time_s: f64) -> DVec3 {
        match self {
            Self::Steady => own,
            Self::Constituent { period_s, peak_s, minor, residual_m_s } => {
                let (sine, cosine) =
                    libm::sincos(TAU * libm::fmod(time_s - peak_s, *period_s) / period_s);
                *residual_m_s + own * cosine + DVec3::new(-own.y, own.x, 0.0) * (minor * sine)
            }
            Self::Table(rows) => velocity_between(rows, time_s),
        }
    }
}

/// Velocity at a time, by linear interpolation between rows [m/s].
fn velocity_between(rows: &[(f64, DVec3)], time_s: f64) -> DVec3 {
    debug_assert!(rows.is_sorted_by(|first, second| first.0 < second.0), "times must increase");
    let after = rows.partition_point(|(time, _)| *time <= time_s);
    match (after.checked_sub(1).and_then(|before| rows.get(before)), rows.get(after)) {
        (Some((from, first)), Some((until, second))) => {
            *first + (*second - *first) * ((time_s - from) / (until - from))
        }
        (Some((_, end)), None) | (None, Some((_, end))) => *end,
        (None, None) => DVec3::ZERO,
    }
}

/// Pieces per doubling of the height.
const PIECES: u32 = 4;

/// Bits of a double's fraction below those of the piece index.
const SHIFT: u32 = 52 - PIECES.ilog2();

/// Bits of a double's fraction.
const FRACTION: u64 = (1 << 52) - 1;

/// Share of the surface velocity below which a power law is replaced by a straight line.
const LEAST_SHARE: f64 = 5e-4;

/// Share of the roughness length below which the logarithmic law is replaced by a straight line.
const LEAST_ROUGHNESS: f64 = 0.01;

/// A law of the current as cubic pieces over the height.
#[derive(Clone, Debug, PartialEq)]
pub struct LawTable {
    /// Lower end of the first piece.
    least: f64,
    /// Coefficients of each piece, in powers of the position in it.
    pieces: Vec<[f64; 4]>,
}

impl LawTable {
    /// Table of a profile; `None` for one that needs no table.
    pub fn of(profile: &Profile) -> Option<Self> {
        match *profile {
            Profile::Power(exponent) => Some(Self::power(exponent)),
            Profile::Log(roughness) => Some(Self::log(roughness)),
            Profile::Uniform | Profile::Table(_) => None,
        }
    }

    /// Power law with a positive exponent.
    fn power(exponent: f64) -> Self {
        Self::new(libm::log2(LEAST_SHARE) / exponent, |height| {
            let share = libm::pow(height, exponent);
            [share, exponent * share]
        })
    }

    /// Logarithmic law with a positive roughness.
    fn log(roughness: f64) -> Self {
        let whole = libm::log1p(1.0 / roughness);
        let least = libm::fmin(libm::log2(LEAST_ROUGHNESS * roughness), 0.0);
        Self::new(least, |height| {
            [libm::log1p(height / roughness) / whole, height / (height + roughness) / whole]
        })
    }

    /// Table of a law that returns its value and the height times its slope; `least` is the binary logarithm of the height
    /// below which it is linear.
    fn new(least: f64, law: impl Fn(f64) -> [f64; 2]) -> Self {
        // The exponent of the smallest normal number limits the height.
        let least = libm::exp2(libm::fmax(libm::floor(least), -1022.0));
        let (first, last) = (least.to_bits() >> SHIFT, 1.0_f64.to_bits() >> SHIFT);
        Self { least, pieces: (first..=last).map(|number| piece(&law, number)).collect() }
    }

    /// Share of the surface velocity at a height from 0 to 1.
    #[inline]
    pub fn share(&self, height: f64) -> f64 {
        let bits = height.max(self.least).to_bits();
        let number = ((bits >> SHIFT) - (self.least.to_bits() >> SHIFT)) as usize;
        let place = f64::from_bits(1.0_f64.to_bits() | (bits << (52 - SHIFT) & FRACTION)) - 1.0;
        // The last piece begins at a height of 1.
        let [one, two, three, four] = &self.pieces[number.min(self.pieces.len() - 1)];
        let share = one + place * (two + place * (three + place * four));
        if height < self.least { share * (height / self.least) } else { share }
    }
}

/// Cubic with the values and slopes of the law at the ends of a piece.
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
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_table_is_linear_between_rows_and_constant_beyond_its_ends() {
        let rows = vec![
            ProfileRow { height: 0.2, along: 0.4, left: 0.0 },
            ProfileRow { height: 0.8, along: 1.0, left: 0.6 },
        ];
        let at = |height| Profile::Table(rows.clone()).turn(DVec3::new(0.0, 2.0, 0.0), height);
        assert!((at(0.5) - DVec3::new(-0.6, 1.4, 0.0)).length() < 1e-15);
        assert!((at(0.0) - DVec3::new(0.0, 0.8, 0.0)).length() < 1e-15);
        assert!((at(1.0) - DVec3::new(-1.2, 2.0, 0.0)).length() < 1e-15);
    }

    #[test]
    fn a_constituent_peaks_turns_and_is_periodic() {
        let own = DVec3::new(0.3, 0.4, 0.0);
        let tide = |minor, residual_m_s| Tide::Constituent {
            period_s: 44_712.0,
            peak_s: 1000.0,
            minor,
            residual_m_s,
        };
        let straight = tide(0.0, DVec3::ZERO);
        assert!((straight.velocity(own, 1000.0) - own).length() < 1e-15);
        assert!((straight.velocity(own, 1000.0 + 22_356.0) + own).length() < 1e-12);
        assert!(straight.velocity(own, 1000.0 - 11_178.0).length() < 1e-12);
        let ellipse = tide(0.25, DVec3::X);
        assert!(
            (ellipse.velocity(own, 1000.0 + 11_178.0) - DVec3::new(1.0 - 0.1, 0.075, 0.0)).length()
                < 1e-12
        );
        // Its mean over a period is the residual.
        let mean =
            (0..100).map(|part| ellipse.velocity(own, 447.12 * f64::from(part))).sum::<DVec3>()
                / 100.0;
        assert!((mean - DVec3::X).length() < 1e-12);
    }

    #[test]
    fn a_table_is_linear_between_its_rows() {
        let tide = Tide::Table(vec![(10.0, DVec3::X), (20.0, DVec3::Y * 3.0)]);
        assert_eq!(tide.velocity(DVec3::Z, 0.0), DVec3::X);
        assert!((tide.velocity(DVec3::Z, 15.0) - DVec3::new(0.5, 1.5, 0.0)).length() < 1e-15);
        assert_eq!(tide.velocity(DVec3::Z, 30.0), DVec3::Y * 3.0);
    }

    /// At every power of two, within every doubling, at bed and surface: power laws from nearly uniform to linear, and beds
    /// from smooth mud in deep water to a roughness length greater than the depth.
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

    /// The depth mean of the logarithmic law is `(1 + r) - 1/ln(1 + 1/r)`; that of the table is computed by the trapezium rule.
    #[test]
    fn the_mean_of_the_logarithmic_law_is_its_integral() {
        for roughness in [1e-5_f64, 1e-4, 1e-3, 0.1] {
            let table = LawTable::log(roughness);
            // Heights proportional to the square of their index are dense near the bed.
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

    /// Textbook law `ln(z/z0)` between two heights far above the roughness length: 0.3 m/s at 1.5 m over gravel of 3 mm gives
    /// 0.334 m/s at 3 m.
    #[test]
    fn speeds_at_two_heights_are_as_their_logarithms() {
        let (depth, rough) = (30.0, 3e-3);
        let table = LawTable::log(rough / depth);
        let ratio = table.share(3.0 / depth) / table.share(1.5 / depth);
        assert!((ratio - libm::log(3.0 / rough) / libm::log(1.5 / rough)).abs() < 1e-3, "{ratio}");
    }
}
