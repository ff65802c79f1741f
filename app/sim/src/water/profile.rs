//! Current by height: uniform, by a power law, or a table.
//!
//! Power law: `p(h) = h^n`, `h` the height above the seabed as a share of the depth, `n` the exponent (1/7 for a tidal
//! stream). Reference: Soulsby 1997, Dynamics of Marine Sands, section 3.3 (doi:10.1680/doms.25844).
//! Table: linear between its rows in both components, so that the direction turns with height too.

use glam::DVec3;

/// How the current changes with height, as a share of its velocity where it is fastest.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// The same at every height.
    Uniform,
    /// Power law with this exponent, above zero.
    Power(f64),
    /// Rows in rising order of height; below the first and above the last as there.
    Table(Vec<ProfileRow>),
}

/// The current at one height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileRow {
    /// Height above the seabed as a share of the depth.
    pub height: f64,
    /// Share of the fastest velocity that runs the same way.
    pub along: f64,
    /// Share of it that runs at right angles to the left.
    pub left: f64,
}

impl Profile {
    /// Power law; an exponent of zero is uniform.
    #[must_use]
    pub fn power(exponent: f64) -> Self {
        if exponent > 0.0 { Self::Power(exponent) } else { Self::Uniform }
    }

    /// The velocity at a height from 0 to 1, from that where the current is fastest.
    #[must_use]
    pub fn turn(&self, fastest: DVec3, height: f64) -> DVec3 {
        match self {
            Self::Uniform => fastest,
            Self::Power(exponent) => fastest * libm::pow(height, *exponent),
            Self::Table(rows) => {
                let (along, left) = between(rows, height);
                fastest * along + DVec3::new(-fastest.y, fastest.x, 0.0) * left
            }
        }
    }
}

/// Both shares at a height, linear between rows.
fn between(rows: &[ProfileRow], height: f64) -> (f64, f64) {
    let above = rows.partition_point(|row| row.height <= height);
    match (above.checked_sub(1).and_then(|below| rows.get(below)), rows.get(above)) {
        (Some(low), Some(high)) => {
            let share = (height - low.height) / (high.height - low.height);
            (low.along + (high.along - low.along) * share, low.left + (high.left - low.left) * share)
        }
        (Some(end), None) | (None, Some(end)) => (end.along, end.left),
        (None, None) => (0.0, 0.0),
    }
}

/// Pieces in each doubling of the height.
const PIECES: u32 = 4;
/// Bits of a double's fraction below those that count the pieces.
const SHIFT: u32 = 52 - PIECES.ilog2();
/// Bits of a double's fraction.
const FRACTION: u64 = (1 << 52) - 1;
/// Share of the surface speed below which the law is not followed down to the seabed.
const LEAST_SHARE: f64 = 5e-4;

/// A power law in cubic pieces, for the solver.
///
/// Four pieces to each doubling of the height, with the law's own values and slopes at their ends: a double's exponent and
/// first two bits of its fraction number them, the rest of its fraction is the place within, so that no power, division
/// or search is needed. A piece's error is below `n (1 - n)(2 - n)(3 - n)/384 · 4⁻⁴ ≤ 1e-5` of the value. Below the height
/// where the law has fallen to 5e-4 of the surface speed it falls straight to zero (rope that lies
/// on the seabed would else feel a trace of current, and statics wander for ten times the passes). Everywhere the error is below 0.1 % of
/// the surface speed.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerTable {
    /// Height at which the first piece begins.
    least: f64,
    /// Coefficients of each piece by the share of its width.
    pieces: Vec<[f64; 4]>,
}

impl PowerTable {
    /// For an exponent above zero.
    #[must_use]
    pub fn new(exponent: f64) -> Self {
        // The exponent of the least positive normal number bounds how far down it goes.
        let least = libm::exp2(libm::fmax(libm::floor(libm::log2(LEAST_SHARE) / exponent), -1022.0));
        let (first, last) = (least.to_bits() >> SHIFT, 1.0_f64.to_bits() >> SHIFT);
        Self { least, pieces: (first..=last).map(|number| piece(exponent, number)).collect() }
    }

    /// Share of the surface speed at a height from 0 to 1.
    #[inline]
    #[must_use]
    pub fn share(&self, height: f64) -> f64 {
        let bits = height.max(self.least).to_bits();
        let number = ((bits >> SHIFT) - (self.least.to_bits() >> SHIFT)) as usize;
        let place = f64::from_bits(1.0_f64.to_bits() | (bits << (52 - SHIFT) & FRACTION)) - 1.0;
        let [one, two, three, four] = self.pieces.get(number).copied().unwrap_or([1.0, 0.0, 0.0, 0.0]);
        let share = one + place * (two + place * (three + place * four));
        if height < self.least { share * (height / self.least) } else { share }
    }
}

/// The cubic with the law's values and slopes at the ends of a piece.
fn piece(exponent: f64, number: u64) -> [f64; 4] {
    let (low, high) = (f64::from_bits(number << SHIFT), f64::from_bits((number + 1) << SHIFT));
    let (at_low, at_high) = (libm::pow(low, exponent), libm::pow(high, exponent));
    let rise = at_high - at_low;
    let (rate_low, rate_high) = (exponent * at_low * ((high - low) / low), exponent * at_high * ((high - low) / high));
    [at_low, rate_low, 3.0 * rise - 2.0 * rate_low - rate_high, rate_low + rate_high - 2.0 * rise]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At every power of two, within every doubling, at bed and surface; exponents from a nearly uniform to a linear law.
    #[test]
    fn the_table_is_within_a_tenth_of_a_percent_of_the_surface_speed_everywhere() {
        let mut worst = 0.0_f64;
        for exponent in [0.02, 0.1, 1.0 / 7.0, 0.25, 0.5, 0.8, 1.0] {
            let table = PowerTable::new(exponent);
            let heights = (0..1000)
                .flat_map(|doublings| (0..97).map(move |part| libm::exp2(-f64::from(doublings)) * (1.0 - f64::from(part) / 194.0)));
            for height in heights.chain([0.0, f64::MIN_POSITIVE, 5e-324]) {
                worst = worst.max((table.share(height) - libm::pow(height, exponent)).abs());
            }
        }
        println!("worst error of the table: {worst:.2e}");
        assert!(worst < 1e-3, "{worst}");
        assert!((PowerTable::new(1.0 / 7.0).share(1.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn rows_are_joined_by_straight_lines_and_hold_beyond_their_ends() {
        let rows = vec![ProfileRow { height: 0.2, along: 0.4, left: 0.0 }, ProfileRow { height: 0.8, along: 1.0, left: 0.6 }];
        let at = |height| Profile::Table(rows.clone()).turn(DVec3::new(0.0, 2.0, 0.0), height);
        assert!((at(0.5) - DVec3::new(-0.6, 1.4, 0.0)).length() < 1e-15);
        assert!((at(0.0) - DVec3::new(0.0, 0.8, 0.0)).length() < 1e-15);
        assert!((at(1.0) - DVec3::new(-1.2, 2.0, 0.0)).length() < 1e-15);
    }
}
