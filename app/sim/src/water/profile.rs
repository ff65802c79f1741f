//! Current by height: uniform, by a power law, a logarithmic law, or a table.
//!
//! `h` is the height above the seabed as a share of the depth, `p` the current there as a share of its velocity at the
//! surface.
//! Power law: `p(h) = h^n`, `n` the exponent (1/7 for a tidal stream). Reference: Soulsby 1997, Dynamics of Marine Sands,
//! section 3.3 (doi:10.1680/doms.25844).
//! Logarithmic law, of a turbulent boundary layer over a rough bed: `u(z) = (u*/kappa) ln((z + z0)/z0)` with `z` the height,
//! `u*` the friction velocity, `kappa` = 0.4 and `z0` the bed's roughness length, so that `p(h) = ln(1 + h/r)/ln(1 + 1/r)` with
//! `r = z0/depth`; its mean over the depth is `(1 + r) - 1/ln(1 + 1/r)` of the surface speed. Written about `-z0` it falls to zero
//! on the bed itself and nowhere below zero; ten roughness lengths up it is within 5 % of `ln(z/z0)`, at a hundred within 0.3 %.
//! References: Richards and Hoxey 1993 for this form (doi:10.1016/0167-6105(93)90124-7); Soulsby 1997, chapter 3, for the law
//! at sea and the roughness lengths of sea beds.
//! Table: linear between its rows in both components, so that the direction turns with height too.

use glam::DVec3;

/// How the current changes with height, as a share of its velocity where it is fastest.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// Equal at every height.
    Uniform,
    /// Power law with this exponent, above zero.
    Power(f64),
    /// Logarithmic law over a bed of this roughness length, as a share of the depth, above zero.
    Log(f64),
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
            Self::Log(roughness) => {
                fastest * (libm::log1p(height / roughness) / libm::log1p(1.0 / roughness))
            }
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
            (
                low.along + (high.along - low.along) * share,
                low.left + (high.left - low.left) * share,
            )
        }
        (Some(end), None) | (None, Some(end)) => (end.along, end.left),
        (None, None) => (0.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_joined_by_straight_lines_and_hold_beyond_their_ends() {
        let rows = vec![
            ProfileRow { height: 0.2, along: 0.4, left: 0.0 },
            ProfileRow { height: 0.8, along: 1.0, left: 0.6 },
        ];
        let at = |height| Profile::Table(rows.clone()).turn(DVec3::new(0.0, 2.0, 0.0), height);
        assert!((at(0.5) - DVec3::new(-0.6, 1.4, 0.0)).length() < 1e-15);
        assert!((at(0.0) - DVec3::new(0.0, 0.8, 0.0)).length() < 1e-15);
        assert!((at(1.0) - DVec3::new(-1.2, 2.0, 0.0)).length() < 1e-15);
    }
}
