//! Current by time: steady, a tidal constituent, or a table.
//!
//! Constituent: `S(t) = R + U cos φ + r (ẑ × U) sin φ`, `φ = 2π (t - t₀)/P`, with `R` the residual, `U` the velocity at
//! its peak `t₀`, `P` the period (12.42 h for M2) and `r` the ellipse's minor axis over its major one, above zero where
//! the velocity turns anticlockwise seen from above. Slack water of a constituent without residual and minor axis is a
//! quarter of a period from its peak. Reference: Pugh 1987, Tides, Surges and Mean Sea-Level, section 5:3.

use core::f64::consts::TAU;

use glam::DVec3;

/// How the current changes with time.
#[derive(Clone, Debug, PartialEq)]
pub enum Tide {
    /// Not at all.
    Steady,
    /// One tidal constituent about a residual.
    Constituent {
        /// Period [s].
        period_s: f64,
        /// A time at which it runs with the current's own velocity [s].
        peak_s: f64,
        /// Minor axis of its ellipse over the major one, above zero where it turns anticlockwise.
        minor: f64,
        /// What is left when the constituent is averaged out [m/s].
        residual_m_s: DVec3,
    },
    /// Velocity at times in rising order, in place of the current's own; before the first and after the last as there.
    Table(Vec<(f64, DVec3)>),
}

impl Tide {
    /// Velocity where the current is fastest, from that before the tide turns it [m/s].
    #[must_use]
    pub fn velocity(&self, own: DVec3, time_s: f64) -> DVec3 {
        match self {
            Self::Steady => own,
            Self::Constituent { period_s, peak_s, minor, residual_m_s } => {
                let (sine, cosine) =
                    libm::sincos(TAU * libm::fmod(time_s - peak_s, *period_s) / period_s);
                *residual_m_s + own * cosine + DVec3::new(-own.y, own.x, 0.0) * (minor * sine)
            }
            Self::Table(rows) => between(rows, time_s),
        }
    }
}

fn between(rows: &[(f64, DVec3)], time_s: f64) -> DVec3 {
    let after = rows.partition_point(|(time, _)| *time <= time_s);
    match (after.checked_sub(1).and_then(|before| rows.get(before)), rows.get(after)) {
        (Some((from, first)), Some((until, second))) => {
            *first + (*second - *first) * ((time_s - from) / (until - from))
        }
        (Some((_, end)), None) | (None, Some((_, end))) => *end,
        (None, None) => DVec3::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constituent_peaks_turns_and_comes_back() {
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
}
